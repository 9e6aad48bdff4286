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
from .scenes.motion import collider_pose
from .names import IntegratorName, PressureName, SolverName
from .scenes.scene import Scene, SolverPart, material_groups
from .scenes.solids import baked_solid
from .state import State, put_into

DELETIONS = (
    pbmpm.EventKind.DELETED_NOT_FINITE,
    pbmpm.EventKind.DELETED_OUT_OF_RANGE,
    pbmpm.EventKind.DELETED_CONDITION,
)

_PLAIN = SolverPart()  # the library's defaults


@dataclass(frozen=True)
class RunSettings:
    """What may differ from run to run of one scene."""

    rate_hz: float
    substeps: int
    iterations: int
    threads: int = 0
    """0: one per core."""
    solver: SolverName = _PLAIN.solver
    pressure: PressureName = _PLAIN.pressure
    integrator: IntegratorName = _PLAIN.integrator
    flip: float = _PLAIN.flip
    target_error: float = _PLAIN.target_error
    time_budget_ms: float = _PLAIN.time_budget_ms

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
        return f"{self.solver_text()}, {self.pace_text()}"

    def pace_text(self) -> str:
        """Rate, substeps and iterations for people."""
        parts = f" x {self.substeps} substeps" if self.substeps > 1 else ""
        return f"{self.rate_hz:g} Hz{parts} x {self.iterations} iteration{'s' if self.iterations > 1 else ''}"

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
            "solver": self.solver,
            "pressure": self.pressure,
            "integrator": self.integrator,
            "flip": self.flip,
            "target_error": self.target_error,
            "time_budget_ms": self.time_budget_ms,
        }


def solved_with(scene: Scene, settings: RunSettings) -> Scene:
    """The scene as if it had asked for these settings of the solver itself."""
    solver = SolverPart(**{name: getattr(settings, name) for name in SolverPart.model_fields})
    return scene.model_copy(update={"solver": solver})


def versions() -> dict[str, str]:
    """Versions of what makes the result."""
    return {"pbmpm": pbmpm.__version__, "numpy": np.__version__}


@dataclass(frozen=True)
class Bookmark:
    """A moment of a simulation to go back to."""

    snapshot: bytearray
    steps: int
    switched: dict[int, bool]
    bodies: tuple[dict[str, Any], ...]


