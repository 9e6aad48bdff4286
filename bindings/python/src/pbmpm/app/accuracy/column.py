"""A column of water at rest in a box: how much it sinks together, beside what the solver's compressibility predicts.

The column starts at its rest density, is let go, bounces and settles. Its height is taken from the uppermost
TOP_SHARE of its particles, averaged over them and over the last second: that does not depend on how single particles
lie at the surface. Each setting is run twice: with the default material, and without volume feedback, for which the law
holds; the difference is what the feedback changes.
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
    DEFAULT_FEEDBACK,
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


@dataclass
class _Run:
    """What one run gave."""

    sinking: float | None
    """Lost height over the rest height; None when it broke."""
    cost: float
    """Milliseconds per simulated second."""
    volume_error_rms: float
    """Over the last second, or over the whole run when it broke."""
    judge: StabilityJudge


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
            "volume_feedback": DEFAULT_FEEDBACK,
            "timing": "one run, with volume feedback",
        }

    def scene(self, volume_feedback: float = DEFAULT_FEEDBACK) -> Scene:
        """The column in its box."""
        width = WIDTH_RATIO * self.height
        return water_scene(
            "column_2d",
            "Hydrostatic column: the settled height shows the compressibility of the solver.",
            self.cell_size,
            (width, BOX_HEIGHT * self.height),
            (width, self.height),
            self.seconds,
            iterations=10,
            volume_feedback=volume_feedback,
        )

    def measure(self, settings: RunSettings) -> dict[str, Any]:
        """One row of the sweep."""
        modulus = modulus_over_density(self.scene(), settings)
        predicted = laws.mean_compression(self.height, GRAVITY, modulus)
        run, plain = self._run(settings, DEFAULT_FEEDBACK, predicted), self._run(settings, 0.0, predicted)
        reasons = run.judge.reasons + [f"without feedback: {reason}" for reason in plain.judge.reasons]
        return {
            "rate_hz": settings.rate_hz,
            "iterations": settings.iterations,
            "ms_per_simulated_second": run.cost,
            "height_error": None if run.sinking is None else -run.sinking,
            "height_error_without_feedback": None if plain.sinking is None else -plain.sinking,
            "height_error_law": -predicted,
            "volume_error_rms": run.volume_error_rms,
            "volume_error_without_feedback": plain.volume_error_rms,
            "volume_error_law": laws.settled_volume_error(self.height, GRAVITY, modulus),
            "energy_peak": max(run.judge.energy_peak, plain.judge.energy_peak),
            "stable": not reasons,
            "reasons": reasons,
        }

    def _run(self, settings: RunSettings, volume_feedback: float, predicted: float) -> _Run:
        steps = max(1, math.ceil(self.seconds * settings.rate_hz))
        last_second = steps - min(steps, math.ceil(settings.rate_hz))
        first, last, judge = Meter(), Meter(), StabilityJudge()
        heights: list[float] = []
        with Simulation(self.scene(volume_feedback), settings) as simulation:
            start = self._top(simulation)
            judge.begin(start_energy(simulation))
            for step in range(steps):
                timed_step(simulation, first if step < last_second else last, judge)
                if judge.broken:
                    break
                if step >= last_second:
                    heights.append(self._top(simulation))
        sinking = (start - float(np.mean(heights))) / self.height if heights and not judge.broken else None
        if sinking is not None:
            judge.settle(1.0 - sinking, 1.0 - predicted)
        cost = 1e3 * (first.seconds + last.seconds) / ((first.steps + last.steps) * settings.dt)
        return _Run(sinking, cost, (last if last.steps else first).volume_error_rms, judge)

    def _top(self, simulation: Simulation) -> float:
        """Mean height of the uppermost particles [m]."""
        heights = np.array(simulation.world.positions.array()[:, 1])
        count = max(1, round(TOP_SHARE * len(heights)))
        return float(np.partition(heights, -count)[-count:].mean())
