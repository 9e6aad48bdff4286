"""Scene files: a documented JSON format, checked field by field.

A scene holds everything a run needs: the world, its materials, what fills it, the obstacles and how they move, the
rate, and when to take pictures. ``samples/scenes/README.md`` describes each field; the classes here are the same
description in code. Lengths are metres, times seconds, angles radians. Vectors have as many components as the
scene's ``dimension``. Unknown fields are refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Annotated, Any, Literal, cast, get_args, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, model_validator

from ...materials import Elastic, Liquid, Sand, Visco
from ...settings import DEFAULTS
from ..names import EffectName, IntegratorName, PressureName, SolverName

FORMAT_NAME = "pbmpm-scene"
FORMAT_VERSION = 1
DEFAULT_PICTURE_COUNT = 5

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1)]
Modulus = Annotated[float, Field(ge=1e-3, le=1e15)]
Rate = Annotated[float, Field(ge=0.1, le=1e6)]
Substeps = Annotated[int, Field(ge=1, le=256)]
Iterations = Annotated[int, Field(ge=1, le=1000)]
Milliseconds = Annotated[float, Field(ge=0, le=1e6)]
Vector = Annotated[list[Finite], Field(min_length=2, max_length=3)]
PositiveVector = Annotated[list[Positive], Field(min_length=2, max_length=3)]
Rotation = Finite | Annotated[list[Finite], Field(min_length=4, max_length=4)]


class Part(BaseModel):
    """Base of all parts of a scene: unknown fields and wrong types are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    @classmethod
    @cache
    def vectors(cls) -> frozenset[str]:
        """The fields with a number per axis: those of the type Vector or PositiveVector."""
        hints = get_type_hints(cls, include_extras=True)
        return frozenset(name for name in cls.model_fields if any(kind in (hints[name], *get_args(hints[name])) for kind in (Vector, PositiveVector)))

    @classmethod
    def kinds(cls) -> Iterator[type[Part]]:
        """This one, and all that derive from it."""
        yield cls
        for kind in cls.__subclasses__():
            yield from kind.kinds()


_LIQUID, _ELASTIC, _SAND, _VISCO = Liquid(), Elastic(), Sand(), Visco()  # the library's defaults


class LiquidPart(Part):
    """A liquid. Fields and defaults are those of ``pbmpm_material_def``."""

    kind: Literal["liquid"]
    density: Annotated[float, Field(ge=1e-3, le=1e6)] = _LIQUID.density
    relaxation: Annotated[float, Field(gt=0, lt=2)] = _LIQUID.relaxation
    viscosity: Share = _LIQUID.viscosity
    volume_feedback: Share = _LIQUID.volume_feedback
    bulk_modulus: Modulus | Annotated[float, Field(ge=0, le=0)] = _LIQUID.bulk_modulus
    """0: incompressible."""
    kinematic_viscosity: Annotated[float, Field(ge=0, le=1e6)] = _LIQUID.kinematic_viscosity


class _SolidPart(Part):
    """What all matter with a deformation gradient has. Fields and defaults are those of ``pbmpm_material_def``."""

    density: Annotated[float, Field(ge=1e-3, le=1e6)] = _ELASTIC.density
    relaxation: Annotated[float, Field(gt=0, lt=2)] = _ELASTIC.relaxation
    elasticity_ratio: Share = _ELASTIC.elasticity_ratio
    strain_policy: Literal["clamp", "delete"] = "clamp"
    strain_min: Annotated[float, Field(ge=1e-3, le=1)] = _ELASTIC.strain_min
    strain_max: Annotated[float, Field(ge=1, le=1e4)] = _ELASTIC.strain_max
    condition_max: Annotated[float, Field(ge=10, le=1e6)] = _ELASTIC.condition_max
    rebound_max: Annotated[float, Field(gt=0, le=10)] = _ELASTIC.rebound_max
    young_modulus: Modulus = _ELASTIC.young_modulus
    poisson_ratio: Annotated[float, Field(ge=0, le=0.495)] = _ELASTIC.poisson_ratio


