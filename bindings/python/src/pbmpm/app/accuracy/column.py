"""A column of water at rest in a box: how much it sinks together, beside what the solver's compressibility predicts.

The column starts at its rest density, is let go, bounces and settles. Its height is taken from the uppermost
TOP_SHARE of its particles, averaged over them and over the last second: that does not depend on how single particles
lie at the surface.
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
TOP_SHARE = 0.05


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
            "column_2d",
            description,
            self.cell_size,
            (width, BOX_HEIGHT * self.height),
            (width, self.height),
            self.seconds,
            iterations=10,
        )

    def measure(self, settings: RunSettings) -> dict[str, Any]:
        """One row of the sweep."""
        steps = max(1, math.ceil(self.seconds * settings.rate_hz))
        last_second = steps - min(steps, math.ceil(settings.rate_hz))
        whole, settled, judge = Meter(), Meter(), StabilityJudge()
        heights: list[float] = []
        with Simulation(self.scene(), settings) as simulation:
            start = self._top(simulation)
            judge.begin(start_energy(simulation))
            for step in range(steps):
                timed_step(simulation, whole if step < last_second else settled, judge)
                if judge.broken:
                    break
                if step >= last_second:
                    heights.append(self._top(simulation))
        sinking = (start - float(np.mean(heights))) / self.height if heights and not judge.broken else None
        seconds = (whole.seconds + settled.seconds) / ((whole.steps + settled.steps) * settings.dt)
        return self._row(settings, 1e3 * seconds, sinking, settled if settled.steps else whole, judge)

    def _top(self, simulation: Simulation) -> float:
        """Mean height of the uppermost particles [m]."""
        heights = np.array(simulation.world.positions.array()[:, 1])
        count = max(1, round(TOP_SHARE * len(heights)))
        return float(np.partition(heights, -count)[-count:].mean())

    def _row(
        self, settings: RunSettings, cost: float, sinking: float | None, meter: Meter, judge: StabilityJudge
    ) -> dict[str, Any]:
        modulus = modulus_over_density(self.scene(), settings)
        predicted = laws.mean_compression(self.height, GRAVITY, modulus)
        if sinking is not None:
            judge.settle(1.0 - sinking, 1.0 - predicted)
        return {
            "rate_hz": settings.rate_hz,
            "iterations": settings.iterations,
            "ms_per_simulated_second": cost,
            "height_error": None if sinking is None else -sinking,
            "height_error_law": -predicted,
            "volume_error_rms": meter.volume_error_rms,
            "volume_error_law": laws.settled_volume_error(self.height, GRAVITY, modulus),
            "energy_peak": judge.energy_peak,
            "stable": not judge.reasons,
            "reasons": judge.reasons,
        }
