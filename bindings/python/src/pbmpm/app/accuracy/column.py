"""A column of water at rest in a box: how much it sinks together, beside what the solver's compressibility predicts.

The column starts at its rest density, is let go, bounces and settles. Its height is twice the height of the centre of
mass, averaged over the last second and taken relative to the start: that does not depend on how single particles lie
at the surface.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..meter import Meter
from ..scene import Scene
from ..simulation import RunSettings, Simulation
from . import laws
from .common import (
    GRAVITY,
    PARTICLES_PER_AXIS,
    centre_height,
    centre_height_of,
    modulus_over_density,
    start_energy,
    timed_step,
    water_scene,
)
from .stability import StabilityJudge

DEFAULT_HEIGHT = 1.0
DEFAULT_CELLS = 32
WIDTH_RATIO = 0.5
BOX_HEIGHT = 1.5
DEFAULT_SECONDS = 5.0


@dataclass(frozen=True)
class Column:
    """The case at one size and resolution."""

    height: float = DEFAULT_HEIGHT
    """Rest height [m]."""
    cells: int = DEFAULT_CELLS
    """Cells over the height."""
    seconds: float = DEFAULT_SECONDS

    name = "column"

    @property
    def cell_size(self) -> float:
        return self.height / self.cells

    def facts(self) -> dict[str, Any]:
        """What a report says about the case."""
        return {
            "column_height": self.height,
            "cell_size": self.cell_size,
            "particles_per_axis": PARTICLES_PER_AXIS,
            "seconds": self.seconds,
            "timing": "one run",
        }

    def scene(self) -> Scene:
        """The column in its box."""
        width = WIDTH_RATIO * self.height
        description = "Hydrostatic column: the settled height shows the compressibility of the solver."
        return water_scene(
            "column_2d", description, self.cell_size, (width, BOX_HEIGHT * self.height), (width, self.height), self.seconds, iterations=10
        )

    def measure(self, settings: RunSettings) -> dict[str, Any]:
        """One row of the sweep."""
        steps = max(1, math.ceil(self.seconds * settings.rate_hz))
        last_second = steps - min(steps, math.ceil(settings.rate_hz))
        whole, settled, judge = Meter(), Meter(), StabilityJudge()
        centres: list[float] = []
        with Simulation(self.scene(), settings) as simulation:
            centre = centre_height(simulation)
            judge.begin(start_energy(simulation))
            for step in range(steps):
                stats = timed_step(simulation, whole if step < last_second else settled, judge)
                if judge.broken:
                    break
                if step >= last_second:
                    centres.append(centre_height_of(stats))
        ratio = float(np.mean(centres)) / centre if centres and not judge.broken else None
        seconds = (whole.seconds + settled.seconds) / ((whole.steps + settled.steps) * settings.dt)
        return self._row(settings, 1e3 * seconds, ratio, settled if settled.steps else whole, judge)

    def _row(self, settings: RunSettings, cost: float, ratio: float | None, meter: Meter, judge: StabilityJudge) -> dict[str, Any]:
        modulus = modulus_over_density(self.scene(), settings)
        predicted = laws.settled_height_ratio(self.height, GRAVITY, modulus)
        if ratio is not None:
            judge.settle(ratio, predicted)
        return {
            "rate_hz": settings.rate_hz,
            "iterations": settings.iterations,
            "ms_per_simulated_second": cost,
            "height_error": None if ratio is None else ratio - 1.0,
            "height_error_law": predicted - 1.0,
            "volume_error_rms": meter.volume_error_rms,
            "volume_error_law": laws.settled_volume_error(self.height, GRAVITY, modulus),
            "energy_peak": judge.energy_peak,
            "stable": not judge.reasons,
            "reasons": judge.reasons,
        }
