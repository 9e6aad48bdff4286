"""What adds and takes matter while a world runs: emitters, drains and kill bounds, and the account of it."""

from __future__ import annotations

import enum
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from ._convert import Rotation, Vector, assign, assign_vector, initialised, plain, quaternion, shortest, sized, vector
from ._ffi import ffi
from ._library import lib
from .materials import Material
from .shapes import Shape, from_c, to_c

if TYPE_CHECKING:
    from .world import World


class Region(enum.Enum):
    """Where an emitter's particles are born."""

    VOLUME = ffi.integer_const("PBMPM_EMIT_VOLUME")  #: anywhere inside the shape
    DISC = ffi.integer_const("PBMPM_EMIT_DISC")  #: on the disc of a sphere's radius, perpendicular to the direction (2D: a line)


@dataclass(frozen=True)
class EmitterStatus:
    """What an emitter has done since it was created."""

    emitted: int  #: particles
    emitted_mass: float  #: [kg] (2D: per metre of depth)
    refused_full: int  #: particles that were due where there was no space: matter, an obstacle, or outside of the domain
    refused_budget: int  #: ... after the budget was spent
    refused_capacity: int  #: ... when the world was full

    @property
    def refused(self) -> int:
        """Particles that were due and not emitted."""
        return self.refused_full + self.refused_budget + self.refused_capacity


@dataclass(frozen=True)
class DrainStatus:
    """What a drain has taken since it was created."""

    drained: int  #: particles
    drained_mass: float  #: [kg] (2D: per metre of depth)


@dataclass(frozen=True)
class Flow:
    """What came and went in the life of a world, without what calls added and removed. Masses in kg (2D: per metre of
    depth)."""

    emitted: int  #: particles
    refused: int  #: particles that were due and not emitted
    drained: int  #: particles
    killed: int  #: particles that left the kill bounds
    emitted_mass: float
    drained_mass: float
    killed_mass: float


def _read(kind: type, structure: Any) -> Any:
    return kind(**{item.name: plain(getattr(structure, item.name)) for item in fields(kind)})


class Emitter:
    """A source of particles in a world. Made by `World.add_emitter()`."""

    __slots__ = ("_world", "_id")

    def __init__(self, world: World, identifier: Any) -> None:
        self._world = world
        self._id = identifier

    def _definition(self) -> Any:
        out = sized("pbmpm_emitter_def")
        out.shape.size = ffi.sizeof("pbmpm_shape")
        self._world._call(lib.pbmpm_emitter_get, self._id, out)
        return out

    def change(self, **values: Any) -> None:
        """Changes what is named, with the names of `World.add_emitter()`; counts and fractions of a particle are kept."""
        definition = self._definition()
        _fill_emitter(definition, self._world.dimension, values)
        self._world._call(lib.pbmpm_emitter_set, self._id, definition)

    @property
    def shape(self) -> Shape:
        """The shape with its current pose; the rotation is a quaternion."""
        return from_c(self._definition().shape, self._world.dimension)

    @property
    def rate(self) -> float:
        """Rest volume per second [m^d/s]."""
        return shortest(self._definition().rate)

    @property
    def enabled(self) -> bool:
        """Whether it emits. Assigning switches it on and off; no time passes for it when it is off."""
        return bool(self._definition().enabled)

    @enabled.setter
    def enabled(self, value: bool) -> None:
        self.change(enabled=value)

    @property
    def status(self) -> EmitterStatus:
        """Counts since it was created."""
        out = sized("pbmpm_emitter_status")
        self._world._call(lib.pbmpm_emitter_status_get, self._id, out)
        status: EmitterStatus = _read(EmitterStatus, out)
        return status

    def move(self, position: Vector, rotation: Rotation | None = None) -> None:
        """Sets the pose that it shall have at the end of the next step; particles are born all along the way.

        Args:
            position: shape (d,) [m].
            rotation: angle [rad] in 2D, or a quaternion (x, y, z, w); None leaves it as it is.
        """
        c_position = ffi.new("float[3]", vector("position", position, self._world.dimension))
        c_rotation = ffi.NULL if rotation is None else ffi.new("float[4]", quaternion(rotation))
        self._world._call(lib.pbmpm_emitter_move, self._id, c_position, c_rotation)

    def destroy(self) -> None:
        """Removes the emitter; its particles stay."""
        self._world._call(lib.pbmpm_emitter_destroy, self._id)

    def __repr__(self) -> str:
        return f"<pbmpm.Emitter {self._id.index}:{self._id.generation}>"


def _fill_emitter(out: Any, dimension: int, values: dict[str, Any]) -> None:
    """Writes the values that are not None into the C structure of an emitter."""
    for name, value in values.items():
        if value is None:
            continue
        if name == "shape":
            out.shape = to_c(value, dimension)[0]
        elif name == "material":
            out.material = value._id
        elif name == "direction":
            assign_vector(out, name, value, dimension)
        elif name == "enabled":
            out.enabled = bool(value)
        elif name == "region":
            out.region = Region(value).value
        elif name in ("seed", "rate", "speed", "spread", "particles_per_axis", "fill_limit", "budget"):
            assign(out, name, value)
        else:
            raise TypeError(f"an emitter has no '{name}'")