class ElasticPart(_SolidPart):
    """An elastic solid."""

    kind: Literal["elastic"]
    elastic_model: Literal["fixed_corotated", "neo_hookean"] = "fixed_corotated"


class SandPart(_SolidPart):
    """Grains with friction."""

    kind: Literal["sand"]
    elasticity_ratio: Annotated[float, Field(ge=0.01, le=1)] = _SAND.elasticity_ratio
    friction_angle: Annotated[float, Field(ge=0, le=1.4)] = _SAND.friction_angle
    """[rad]"""
    cohesion: Annotated[float, Field(ge=0, le=0.5)] = _SAND.cohesion
    volume_correction: bool = _SAND.volume_correction


class ViscoPart(_SolidPart):
    """A solid that flows where it is strained too far."""

    kind: Literal["visco"]
    elasticity_ratio: Annotated[float, Field(ge=0.01, le=1)] = _VISCO.elasticity_ratio
    yield_strain: Annotated[float, Field(ge=0, le=10)] = _VISCO.yield_strain
    flow_rate: Annotated[float, Field(ge=0, le=1e9)] = _VISCO.flow_rate
    """[1/s]"""
    volume_feedback: Share = _VISCO.volume_feedback


MaterialPart = Annotated[LiquidPart | ElasticPart | SandPart | ViscoPart, Field(discriminator="kind")]


class PlanePart(Part):
    """Half space behind the plane (2D: line) through ``position`` with the outward ``normal``."""

    kind: Literal["plane"]
    position: Vector
    normal: Vector


class BoxPart(Part):
    """Box (2D: rectangle) around ``position``."""

    kind: Literal["box"]
    position: Vector
    half_extents: PositiveVector
    rotation: Rotation = 0.0


class SpherePart(Part):
    """Ball (2D: disc)."""

    kind: Literal["sphere"]
    position: Vector
    radius: Positive


class CapsulePart(Part):
    """All points within ``radius`` of a segment of ``half_length`` along the local first axis."""

    kind: Literal["capsule"]
    position: Vector
    half_length: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    radius: Positive
    rotation: Rotation = 0.0


class BakedPart(Part):
    """What is baked to a grid of distances."""

    _cell_size: float | None = PrivateAttr(None)

    resolution: Annotated[int, Field(ge=4, le=1024)] | None = None
    """Grid cells along the longest side. Default: as many as the surface needs, and cells no wider than the scene's."""

    @property
    def cell_size(self) -> float | None:
        """Of the scene that it stands in [m]."""
        return self._cell_size

    def stand_in(self, cell_size: float) -> None:
        """Tells it the cell size of its scene [m]."""
        self._cell_size = cell_size


class MeshPart(BakedPart):
    """A solid of any form: closed triangles (2D: edges), from a file or given here, baked to a grid of distances."""

    kind: Literal["mesh"]
    position: Vector
    """Where the origin of the mesh stands."""
    rotation: Rotation = 0.0
    file: str | None = None
    """OBJ, STL, PLY ..., or a baked solid (.sdf); relative to the scene file."""
    vertices: list[Vector] | None = None
    elements: list[Annotated[list[Annotated[int, Field(ge=0)]], Field(min_length=2, max_length=3)]] | None = None
    hull: bool = False
    """The convex hull of the vertices."""

    @model_validator(mode="after")
    def _has_one_source(self) -> MeshPart:
        if (self.file is None) == (self.vertices is None):
            raise ValueError("a mesh needs either a file or vertices")
        if self.vertices is not None and (self.elements is None) != self.hull:
            raise ValueError("vertices need elements, or hull, and not both")
        return self


class HeightsPart(BakedPart):
    """A body that is solid from heights over a lattice down to a base."""

    kind: Literal["heights"]
    position: Vector
    """Where height 0 of the first sample stands."""
    rotation: Rotation = 0.0
    heights: list[Finite] | list[list[Finite]]
    spacing: Positive
    up: Annotated[int, Field(ge=0, le=2)] = 1
    thickness: Positive = 1.0

    @model_validator(mode="after")
    def _is_a_lattice(self) -> HeightsPart:
        if len({len(row) if isinstance(row, list) else 0 for row in self.heights}) != 1:
            raise ValueError("heights: all rows need the same length")
        return self


