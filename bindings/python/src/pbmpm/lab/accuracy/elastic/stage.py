"""Worlds of elastic bodies that start from a given field of velocities, and their runs.

Bodies are regular lattices of 2 particles per cell and axis, or more, aligned with the grid, so that a body of n
cells has 2 n particles across and its rest volume is exact. A clamp is a box with sticky friction whose face is where
the body ends: the library pushes particles out of obstacles, so a body cannot reach into its clamp. The nodes on the
face and behind it stand still; those before it are free. A body is therefore held over its last cell only, and a
little softer there than the built-in end of a beam: an error of discretisation that goes with the cell size.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import pbmpm

from ...meter import stepping_clock
from ...simulation import RunSettings
from ..case import Measurement
from . import strain
from .theory import Solid

PARTICLES_PER_AXIS = 2
CLAMP_OVERLAP = 1e-3
"""Cells by which a clamp's face lies within the body, so that rounding cannot free the nodes on it. The outermost
particles are a quarter of a cell away."""

MODELS = {
    strain.FIXED_COROTATED: pbmpm.ElasticModel.FIXED_COROTATED,
    strain.NEO_HOOKEAN: pbmpm.ElasticModel.NEO_HOOKEAN,
}

VelocityField = Callable[[np.ndarray], np.ndarray]


def lattice(
    lower: Sequence[float], upper: Sequence[float], cell_size: float, per_axis: int = PARTICLES_PER_AXIS
) -> np.ndarray:
    """Points of the regular lattice that fills a box, shape (n, d); ``per_axis`` of them per cell and axis."""
    axes = []
    for low, high in zip(lower, upper):
        count = max(1, round(per_axis * (high - low) / cell_size))
        axes.append(low + (np.arange(count) + 0.5) * (high - low) / count)
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def disc(centre: Sequence[float], radius: float, cell_size: float) -> np.ndarray:
    """Points of the lattice around the centre within the radius: a disc, or a ball."""
    middle = np.asarray(centre, dtype=float)
    reach = math.ceil(radius / cell_size) * cell_size
    points = lattice(middle - reach, middle + reach, cell_size)
    return points[np.sum((points - middle) ** 2, axis=1) < radius**2]


@dataclass
class State:
    """A copy of a body's particles, in the order in which they were added."""

    positions: np.ndarray
    velocities: np.ndarray
    affine: np.ndarray
    deformations: np.ndarray
    masses: np.ndarray


class Stage:
    """A world of elastic bodies of one material. Use it as a context manager."""

    def __init__(
        self,
        solid: Solid,
        cell_size: float,
        settings: RunSettings,
        capacity: int,
        gravity: Sequence[float] | None = None,
        model: str = strain.FIXED_COROTATED,
    ) -> None:
        self.solid, self.cell_size, self.settings, self.model = solid, cell_size, settings, model
        self.world = pbmpm.World(
            solid.dimension,
            cell_size,
            capacity=capacity,
            gravity=gravity if gravity is not None else [0.0] * solid.dimension,
            max_displacement=64.0,
            **settings.for_world(),
        )
        self.material = self.world.add_material(
            pbmpm.Elastic(
                density=solid.density,
                young_modulus=solid.young,
                poisson_ratio=solid.poisson,
                elastic_model=MODELS[model],
            )
        )

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.world.close()

    def add_body(
        self,
        points: np.ndarray,
        volume: float,
        velocity: VelocityField | None = None,
        gradient: np.ndarray | None = None,
    ) -> np.ndarray:
        """Adds a body of this rest volume [m^d]; gives its particles' identifiers in the order of ``points``.

        ``gradient`` is the velocity gradient at each point, shape (n, d, d) or (d, d).
        """
        speeds = None if velocity is None else velocity(points)
        ids = self.world.add_particles(self.material, points, speeds, volume / len(points))
        if gradient is not None:
            shape = (len(points), self.solid.dimension, self.solid.dimension)
            self.world.set(pbmpm.Field.AFFINE_VELOCITY, np.broadcast_to(gradient, shape), ids)
        return ids

    def clamp(self, axis: int, face: float, side: int) -> None:
        """Holds what ends at this face; ``side`` is +1 when the body lies beyond it along the axis, else -1."""
        thick = 4.0 * self.cell_size
        half = [1e3 * self.cell_size] * self.solid.dimension
        half[axis] = 0.5 * thick
        position = [0.0] * self.solid.dimension
        position[axis] = face + side * (CLAMP_OVERLAP * self.cell_size - 0.5 * thick)
        self.world.add_collider(pbmpm.Box(position, half), friction=pbmpm.Friction.STICK)

    def state(self, ids: np.ndarray) -> State:
        """Where the particles are and how they move."""
        world, rows = self.world, self.world.find(ids)
        views = (world.positions, world.velocities, world.affine_velocities, world.deformations, world.masses)
        return State(*(np.array(view.array()[rows], dtype=np.float64) for view in views))

    def mean_position(self, ids: np.ndarray) -> np.ndarray:
        """Of some particles [m]."""
        return self.world.positions.array()[self.world.find(ids)].astype(np.float64).mean(axis=0)

    def angular_momentum(self, ids: np.ndarray) -> float:
        """About the body's centre of mass."""
        s = self.state(ids)
        return strain.angular_momentum(s.positions, s.velocities, s.affine, s.masses, self.cell_size)

    def energy(self, ids: np.ndarray) -> tuple[float, float]:
        """Kinetic and stored energy of a body [J]."""
        s = self.state(ids)
        moving = strain.kinetic_energy(s.velocities, s.affine, s.masses, self.cell_size)
        return moving, strain.strain_energy(self.solid, self.model, s.deformations, s.masses)


