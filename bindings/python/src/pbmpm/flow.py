"""What adds and takes matter while a world runs: emitters, drains and kill bounds, and the account of it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, TypeVar

from ._choice import Choice
from ._convert import Rotation, Vector, assign_vector, initialised, plain, sized
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from ._setters import Value, components, one_of, real, whole
from ._switchable import Switchable
from .materials import Material
from .shapes import Shape

Record = TypeVar("Record")


class Region(Choice):
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


def _read(kind: type[Record], structure: Any) -> Record:
    return kind(**{item.name: plain(getattr(structure, item.name)) for item in fields(kind)})  # type: ignore[arg-type]


def _set_material(out: Any, value: Material, dimension: int) -> None:
    if not isinstance(value, Material):
        raise TypeError(f"material: a Material is needed (World.add_material), not {type(value).__name__}")
    out.material = value._id


def _own(identifier: Any) -> Any:
    """An identifier that outlives the structure that it is part of."""
    return ffi.new("pbmpm_material_id *", identifier)[0]


def _set_material_or_all(out: Any, value: Material | None, dimension: int) -> None:
    if value is None:
        out.material.index = out.material.generation = 0
    else:
        _set_material(out, value, dimension)


def _material_or_all(definition: Any, world: Any) -> Material | None:
    return Material(world, _own(definition.material)) if definition.material.generation else None


class Emitter(Switchable):
    """A source of particles in a world. Made by `World.add_emitter()`."""

    __slots__ = ()
    _name = "emitter"
    material: Value[Material, Material] = Value(_set_material, lambda definition, world: Material(world, _own(definition.material)), "Of its particles.")
    rate = real("rate", "Rest volume per second [m^d/s].")
    region = one_of("region", Region, "Where its particles are born.")
    speed = real("speed", "Of its particles [m/s].")
    direction = components("direction", "Of the speed before the shape's rotation, shape (d,).")
    spread = real("spread", "Largest angle between the velocity of a particle and `direction` [rad].")
    particles_per_axis = real("particles_per_axis", "Size of its particles: so many per cell and axis.")
    fill_limit = real("fill_limit", "Rest volume per volume where nothing more is emitted; 1: full.")
    budget = whole("budget", "Particles that it may emit in its life; 0: no limit.")
    seed = whole("seed", "Of places and directions.")
    user_value = whole("user_value", "Of its particles, see `Field.USER_VALUE`.")

    @property
    def status(self) -> EmitterStatus:
        """Counts since it was created."""
        return _read(EmitterStatus, self._status())

    def move(self, position: Vector, rotation: Rotation | None = None) -> None:
        """Sets the pose that it shall have at the end of the next step; particles are born all along the way.

        Args:
            position: shape (d,) [m].
            rotation: angle [rad] in 2D, or a quaternion (x, y, z, w); None leaves it as it is.
        """
        self._set_pose("move", position, rotation)


class Drain(Switchable):
    """A shape that takes out the particles inside it. Made by `World.add_drain()`."""

    __slots__ = ()
    _name = "drain"
    material: Value[Material | None, Material | None] = Value(_set_material_or_all, _material_or_all, "What it takes; None: everything.")

    @property
    def status(self) -> DrainStatus:
        """Counts since it was created."""
        return _read(DrainStatus, self._status())


class WorldFlow(WorldPart):
    """The part of a `World` that adds and takes matter."""

    __slots__ = ()

    def add_emitter(
        self,
        shape: Shape,
        material: Material,
        rate: float,
        *,
        region: Region | str | None = None,
        speed: float | None = None,
        direction: Vector | None = None,
        spread: float | None = None,
        particles_per_axis: float | None = None,
        fill_limit: float | None = None,
        budget: int | None = None,
        seed: int | None = None,
        enabled: bool | None = None,
        user_value: int | None = None,
        key: int = 0,
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
            user_value: of its particles, see `Field.USER_VALUE`; default 0.
            key: what snapshots know it by, a number that no other emitter of the world has; 0: its place.
        """
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
            "user_value": user_value,
            "key": key,
        }
        return Emitter(self, Emitter._add(self, values))  # type: ignore[arg-type]

    def add_drain(self, shape: Shape, *, material: Material | None = None, enabled: bool = True, key: int = 0) -> Drain:
        """Adds a shape that takes out the particles that are inside it at the end of a substep.

        Args:
            shape: where.
            material: what it takes; None: everything.
            enabled: whether it takes anything yet.
            key: what snapshots know it by, a number that no other drain of the world has; 0: its place.
        """
        values = {"shape": shape, "material": material, "enabled": enabled, "key": key}
        return Drain(self, Drain._add(self, values))  # type: ignore[arg-type]

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
        return _read(Flow, out)
