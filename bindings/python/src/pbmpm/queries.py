"""Asking where matter is: in a region, at points, on a line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from ._convert import Vector, assign, assign_vector, floats, initialised, plain, pointer, shortest, sized, sized_array
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from .materials import Material
from .shapes import Shape, to_c

if TYPE_CHECKING:
    from .world import World

_SHARES = 256  #: materials per world at most


@dataclass(frozen=True)
class RegionShare:
    """What one material has in a region."""

    material: Material
    count: int  #: particles whose centre is inside
    mass: float  #: of these [kg] (2D: per metre of depth)
    volume: float  #: present volume [m^d]
    rest_volume: float  #: [m^d]


@dataclass(frozen=True)
class PointFields:
    """Fields at n points."""

    filling: npt.NDArray[np.float32]  #: (n,) share of space that matter at rest volume takes
    density: npt.NDArray[np.float32]  #: (n,) [kg/m^3] (2D: kg/m^2)
    velocity: npt.NDArray[np.float32]  #: (n, d) [m/s]; 0 where there is no matter


@dataclass(frozen=True)
class RayHit:
    """Where a ray met matter."""

    distance: float  #: from the origin [m]
    position: tuple[float, ...]  #: [m]
    normal: tuple[float, ...]  #: unit vector out of the matter; 0 where the filling has no gradient
    material: Material  #: of the particle
    particle: tuple[int, int]  #: identifier of the nearest particle


class WorldQueries(WorldPart):
    """Questions to a `World` about the space between its particles. They see the state of now and change nothing.

    The filling is the sum over particles of rest volume times the weight of the solver's transfers (quadratic splines), per
    cell volume: about 1 inside matter, 1/2 on its surface and on walls, 0 farther than 1.5 cells from it.
    """

    __slots__ = ()

    def query_region(self, shape: Shape) -> list[RegionShare]:
        """What is inside a shape: one entry per material that has particles there, in the order of their indices."""
        room, count = sized_array("pbmpm_region_share", _SHARES), ffi.new("uint32_t *")
        self._call(lib.pbmpm_query_region, to_c(shape, self._dimension), room, _SHARES, count)
        shares = [room[i] for i in range(count[0])]
        return [
            RegionShare(self._material(share.material), share.count, share.mass, share.volume, share.rest_volume) for share in shares
        ]

    def query_points(self, points: npt.ArrayLike) -> PointFields:
        """Filling, density and velocity at points.

        Args:
            points: shape (n, d) [m].
        """
        places = floats("points", points, (-1, self._dimension))
        count = len(places)
        filling, density = np.empty(count, np.float32), np.empty(count, np.float32)
        velocity = np.empty((count, self._dimension), np.float32)
        outputs = [pointer("float", array, writable=True) for array in (filling, density, velocity)]
        self._call(lib.pbmpm_query_points, pointer("float", places), count, *outputs)
        return PointFields(filling, density, velocity)

    def query_heights(
        self, points: npt.ArrayLike, *, direction: Vector | None = None, level: float = 0.5
    ) -> npt.NDArray[np.float32]:
        """The surface of the highest matter over or under points.

        Args:
            points: shape (n, d) [m].
            direction: what "up" is; None: against gravity.
            level: filling at which matter begins, in (0, 100].

        Returns:
            Coordinates along the direction, shape (n,) [m]: with "up" along y the y of the surface; -inf where the line
            through a point meets no matter.
        """
        places = floats("points", points, (-1, self._dimension))
        up = None if direction is None else floats("direction", direction, (self._dimension,))
        heights = np.empty(len(places), np.float32)
        inputs = pointer("float", places), len(places), pointer("float", up)
        self._call(lib.pbmpm_query_heights, *inputs, level, pointer("float", heights, writable=True))
        return heights

    def query_ray(
        self, origin: Vector, direction: Vector, *, max_distance: float | None = None, level: float | None = None
    ) -> RayHit | None:
        """The first point along a ray where the filling reaches a level, or None.

        Args:
            origin: where the ray begins [m]; in matter it hits at once.
            direction: of any length.
            max_distance: how far it goes [m]; default 1e9.
            level: filling that stops it, in (0, 100]; default 0.5.
        """
        ray, hit = initialised("pbmpm_ray"), sized("pbmpm_ray_hit")
        assign_vector(ray, "origin", origin, self._dimension)
        assign_vector(ray, "direction", direction, self._dimension)
        for name, value in {"max_distance": max_distance, "level": level}.items():
            if value is not None:
                assign(ray, name, value)
        self._call(lib.pbmpm_query_ray, ray, hit)
        if not hit.hit:
            return None
        position, normal = plain(hit.position)[: self._dimension], plain(hit.normal)[: self._dimension]
        particle = hit.particle.index, hit.particle.generation
        return RayHit(shortest(hit.distance), position, normal, self._material(hit.material), particle)

    def _material(self, identifier: Any) -> Material:
        # A copy: the structure that the identifier stands in may go.
        return Material(cast("World", self), ffi.new("pbmpm_material_id *", identifier)[0])