SolidPart = Annotated[BoxPart | SpherePart | CapsulePart, Field(discriminator="kind")]
ObstaclePart = Annotated[PlanePart | BoxPart | SpherePart | CapsulePart, Field(discriminator="kind")]


AnyObstaclePart = Annotated[
    PlanePart | BoxPart | SpherePart | CapsulePart | MeshPart | HeightsPart, Field(discriminator="kind")
]


class DomainPart(Part):
    """Closed box that holds the matter in."""

    min: Vector
    max: Vector
    friction: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0


class FillPart(Part):
    """A shape filled with particles of one material on a jittered lattice."""

    shape: SolidPart
    material: str
    particles_per_axis: Annotated[float, Field(ge=0.25, le=16)] = 2.0
    jitter: Share = 0.5
    velocity: Vector | None = None
    seed: Annotated[int, Field(ge=0, lt=2**32)] = 1


class KeyframePart(Part):
    """Where an obstacle is at one time."""

    time: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    position: Vector
    rotation: Rotation = 0.0


class MotionPart(Part):
    """Poses over time, linear between the keyframes; held before the first and after the last, or repeated."""

    keyframes: Annotated[list[KeyframePart], Field(min_length=2)]
    repeat: bool = False

    @model_validator(mode="after")
    def _times_rise(self) -> MotionPart:
        times = [frame.time for frame in self.keyframes]
        if any(later <= earlier for earlier, later in zip(times, times[1:])):
            raise ValueError("the times of the keyframes must rise")
        return self


class BodyPart(Part):
    """What makes an obstacle a rigid body that matter pushes. It keeps inside the domain and passes other obstacles."""

    mass: Positive | None = None
    """[kg]; in 2D per metre of depth"""
    density: Positive | None = None
    """[kg/m^3], instead of the mass"""
    moves: bool = True
    """False: it hangs on a hinge, and only turns."""
    pivot: Vector | None = None
    """Where the hinge is; the position of the shape when it is not told."""
    slides: Vector | None = None
    """Its centre of mass moves along this direction alone."""
    turns: bool = True
    axis: Annotated[list[Finite], Field(min_length=3, max_length=3)] | None = None
    """In 3D: it turns about this axis alone."""
    velocity: Vector | None = None

    @model_validator(mode="after")
    def _is_one_body(self) -> BodyPart:
        if (self.mass is None) == (self.density is None):
            raise ValueError("a body needs either a mass or a density")
        if not self.moves and (not self.turns or self.velocity is not None):
            raise ValueError("a body that does not move has to turn, and has no velocity")
        if not self.moves and self.slides is not None:
            raise ValueError("a body that does not move does not slide")
        if self.moves and self.pivot is not None:
            raise ValueError("a body with a pivot does not move: set moves to false")
        for name in ("axis", "slides"):
            if getattr(self, name) is not None and math.hypot(*getattr(self, name)) < 1e-6:
                raise ValueError(f"{name}: must not be zero")
        return self


class ColliderPart(Part):
    """An obstacle; with ``motion`` or ``body`` it is kinematic."""

    shape: AnyObstaclePart
    friction: Literal["coulomb", "stick", "slip"] = "coulomb"
    friction_coefficient: Annotated[float, Field(ge=0, le=100)] = 0.2
    """A number for `friction` is this one, of Coulomb's law."""
    meets: Annotated[list[str], Field(min_length=1)] | None = None
    """Names of the materials that it acts on; default all."""
    motion: MotionPart | None = None
    body: BodyPart | None = None

    @model_validator(mode="before")
    @classmethod
    def _friction_may_be_a_number(cls, data: Any) -> Any:
        """As that of the domain is."""
        if not isinstance(data, dict) or isinstance(data.get("friction"), bool) or not isinstance(data.get("friction"), int | float):
            return data
        if "friction_coefficient" in data:
            raise ValueError("friction: a number is the friction_coefficient, which is there as well")
        return {**data, "friction": "coulomb", "friction_coefficient": data["friction"]}

    @model_validator(mode="after")
    def _moves_one_way(self) -> ColliderPart:
        if self.body is not None and self.motion is not None:
            raise ValueError("an obstacle has a motion or a body, not both")
        if self.body is not None and self.shape.kind == "plane":
            raise ValueError("body: a plane cannot be one")
        return self


