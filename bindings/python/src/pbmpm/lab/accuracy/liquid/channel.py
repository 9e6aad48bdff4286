"""Viscous flow between two plates that starts from rest: Couette (one plate moves) and Poiseuille (a force pushes).

A slab of liquid, open at both ends and without gravity, fills the gap between plates that hold it fast. Its ends are
at no pressure, so that its middle flows as an endless slab does, as long as the ends have moved less than their
distance from it.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from ..case import Case, CurvePanel, ErrorMeasure, Measurement, Setting, settings_of
from ..measures import Curve
from ..trial import Trial
from .common import box_fill, explicit_settings, stiff_enough, water_scene

GAP = 0.5  # L [m]
SLAB_GAPS = 4.0
MIDDLE_GAPS = 0.5  # half width of the part that is measured
SECONDS = 4.0
END = 0.2  # of T = nu t / L^2
VISCOSITY = END * GAP**2 / SECONDS  # nu [m^2/s]
FASTEST = 0.05  # [m/s]
SAMPLED = (0.05, 0.1, 0.2)  # of T
_TERMS = 200
_PLATE = 0.5  # half thickness over the gap


def couette(height: np.ndarray, time: float) -> np.ndarray:
    """u / V0 at heights y / L and at T = nu t / L^2, the upper plate moving with V0: the steady profile and its start-up."""
    n = np.arange(1, _TERMS + 1)[:, None]
    waves = 2.0 / (n * math.pi) * (-1.0) ** n * np.sin(n * math.pi * height) * np.exp(-((n * math.pi) ** 2) * time)
    return height + waves.sum(axis=0)


def poiseuille(height: np.ndarray, time: float) -> np.ndarray:
    """u / (F L^2 / (8 nu)) under a force F per mass: 4 y (1 - y) less what has not yet been reached."""
    n = 2.0 * np.arange(_TERMS)[:, None] + 1.0
    waves = 32.0 / (n * math.pi) ** 3 * np.sin(n * math.pi * height) * np.exp(-((n * math.pi) ** 2) * time)
    return 4.0 * height * (1.0 - height) - waves.sum(axis=0)


@dataclass(frozen=True)
class _Channel(Case):
    """What both flows share."""

    gap: float = GAP

    dimension = 2
    kind = "liquid"
    length_name = "gap between the plates"
    error_kinds = (
        ErrorMeasure("profile_error", "discretisation", "%", "RMS of u - u_exact over the largest u, at T = 0.05, 0.1, 0.2"),
        ErrorMeasure("end_error", "discretisation", "%", "the same at T = 0.2 alone"),
    )
    notes = (
        "The paper's solver stands for the viscosity by a share that each iteration removes, at most 1; where that is not"
        " enough, it cannot be as viscous."
    )

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.gap

    @abstractmethod
    def exact(self, height: np.ndarray, time: float) -> np.ndarray:
        """u over FASTEST."""

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (60,), (2, 10), (12,))
        variants = ("paper", "dual", "dual-cells")
        coarse = settings_of(variants, (30, 120), (1, 5, 20), (16,))
        fine = settings_of(("paper", "dual"), (60, 120), (5, 10), (32,))
        return coarse + fine + explicit_settings(FASTEST, GAP / 16, 16)

    @property
    def panels(self) -> tuple[CurvePanel, ...]:  # type: ignore[override]
        heights = np.linspace(0.0, 1.0, 21)
        truth = Curve(heights, self.exact(heights, SAMPLED[-1]))
        return (CurvePanel("profile", "y / L", "u at T = 0.2 over the largest", truth, "exact"),)

    def scene(self, setting: Setting, force: float, speed: float) -> Scene:
        """The slab between its plates; ``force`` [m/s^2] along x, ``speed`` [m/s] of the upper plate."""
        cell, half = self.cell_size(setting), 0.5 * SLAB_GAPS * GAP
        water: dict[str, float] = stiff_enough(setting, FASTEST)
        water["kinematic_viscosity"] = VISCOSITY
        scene = water_scene(
            self.name.replace("-", "_"),
            cell,
            [box_fill((-half, 0.0), (half, GAP), jitter=0.0)],
            domain=None,
            gravity=0.0,
            water=water,
            colliders=[_plate(-_PLATE * GAP, 0.0), _plate((1.0 + _PLATE) * GAP, speed)],
        )
        return scene.model_copy(update={"gravity": [force, 0.0]})

    @abstractmethod
    def _scene(self, setting: Setting) -> Scene:
        """The scene of this flow."""

    def measure(self, setting: Setting) -> Measurement:
        wanted = [time * GAP**2 / VISCOSITY for time in SAMPLED]
        profiles: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []

        def observe(simulation: Simulation) -> None:
            if len(profiles) < len(wanted) and simulation.time >= wanted[len(profiles)] - 1e-6:
                profiles.append(self._profile(simulation))

        run = Trial(self._scene(setting), setting, SECONDS, observe=observe)
        if run.judge.broken or len(profiles) < len(wanted):
            return run.measurement({measure.name: None for measure in self.error_kinds})
        errors = [float(np.sqrt(np.mean((speed - exact) ** 2))) for _, speed, exact in profiles]
        curve = _binned(*profiles[-1][:2])
        return run.measurement(
            {"profile_error": float(np.sqrt(np.mean(np.square(errors)))), "end_error": errors[-1]},
            observed=tuple(curve.at(np.linspace(0.1, 0.9, 9))),
            curves={"profile": curve},
        )

    def _profile(self, simulation: Simulation) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Height over the gap, speed over the fastest, and the exact speed, of the particles in the middle."""
        world = simulation.world
        places = world.positions.array().astype(np.float64)
        middle = np.abs(places[:, 0] - np.median(places[:, 0])) < MIDDLE_GAPS * GAP
        heights = np.clip(places[middle, 1] / GAP, 0.0, 1.0)
        speeds = world.velocities.array()[middle, 0].astype(np.float64) / FASTEST
        return heights, speeds, self.exact(heights, VISCOSITY * simulation.time / GAP**2)


