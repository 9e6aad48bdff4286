"""A standing wave in a box: the first sloshing mode of linear theory."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from ..elastic.signal import fit_oscillation
from ..trial import Trial
from .common import GRAVITY, box_fill, explicit_settings, rest_energy, stiff_enough, water_scene

PERIODS = 3.0
AMPLITUDE_SHARE = 0.05  # of the depth
_MOST_GROWTH = 50.0  # exponent per period; a wave that broke may fit one that no number can hold


@dataclass(frozen=True)
class StandingWave(Case):
    """Half a wave length in the tank, released from rest. The tank is three depths long, so its walls are on nodes."""

    depth: float = 0.6
    tank_length: float = 1.8

    name = "standing-wave"
    title = "Standing wave, planar"
    dimension = 2
    kind = "liquid"
    truth = (
        "theory: omega^2 = g k tanh(k h), k = pi / L; L = 1.8 m, h = 0.6 m: a period of 1.719 s; no damping."
        " At an amplitude of 5 % of the depth the period is longer by less than 0.3 %"
    )
    error_kinds = (
        ErrorMeasure("period_error", "discretisation", "%", "|T - T_theory| / T_theory over three periods"),
        ErrorMeasure("damping", "discretisation", "%", "share of the amplitude lost per period"),
    )
    length_name = "depth of the water"
    notes = "From the sideways motion of the centre of mass, fitted by a damped oscillation."

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.depth

    @property
    def wave_number(self) -> float:
        """k [1/m]."""
        return math.pi / self.tank_length

    @property
    def frequency(self) -> float:
        """[Hz]"""
        return math.sqrt(GRAVITY * self.wave_number * math.tanh(self.wave_number * self.depth)) / (2.0 * math.pi)

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (60, 120), (5, 20), (12,))
        variants = ("paper", "dual", "dual-cells", "dual-cells-flip0.9")
        coarse = settings_of(variants, (30, 120), (1, 5, 20), (16,))
        fine = settings_of(("paper", "dual"), (60, 120), (5, 20), (32,))
        return coarse + fine + explicit_settings(self.fastest, self.depth / 16, 16)

    @property
    def fastest(self) -> float:
        """No wave of the surface is faster [m/s]."""
        return math.sqrt(GRAVITY * self.depth)

    def scene(self, setting: Setting) -> Scene:
        """The tank with its water still flat."""
        return water_scene(
            "standing_wave",
            self.cell_size(setting),
            [box_fill((0.0, 0.0), (self.tank_length, self.depth), jitter=0.0)],
            domain=((0.0, 0.0), (self.tank_length, 1.5 * self.depth)),
            water=stiff_enough(setting, self.fastest),
        )

    def _displace(self, simulation: Simulation) -> None:
        """Moves the particles by the displacement of the mode, which is free of divergence: a cos(k x) at the surface."""
        k, a = self.wave_number, AMPLITUDE_SHARE * self.depth
        x, y = simulation.world.positions.array().astype(np.float64).T
        scale = a / math.sinh(k * self.depth)
        along = x - scale * np.cosh(k * y) * np.sin(k * x)
        simulation.world.positions = np.stack([along, y + scale * np.sinh(k * y) * np.cos(k * x)], axis=1)

    def measure(self, setting: Setting) -> Measurement:
        samples: list[tuple[float, float]] = []

        def observe(simulation: Simulation) -> None:
            samples.append((simulation.time, float(simulation.world.positions.array()[:, 0].mean(dtype=np.float64))))

        run = Trial(
            self.scene(setting),
            setting,
            PERIODS / self.frequency,
            start_energy=rest_energy,
            prepare=self._displace,
            observe=observe,
            every=max(1, int(setting.rate_hz / 60.0)),
        )
        times, sideways = np.array(samples).T
        fit = fit_oscillation(times, sideways, self.frequency)
        if fit is None:
            return run.measurement({"period_error": None, "damping": None})
        period = self.frequency / fit.frequency
        growth = min(-fit.decay / fit.frequency, _MOST_GROWTH)
        return run.measurement(
            {"period_error": abs(period - 1.0), "damping": abs(1.0 - math.exp(growth))},
            observed=(period,),
            extra={"fit_residual": fit.residual},
        )


@dataclass(frozen=True)
class OffGridWave(StandingWave):
    """The same in a tank whose far wall is not on a node."""

    tank_length: float = 1.73

    name = "standing-wave-off-grid"
    title = "Standing wave between walls that are not on nodes, planar"
    truth = StandingWave.truth.replace("L = 1.8 m", "L = 1.73 m").replace("1.719 s", "1.668 s")

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (60,), (20,), (12,))
        variants = ("paper", "dual", "dual-cells")
        coarse = settings_of(variants, (30, 120), (1, 5, 20), (16,))
        return coarse + explicit_settings(self.fastest, self.depth / 16, 16)