class Drain:
    """A shape that takes out the particles inside it. Made by `World.add_drain()`."""

    __slots__ = ("_world", "_id")

    def __init__(self, world: World, identifier: Any) -> None:
        self._world = world
        self._id = identifier

    def _definition(self) -> Any:
        out = sized("pbmpm_drain_def")
        out.shape.size = ffi.sizeof("pbmpm_shape")
        self._world._call(lib.pbmpm_drain_get, self._id, out)
        return out

    @property
    def shape(self) -> Shape:
        """Where it is. Assigning moves it; the counts are kept."""
        return from_c(self._definition().shape, self._world.dimension)

    @shape.setter
    def shape(self, value: Shape) -> None:
        definition = self._definition()
        definition.shape = to_c(value, self._world.dimension)[0]
        self._world._call(lib.pbmpm_drain_set, self._id, definition)

    @property
    def enabled(self) -> bool:
        """Whether it takes anything."""
        return bool(self._definition().enabled)

    @enabled.setter
    def enabled(self, value: bool) -> None:
        definition = self._definition()
        definition.enabled = bool(value)
        self._world._call(lib.pbmpm_drain_set, self._id, definition)

    @property
    def status(self) -> DrainStatus:
        """Counts since it was created."""
        out = sized("pbmpm_drain_status")
        self._world._call(lib.pbmpm_drain_status_get, self._id, out)
        status: DrainStatus = _read(DrainStatus, out)
        return status

    def destroy(self) -> None:
        """Removes the drain."""
        self._world._call(lib.pbmpm_drain_destroy, self._id)

    def __repr__(self) -> str:
        return f"<pbmpm.Drain {self._id.index}:{self._id.generation}>"


class WorldFlow:
    """The part of a `World` that adds and takes matter."""

    __slots__ = ()
    _dimension: int

    def _call(self, function: Any, *arguments: Any) -> Any:
        """Calls a function of the C library with this world."""
        raise NotImplementedError

    def add_emitter(
        self,
        shape: Shape,
        material: Material,
        rate: float,
        *,
        region: Region | None = None,
        speed: float | None = None,
        direction: Vector | None = None,
        spread: float | None = None,
        particles_per_axis: float | None = None,
        fill_limit: float | None = None,
        budget: int | None = None,
        seed: int | None = None,
        enabled: bool | None = None,
    ) -> Emitter:
        """Adds a source of particles.

        Args:
            shape: where (not a plane).
            material: of the particles.
            rate: rest volume per second [m^d/s]; a disc of the area A runs full with A times speed.
            region: the whole shape (default), or the disc of its radius.
            speed: [m/s]; default 0.
            direction: of the speed, before the shape's rotation; default down the second axis.
            spread: largest angle between a particle's velocity and `direction` [rad]; default 0.
            particles_per_axis: size of the particles: so many per cell and axis; default 2.
            fill_limit: rest volume per volume where nothing more is emitted; default 1: full.
            budget: particles that it may emit in its life; 0 (default): no limit.
            seed: of places and directions.
            enabled: whether it begins with the next step (default) or when `Emitter.enabled` is set.
        """
        definition = initialised("pbmpm_emitter_def")
        if not isinstance(material, Material):
            raise TypeError(f"material: a Material is needed (World.add_material), not {type(material).__name__}")
        values = {
            "shape": shape,
            "material": material,
            "rate": rate,
            "region": region,
            "speed": speed,
            "direction": direction,
            "spread": spread,
            "particles_per_axis": particles_per_axis,
            "fill_limit": fill_limit,
            "budget": budget,
            "seed": seed,
            "enabled": enabled,
        }
        _fill_emitter(definition, self._dimension, values)
        out = ffi.new("pbmpm_emitter_id *")
        self._call(lib.pbmpm_emitter_create, definition, out)
        return Emitter(self, out[0])  # type: ignore[arg-type]

    def add_drain(self, shape: Shape, *, material: Material | None = None, enabled: bool = True) -> Drain:
        """Adds a shape that takes out the particles that are inside it at the end of a substep.

        Args:
            shape: where.
            material: what it takes; None: everything.
            enabled: whether it takes anything yet.
        """
        definition = initialised("pbmpm_drain_def")
        definition.shape = to_c(shape, self._dimension)[0]
        definition.enabled = bool(enabled)
        if material is not None:
            definition.material = material._id
        out = ffi.new("pbmpm_drain_id *")
        self._call(lib.pbmpm_drain_create, definition, out)
        return Drain(self, out[0])  # type: ignore[arg-type]

    @property
    def kill_bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
        """Lower and upper corner [m] of the box that particles live in: those outside are taken out. None: no bounds."""
        bounds = sized("pbmpm_kill_bounds")
        self._call(lib.pbmpm_world_get_kill_bounds, bounds)
        if not bounds.enabled:
            return None
        return tuple(plain(bounds.low)[: self._dimension]), tuple(plain(bounds.high)[: self._dimension])

    @kill_bounds.setter
    def kill_bounds(self, corners: tuple[Vector, Vector] | None) -> None:
        bounds = initialised("pbmpm_kill_bounds")
        if corners is not None:
            bounds.enabled = 1
            assign_vector(bounds, "low", corners[0], self._dimension)
            assign_vector(bounds, "high", corners[1], self._dimension)
        self._call(lib.pbmpm_world_set_kill_bounds, bounds)

    @property
    def flow(self) -> Flow:
        """What emitters, drains and bounds have done since the world was created."""
        out = sized("pbmpm_flow")
        self._call(lib.pbmpm_world_get_flow, out)
        flow: Flow = _read(Flow, out)
        return flow
