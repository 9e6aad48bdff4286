"""Scene files: a documented JSON format, checked field by field.

A scene holds everything a run needs: the world, its materials, what fills it, the obstacles and how they move, the
rate, and when to take pictures. ``samples/scenes/README.md`` describes each field; the classes here are the same
description in code. Lengths are metres, times seconds, angles radians. Vectors have as many components as the
scene's ``dimension``. Unknown fields are refused.
"""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Annotated, Any, Literal, cast

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from ..materials import Elastic, Liquid, Sand, Visco
from ..settings import DEFAULTS
from .errors import InputError
from .hints import did_you_mean
from .names import EffectName, IntegratorName, PressureName, SolverName

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


class _Part(BaseModel):
    """Base of all parts of a scene: unknown fields and wrong types are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


_LIQUID, _ELASTIC, _SAND, _VISCO = Liquid(), Elastic(), Sand(), Visco()  # the library's defaults


class LiquidPart(_Part):
    """A liquid. Fields and defaults are those of ``pbmpm_material_def``."""

    kind: Literal["liquid"]
    density: Annotated[float, Field(ge=1e-3, le=1e6)] = _LIQUID.density
    relaxation: Annotated[float, Field(gt=0, lt=2)] = _LIQUID.relaxation
    viscosity: Share = _LIQUID.viscosity
    volume_feedback: Share = _LIQUID.volume_feedback
    bulk_modulus: Modulus | Annotated[float, Field(ge=0, le=0)] = _LIQUID.bulk_modulus
    """0: incompressible."""
    kinematic_viscosity: Annotated[float, Field(ge=0, le=1e6)] = _LIQUID.kinematic_viscosity


class _SolidPart(_Part):
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


class PlanePart(_Part):
    """Half space behind the plane (2D: line) through ``position`` with the outward ``normal``."""

    kind: Literal["plane"]
    position: Vector
    normal: Vector


class BoxPart(_Part):
    """Box (2D: rectangle) around ``position``."""

    kind: Literal["box"]
    position: Vector
    half_extents: PositiveVector
    rotation: Rotation = 0.0


class SpherePart(_Part):
    """Ball (2D: disc)."""

    kind: Literal["sphere"]
    position: Vector
    radius: Positive


class CapsulePart(_Part):
    """All points within ``radius`` of a segment of ``half_length`` along the local first axis."""

    kind: Literal["capsule"]
    position: Vector
    half_length: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    radius: Positive
    rotation: Rotation = 0.0


class MeshPart(_Part):
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
    resolution: Annotated[int, Field(ge=4, le=1024)] = 64

    @model_validator(mode="after")
    def _has_one_source(self) -> MeshPart:
        if (self.file is None) == (self.vertices is None):
            raise ValueError("a mesh needs either a file or vertices")
        if self.vertices is not None and (self.elements is None) != self.hull:
            raise ValueError("vertices need elements, or hull, and not both")
        return self


class HeightsPart(_Part):
    """A body that is solid from heights over a lattice down to a base."""

    kind: Literal["heights"]
    position: Vector
    """Where height 0 of the first sample stands."""
    rotation: Rotation = 0.0
    heights: list[Finite] | list[list[Finite]]
    spacing: Positive
    up: Annotated[int, Field(ge=0, le=2)] = 1
    thickness: Positive = 1.0
    resolution: Annotated[int, Field(ge=4, le=1024)] | None = None

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


class DomainPart(_Part):
    """Closed box that holds the matter in."""

    min: Vector
    max: Vector
    friction: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0


class FillPart(_Part):
    """A shape filled with particles of one material on a jittered lattice."""

    shape: SolidPart
    material: str
    particles_per_axis: Annotated[float, Field(ge=0.25, le=16)] = 2.0
    jitter: Share = 0.5
    velocity: Vector | None = None
    seed: Annotated[int, Field(ge=0, lt=2**32)] = 1


class KeyframePart(_Part):
    """Where an obstacle is at one time."""

    time: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    position: Vector
    rotation: Rotation = 0.0


class MotionPart(_Part):
    """Poses over time, linear between the keyframes; held before the first and after the last, or repeated."""

    keyframes: Annotated[list[KeyframePart], Field(min_length=2)]
    repeat: bool = False

    @model_validator(mode="after")
    def _times_rise(self) -> MotionPart:
        times = [frame.time for frame in self.keyframes]
        if any(later <= earlier for earlier, later in zip(times, times[1:])):
            raise ValueError("the times of the keyframes must rise")
        return self


class BodyPart(_Part):
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


class ColliderPart(_Part):
    """An obstacle; with ``motion`` or ``body`` it is kinematic."""

    shape: AnyObstaclePart
    friction: Literal["coulomb", "stick", "slip"] = "coulomb"
    friction_coefficient: Annotated[float, Field(ge=0, le=100)] = 0.2
    meets: Annotated[list[str], Field(min_length=1)] | None = None
    """Names of the materials that it acts on; default all."""
    motion: MotionPart | None = None
    body: BodyPart | None = None

    @model_validator(mode="after")
    def _moves_one_way(self) -> ColliderPart:
        if self.body is not None and self.motion is not None:
            raise ValueError("an obstacle has a motion or a body, not both")
        if self.body is not None and self.shape.kind == "plane":
            raise ValueError("body: a plane cannot be one")
        return self


class _TimedPart(_Part):
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


class KillBoundsPart(_Part):
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


class CameraPart(_Part):
    """A perspective camera for pictures of 3D scenes."""

    eye: Annotated[list[Finite], Field(min_length=3, max_length=3)]
    target: Annotated[list[Finite], Field(min_length=3, max_length=3)]
    field_of_view: Annotated[float, Field(gt=0.05, lt=3.0)] = 0.6


class SolverPart(_Part):
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


class SleepingPart(_Part):
    """Matter at rest takes no part in steps. None: the library's defaults, those of ``pbmpm_settings``."""

    speed: Annotated[float, Field(ge=1e-9, le=1e9)] | None = None
    """[m/s]"""
    time: Annotated[float, Field(ge=0, le=1e6)] | None = None
    """[s]"""


