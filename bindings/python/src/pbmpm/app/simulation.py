"""A scene brought to life: the only place of the command that builds worlds from scenes."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

import pbmpm

from .errors import InputError
from .bodies import Body
from .flows import Flows, emitted_at_most, shape_of
from .frame import Frame
from .motion import collider_pose
from .names import IntegratorName, PressureName, SolverName
from .scene import Scene
from .solids import baked_solid

DELETIONS = (
    pbmpm.EventKind.DELETED_NOT_FINITE,
    pbmpm.EventKind.DELETED_OUT_OF_RANGE,
    pbmpm.EventKind.DELETED_CONDITION,
)


@dataclass(frozen=True)
class RunSettings:
    """What may differ from run to run of one scene."""

    rate_hz: float
    substeps: int
    iterations: int
    threads: int = 0
    """0: one per core."""
    solver: SolverName = "paper"
    pressure: PressureName = "particles"
    integrator: IntegratorName = "euler"
    flip: float = 0.0
    target_error: float = 0.0
    time_budget_ms: float = 0.0

    @classmethod
    def of(cls, scene: Scene, threads: int = 0, **changes: Any) -> RunSettings:
        """What a scene asks for, but for the changes."""
        own = {"rate_hz": scene.rate_hz, "substeps": scene.substeps, "iterations": scene.iterations}
        return cls(**{**own, **scene.solver.model_dump(), "threads": threads, **changes})

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return 1.0 / self.rate_hz

    def text(self) -> str:
        """For captions."""
        parts = f" x {self.substeps} substeps" if self.substeps > 1 else ""
        return (
            f"{self.solver_text()}, {self.rate_hz:g} Hz{parts} x {self.iterations}"
            f" iteration{'s' if self.iterations > 1 else ''}"
        )

    def solver_text(self) -> str:
        """The solver with its options where they differ from the defaults."""
        options = [name for name, plain in ((self.pressure, "particles"), (self.integrator, "euler")) if name != plain]
        return "-".join([self.solver, *options, *([f"flip{self.flip:g}"] if self.flip else [])])

    def as_dict(self) -> dict[str, Any]:
        """For reports: everything but the threads."""
        return {item.name: getattr(self, item.name) for item in fields(self) if item.name != "threads"}

    def for_world(self) -> dict[str, Any]:
        """The settings as `pbmpm.World` takes them."""
        return {
            "threads": self.threads,
            "substeps": self.substeps,
            "iterations": self.iterations,
            "solver": pbmpm.Solver[self.solver.upper()],
            "pressure": pbmpm.Pressure[self.pressure.upper()],
            "integrator": pbmpm.Integrator[self.integrator.upper()],
            "flip": self.flip,
            "target_error": self.target_error,
            "time_budget_ms": self.time_budget_ms,
        }


def versions() -> dict[str, str]:
    """Versions of what makes the result."""
    return {"pbmpm": pbmpm.__version__, "numpy": np.__version__}


class Simulation:
    """A world filled as the scene says, with its obstacles following their motions. Use it as a context manager."""

    def __init__(self, scene: Scene, settings: RunSettings) -> None:
        self.scene, self.settings = scene, settings
        self.steps = 0
        self.events: Counter[str] = Counter()
        """Particles by kind of event, as far as the library kept the events."""
        self._events_missed = 0
        self.world = _make_world(scene, settings)
        try:
            self._populate()
        except BaseException:
            self.world.close()
            raise
        self.start_count = len(self.world)
        self.start_mass = float(np.sum(self.world.masses, dtype=np.float64))

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: Any) -> None:
        self.world.close()

    def _populate(self) -> None:
        self.materials = {name: self.world.add_material(_material(part)) for name, part in self.scene.materials.items()}
        self._rows = np.zeros(max(m.index for m in self.materials.values()) + 1, dtype=np.uint8)
        for row, material in enumerate(self.materials.values()):
            self._rows[material.index] = row
        for index, fill in enumerate(self.scene.fills):
            added = self.world.fill(
                shape_of(fill.shape),
                self.materials[fill.material],
                particles_per_axis=fill.particles_per_axis,
                jitter=fill.jitter,
                seed=fill.seed,
                velocity=fill.velocity,
            )
            if added == 0:
                raise InputError(
                    f"{self.scene.name}: fills[{index}]: no particle fits into this shape inside the domain"
                )
        self._moving = []
        self._bodies: dict[int, Body] = {}
        for index, part in enumerate(self.scene.colliders):
            collider = self.world.add_collider(
                self._obstacle_shape(part.shape),
                friction=pbmpm.Friction[part.friction.upper()],
                friction_coefficient=part.friction_coefficient,
                kinematic=part.motion is not None or part.body is not None,
                measures_impulse=part.body is not None,
            )
            if part.body is not None:
                self._bodies[index] = Body(collider, part, self.scene)
            if part.motion is not None:
                position, rotation = collider_pose(part, 0.0)
                collider.teleport(position[: self.scene.dimension], rotation)
                self._moving.append((collider, part))
        self._flows = Flows(self.world, self.scene, self.materials)

    def _obstacle_shape(self, part: Any) -> pbmpm.Shape:
        if part.kind not in ("mesh", "heights"):
            return shape_of(part)
        solid = self.world.load_solid(baked_solid(part, self.scene.dimension))
        return pbmpm.Baked(part.position, solid, part.rotation)

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self.steps * self.settings.dt

    @property
    def isa(self) -> str:
        """Instruction set of the kernels."""
        return pbmpm.isa()

    @property
    def thread_count(self) -> int:
        """Shares the work was cut into; as asked for before the first step."""
        return self.world.stats.thread_count or self.settings.threads

    def step(self) -> None:
        """Advances by one step, with the obstacles on their way."""
        for collider, part in self._moving:
            position, rotation = collider_pose(part, (self.steps + 1) * self.settings.dt)
            collider.move(position[: self.scene.dimension], rotation)
        self._flows.before_step(self.time, self.settings.dt)
        for body in self._bodies.values():
            body.before_step(self.settings.dt)
        self.world.step(self.settings.dt)
        for body in self._bodies.values():
            body.after_step(self.settings.dt)
        self.steps += 1

    def stats(self) -> pbmpm.Stats:
        """Figures of the last step; counts its events."""
        for event in self.world.events:
            self.events[event.kind.name.lower()] += event.count
        self._events_missed += self.world.events_missed
        return self.world.stats

    def frame(self) -> Frame:
        """A copy of all particles."""
        world = self.world
        return Frame(
            self.time,
            self.steps,
            world.positions.copy(),
            world.velocities.copy(),
            world.volume_ratios.copy(),
            self._rows[world.material_indices.copy()],
            world.ids.copy(),
            {index: body.pose for index, body in self._bodies.items()},
        )

    def finite(self) -> bool:
        """Whether all positions, velocities and volume ratios are finite."""
        world = self.world
        return all(
            bool(np.isfinite(field.array()).all()) for field in (world.positions, world.velocities, world.volume_ratios)
        )

    def problems(self) -> list[str]:
        """What a run must never show: numbers that are not finite, or particles lost without a word."""
        found = []
        if not self.finite():
            found.append("a position, velocity or volume ratio is not finite")
        stats = self.world.stats
        flow = self.world.flow
        lost = self.start_count + flow.emitted - flow.drained - flow.killed - len(self.world)
        if lost != stats.deleted_total:
            found.append(f"{lost} particles are gone, but the library reports {stats.deleted_total} deletions")
        told = sum(self.events[kind.name.lower()] for kind in DELETIONS)
        if not told <= stats.deleted_total <= told + self._events_missed:
            found.append(f"the library deleted {stats.deleted_total} particles, but events tell of {told}")
        return found

    def figures(self) -> dict[str, Any]:
        """The part of a report that speaks of the state reached."""
        stats = self.world.stats
        return {
            "particles": len(self.world),
            "particles_at_start": self.start_count,
            "simulated_seconds": self.time,
            "volume_error_rms": stats.volume_error_rms,
            "volume_error_max": stats.volume_error_max,
            "max_speed": stats.max_speed,
            "mass": float(np.sum(self.world.masses, dtype=np.float64)),
            "mass_at_start": self.start_mass,
            "momentum": list(stats.momentum),
            "kinetic_energy": stats.kinetic_energy,
            "potential_energy": stats.potential_energy,
            "deleted": stats.deleted_total,
            "clamped": stats.clamped_total,
            "events": dict(self.events),
            **self._flows.figures(),
            **({"bodies": [body.figures() for body in self._bodies.values()]} if self._bodies else {}),
            "finite": self.finite(),
            "memory_bytes": stats.memory_bytes,
            "hash": f"{self.world.hash():016x}",
        }


def _make_world(scene: Scene, settings: RunSettings) -> pbmpm.World:
    domain = scene.domain
    return pbmpm.World(
        scene.dimension,
        scene.cell_size,
        capacity=scene.capacity or max(1, _capacity(scene) + emitted_at_most(scene)),
        gravity=scene.gravity,
        domain=None if domain is None else (domain.min, domain.max),
        domain_friction=None if domain is None else domain.friction,
        origin=scene.origin,
        max_displacement=scene.max_displacement,
        **settings.for_world(),
    )


def _capacity(scene: Scene) -> int:
    """Room for every lattice point of every fill: those in the boxes around them, and one more layer on each side."""
    total = 0
    for fill in scene.fills:
        shape, spacing = fill.shape, scene.cell_size / fill.particles_per_axis
        half = getattr(shape, "half_extents", None) or [shape.radius] * scene.dimension
        if shape.kind == "capsule":
            half = [half[0] + shape.half_length, *half[1:]]
        total += math.prod(math.ceil(2 * extent / spacing) + 2 for extent in half)
    return total


def _material(part: Any) -> pbmpm.Liquid | pbmpm.Elastic:
    values = part.model_dump(exclude={"kind"})
    if part.kind == "liquid":
        return pbmpm.Liquid(**values)
    values["strain_policy"] = pbmpm.StrainPolicy[part.strain_policy.upper()]
    values["elastic_model"] = pbmpm.ElasticModel[part.elastic_model.upper()]
    return pbmpm.Elastic(**values)
