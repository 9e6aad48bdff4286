"""Shapes for obstacles, fills, removals and queries. Lengths in metres, positions relative to the world's origin; in
2D a box is a rectangle, a sphere a disc, and every vector has two components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ._convert import Rotation, Vector, assign, assign_vector, initialised, plain, quaternion, shortest
from ._ffi import ffi
from ._fixed import tells_names
from .solids import LoadedSolid


@tells_names
@dataclass(frozen=True)
class Plane:
    """The half space behind a plane.

    Attributes:
        position: a point of the plane [m].
        normal: outward direction before rotation, of any length.
        rotation: angle [rad] in 2D, or a quaternion (x, y, z, w).
    """

    position: Vector
    normal: Vector
    rotation: Rotation = 0.0


@tells_names
@dataclass(frozen=True)
class Box:
    """A box.

    Attributes:
        position: centre [m].
        half_extents: half the edge length along each axis [m].
        rotation: angle [rad] in 2D, or a quaternion (x, y, z, w).
    """

    position: Vector
    half_extents: Vector
    rotation: Rotation = 0.0


@tells_names
@dataclass(frozen=True)
class Sphere:
    """A ball.

    Attributes:
        position: centre [m].
        radius: [m].
    """

    position: Vector
    radius: float


@tells_names
@dataclass(frozen=True)
class Capsule:
    """All points within a distance of a segment.

    Attributes:
        position: centre [m].
        half_length: half the length of the segment, which lies along the local first axis [m].
        radius: [m].
        rotation: angle [rad] in 2D, or a quaternion (x, y, z, w).
    """

    position: Vector
    half_length: float
    radius: float
    rotation: Rotation = 0.0


@tells_names
@dataclass(frozen=True)
class Baked:
    """A solid of any form, see `bake_mesh()`, `bake_hull()` and `bake_heights()`.

    Attributes:
        position: where the origin of its mesh stands [m].
        solid: what `World.load_solid()` of the same world returned; many shapes may share it.
        rotation: angle [rad] in 2D, or a quaternion (x, y, z, w).
    """

    position: Vector
    solid: LoadedSolid
    rotation: Rotation = 0.0


Shape = Plane | Box | Sphere | Capsule | Baked

_KINDS: dict[type, int] = {
    Plane: ffi.integer_const("PBMPM_PLANE"),
    Box: ffi.integer_const("PBMPM_BOX"),
    Sphere: ffi.integer_const("PBMPM_SPHERE"),
    Capsule: ffi.integer_const("PBMPM_CAPSULE"),
    Baked: ffi.integer_const("PBMPM_BAKED"),
}


def to_c(shape: Shape, dimension: int) -> Any:
    """The C structure of a shape."""
    if type(shape) not in _KINDS:
        raise TypeError(f"a Plane, Box, Sphere, Capsule or Baked is needed, not {type(shape).__name__}")
    if isinstance(shape, Baked) and not isinstance(shape.solid, LoadedSolid):
        raise TypeError(f"Baked(position, solid): the solid is what World.load_solid() returned, not a {type(shape.solid).__name__}")
    out = initialised("pbmpm_shape")
    out.kind = _KINDS[type(shape)]
    assign_vector(out, "position", shape.position, dimension)
    if not isinstance(shape, Sphere):
        out.rotation = quaternion(shape.rotation)
    if isinstance(shape, Plane):
        assign_vector(out, "normal", shape.normal, dimension)
    elif isinstance(shape, Box):
        assign_vector(out, "half_extents", shape.half_extents, dimension)
    elif isinstance(shape, Capsule):
        out.half_extents[0] = float(shape.half_length)
        assign(out, "radius", shape.radius)
    elif isinstance(shape, Baked):
        out.baked = shape.solid._id
    elif isinstance(shape, Sphere):
        assign(out, "radius", shape.radius)
    return out


def from_c(shape: Any, dimension: int) -> Shape:
    """The shape that a C structure describes. Rotations come back as quaternions."""
    position = plain(shape.position)[:dimension]
    rotation = plain(shape.rotation)
    if shape.kind == _KINDS[Plane]:
        return Plane(position, plain(shape.normal)[:dimension], rotation)
    if shape.kind == _KINDS[Box]:
        return Box(position, plain(shape.half_extents)[:dimension], rotation)
    if shape.kind == _KINDS[Sphere]:
        return Sphere(position, shortest(shape.radius))
    if shape.kind == _KINDS[Capsule]:
        return Capsule(position, shortest(shape.half_extents[0]), shortest(shape.radius), rotation)
    raise ValueError(f"there is no shape of kind {shape.kind} here")