class PicturesPart(_Part):
    """When to take pictures and how they look."""

    times: list[Annotated[float, Field(ge=0, allow_inf_nan=False)]] | None = None
    colour: Literal["speed", "material"] = "speed"
    width: Annotated[int, Field(ge=160, le=7680)] = 1280
    camera: CameraPart | None = None


class Scene(_Part):
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

    @property
    def sources(self) -> list[FillPart | EmitterPart]:
        """All that brings particles."""
        return [*self.fills, *self.emitters]

    def picture_times(self, seconds: float) -> list[float]:
        """The scene's own times up to ``seconds``, or evenly spread ones when it names none."""
        if self.pictures.times is not None:
            return [time for time in self.pictures.times if time <= seconds]
        return [seconds * index / (DEFAULT_PICTURE_COUNT - 1) for index in range(DEFAULT_PICTURE_COUNT)]


#: Bits of the groups of a material.
MATERIALS_THAT_CAN_BE_MET = 32


def material_groups(scene: Scene) -> dict[str, int]:
    """The groups of each material: one of its own where an obstacle does not act on all."""
    chosen = any(part.meets is not None for part in scene.colliders)
    return {name: 1 << index if chosen else 1 for index, name in enumerate(scene.materials)}


def load_scene(path: Path) -> Scene:
    """Reads a scene of our own format or of the EA demo's, told apart by their contents."""
    from .ea_scene import import_ea_scene, looks_like_ea_scene

    data = read_json(path)
    if looks_like_ea_scene(data):
        return import_ea_scene(data, path.name)
    _find_files(data, path.parent)
    return parse_scene(data, str(path))


def _find_files(data: Any, folder: Path) -> None:
    """Makes the names of mesh files relative to the folder of the scene; what is no scene is left to the checks."""
    colliders = data.get("colliders") if isinstance(data, dict) else None
    for collider in colliders if isinstance(colliders, list) else []:
        shape = collider.get("shape") if isinstance(collider, dict) else None
        if isinstance(shape, dict) and isinstance(shape.get("file"), str):
            shape["file"] = str(folder / shape["file"])


def parse_scene(data: Any, source: str = "scene") -> Scene:
    """Checks decoded JSON and makes a Scene of it; InputError names each field that is wrong."""
    from .effects.catalogue import missing

    if not isinstance(data, dict) or data.get("format") != FORMAT_NAME:
        raise InputError(f"{source}: not a scene: the field 'format' must be \"{FORMAT_NAME}\"")
    try:
        scene = Scene.model_validate(data)
    except ValidationError as error:
        raise InputError(describe_problems(error, data, source)) from None
    problems = _cross_check(scene) or missing(scene)
    if problems:
        raise InputError("\n".join(f"{source}: {problem}" for problem in problems))
    return scene


def read_json(path: Path) -> Any:
    """Decodes a file; InputError says what is wrong with it, and where."""
    if path.suffix.lower() in (".yaml", ".yml"):
        raise InputError(f"{path}: this is YAML; scenes and presets are JSON")
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise InputError(f"{path}: is a folder, not a file") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file") from None
    if not text.strip():
        raise InputError(f"{path}: the file is empty")
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise InputError(f"{path}: cannot be read: brackets are nested too deeply") from None
    except ValueError as error:  # a number of thousands of digits
        raise InputError(f"{path}: cannot be read: {error}") from None


def describe_problems(error: ValidationError, data: Any, source: str) -> str:
    """One line for each field that is wrong."""
    lines = []
    for item in error.errors():
        message = item["msg"].removeprefix("Value error, ")
        if item["type"] == "extra_forbidden":
            message = f"unknown field{did_you_mean(item['loc'][-1], _all_fields())}"
        elif item["type"] == "literal_error":
            message += did_you_mean(item["input"], re.findall(r"'(\w+)'", item["ctx"]["expected"]))
        elif item["type"] == "union_tag_invalid":
            message = f"'{item['ctx']['tag']}' is not one of {item['ctx']['expected_tags']}"
            message += did_you_mean(item["ctx"]["tag"], re.findall(r"'(\w+)'", item["ctx"]["expected_tags"]))
        elif item["type"] == "missing":
            message = "this field is required"
        lines.append(f"{source}: {_field_path(item['loc'], data)}: {message}")
    return "\n".join(dict.fromkeys(lines))


