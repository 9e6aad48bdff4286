"""What must not change when a body drifts, is turned, or lies turned from the start."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

import pbmpm

from ...simulation import RunSettings
from .stage import Record, Stage, disc, lattice, run
from .theory import Solid

_SPEED_LIMIT = 1e3  # [m/s], of drifting bodies too


@dataclass(frozen=True)
class Check:
    """One figure beside its limit, both in cells."""

    name: str
    figure: float | None  #: None when a run failed
    limit: float

    @property
    def passed(self) -> bool:
        return self.figure is not None and self.figure <= self.limit


@dataclass(frozen=True)
class Invariance:
    """A body that is thrown into a vibration: pulled along one axis, pressed along the other."""

    solid: Solid = Solid(young=1e5, poisson=0.3, density=1000.0)
    cell_size: float = 1.0 / 32.0
    steps: int = 100
    rate_of_strain: float = 1.0  #: at the start [1/s]

    def checks(self, settings: RunSettings) -> tuple[list[Check], list[Record]]:
        """All checks at one setting, and the runs that they took."""
        still = self._vibrate(settings)
        fast = self._vibrate(settings, drift=2.0)
        slow = self._vibrate(settings, drift=0.37)
        quarter = self._vibrate(settings, turn=0.5 * math.pi)
        eighth = self._vibrate(settings, turn=0.25 * math.pi)
        records = [run_of for run_of, _ in (still, fast, slow, quarter, eighth)]
        place = still[1]
        rest, resting = self._lie_turned(settings)
        return [
            # Positions are a cell and a share of it, but ways of 2 cells round to 2^-22 of a cell, in the share of each
            # of the 9 nodes and in each of the steps.
            Check("drift by 2 cells per step", self._apart(place, fast[1]), 9.0 * self.steps * 2.0**-22),
            Check("drift by 0.37 cells per step", self._apart(place, slow[1]), 0.02),
            # Sums in another order; 100 steps of float32.
            Check("turned by 90 degrees", self._apart(place, quarter[1]), 1e-3),
            Check("turned by 45 degrees", self._apart(place, eighth[1]), 0.03 * self._reach(place)),
            Check("at rest but turned", rest, 1e-5),
        ], [*records, resting]

    def _vibrate(
        self, settings: RunSettings, drift: float = 0.0, turn: float = 0.0
    ) -> tuple[Record, np.ndarray | None]:
        """Places of the particles after all steps, without the drift and turned back [cells]; None after a failure."""
        rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        gradient = rotation @ np.diag([self.rate_of_strain, -self.rate_of_strain]) @ rotation.T
        speed = np.array([1.0, 1.0]) * drift * self.cell_size * settings.rate_hz
        size = np.array([6.0, 4.0]) * self.cell_size
        points = lattice(-size, size, self.cell_size) @ rotation.T
        with Stage(self.solid, self.cell_size, settings, len(points)) as stage:
            ids = stage.add_body(points, 4.0 * float(np.prod(size)), lambda x: x @ gradient.T + speed, gradient)
            record = run(stage, self.steps * settings.dt, lambda: 0.0, _SPEED_LIMIT, every=self.steps)
            if not record.stable:
                return record, None
            travelled = speed * stage.world.stats.simulated_seconds
            places = (stage.state(ids).positions - travelled) @ rotation
        return record, places / self.cell_size

    def _lie_turned(self, settings: RunSettings) -> tuple[float | None, Record]:
        """How far a disc that is given F = a rotation moves in a step [cells]: it has no stress."""
        points = disc([0.0, 0.0], 5.0 * self.cell_size, self.cell_size)
        rotation = np.array([[0.6, -0.8], [0.8, 0.6]])
        with Stage(self.solid, self.cell_size, settings, len(points)) as stage:
            ids = stage.add_body(points, len(points) * (0.5 * self.cell_size) ** 2)
            stage.world.set(pbmpm.Field.DEFORMATION, np.broadcast_to(rotation, (len(points), 2, 2)), ids)
            record = run(stage, settings.dt, lambda: 0.0, _SPEED_LIMIT)
            moved = np.abs(stage.state(ids).positions - points).max() / self.cell_size
        return (float(moved) if record.stable else None), record

    @staticmethod
    def _apart(one: np.ndarray | None, other: np.ndarray | None) -> float | None:
        """Largest distance of the same particle in two runs [cells]."""
        if one is None or other is None:
            return None
        return float(np.linalg.norm(one - other, axis=1).max())

    @staticmethod
    def _reach(places: np.ndarray | None) -> float:
        """Largest distance from the middle [cells]."""
        return math.inf if places is None else float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())