class _TimedPart(Part):
    """Something that works from ``start`` until ``stop`` [s]; without ``stop`` for ever."""

    start: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    stop: Positive | None = None

    @model_validator(mode="after")
    def _stops_after_start(self) -> _TimedPart:
        if self.stop is not None and self.stop <= self.start:
            raise ValueError("stop must be after start")
        return self

    def works_at(self, time: float) -> bool:
        """Whether it works in the step that begins at ``time``; a rounding error is forgiven."""
        early = time + 1e-9
        return early >= self.start and (self.stop is None or early < self.stop)


class EmitterPart(_TimedPart):
    """A source of particles; with ``motion`` it moves. Fields and defaults are those of ``pbmpm_emitter_def``."""

    shape: SolidPart
    material: str
    rate: Annotated[float, Field(ge=0, le=1e12)]
    region: Literal["volume", "disc"] = "volume"
    speed: Annotated[float, Field(ge=0, le=1e6)] = 0.0
    direction: Vector | None = None
    """Default: down the second axis."""
    spread: Annotated[float, Field(ge=0, le=math.pi)] = 0.0
    particles_per_axis: Annotated[float, Field(ge=0.25, le=16)] = 2.0
    fill_limit: Annotated[float, Field(ge=0.1, le=100)] = 1.0
    budget: Annotated[int, Field(ge=0, lt=2**64)] = 0
    """Particles; 0: no limit."""
    seed: Annotated[int, Field(ge=0, lt=2**32)] = 1
    motion: MotionPart | None = None

    @property
    def velocity(self) -> list[float]:
        """As far as pictures care: how fast."""
        return [self.speed]


class DrainPart(_TimedPart):
    """A shape that takes particles out."""

    shape: ObstaclePart
    material: str | None = None
    """Only these; default all."""


class KillBoundsPart(Part):
    """The box that particles live in; those outside are taken out."""

    min: Vector
    max: Vector


class ForcePart(_TimedPart):
    """A force besides gravity. Fields and defaults are those of ``pbmpm_force_def``; without ``shape`` it acts everywhere."""

    kind: Literal["uniform", "radial", "vortex", "drag", "grab"]
    strength: Annotated[float, Field(ge=-1e9, le=1e9)] = 1.0
    shape: ObstaclePart | None = None
    falloff: Literal["none", "linear", "smooth", "inverse_square"] = "none"
    range: Annotated[float, Field(ge=0, le=1e9)] = 0.0
    direction: Vector | None = None
    """Default: the second axis."""
    velocity: Vector | None = None
    spin: Annotated[float, Field(ge=-1e6, le=1e6)] = 0.0

    @model_validator(mode="after")
    def _makes_sense(self) -> ForcePart:
        if self.kind == "drag" and self.strength < 0:
            raise ValueError("the strength of a drag must not be negative")
        if self.falloff == "inverse_square" and self.range == 0:
            raise ValueError("range: an inverse square needs one greater than 0")
        return self


class CameraPart(Part):
    """A perspective camera for pictures of 3D scenes."""

    eye: Annotated[list[Finite], Field(min_length=3, max_length=3)]
    target: Annotated[list[Finite], Field(min_length=3, max_length=3)]
    field_of_view: Annotated[float, Field(gt=0.05, lt=3.0)] = 0.6


