"""The surface of matter as a triangle mesh, and particles as points to draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from ._convert import assign, initialised, sized
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from .materials import Material

if TYPE_CHECKING:
    from .world import World

#: Red, green, blue, opacity, each from 0 to 255.
Colour = tuple[int, int, int, int]

_POINT = np.dtype([("position", np.float32, 3), ("radius", np.float32), ("velocity", np.float32, 3), ("colour", np.uint8, 4)])


@dataclass(frozen=True)
class Mesh:
    """A closed surface: n vertices and m triangles."""

    positions: npt.NDArray[np.float32]  #: (n, 3) [m]
    triangles: npt.NDArray[Any]  #: (m, 3) numbers of vertices, counterclockwise from outside
    normals: npt.NDArray[np.float32]  #: (n, 3) unit vectors out of the matter
    velocities: npt.NDArray[np.float32] | None  #: (n, 3) [m/s], if they were asked for
    weights: npt.NDArray[np.float32] | None  #: (n, materials) shares, if they were asked for

    @property
    def volume(self) -> float:
        """What it encloses [m^3]."""
        a, b, c = (self.positions[self.triangles[:, k]].astype(np.float64) for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0

    @property
    def area(self) -> float:
        """[m^2]"""
        a, b, c = (self.positions[self.triangles[:, k]].astype(np.float64) for k in range(3))
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0


class WorldSurface(WorldPart):
    """The part of a `World` that makes what is drawn of it."""

    __slots__ = ()

    def surface(
        self,
        materials: Sequence[Material] = (),
        *,
        subdivision: int | None = None,
        level: float | None = None,
        keeps_thin: bool | None = None,
        velocities: bool = False,
        weights: bool = False,
        narrow: bool = False,
    ) -> Mesh:
        """The surface of matter, in 3D: where the filling is `level`.

        Spray is no part of it: particles that are alone, and drops of less than a cell. `surface_points(spray_only=True)` has them.

        Args:
            materials: of which it is; none: all.
            subdivision: points of the lattice per cell and axis, 1 or 2.
            level: filling at the surface.
            keeps_thin: whether layers and threads that are a particle thick are part of it.
            velocities: whether vertices get one.
            weights: whether vertices get the share of each of `materials`.
            narrow: 16-bit numbers of vertices; CapacityError if there are more than 65535.

        Arguments left at None take the C library's defaults.
        """
        definition, chosen = initialised("pbmpm_surface_def"), self._list(materials)
        definition.materials, definition.material_count = chosen, len(materials)
        definition.index_bytes = 2 if narrow else 4
        for name, value in {"subdivision": subdivision, "level": level, "keeps_thin": keeps_thin}.items():
            if value is not None:
                assign(definition, name, value)
        mesh = sized("pbmpm_surface_mesh")
        self._call(lib.pbmpm_surface_extract, definition, mesh)
        count = mesh.vertex_count
        arrays = {"positions": np.empty((count, 3), np.float32), "normals": np.empty((count, 3), np.float32)}
        if velocities:
            arrays["velocities"] = np.empty((count, 3), np.float32)
        if weights:
            arrays["weights"] = np.empty((count, len(materials)), np.float32)
        triangles = np.empty((mesh.index_count // 3, 3), np.uint16 if narrow else np.uint32)
        for name, array in arrays.items():
            setattr(mesh, name, ffi.from_buffer("float[]", array, require_writable=True))
        mesh.indices = ffi.from_buffer(triangles, require_writable=True)
        mesh.vertex_capacity, mesh.index_capacity = count, triangles.size
        self._call(lib.pbmpm_surface_extract, definition, mesh)
        return Mesh(arrays["positions"], triangles, arrays["normals"], arrays.get("velocities"), arrays.get("weights"))

    def surface_points(
        self,
        materials: Sequence[Material] = (),
        *,
        palette: Mapping[Material, Colour] | None = None,
        colour_from_user: bool = False,
        radius_scale: float | None = None,
        spray_only: bool = False,
    ) -> npt.NDArray[Any]:
        """Particles as points to draw: records of position (3 floats [m]), radius [m], velocity (3 floats [m/s]), colour (4 bytes).

        Args:
            materials: whose particles; none: those of the palette, or all.
            palette: a colour for each material.
            colour_from_user: whether the 4 bytes of a particle's user value are its colour.
            radius_scale: 1: a point has the volume of its particle.
            spray_only: only particles that `surface()` leaves out, in 3D.
        """
        materials = materials or tuple(palette or ())
        definition, chosen = initialised("pbmpm_points_def"), self._list(materials)
        definition.materials, definition.material_count = chosen, len(materials)
        definition.colour_from_user, definition.spray_only = colour_from_user, spray_only
        if radius_scale is not None:
            assign(definition, "radius_scale", radius_scale)
        if palette is not None:
            colours = ffi.from_buffer("uint32_t[]", np.array([palette.get(it, (255, 255, 255, 255)) for it in materials], np.uint8))
            definition.palette = colours
        points, count = np.empty(len(cast("World", self)), _POINT), ffi.new("uint32_t *")
        room = ffi.from_buffer("pbmpm_point[]", points, require_writable=True) if len(points) else ffi.NULL
        self._call(lib.pbmpm_surface_points, definition, room, len(points), count)
        return points[: count[0]]

    def _list(self, materials: Sequence[Material]) -> Any:
        return ffi.new("pbmpm_material_id[]", [cast("World", self)._id_of(material) for material in materials]) if materials else ffi.NULL