class Calmer:
    """Brings a body to rest by taking a share of its velocities after every step, whatever the solver damps.

    With ``frequency`` that of the slowest vibration, 2 omega times the velocity is just enough for it not to swing back
    (critical damping): after t what is left is (1 + omega t) exp(-omega t).
    """

    def __init__(self, stage: Stage, ids: np.ndarray, frequency: float) -> None:
        self._stage, self._ids = stage, ids
        self._kept = math.exp(-4.0 * math.pi * frequency * stage.settings.dt)

    def look(self) -> None:
        """To be called after each step."""
        world = self._stage.world
        rows = world.find(self._ids)
        for motion in (pbmpm.Field.VELOCITY, pbmpm.Field.AFFINE_VELOCITY):
            world.set(motion, self._kept * world.view(motion).array()[rows], self._ids)


@dataclass
class Record:
    """What a run gave."""

    times: np.ndarray
    values: np.ndarray  #: one row per observation
    ms_per_simulated_second: float
    iterations_used: float  #: per substep, mean
    predicted_error: float  #: mean of the steps' [cells]
    energy_checks_failed: int
    reasons: list[str] = field(default_factory=list)  #: why the run is not stable; empty when it is

    @property
    def stable(self) -> bool:
        return not self.reasons

    def measurement(
        self, errors: dict[str, float | None], observed: tuple[float, ...] | None, **extra: Any
    ) -> Measurement:
        """The measurement of a case that consists of this run alone; errors of a run that broke are dropped."""
        return Measurement(
            errors=errors if self.stable else dict.fromkeys(errors),
            ms_per_simulated_second=self.ms_per_simulated_second,
            iterations_used=self.iterations_used,
            predicted_error=self.predicted_error,
            stable=self.stable,
            reasons=list(self.reasons),
            extra={"energy_checks_failed": self.energy_checks_failed, **extra},
            observed=observed if self.stable else None,
        )


def run(
    stage: Stage,
    seconds: float,
    observe: Callable[[], Sequence[float] | float | None],
    speed_limit: float,
    every: int = 1,
) -> Record:
    """Steps a stage for ``seconds`` and observes it before the first and after each ``every``-th step.

    What is observed may be None, for callers who only want to look or act.

    A run ends early, as not stable, when a figure is not finite, a particle was deleted, or one is faster than
    ``speed_limit`` [m/s]. Only the calls of the library's step are timed.
    """
    world, dt, clock = stage.world, stage.settings.dt, stepping_clock(stage.settings.threads)
    steps = max(1, round(seconds / dt))
    times, values, reasons = [0.0], [observe()], []
    spent, done, used, predicted, refused = 0.0, 0, 0, 0.0, 0
    for step in range(1, steps + 1):
        begin = clock()
        world.step(dt)
        spent += clock() - begin
        stats, done = world.stats, step
        used, predicted = used + stats.iterations_used, predicted + stats.predicted_error
        refused += stats.energy_checks_failed
        reasons = failures(stats, speed_limit)
        if reasons:
            break
        if step % every == 0:
            times.append(step * dt)
            values.append(observe())
    return Record(
        np.array(times),
        np.array(values, dtype=np.float64),
        1e3 * spent / (done * dt),
        used / done,
        predicted / done,
        refused,
        reasons,
    )


def failures(stats: pbmpm.Stats, speed_limit: float) -> list[str]:
    """What makes a step count as failed."""
    when = f"at {stats.simulated_seconds:.3f} s"
    if not (math.isfinite(stats.max_speed) and math.isfinite(stats.kinetic_energy)):
        return [f"a figure is not finite {when}"]
    if stats.deleted_total:
        return [f"particles were deleted {when}"]
    if stats.max_speed > speed_limit:
        return [f"{stats.max_speed:.3g} m/s, more than {speed_limit:.3g}, {when}"]
    return []