class SolverPart(Part):
    """How the equations are solved. Fields and defaults are those of ``pbmpm_settings``. A name alone stands for ``{"solver": name}``."""

    @model_validator(mode="before")
    @classmethod
    def _from_name(cls, data: Any) -> Any:
        return {"solver": data} if isinstance(data, str) else data

    solver: SolverName = cast(SolverName, DEFAULTS.solver.name.lower())
    pressure: PressureName = cast(PressureName, DEFAULTS.pressure.name.lower())
    integrator: IntegratorName = cast(IntegratorName, DEFAULTS.integrator.name.lower())
    flip: Share = DEFAULTS.flip
    target_error: Share = DEFAULTS.target_error
    time_budget_ms: Milliseconds = DEFAULTS.time_budget_ms


class SleepingPart(Part):
    """Matter at rest takes no part in steps. None: the library's defaults, those of ``pbmpm_settings``."""

    speed: Annotated[float, Field(ge=1e-9, le=1e9)] | None = None
    """[m/s]"""
    time: Annotated[float, Field(ge=0, le=1e6)] | None = None
    """[s]"""


class PicturesPart(Part):
    """When to take pictures and how they look."""

    times: list[Annotated[float, Field(ge=0, allow_inf_nan=False)]] | None = None
    colour: Literal["speed", "material"] = "speed"
    width: Annotated[int, Field(ge=160, le=7680)] = 1280
    camera: CameraPart | None = None


class Scene(Part):
    """A whole scene. ``notes`` is filled by importers with what they could not carry over."""

    format: Literal["pbmpm-scene"]
    version: Literal[1]
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_.-]+$", max_length=80)]
    description: str = ""
    dimension: Literal[2, 3]
    cell_size: Annotated[float, Field(ge=1e-6, le=1e6)]
    origin: Vector | None = None
    gravity: Vector
    domain: DomainPart | None = None
    seconds: Positive
    rate_hz: Rate = 60.0
    substeps: Substeps = DEFAULTS.substeps
    iterations: Iterations = DEFAULTS.iterations
    solver: SolverPart = SolverPart()
    max_displacement: Annotated[float, Field(ge=0.1, le=64)] = DEFAULTS.max_displacement
    materials: Annotated[dict[str, MaterialPart], Field(min_length=1)]
    fills: list[FillPart] = []
    colliders: list[ColliderPart] = []
    emitters: list[EmitterPart] = []
    drains: list[DrainPart] = []
    kill_bounds: KillBoundsPart | None = None
    forces: list[ForcePart] = []
    sleeping: SleepingPart | None = None
    """Without it matter never sleeps, unless ``effects`` has it."""
    capacity: Annotated[int, Field(ge=1, le=2**28)] | None = None
    """Particles that there is room for; default: what fills and emitters can bring."""
    effects: list[EffectName] | None = None
    """The effects that the scene is meant to have; without the list they follow from what is in it."""
    pictures: PicturesPart = PicturesPart()
    notes: list[str] = []

    @model_validator(mode="after")
    def _solids_know_the_cells(self) -> Scene:
        for collider in self.colliders:
            if isinstance(collider.shape, BakedPart):
                collider.shape.stand_in(self.cell_size)
        return self

    @model_validator(mode="after")
    def _pictures_are_taken(self) -> Scene:
        late = [time for time in self.pictures.times or [] if time > self.seconds]
        if late:
            raise ValueError(f"pictures.times: {late[0]:g} s is after the end of the scene at {self.seconds:g} s")
        return self

    @property
    def sources(self) -> list[FillPart | EmitterPart]:
        """All that brings particles."""
        return [*self.fills, *self.emitters]

    def picture_times(self, seconds: float) -> list[float]:
        """The scene's own times up to ``seconds``, or evenly spread ones when it names none."""
        if self.pictures.times is not None:
            return [time for time in self.pictures.times if time <= seconds]
        return [seconds * index / (DEFAULT_PICTURE_COUNT - 1) for index in range(DEFAULT_PICTURE_COUNT)]


def material_groups(scene: Scene) -> dict[str, int]:
    """The groups of each material: one of its own where an obstacle does not act on all."""
    chosen = any(part.meets is not None for part in scene.colliders)
    return {name: 1 << index if chosen else 1 for index, name in enumerate(scene.materials)}