def _all_fields() -> list[str]:
    """The names of the fields of all parts of a scene."""
    parts, names = [_Part], dict[str, None]()
    while parts:
        part = parts.pop()
        parts += part.__subclasses__()
        names.update(dict.fromkeys(part.model_fields))
    return list(names)


def _field_path(location: tuple[int | str, ...], data: Any) -> str:
    """The path as the user wrote it: without the names of union members that pydantic puts in between."""
    path = ""
    for position, step in enumerate(location):
        last = position == len(location) - 1
        known = _holds(data, step)
        if not known and not (last and isinstance(data, dict) and isinstance(step, str)):
            continue
        path += f"[{step}]" if isinstance(step, int) else f".{step}" if path else step
        data = data[step] if known else None
    return path or "(whole file)"


def _holds(data: Any, step: int | str) -> bool:
    if isinstance(data, dict):
        return step in data
    return isinstance(data, list) and isinstance(step, int) and step < len(data)


def _cross_check(scene: Scene) -> list[str]:
    """What no single field shows: vector lengths, references, domain size."""
    problems = list(_vector_problems(scene, scene.dimension, ""))
    if not scene.sources:
        problems.append("fills: there is nothing in the scene: it needs a fill or an emitter")
    problems += _material_problems(scene)
    if max(material_groups(scene).values()).bit_length() > MATERIALS_THAT_CAN_BE_MET:
        problems.append(f"colliders: `meets` works with {MATERIALS_THAT_CAN_BE_MET} materials at most")
    for index, part in enumerate(scene.colliders):
        if scene.dimension == 2 and part.body is not None and part.body.axis is not None:
            problems.append(f"colliders[{index}].body.axis: in 2D a body turns in the plane")
    for name in ("colliders", "drains", "forces"):
        for index, part in enumerate(getattr(scene, name)):
            if part.shape is not None and part.shape.kind == "plane" and math.hypot(*part.shape.normal) < 1e-6:
                problems.append(f"{name}[{index}].shape.normal: must not be zero")
    for name in ("emitters", "forces"):
        for index, part in enumerate(getattr(scene, name)):
            if part.direction is not None and math.hypot(*part.direction) < 1e-6:
                problems.append(f"{name}[{index}].direction: must not be zero")
    bounds = scene.kill_bounds
    if bounds is not None and any(high <= low for low, high in zip(bounds.min, bounds.max)):
        problems.append("kill_bounds.max: must be above kill_bounds.min on every axis")
    if scene.domain is not None and not problems:
        for axis in range(scene.dimension):
            if scene.domain.max[axis] - scene.domain.min[axis] < 4 * scene.cell_size:
                problems.append(f"domain.max[{axis}]: must be at least 4 cells above domain.min[{axis}]")
    return problems


def _material_problems(scene: Scene) -> list[str]:
    """Materials that are named but not there."""
    named = [
        (f"{name}[{index}].material", part.material)
        for name in ("fills", "emitters", "drains")
        for index, part in enumerate(getattr(scene, name))
    ]
    named += [(f"colliders[{index}].meets", name) for index, part in enumerate(scene.colliders) for name in part.meets or ()]
    known = ", ".join(sorted(scene.materials))
    return [
        f"{where}: no material is called '{material}' (there are: {known})"
        for where, material in named
        if material is not None and material not in scene.materials
    ]


def _vector_problems(part: _Part, dimension: int, path: str):
    """Yields a complaint for each vector or rotation that does not fit the dimension."""
    for name in type(part).model_fields:
        value = getattr(part, name)
        where = f"{path}.{name}" if path else name
        if isinstance(value, CameraPart):
            continue
        if isinstance(value, _Part):
            yield from _vector_problems(value, dimension, where)
        elif name == "rotation":
            yield from _rotation_problems(value, dimension, where)
        elif isinstance(value, dict):
            continue
        elif isinstance(value, list) and value and isinstance(value[0], _Part):
            for index, item in enumerate(value):
                yield from _vector_problems(item, dimension, f"{where}[{index}]")
        elif name in _VECTOR_FIELDS and value is not None and len(value) != dimension:
            yield f"{where}: needs {dimension} numbers in a scene of dimension {dimension}, has {len(value)}"


_VECTOR_FIELDS = {"origin", "gravity", "min", "max", "position", "half_extents", "normal", "velocity", "direction"}


def _rotation_problems(value: float | list[float], dimension: int, where: str):
    if isinstance(value, list):
        if dimension == 2:
            yield f"{where}: in 2D this is one angle in radians"
        elif not 0.5 <= math.hypot(*value) <= 2:
            yield f"{where}: a quaternion (x, y, z, w) of length 1 is needed"
    elif dimension == 3 and value != 0:
        yield f"{where}: in 3D this is a quaternion [x, y, z, w]"
