"""What holds in every hard case, whatever else it asks for: nothing becomes NaN, nothing is lost without an event, nothing
leaves the domain, nothing is faster than the documented clamp."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

import pbmpm

from .case import Check, Setting

GRAVITY = 9.81
#: Rounding of a position in a view, relative to the size of the domain.
POSITION_ROUNDING = 1e-6
#: Rounding of energy summed over single precision steps, relative.
ENERGY_ROUNDING = 1e-4
#: Kinetic and potential energy may exceed what was there at the start by this share (validation check "energy": no violation
#: above 0.1 %).
ENERGY_SLACK = 0.001
#: Rounding of a speed at the clamp.
SPEED_ROUNDING = 1e-4


def vector(dimension: int, *components: float) -> list[float]:
    """The first components of a vector, one per axis; missing ones are 0."""
    return [*components, 0.0, 0.0, 0.0][:dimension]


def downwards(dimension: int) -> list[float]:
    """Gravity along the second axis."""
    return vector(dimension, 0.0, -GRAVITY)


def make_world(
    setting: Setting,
    cell_size: float,
    *,
    capacity: int = 40_000,
    gravity: bool = False,
    size: list[float] | None = None,
    max_displacement: float | None = None,
) -> pbmpm.World:
    """A world at a setting; with a size [m] it is a closed box without friction from 0 to there."""
    dimension = setting.dimension
    return pbmpm.World(
        dimension,
        cell_size,
        capacity=capacity,
        gravity=downwards(dimension) if gravity else None,
        domain=None if size is None else ([0.0] * dimension, size[:dimension]),
        iterations=setting.iterations,
        solver=setting.solver,
        max_displacement=max_displacement,
        threads=setting.threads,
    )


class Watch:
    """Steps a world and notes what must never happen."""

    def __init__(self, world: pbmpm.World) -> None:
        self.world = world
        self.start_count = len(world)
        self.not_finite = 0
        self.outside = 0
        self.clamp_ratio = 0.0
        self.fastest = 0.0  #: highest speed since the last `forget()` [m/s]
        self.longest = 0.0  #: highest displacement since then [cells]

    def forget(self) -> None:
        """Begins anew with the highest speed."""
        self.fastest = self.longest = 0.0

    def step(self, dt: float) -> pbmpm.Stats:
        """One step, looked at."""
        world = self.world
        world.step(dt)
        stats = world.stats
        positions, velocities = world.positions.array(), world.velocities.array()
        finite = np.isfinite(positions).all(axis=1) & np.isfinite(velocities).all(axis=1)
        self.not_finite += int((~finite).sum()) + (not math.isfinite(stats.kinetic_energy))
        self.outside += self._count_outside(positions)
        clamp = world.max_displacement * world.cell_size * world.substeps / dt
        self.clamp_ratio = max(self.clamp_ratio, stats.max_speed / clamp)
        self.fastest = max(self.fastest, stats.max_speed)
        self.longest = max(self.longest, stats.max_displacement)
        return stats

    def run(self, seconds: float, dt: float) -> pbmpm.Stats:
        """Equal steps over some time."""
        for _ in range(max(1, round(seconds / dt))):
            stats = self.step(dt)
        return stats

    def _count_outside(self, positions: npt.NDArray[np.float32]) -> int:
        domain = self.world.domain
        if domain is None:
            return 0
        low, high = np.array(domain[0]), np.array(domain[1])
        slack = POSITION_ROUNDING * np.abs(np.stack([low, high])).max()
        return int(((positions < low - slack) | (positions > high + slack)).any(axis=1).sum())

    def checks(self) -> list[Check]:
        """The universal checks. Deletions are reported by the library's own count."""
        world = self.world
        flow = world.flow
        lost = self.start_count + flow.emitted - flow.drained - flow.killed - len(world) - world.stats.deleted_total
        return [
            Check("values that are not finite", self.not_finite, 0),
            Check("particles lost without an event", abs(lost), 0),
            Check("particles outside the domain", self.outside, 0),
            Check("highest speed over the clamp", self.clamp_ratio, 1.0 + SPEED_ROUNDING),
        ]


def total_energy(stats: pbmpm.Stats) -> float:
    """Kinetic and potential energy [J]."""
    return stats.kinetic_energy + stats.potential_energy


def highest_energy(
    watch: Watch, seconds: float, dt: float, *, longest: float = 0.0, is_over: Callable[[], bool] = lambda: True
) -> Check:
    """Steps matter that begins at rest and unstrained in gravity, and compares its kinetic and potential energy with the
    start's, above the floor at the origin. What is stored as strain came from there, so the sum without it is bounded, too.
    It goes on until it is over, for the longest time at most."""
    start, peak, steps = potential_energy(watch.world), -math.inf, 0
    while steps < max(1, round(seconds / dt)) or (steps < longest / dt and not is_over()):
        peak = max(peak, total_energy(watch.step(dt)) / start)
        steps += 1
    return Check("highest energy over the start's", peak, 1.0 + ENERGY_SLACK)


def potential_energy(world: pbmpm.World) -> float:
    """Energy in gravity of a world at rest, relative to its origin [J]."""
    positions = world.positions.array().astype(float)
    weights = world.masses.array().astype(float)
    return -float(weights @ (positions @ np.array(world.gravity)))


def occupied_share(world: pbmpm.World, cells: int) -> float:
    """Number of cells with particles, over the number that the matter fills at rest."""
    places = np.floor(world.positions.array() / world.cell_size).astype(int)
    return len(np.unique(places, axis=0)) / cells
