"""The planar dam break of Martin and Moyce (1952): a column twice as high as wide collapses on a dry floor.

The experiment's figures are dimensionless, so the case is run by Froude similarity at a size that games have: a column
1 m wide by default (the experiment's own is 0.05715 m). Two runs are made for each setting: one in a tank long enough
for the wave never to come back while front and height are compared, and another in a tank four widths long, in which the
water comes to rest, for the stability verdict.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from .. import laws
from ..case import Case, CurvePanel, ErrorMeasure, Measurement, Setting, settings_of
from ..measures import Curve, absolute_rms, best_shift, body_extent, dam_break_experiment, occupied_area, relative_rms
from ..trial import Trial
from .common import (
    GRAVITY,
    PARTICLES_PER_AXIS,
    box_fill,
    explicit_settings,
    paper_modulus_over_density,
    rest_energy,
    stiff_enough,
    water_scene,
)

DEFAULT_WIDTH = 1.0
HEIGHT_RATIO = 2.0
LONG_TANK = 16.0  # [column widths] the wave does not return before LAST_TAU
SHORT_TANK = 4.0
TANK_HEIGHT = 3.0
WALL_STRIP = 2.0  # [cells] where the height at the wall is taken
LAST_TAU = 7.4  # last measured height
_SAMPLES_PER_UNIT_TIME = 25  # of tau
_VOLUME_SAMPLES = 15  # in the last second


@dataclass(frozen=True)
class DamBreak(Case):
    """The case at one size."""

    width: float = DEFAULT_WIDTH
    """Width a of the column [m]."""
    stability_seconds: float = 5.0

    name = "dam-break"
    title = "Dam break of Martin and Moyce, planar"
    dimension = 2
    kind = "liquid"
    truth = (
        "experiment: Martin and Moyce 1952, n^2 = 2, a = 2.25 in; front Z = x / a against T = t sqrt(2 g / a), height"
        " H = h / (2 a) against tau = t sqrt(g / a), all without unit"
    )
    error_kinds = (
        ErrorMeasure("front_rms_shifted", "model", "%", "RMS of (Z - Z_exp) / Z_exp, best time shift within 0.5", 0.04),
        ErrorMeasure("front_rms", "model", "%", "without a shift: a right front is ahead; a soft one may meet it by luck"),
        ErrorMeasure("height_rms", "model", "1", "RMS of H - H_exp", 0.10),
    )
    length_name = "width of the column"
    notes = (
        "The experiment's gate opens slowly, so a right front leads by a shift of about 0.2. Timing: the run in the long"
        " tank. Stability: also a run in a tank four widths long, until the water rests."
    )

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.width

    @property
    def panels(self) -> tuple[CurvePanel, ...]:  # type: ignore[override]
        label = "Martin and Moyce 1952"
        return (
            CurvePanel("front", "T = t sqrt(2 g / a)", "front Z = x / a", dam_break_experiment("front"), label),
            CurvePanel("height", "tau = t sqrt(g / a)", "height at the wall H", dam_break_experiment("height"), label),
        )

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (30, 60, 240), (1, 5, 20), (16,), most_work=240 * 10)
        variants = ("paper", "dual", "dual-cells", "dual-cells-flip0.9")
        coarse = settings_of(variants, (30, 60, 120, 240), (1, 5, 20), (16,), most_work=240 * 8)
        fine = settings_of(("paper", "dual"), (120,), (5,), (32,))
        return coarse + fine + explicit_settings(self.fastest, self.width / 16, 16)

    @property
    def fastest(self) -> float:
        """Of a fall from the column's top [m/s]."""
        return math.sqrt(2.0 * GRAVITY * HEIGHT_RATIO * self.width)

    def scene(self, setting: Setting, tank: float = SHORT_TANK) -> Scene:
        """The scene with a tank of a length given in column widths."""
        a = self.width
        return water_scene(
            "dam_break_2d",
            self.cell_size(setting),
            [box_fill((0.0, 0.0), (a, HEIGHT_RATIO * a))],
            domain=((0.0, 0.0), (tank * a, TANK_HEIGHT * a)),
            water=stiff_enough(setting, self.fastest),
        )

    def measure(self, setting: Setting) -> Measurement:
        run, front, height = self._collapse(setting)
        measured = dam_break_experiment("front")
        shift, shifted = best_shift(front, measured)
        errors: dict[str, float | None] = {
            "front_rms_shifted": shifted,
            "front_rms": relative_rms(front, measured),
            "height_rms": absolute_rms(height, dam_break_experiment("height")),
        }
        settled = None if run.judge.broken else self._settle(setting, run)
        return run.measurement(
            errors,
            observed=tuple(front.at(measured.times) / measured.values),
            curves={"front": front, "height": height},
            extra={"shift": shift, "settled_volume": settled},
        )

    def _collapse(self, setting: Setting) -> tuple[Trial, Curve, Curve]:
        """Front Z(T) and height H(tau) in the long tank."""
        a = self.width
        unit = math.sqrt(a / GRAVITY)  # seconds per unit of tau
        samples: list[tuple[float, float, float]] = []
        run = Trial(
            self.scene(setting, LONG_TANK),
            setting,
            LAST_TAU * unit,
            start_energy=rest_energy,
            observe=lambda simulation: samples.append((simulation.time / unit, *self._extents(simulation, setting))),
            every=max(1, int(unit * setting.rate_hz / _SAMPLES_PER_UNIT_TIME)),
        )
        tau, fronts, heights = np.array(samples).T
        return run, Curve(math.sqrt(HEIGHT_RATIO) * tau, fronts / a), Curve(tau, heights / (HEIGHT_RATIO * a))

    def _extents(self, simulation: Simulation, setting: Setting) -> tuple[float, float]:
        """Front and height at the back wall [m]."""
        cell = self.cell_size(setting)
        x, y = simulation.world.positions.array().T
        at_wall = y[x < WALL_STRIP * cell]
        return body_extent(x, cell, cell / PARTICLES_PER_AXIS), body_extent(at_wall, cell, cell / PARTICLES_PER_AXIS)

    def _settle(self, setting: Setting, run: Trial) -> float | None:
        """Lets the water come to rest in the short tank and adds the verdict to the run's.

        Gives the volume that the water takes in the last second over its rest volume; None when it broke.
        """
        scene, depth = self.scene(setting), HEIGHT_RATIO * self.width / SHORT_TANK
        volumes: list[float] = []

        def observe(simulation: Simulation) -> None:
            if simulation.time > self.stability_seconds - 1.0:
                volumes.append(occupied_area(simulation.world.positions.array(), scene.cell_size))

        every = max(1, int(setting.rate_hz / _VOLUME_SAMPLES))
        rest = Trial(
            scene, setting, self.stability_seconds, start_energy=rest_energy, observe=observe, every=every, judge=run.judge
        )
        if rest.judge.broken or not volumes:
            return None
        ratio = float(np.mean(volumes)) / (HEIGHT_RATIO * self.width**2)
        profile = laws.column_profile(depth, GRAVITY, paper_modulus_over_density(scene, setting.run_settings()))
        run.judge.settle(ratio, laws.apparent_height_ratio(profile))
        return ratio
