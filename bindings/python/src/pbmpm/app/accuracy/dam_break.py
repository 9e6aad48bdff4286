"""The planar dam break of Martin and Moyce (1952): a column twice as high as wide collapses on a dry floor.

The experiment's figures are dimensionless, so the case is run by Froude similarity at a size that games have: a column
1 m wide by default (the experiment's own is 0.05715 m). Two runs are made for each setting: one in a tank long enough
for the wave never to come back while front and height are compared, and a longer one in a tank four widths long, in
which the water comes to rest, for the stability verdict.
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
from .measures import Curve, absolute_rms, best_shift, body_extent, dam_break_experiment, occupied_area, relative_rms
from .stability import StabilityJudge

DEFAULT_WIDTH = 1.0
DEFAULT_CELLS = 16
HEIGHT_RATIO = 2.0
LONG_TANK = 16.0  # [column widths] the wave does not return before LAST_TAU
SHORT_TANK = 4.0
TANK_HEIGHT = 3.0
WALL_STRIP = 2.0  # [cells] where the height at the wall is taken
LAST_TAU = 7.4  # last measured height
TIMING_REPEATS = 2
_SAMPLES_PER_UNIT_TIME = 25  # of tau
_VOLUME_SAMPLES = 15  # in the last second


@dataclass(frozen=True)
class _Collapse:
    """What one run in the long tank gave: front Z(T), height H(tau), and its cost."""

    front: Curve
    height: Curve
    meter: Meter


@dataclass(frozen=True)
class DamBreak:
    """The case at one size and resolution."""

    width: float = DEFAULT_WIDTH
    """Width a of the column [m]."""
    cells: int = DEFAULT_CELLS
    """Cells over the width of the column."""
    stability_seconds: float = 20.0

    name = "dam-break"

    @property
    def cell_size(self) -> float:
        return self.width / self.cells

    def facts(self) -> dict[str, Any]:
        """What a report says about the case."""
        return {
            "column_width": self.width,
            "cell_size": self.cell_size,
            "particles_per_axis": PARTICLES_PER_AXIS,
            "stability_seconds": self.stability_seconds,
            "timing": f"minimum of {TIMING_REPEATS} runs in the long tank",
        }

    def scene(self, tank: float = SHORT_TANK, seconds: float = 3.0) -> Scene:
        """The scene with a tank of a length given in column widths."""
        a = self.width
        description = "Planar dam break of Martin and Moyce (1952): column twice as high as wide, dry floor."
        return water_scene(
            "dam_break_2d",
            description,
            self.cell_size,
            (tank * a, TANK_HEIGHT * a),
            (a, HEIGHT_RATIO * a),
            seconds,
            iterations=10,
        )

    def measure(self, settings: RunSettings) -> dict[str, Any]:
        """One row of the sweep, with the simulated curves under ``curves``."""
        judge = StabilityJudge()
        runs = [self._collapse(settings, judge) for _ in range(TIMING_REPEATS)]
        front, height = runs[0].front, runs[0].height
        shift, shifted = best_shift(front, dam_break_experiment("front"))
        settled = None if judge.broken else self._settle(settings, judge)
        return {
            "rate_hz": settings.rate_hz,
            "iterations": settings.iterations,
            "ms_per_simulated_second": min(run.meter.ms_per_simulated_second(settings.dt) for run in runs),
            "front_rms": relative_rms(front, dam_break_experiment("front")),
            "front_rms_shifted": shifted,
            "shift": shift,
            "height_rms": absolute_rms(height, dam_break_experiment("height")),
            "volume_error_rms": runs[0].meter.volume_error_rms,
            "settled_volume": settled,
            "energy_peak": judge.energy_peak,
            "stable": not judge.reasons,
            "reasons": judge.reasons,
            "curves": {"front": front, "height": height},
        }

    def _collapse(self, settings: RunSettings, judge: StabilityJudge) -> _Collapse:
        a = self.width
        unit = math.sqrt(a / GRAVITY)  # seconds per unit of tau
        steps = math.ceil(LAST_TAU * unit * settings.rate_hz)
        every = max(1, int(unit * settings.rate_hz / _SAMPLES_PER_UNIT_TIME))
        samples, meter = [], Meter()
        with Simulation(self.scene(LONG_TANK, steps * settings.dt), settings) as simulation:
            judge.begin(start_energy(simulation))
            samples.append((0.0, *self._extents(simulation)))
            for step in range(1, steps + 1):
                timed_step(simulation, meter, judge)
                if judge.broken:
                    break
                if step % every == 0 or step == steps:
                    samples.append((simulation.time / unit, *self._extents(simulation)))
        tau, fronts, heights = np.array(samples).T
        return _Collapse(
            Curve(math.sqrt(HEIGHT_RATIO) * tau, fronts / a), Curve(tau, heights / (HEIGHT_RATIO * a)), meter
        )

    def _extents(self, simulation: Simulation) -> tuple[float, float]:
        """Front and height at the back wall [m]."""
        positions = simulation.world.positions.array()
        x, y = positions[:, 0], positions[:, 1]
        spacing = self.cell_size / PARTICLES_PER_AXIS
        at_wall = y[x < WALL_STRIP * self.cell_size]
        return body_extent(x, self.cell_size, spacing), body_extent(at_wall, self.cell_size, spacing)

    def _settle(self, settings: RunSettings, judge: StabilityJudge) -> float | None:
        """Runs until the water rests and tells the judge.

        Gives the volume that the water takes in the last second over its rest volume.
        """
        steps = max(1, math.ceil(self.stability_seconds * settings.rate_hz))
        last_second = steps - min(steps, math.ceil(settings.rate_hz))
        scene = self.scene(SHORT_TANK, self.stability_seconds)
        depth = HEIGHT_RATIO * self.width / SHORT_TANK
        every = max(1, int(settings.rate_hz / _VOLUME_SAMPLES))
        volumes = []
        with Simulation(scene, settings) as simulation:
            judge.begin(start_energy(simulation))
            for step in range(steps):
                timed_step(simulation, Meter(), judge)
                if judge.broken:
                    return None
                if step >= last_second and step % every == 0:
                    positions = simulation.world.positions.array()
                    volumes.append(occupied_area(positions, self.cell_size))
        ratio = float(np.mean(volumes)) / (HEIGHT_RATIO * self.width**2)
        profile = laws.column_profile(depth, GRAVITY, modulus_over_density(scene, settings))
        judge.settle(ratio, laws.apparent_height_ratio(profile))
        return ratio