class Simulation:
    """A world filled as the scene says, with its obstacles following their motions. Use it as a context manager.

    With a ``start`` it begins with the matter of another simulation, in place of the scene's fills; ``room`` is then for
    so many particles.
    """

    def __init__(self, scene: Scene, settings: RunSettings, start: State | None = None, room: int = 0) -> None:
        self.scene, self.settings = scene, settings
        self.steps = start.steps if start is not None else 0
        self.events: Counter[str] = Counter()
        """Particles by kind of event, as far as the library kept the events."""
        self._events_missed = 0
        self.world = _make_world(scene, settings, room)
        try:
            self._populate(start)
        except BaseException:
            self.world.close()
            raise
        self.start_count = len(self.world)
        self.start_mass = self._mass()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: Any) -> None:
        self.world.close()

    def _populate(self, start: State | None) -> None:
        self._groups = material_groups(self.scene)
        self.materials = {name: self.world.add_material(_material(part, self._groups[name])) for name, part in self.scene.materials.items()}
        self._rows = np.zeros(max(m.index for m in self.materials.values()) + 1, dtype=np.uint8)
        for row, material in enumerate(self.materials.values()):
            self._rows[material.index] = row
        self._add_obstacles()  # before the fills, which leave out what is in one
        if start is None:
            self._fill()
        else:
            put_into(self.world, self.materials, start)
        for body, state in zip(self._bodies.values(), start.bodies if start is not None else ()):
            body.state = state
        self._flows = Flows(self.world, self.scene, self.materials, self.time)

    def _fill(self) -> None:
        for index, fill in enumerate(self.scene.fills):
            try:
                self.world.fill(
                    shape_of(fill.shape),
                    self.materials[fill.material],
                    particles_per_axis=fill.particles_per_axis,
                    jitter=fill.jitter,
                    seed=fill.seed,
                    velocity=fill.velocity,
                )
            except (pbmpm.InvalidArgumentError, pbmpm.CapacityError) as problem:
                raise InputError(f"{self.scene.name}: fills[{index}]: {problem}") from problem

    def _add_obstacles(self) -> None:
        self.colliders: list[pbmpm.Collider] = []
        """In the order of the scene."""
        self._moving = []
        measured = measures_all(self.scene)
        self._bodies: dict[int, Body] = {}
        for index, part in enumerate(self.scene.colliders):
            collider = self.world.add_collider(
                self._obstacle_shape(part.shape, f"colliders[{index}].shape"),
                friction=part.friction,
                friction_coefficient=part.friction_coefficient,
                kinematic=part.motion is not None or part.body is not None,
                measures_impulse=measured or part.body is not None,
                meets=sum(self._groups[name] for name in set(part.meets or ())),
            )
            self.colliders.append(collider)
            if part.body is not None:
                self._bodies[index] = Body(collider, part, self.scene)
            if part.motion is not None:
                position, rotation = collider_pose(part, self.time)
                collider.teleport(position[: self.scene.dimension], rotation)
                self._moving.append((collider, part))

    def _obstacle_shape(self, part: Any, field: str) -> pbmpm.Shape:
        if part.kind not in ("mesh", "heights"):
            return shape_of(part)
        try:
            solid = self.world.load_solid(baked_solid(part, self.scene.dimension))
        except InputError as problem:
            raise InputError(f"{self.scene.name}: {field}: {problem}") from None
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
        self._set_motions()
        self._flows.before_step(self.time, self.settings.dt)
        for body in self._bodies.values():
            body.before_step(self.settings.dt)
        self.advance(self.settings.dt)
        self.steps += 1

    def advance(self, dt: float) -> None:
        """The step of the world alone."""
        self.world.step(dt)

    def advice(self) -> list[pbmpm.Advice]:
        """What the scene and settings will not hold in the next step, and what came true so far."""
        self._set_motions()
        return self.world.advice(self.settings.dt)

    def _set_motions(self) -> None:
        """Where moving obstacles are at the end of the next step."""
        for collider, part in self._moving:
            position, rotation = collider_pose(part, (self.steps + 1) * self.settings.dt)
            collider.move(position[: self.scene.dimension], rotation)

    def body_states(self) -> tuple[dict[str, Any], ...]:
        """How the rigid bodies are and move, in the order of the scene."""
        return tuple(body.state for body in self._bodies.values())

    def bookmark(self) -> Bookmark:
        """A copy of the present moment."""
        return Bookmark(self.world.snapshot(), self.steps, self._flows.switched, self.body_states())

    def go_back(self, bookmark: Bookmark) -> None:
        """Makes everything as it was; the counts of events stay."""
        self.world.restore(bookmark.snapshot)
        self.steps, self._flows.switched = bookmark.steps, bookmark.switched
        for body, state in zip(self._bodies.values(), bookmark.bodies, strict=True):
            body.state = state

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
            world.surface_points()["radius"],
        )

    def surfaces(self) -> list[pbmpm.Mesh]:
        """The surface of each material of the scene, in 3D."""
        return [self.world.surface([material], velocities=True) for material in self.materials.values()]

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
        stats, account = self.world.stats, self.account()
        if account["missing"] != 0:
            lost = account["missing"] + account["deleted"]
            found.append(f"{lost} particles are gone, but the library reports {account['deleted']} deletions")
        if not account["missing"] and not stats.deleted_total and abs(account["missing_mass"]) > self._mass_tolerance():
            found.append(f"{account['missing_mass']:.6g} kg are gone, but no particle is")
        told = sum(self.events[kind.name.lower()] for kind in DELETIONS)
        if not told <= stats.deleted_total <= told + self._events_missed:
            found.append(f"the library deleted {stats.deleted_total} particles, but events tell of {told}")
        return found

    def account(self) -> dict[str, Any]:
        """Where all particles and their mass [kg] (2D: per metre of depth) came from and went: what was there at the start and
        what emitters brought, less what drains, kill bounds and the library took, is there now; but for what is missing.
        The library does not tell the mass of what it deleted: that is missing, too."""
        flow, deleted, now = self.world.flow, self.world.stats.deleted_total, len(self.world)
        left = self.start_mass + flow.emitted_mass - flow.drained_mass - flow.killed_mass
        return {
            "start": self.start_count,
            "emitted": flow.emitted,
            "drained": flow.drained,
            "killed": flow.killed,
            "deleted": deleted,
            "now": now,
            "missing": self.start_count + flow.emitted - flow.drained - flow.killed - deleted - now,
            "missing_mass": left - self._mass(),
        }

    def _mass(self) -> float:
        return float(self.world.stats.mass)

    def _mass_tolerance(self) -> float:
        """Sums in double precision of n masses that do not change are equal but for n roundings at most."""
        flow = self.world.flow
        count, mass = self.start_count + flow.emitted, self.start_mass + flow.emitted_mass
        return 2 * count * float(np.finfo(np.float64).eps) * mass

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
            "mass": self._mass(),
            "mass_at_start": self.start_mass,
            "momentum": list(stats.momentum),
            "kinetic_energy": stats.kinetic_energy,
            "potential_energy": stats.potential_energy,
            "deleted": stats.deleted_total,
            "account": self.account(),
            "clamped": stats.clamped_total,
            "events": dict(self.events),
            **self._flows.figures(),
            **({"bodies": [body.figures() for body in self._bodies.values()]} if self._bodies else {}),
            "finite": self.finite(),
            "memory_bytes": stats.memory_bytes,
            "hash": f"{self.world.hash():016x}",
        }


def measures_all(scene: Scene) -> bool:
    """Whether every obstacle and wall takes impulses, not rigid bodies alone."""
    return "impulses" in (scene.effects or ())


def _make_world(scene: Scene, settings: RunSettings, room: int) -> pbmpm.World:
    domain = scene.domain
    return pbmpm.World(
        scene.dimension,
        scene.cell_size,
        capacity=room or scene.capacity or max(1, _capacity(scene) + emitted_at_most(scene)),
        gravity=scene.gravity,
        domain=None if domain is None else (domain.min, domain.max),
        domain_friction=None if domain is None else domain.friction,
        domain_measures_impulse=measures_all(scene),
        origin=scene.origin,
        max_displacement=scene.max_displacement,
        **settings.for_world(),
        **_sleep(scene),
    )


def _sleep(scene: Scene) -> dict[str, Any]:
    """The settings of sleeping as `pbmpm.World` takes them."""
    if scene.sleeping is not None:
        return {"sleeping": True, "sleep_speed": scene.sleeping.speed, "sleep_time": scene.sleeping.time}
    return {"sleeping": "sleeping" in (scene.effects or ())}


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


_CLASSES = {"liquid": pbmpm.Liquid, "elastic": pbmpm.Elastic, "sand": pbmpm.Sand, "visco": pbmpm.Visco}


def _material(part: Any, groups: int) -> pbmpm.Liquid | pbmpm.Elastic | pbmpm.Sand | pbmpm.Visco:
    return _CLASSES[part.kind](**part.model_dump(exclude={"kind"}), groups=groups)