class Couette(_Channel):
    """The upper plate moves with the speed FASTEST."""

    name = "couette"
    title = "Couette flow that starts up, planar"
    truth = "exact: Fourier series of u / V0 over y / L at T = nu t / L^2; nu = 0.0125 m^2/s, L = 0.5 m, V0 = 0.05 m/s"

    def exact(self, height: np.ndarray, time: float) -> np.ndarray:
        return couette(height, time)

    def _scene(self, setting: Setting) -> Scene:
        return self.scene(setting, 0.0, FASTEST)


class Poiseuille(_Channel):
    """A force that would make the middle FASTEST in the end."""

    name = "poiseuille"
    title = "Poiseuille flow that starts up, planar"
    truth = "exact: Fourier series of u / (F L^2 / (8 nu)) over y / L at T = nu t / L^2; nu = 0.0125 m^2/s, L = 0.5 m"

    def exact(self, height: np.ndarray, time: float) -> np.ndarray:
        return poiseuille(height, time)

    def _scene(self, setting: Setting) -> Scene:
        return self.scene(setting, 8.0 * VISCOSITY * FASTEST / GAP**2, 0.0)


def _plate(height: float, speed: float) -> dict[str, Any]:
    """A plate that holds the liquid fast, much longer than the slab."""
    start = [0.0, height]
    shape = {"kind": "box", "position": start, "half_extents": [4.0 * SLAB_GAPS * GAP, _PLATE * GAP]}
    plate: dict[str, Any] = {"shape": shape, "friction": "stick"}
    if speed:
        end = {"time": 2.0 * SECONDS, "position": [2.0 * SECONDS * speed, height]}
        plate["motion"] = {"keyframes": [{"time": 0.0, "position": start}, end]}
    return plate


def _binned(heights: np.ndarray, speeds: np.ndarray) -> Curve:
    """Mean speeds in twenty layers."""
    layers = np.minimum((20 * heights).astype(np.int64), 19)
    counts = np.bincount(layers, minlength=20)
    filled = counts > 0
    middles = (np.arange(20) + 0.5) / 20
    return Curve(middles[filled], (np.bincount(layers, weights=speeds, minlength=20)[filled]) / counts[filled])
