"""Taylor-Green vortices in a closed box that is full: how much of their energy the solver takes.

u = U sin(k x) cos(k y), v = -U cos(k x) sin(k y) is a steady flow of a liquid without viscosity: its energy stays. What is
lost has three causes: the transfers between particles and grid, the time step, and the iterations. The last one is
the difference from the run with a single iteration.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from ..trial import Trial
from .common import box_fill, explicit_settings, kinetic_energy, stiff_enough, water_scene

SPEED = 0.25  # U [m/s]
SECONDS = 0.25


@dataclass(frozen=True)
class TaylorGreen(Case):
    """One wave length in a box with slippery walls."""

    wave_length: float = 0.5

    name = "taylor-green"
    title = "Taylor-Green vortices, planar"
    dimension = 2
    kind = "liquid"
    truth = (
        "exact: without viscosity the kinetic energy stays; share of it that is lost in 0.25 s at U = 0.25 m/s,"
        " wave length 0.5 m"
    )
    error_kinds = (
        ErrorMeasure("energy_lost", "discretisation", "%", "share of the kinetic energy that is gone after 0.25 s"),
        ErrorMeasure(
            "lost_to_iterations", "solver", "%", "what was lost more than with one iteration at the same rate", 0.10
        ),
    )
    length_name = "wave length"
    notes = (
        "Kinetic energy of the particles' translation. Water moves by up to 2 cells in the time of the case. No volume"
        " feedback: the full box has no room for the growth that it may ask for."
    )

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.wave_length

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual", "dual-cells-flip0.9"), (60,), (1, 10, 50), (16,))
        variants = ("paper", "dual", "dual-flip0.9", "dual-cells", "dual-cells-flip0.9")
        coarse = settings_of(variants, (60, 240), (1, 10, 50), (32,))
        fine = settings_of(("paper", "dual", "dual-cells-flip0.9"), (120, 240), (1, 20), (16,))
        explicit = explicit_settings(SPEED, self.wave_length / 32, 32)
        return coarse + fine + explicit + [replace(setting, flip=0.9) for setting in explicit]

    def scene(self, setting: Setting) -> Scene:
        """The full box."""
        side = self.wave_length
        return water_scene(
            "taylor_green",
            self.cell_size(setting),
            [box_fill((0.0, 0.0), (side, side), jitter=0.0)],
            domain=((0.0, 0.0), (side, side)),
            gravity=0.0,
            water={"volume_feedback": 0.0, **stiff_enough(setting, SPEED)},
        )

    def _stir(self, simulation: Simulation) -> None:
        """Gives each particle the velocity and the velocity gradient of the flow."""
        k = 2.0 * math.pi / self.wave_length
        x, y = k * simulation.world.positions.array().astype(np.float64).T
        sx, cx, sy, cy = np.sin(x), np.cos(x), np.sin(y), np.cos(y)
        simulation.world.velocities = SPEED * np.stack([sx * cy, -cx * sy], axis=1)
        gradient = SPEED * k * np.array([[cx * cy, -sx * sy], [sx * sy, -cx * cy]])
        simulation.world.affine_velocities = np.moveaxis(gradient, 2, 0)

    def measure(self, setting: Setting) -> Measurement:
        run, left = self._run(setting)
        once = left if setting.iterations == 1 else _energy_after_one_iteration(self, replace(setting, iterations=1))
        return run.measurement(
            {"energy_lost": abs(1.0 - left), "lost_to_iterations": max(0.0, once - left)},
            observed=(left,),
            extra={"energy_left": left},
        )

    def _run(self, setting: Setting) -> tuple[Trial, float]:
        energies: list[float] = []
        run = Trial(
            self.scene(setting),
            setting,
            SECONDS,
            start_energy=kinetic_energy,
            prepare=self._stir,
            observe=lambda simulation: energies.append(kinetic_energy(simulation)),
        )
        return run, energies[-1] / energies[0]


@cache
def _energy_after_one_iteration(case: TaylorGreen, setting: Setting) -> float:
    """The share of the energy that is left, measured once per rate and grid."""
    return case._run(setting)[1]
