"""A column of water at rest in a box: its height and its pressure.

The column starts at its rest density, is let go, bounces and settles. Its height is taken from the uppermost
TOP_SHARE of its particles, averaged over them and over the last second: that does not depend on how single particles
lie at the surface. The water has a bulk modulus, so that every solver has a pressure to show.

The paper's solver is run a second time without volume feedback, for which its law of stiffness holds; the difference
is what the feedback changes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from .. import laws
from ..case import COURANT_SHARES, Case, ErrorMeasure, Measurement, Setting, settings_of
from ..trial import Trial
from .common import (
    DEFAULT_FEEDBACK,
    DENSITY,
    GRAVITY,
    WATER,
    box_fill,
    explicit_settings,
    paper_modulus_over_density,
    rest_energy,
    stiff_enough,
    water_scene,
)

DEFAULT_HEIGHT = 1.0
WIDTH_RATIO = 0.5
BOX_HEIGHT = 1.5
DEFAULT_SECONDS = 5.0
TOP_SHARE = 0.05
BULK_MODULUS = 4e6  # [Pa]: the floor of a column of 1 m gives way by 0.25 %
_SAMPLES = 30  # in the last second


@dataclass
class _Rest:
    """A column in its last second."""

    run: Trial
    sinking: float | None
    """Lost height over the rest height; None when it broke."""
    pressure_error: float | None
    speed: float | None
    """Root mean square [m/s]."""
    volume_error: float | None
    """Root mean square of 1 - J."""


@dataclass(frozen=True)
class Column(Case):
    """The case at one size."""

    height: float = DEFAULT_HEIGHT
    """Rest height [m]."""
    seconds: float = DEFAULT_SECONDS

    name = "column"
    title = "Hydrostatic column, planar"
    dimension = 2
    kind = "liquid"
    truth = (
        "theory: pressure [Pa] = rho g depth, height [m] of a liquid with K = 4 MPa (0.12 % less than at rest density);"
        " rho = 1000 kg/m^3, g = 9.81 m/s^2"
    )
    error_kinds = (
        ErrorMeasure("height_error", "discretisation", "%", "|height - true height| over the rest height", 0.005),
        ErrorMeasure("pressure_error", "discretisation", "%", "RMS over the water of p - p_true, over rho g times the height"),
        ErrorMeasure("rest_speed", "discretisation", "m/s", "root mean square speed of the water at rest"),
    )
    length_name = "height of the column"
    finer = {64: 2.0}
    notes = (
        "Averages over the last of five seconds. The dual solver solves for the pressure; else it is that of the volume"
        " ratio J, K (1 - J), with the paper's solver K_eff (1/J - 1) / J. Rows of the paper's solver also tell what its"
        " law predicts."
    )

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.height

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (60, 240), (5, 20, 50), (16,), most_work=240 * 25)
        variants = ("paper", "dual", "dual-cells")
        coarse = settings_of(variants, (60, 240), (1, 5, 20, 100), (32,), most_work=240 * 23)
        own_sound = math.sqrt(BULK_MODULUS / DENSITY)
        rates = [math.ceil(share * own_sound * 32 / self.height) for share in COURANT_SHARES]
        explicit = settings_of(("explicit",), rates, (1,), (32,))
        return coarse + explicit + explicit_settings(self.fastest, self.height / 32, 32)

    @property
    def fastest(self) -> float:
        """Of a fall through the column [m/s]: what weakly compressible water is measured by."""
        return math.sqrt(2.0 * GRAVITY * self.height)

    def scene(self, setting: Setting, volume_feedback: float = DEFAULT_FEEDBACK) -> Scene:
        """The column in its box."""
        width = WIDTH_RATIO * self.height
        return water_scene(
            "column_2d",
            self.cell_size(setting),
            [box_fill((0.0, 0.0), (width, self.height), jitter=0.0)],
            domain=((0.0, 0.0), (width, BOX_HEIGHT * self.height)),
            water={
                "volume_feedback": volume_feedback,
                "bulk_modulus": BULK_MODULUS,
                **(stiff_enough(setting, self.fastest) if setting.sound else {}),
            },
        )

    @property
    def true_sinking(self) -> float:
        """Each layer gives way by its pressure over K: on average rho g h / (2 K)."""
        return DENSITY * GRAVITY * self.height / (2.0 * BULK_MODULUS)

    def measure(self, setting: Setting) -> Measurement:
        rest = self._rest(setting, DEFAULT_FEEDBACK)
        height_error = None if rest.sinking is None else abs(rest.sinking - self.true_sinking)
        extra: dict[str, Any] = {"height_change": None if rest.sinking is None else -rest.sinking}
        reasons: list[str] = []
        if setting.solver == "paper":
            law, reasons = self._beside_the_law(setting)
            extra.update(law, settled_volume_error=rest.volume_error)
        measurement = rest.run.measurement(
            {"height_error": height_error, "pressure_error": rest.pressure_error, "rest_speed": rest.speed},
            observed=None if rest.sinking is None else (rest.sinking,),
            extra=extra,
        )
        measurement.reasons += reasons
        measurement.stable = not measurement.reasons
        return measurement

    def _beside_the_law(self, setting: Setting) -> tuple[dict[str, Any], list[str]]:
        """What the law of the paper's solver says, beside a run without volume feedback."""
        modulus = paper_modulus_over_density(self.scene(setting), setting.run_settings())
        plain = self._rest(setting, 0.0)
        figures = {
            "height_change_without_feedback": None if plain.sinking is None else -plain.sinking,
            "height_change_law": -laws.mean_compression(self.height, GRAVITY, modulus),
            "volume_error_without_feedback": plain.volume_error,
            "volume_error_law": laws.settled_volume_error(self.height, GRAVITY, modulus),
        }
        return figures, [f"without feedback: {reason}" for reason in plain.run.judge.reasons]

    def _rest(self, setting: Setting, volume_feedback: float) -> _Rest:
        scene = self.scene(setting, volume_feedback)
        samples: list[tuple[float, float, float, float]] = []
        start: list[float] = []

        def observe(simulation: Simulation) -> None:
            if simulation.steps == 0:
                start.append(_top(simulation))
            if simulation.time > self.seconds - 1.0:
                samples.append(self._sample(simulation, setting, scene))

        every = max(1, int(setting.rate_hz / _SAMPLES))
        run = Trial(scene, setting, self.seconds, start_energy=rest_energy, observe=observe, every=every)
        if run.judge.broken:
            return _Rest(run, None, None, None, None)
        top, pressure, speed, volume = np.array(samples).T
        sinking = (start[0] - float(top.mean())) / self.height
        law = laws.mean_compression(self.height, GRAVITY, paper_modulus_over_density(scene, setting.run_settings()))
        run.judge.settle(1.0 - sinking, 1.0 - law)
        return _Rest(run, sinking, _rms(pressure), _rms(speed), _rms(volume))

    def _sample(self, simulation: Simulation, setting: Setting, scene: Scene) -> tuple[float, float, float, float]:
        """Height of the top, and root mean squares of pressure error, speed and volume error."""
        world = simulation.world
        ratios = world.volume_ratios.array().astype(np.float64)
        pressure = self._pressure(simulation, setting, scene, ratios)
        surface = self.height * (1.0 - self.true_sinking)
        depth = np.maximum(surface - world.positions.array()[:, 1], 0.0)
        error = (pressure - DENSITY * GRAVITY * depth) / (DENSITY * GRAVITY * self.height)
        return _top(simulation), _rms(error), _rms(np.linalg.norm(world.velocities.array(), axis=1)), _rms(1.0 - ratios)


    def _pressure(self, simulation: Simulation, setting: Setting, scene: Scene, ratios: np.ndarray) -> np.ndarray:
        """Of each particle [Pa]: what the dual solver solves for, else what the volume ratios stand for."""
        if setting.solver == "dual":
            return simulation.world.pressures.array().astype(np.float64)
        if setting.solver == "paper":
            modulus = DENSITY * paper_modulus_over_density(scene, setting.run_settings())
            return modulus * (1.0 / ratios - 1.0) / ratios
        return scene.materials[WATER].bulk_modulus * (1.0 - ratios)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def _top(simulation: Simulation) -> float:
    """Mean height of the uppermost particles [m]."""
    heights = np.array(simulation.world.positions.array()[:, 1])
    count = max(1, round(TOP_SHARE * len(heights)))
    return float(np.partition(heights, -count)[-count:].mean())
