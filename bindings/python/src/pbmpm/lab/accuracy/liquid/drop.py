"""A drop in free space that stretches into an ellipse: the exact motion of an incompressible liquid without walls.

A disc (radius 1) with the velocity (-A x, A y) stays an ellipse with semi-axes a along x and b = 1 / a along y, and its
velocity stays linear: da/dt = -a A, dA/dt = A^2 (a^4 - 1) / (a^4 + 1) (J. J. Monaghan, "Simulating free surface flows with SPH",
J. Comput. Phys. 110, 1994). Area and kinetic energy, (pi rho / 8) A^2 (a^2 + 1 / a^2), are conserved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from ..case import Case, CurvePanel, ErrorMeasure, Measurement, Setting, settings_of
from ..measures import Curve
from ..trial import Trial
from .common import PARTICLES_PER_AXIS, WATER, explicit_settings, kinetic_energy, stiff_enough, water_scene

START_RATE = 1.0  # A0 [1/s]
END = 1.0  # of A0 t
_STEPS = 400
_SAMPLES = 20


@cache
def exact_axis() -> Curve:
    """a against A0 t, for a disc of radius 1; by the classical Runge-Kutta method."""

    def slope(state: np.ndarray) -> np.ndarray:
        rate, a = state
        return np.array([rate**2 * (a**4 - 1.0) / (a**4 + 1.0), -a * rate])

    h, state = END / _STEPS, np.array([1.0, 1.0])
    axis = [1.0]
    for _ in range(_STEPS):
        k1 = slope(state)
        k2 = slope(state + 0.5 * h * k1)
        k3 = slope(state + 0.5 * h * k2)
        k4 = slope(state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        axis.append(float(state[1]))
    return Curve(np.linspace(0.0, END, _STEPS + 1), np.array(axis))


@dataclass(frozen=True)
class Stretch:
    """How a stretching drop is started: turned by an angle, and carried along."""

    angle: float = 0.0
    """Of the axis that shrinks [rad]."""
    drift: tuple[float, float] = (0.0, 0.0)
    """[m/s]"""

    @property
    def axes(self) -> np.ndarray:
        """Rows: the axis that shrinks and the one that grows."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return np.array([[c, s], [-s, c]])

    def start(self, simulation: Simulation) -> None:
        """Gives each particle the velocity and the velocity gradient of the exact motion."""
        gradient = self.axes.T @ np.diag([-START_RATE, START_RATE]) @ self.axes
        world = simulation.world
        places = world.positions.array().astype(np.float64)
        world.velocities = places @ gradient.T + np.array(self.drift)
        world.affine_velocities = np.broadcast_to(gradient, (len(places), 2, 2))

    def spreads(self, simulation: Simulation) -> np.ndarray:
        """Standard deviations of the particles along the two axes [m]; half the semi-axes of a uniform ellipse."""
        places = simulation.world.positions.array().astype(np.float64)
        return np.std((places - places.mean(axis=0)) @ self.axes.T, axis=0)


def drop_scene(name: str, setting: Setting, cell_size: float, radius: float) -> Scene:
    """A disc of water around the origin in free space."""
    shape = {"kind": "sphere", "position": [0.0, 0.0], "radius": radius}
    fill: dict[str, Any] = {"shape": shape, "material": WATER, "particles_per_axis": PARTICLES_PER_AXIS, "jitter": 0.0}
    fastest = START_RATE * radius
    return water_scene(name, cell_size, [fill], domain=None, gravity=0.0, water=stiff_enough(setting, fastest))


@dataclass(frozen=True)
class EllipticalDrop(Case):
    """The case at one size."""

    radius: float = 1.0

    name = "drop"
    title = "Elliptical drop, planar"
    dimension = 2
    kind = "liquid"
    truth = "exact: semi-axis a over its start against A0 t up to 1; area and kinetic energy stay (Monaghan 1994)"
    error_kinds = (
        ErrorMeasure("axis_error", "discretisation", "%", "largest |a - a_exact| / a_exact up to A0 t = 1", 0.02),
        ErrorMeasure("energy_error", "discretisation", "%", "|kinetic energy - its start| / its start at A0 t = 1", 0.05),
        ErrorMeasure("area_error", "discretisation", "%", "|a b - its start| / its start at A0 t = 1"),
    )
    length_name = "radius of the drop"
    finer = {64: 6.0}
    notes = "Axes from the second moments of the particles. Energy with the velocity gradients of the particles."

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.radius

    @property
    def panels(self) -> tuple[CurvePanel, ...]:  # type: ignore[override]
        times = np.linspace(0.0, END, 11)
        return (CurvePanel("axis", "A0 t", "a / a0", Curve(times, exact_axis().at(times)), "exact"),)

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual", "dual-cells-flip0.9"), (30, 60), (1, 5, 20), (16,))
        variants = ("paper", "dual", "dual-flip0.9", "dual-cells", "dual-cells-flip0.9")
        coarse = settings_of(variants, (30, 120), (1, 5, 20), (16,))
        fine = settings_of(("paper", "dual", "dual-cells-flip0.9"), (60, 120), (5, 20), (32,))
        return coarse + fine + explicit_settings(START_RATE * self.radius, self.radius / 16, 16)

    def measure(self, setting: Setting) -> Measurement:
        stretch, spreads, energies, times = Stretch(), [], [], []

        def observe(simulation: Simulation) -> None:
            times.append(simulation.time * START_RATE)
            spreads.append(stretch.spreads(simulation))
            energies.append(kinetic_energy(simulation, affine=True))

        run = Trial(
            drop_scene("elliptical_drop", setting, self.cell_size(setting), self.radius),
            setting,
            END / START_RATE,
            start_energy=kinetic_energy,
            prepare=stretch.start,
            observe=observe,
            every=max(1, int(setting.rate_hz * END / START_RATE / _SAMPLES)),
        )
        share = np.array(spreads) / spreads[0]
        exact = exact_axis().at(np.array(times))
        ends = exact_axis().at(np.array([0.5 * END, END]))
        axis = Curve(np.array(times), share[:, 0])
        return run.measurement(
            {
                "axis_error": float(np.max(np.abs(share[:, 0] / exact - 1.0))),
                "energy_error": abs(energies[-1] / energies[0] - 1.0),
                "area_error": abs(float(share[-1].prod()) - 1.0),
            },
            observed=tuple(axis.at(np.array([0.5 * END, END])) / ends),
            curves={"axis": axis},
        )
