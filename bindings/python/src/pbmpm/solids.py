"""Solids of any form, baked from meshes, points and heights to a grid of signed distances: made once, kept as bytes or in
files, and loaded into worlds, where obstacles share them."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._convert import assign, floats, initialised, plain, pointer, shortest, sized
from ._ffi import ffi
from ._fixed import Fixed
from ._library import lib
from ._member import Member, WorldPart
from .errors import DamagedError, InvalidArgumentError, check


@dataclass(frozen=True)
class SolidInfo:
    """What is known of a baked solid.

    Attributes:
        dimension: 2 or 3.
        counts: values of the grid per axis.
        spacing: width of a grid cell [m].
        minimum: lower corner of the grid [m], in the frame of the mesh.
        maximum: upper corner [m]; the surface lies two cells inside.
    """

    dimension: int
    counts: tuple[int, ...]
    spacing: float
    minimum: tuple[float, ...]
    maximum: tuple[float, ...]


def _info(out: Any) -> SolidInfo:
    d = out.dimension
    return SolidInfo(d, plain(out.count)[:d], shortest(out.spacing), plain(out.minimum)[:d], plain(out.maximum)[:d])


class BakedSolid(Fixed):
    """The bytes of a baked solid. Needs no world; may be kept in a file, copied and pickled.

    Args:
        data: bytes that `bake_mesh()`, `bake_hull()` or `bake_heights()` made.

    Raises:
        DamagedError: they are not whole, or not such bytes at all.
        UnsupportedError: another version made them.
    """

    __slots__ = ("_data", "_info")

    def __init__(self, data: bytes) -> None:
        out = sized("pbmpm_baked_info")
        check(lib.pbmpm_baked_inspect(ffi.from_buffer("char[]", data), len(data), out))
        self._data, self._info = bytes(data), _info(out)

    def __reduce__(self) -> tuple[type[BakedSolid], tuple[bytes]]:
        return type(self), (self._data,)  # so that what comes out of a pickle is looked at

    @classmethod
    def load(cls, path: str | Path) -> BakedSolid:
        """Reads a file that `save()` wrote."""
        return cls(Path(path).read_bytes())

    def save(self, path: str | Path) -> None:
        """Writes a file; a half-written one is never seen under its name."""
        target = Path(path)
        part = target.with_name(target.name + ".part")
        part.write_bytes(self._data)
        part.replace(target)

    @property
    def data(self) -> bytes:
        """The bytes themselves."""
        return self._data

    @property
    def info(self) -> SolidInfo:
        """The grid."""
        return self._info

    @property
    def distances(self) -> npt.NDArray[np.float32]:
        """The signed distances at the nodes of the grid [m], one axis per dimension; read-only."""
        counts = self._info.counts
        start = len(self._data) - 4 * int(np.prod(counts))
        return np.frombuffer(self._data, np.float32, offset=start).reshape(counts[::-1]).T

    def __repr__(self) -> str:
        return f"<pbmpm.BakedSolid {self._info.dimension}D, {' x '.join(map(str, self._info.counts))} values>"


class LoadedSolid(Member):
    """A baked solid in a world. Made by `World.load_solid()`; shapes of kind `Baked` refer to it. It cannot be destroyed
    while an obstacle has its shape (InUseError)."""

    __slots__ = ()
    _name = "baked"
    _instead = "it names a thing of one world; give its BakedSolid to load_solid() of another"

    @property
    def info(self) -> SolidInfo:
        """The grid."""
        out = sized("pbmpm_baked_info")
        self._apply("get", out)
        return _info(out)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, LoadedSolid):
            return NotImplemented
        return self._world is other._world and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[int, int]:
        return self._id.index, self._id.generation


def bake_mesh(
    vertices: npt.ArrayLike, elements: npt.ArrayLike, *, resolution: int | None = None, cache: str | Path | None = None
) -> BakedSolid:
    """Bakes a closed mesh: triangles in 3D, the edges of polygons in 2D. All run in one sense, inward or outward.

    Args:
        vertices: shape (n, d) [m]; d is 2 or 3.
        elements: shape (m, d), indices of vertices.
        resolution: grid cells along the longest side, in [4, 1024]; default 64.
        cache: folder to keep the result in and to look for it first; made if it does not exist.

    Raises:
        InvalidArgumentError: the mesh is open, wound in two ways, or holds no volume; the message says where.
    """
    place = _points("vertices", vertices)
    corners = _indices(elements, place.shape[1])
    definition = _mesh(place, resolution)
    definition.element_count = len(corners)
    definition.elements = pointer("uint32_t", corners)
    return _bake("mesh", definition, [place, corners], cache, definition.resolution)


def bake_hull(
    points: npt.ArrayLike, *, resolution: int | None = None, cache: str | Path | None = None
) -> BakedSolid:
    """Bakes the convex hull of points.

    Args:
        points: shape (n, d) [m].
        resolution, cache: as for `bake_mesh()`.
    """
    place = _points("points", points)
    definition = _mesh(place, resolution)
    return _bake("hull", definition, [place], cache, definition.resolution)


def bake_heights(
    heights: npt.ArrayLike,
    spacing: float | tuple[float, float],
    *,
    up: int = 1,
    thickness: float | None = None,
    resolution: int | None = None,
    cache: str | Path | None = None,
) -> BakedSolid:
    """Bakes a body that is solid from heights over a regular lattice down to a flat base.

    Args:
        heights: shape (n,) in 2D, (n, m) in 3D [m]; sample (i, j) stands at i * spacing along the first axis that is not
            `up`, and at j * spacing along the second.
        spacing: of the lattice [m]; one number, or one per direction.
        up: axis along which heights are measured.
        thickness: how far the base lies below the lowest sample [m]; default 1.
        resolution: grid cells along the longest side; None: cells as wide as the lattice's. Cells wider than the world's leak at
            edges: scene files take `ceil(longest side / cell size)`.
        cache: as for `bake_mesh()`.
    """
    field = np.asarray(heights)
    if field.ndim not in (1, 2):
        raise InvalidArgumentError(f"heights: an array of 1 or 2 axes is needed, not {field.ndim}")
    samples = floats("heights", field.T, tuple(field.T.shape))  # the first index runs fastest
    definition = initialised("pbmpm_heights_def")
    definition.dimension = field.ndim + 1
    assign(definition, "up", up)
    for i, count in enumerate(field.shape):
        definition.count[i] = count
    for i, width in enumerate(np.broadcast_to(np.asarray(spacing, dtype=np.float64), (field.ndim,)).tolist()):
        definition.spacing[i] = width
    definition.heights = pointer("float", samples)
    if thickness is not None:
        assign(definition, "thickness", thickness)
    if resolution is not None:
        assign(definition, "resolution", resolution)
    numbers = (up, plain(definition.spacing), definition.thickness, definition.resolution)
    return _bake("heights", definition, [samples], cache, numbers)


def _points(name: str, values: npt.ArrayLike) -> npt.NDArray[np.float32]:
    shape = np.shape(values)
    if len(shape) != 2 or shape[1] not in (2, 3):
        raise InvalidArgumentError(f"{name}: an array of shape (n, 2) or (n, 3) is needed, not {shape}")
    return floats(name, values, (-1, shape[1]))


def _indices(elements: npt.ArrayLike, corners: int) -> npt.NDArray[np.uint32]:
    array = np.asarray(elements)
    if array.ndim != 2 or array.shape[1] != corners or array.dtype.kind not in "iu":
        raise InvalidArgumentError(f"elements: whole numbers of shape (m, {corners}) are needed, not {array.shape}")
    if array.size and (array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise InvalidArgumentError("elements: an index is negative or too large")
    return np.ascontiguousarray(array, dtype=np.uint32)


def _mesh(place: npt.NDArray[np.float32], resolution: int | None) -> Any:
    definition = initialised("pbmpm_mesh_def")
    definition.dimension = place.shape[1]
    definition.vertex_count = len(place)
    definition.vertices = pointer("float", place)
    if resolution is not None:
        assign(definition, "resolution", resolution)
    return definition


def _bake(kind: str, definition: Any, arrays: list[npt.NDArray[Any]], cache: str | Path | None, numbers: Any) -> BakedSolid:
    """Bakes, or finds the result of the same arrays and numbers in the cache. `arrays` stay alive meanwhile."""
    stored = None if cache is None else Path(cache) / f"{_digest(kind, arrays, numbers)}.sdf"
    if stored is not None and stored.exists():
        try:
            return BakedSolid.load(stored)
        except DamagedError:
            pass  # baked anew below
    function = getattr(lib, f"pbmpm_bake_{kind}")
    size = ffi.new("uint64_t *")
    check(function(definition, ffi.NULL, 0, size))
    buffer = bytearray(size[0])
    check(function(definition, ffi.from_buffer("char[]", buffer, require_writable=True), len(buffer), size))
    solid = BakedSolid(bytes(buffer))
    if stored is not None:
        stored.parent.mkdir(parents=True, exist_ok=True)
        solid.save(stored)
    return solid


def _digest(kind: str, arrays: list[npt.NDArray[Any]], numbers: Any) -> str:
    digest = hashlib.sha256(repr((kind, lib.pbmpm_version(), numbers)).encode())
    for array in arrays:
        digest.update(repr((array.shape, str(array.dtype))).encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


@dataclass(frozen=True)
class Impulse:
    """What matter gave to an obstacle in a step.

    Attributes:
        linear: one number per axis [N s].
        angular: about the obstacle's position after the step [N m s]; one number in 2D, three in 3D.
    """

    linear: tuple[float, ...]
    angular: tuple[float, ...]


def impulse_from_c(out: Any, dimension: int) -> Impulse:
    """The impulse that a C structure holds."""
    return Impulse(tuple(out.linear)[:dimension], tuple(out.angular)[2 if dimension == 2 else 0 :])


class WorldSolids(WorldPart):
    """What a `World` offers of baked solids and of the impulses on its walls."""

    __slots__ = ()

    def load_solid(self, solid: BakedSolid) -> LoadedSolid:
        """Copies a baked solid into the world. Any number of obstacles share it, through shapes of kind `Baked`."""
        if not isinstance(solid, BakedSolid):
            raise TypeError(f"solid: a BakedSolid is needed, not {type(solid).__name__}")
        out = ffi.new("pbmpm_baked_id *")
        self._call(lib.pbmpm_baked_create, ffi.from_buffer("char[]", solid.data), len(solid.data), out)
        return LoadedSolid(self, out[0])  # type: ignore[arg-type]

    def wall_impulse(self, axis: int, upper: bool = False) -> Impulse:
        """What matter gave in the last step to the wall of the domain at the lower or upper end of an axis; the angular
        part is about the world's origin. Needs `domain_measures_impulse`."""
        out = sized("pbmpm_impulse")
        self._call(lib.pbmpm_domain_impulse, axis, int(upper), out)
        return impulse_from_c(out, self._dimension)
