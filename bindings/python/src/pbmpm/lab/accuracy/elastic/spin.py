"""A disc that spins freely: what an integrator does to rotation.

No force acts, so the disc would spin for ever. Backward Euler slows it by a law of its own (``theory.rotation_kept``),
which the converged solver has to show; what it loses beyond that law is the solver's error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...simulation import RunSettings
from .stage import Record, Stage, disc, run
from .theory import Solid

_SPEED_LIMIT = 10.0  # times the speed of the rim


def _turned(angle: float, dimension: int) -> np.ndarray:
    """The rotation by an angle about the third axis."""
    rotation = np.eye(dimension)
    rotation[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    return rotation


@dataclass(frozen=True)
class SpinningDisc:
    """A disc, or in 3D a ball, around the third axis."""

    solid: Solid = Solid(young=5e5, poisson=0.25, density=1000.0)
    radius: float = 0.3125  #: [m]
    cells: int = 10  #: over the radius
    angular_velocity: float = 2.0 * math.pi  #: [rad/s]

    @property
    def cell_size(self) -> float:
        return self.radius / self.cells

    @property
    def period(self) -> float:
        """Of one revolution, were it not braked [s]."""
        return 2.0 * math.pi / self.angular_velocity

    def spin(self, settings: RunSettings, revolutions: float = 1.0) -> Record:
        """The observed values are the angular momentum over that at the start, the kinetic and the stored energy over
        the kinetic energy at the start, the reach of the particles from the centre over that at the start, and their root
        mean square distance from where a rigid disc would carry them, over the radius."""
        dimension, omega = self.solid.dimension, self.angular_velocity
        points = disc([0.0] * dimension, self.radius, self.cell_size)
        turn = np.zeros((dimension, dimension))
        turn[0, 1], turn[1, 0] = -omega, omega
        rest_volume = len(points) * (0.5 * self.cell_size) ** dimension
        with Stage(self.solid, self.cell_size, settings, len(points)) as stage:
            ids = stage.add_body(points, rest_volume, lambda places: places @ turn.T, turn)
            start = stage.angular_momentum(ids)
            energy = stage.energy(ids)[0]
            reach = float(np.linalg.norm(points, axis=1).max())

            def observe() -> list[float]:
                moving, stored = stage.energy(ids)
                places = stage.state(ids).positions
                far = float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())
                angle = omega * stage.world.stats.simulated_seconds
                away = places - points @ _turned(angle, dimension).T
                displaced = float(np.sqrt(np.mean(np.sum(away**2, axis=1)))) / self.radius
                return [stage.angular_momentum(ids) / start, moving / energy, stored / energy, far / reach, displaced]

            seconds = revolutions * self.period
            every = max(1, round(settings.rate_hz * self.period / 24.0))
            return run(stage, seconds, observe, _SPEED_LIMIT * omega * self.radius, every)
