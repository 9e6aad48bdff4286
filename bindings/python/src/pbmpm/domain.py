"""The box that a world may be in, and the origin that its positions are relative to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ._convert import Vector, assign, plain, shortest, sized, vector
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart
from .colliders import Friction


@dataclass(frozen=True)
class Wall:
    """A wall of the domain."""

    open: bool  #: there is no wall: matter gets out
    friction: Friction  #: how matter moves along it
    friction_coefficient: float  #: Coulomb coefficient


class WorldDomain(WorldPart):
    """The part of a `World` that is about its box and its origin."""

    __slots__ = ()

    def _wall(self, axis: int, upper: bool) -> Any:
        out = sized("pbmpm_domain_wall")
        self._call(lib.pbmpm_domain_wall_get, axis, int(upper), out)
        return out

    def wall(self, axis: int, upper: bool = False) -> Wall:
        """The wall of the domain at the lower or upper end of an axis."""
        found = self._wall(axis, upper)
        return Wall(bool(found.open), Friction(found.friction), shortest(found.friction_coefficient))

    def set_wall(
        self,
        axis: int,
        upper: bool = False,
        *,
        open: bool | None = None,
        friction: Friction | None = None,
        friction_coefficient: float | None = None,
    ) -> None:
        """Changes a wall of the domain; what is None stays. The next step knows it.

        Args:
            axis: that it stands across.
            upper: whether it stands at the upper end.
            open: True takes the wall away. Matter that is outside when it closes is put back to it at once.
            friction: how matter moves along it.
            friction_coefficient: Coulomb coefficient, in [0, 100].
        """
        wall = self._wall(axis, upper)
        if open is not None:
            wall.open = bool(open)
        if friction is not None:
            wall.friction = Friction(friction).value
        if friction_coefficient is not None:
            assign(wall, "friction_coefficient", friction_coefficient)
        self._call(lib.pbmpm_domain_wall_set, axis, int(upper), wall)

    def shift_origin(self, wanted: Vector) -> tuple[float, ...]:
        """Moves the origin that all positions are relative to, by the multiple of 4 cells that is nearest to `wanted` [m]; for scenes so
        large that a 32-bit float is too coarse. Matter goes on as it would have.

        Returns:
            What the shift was [m]. All positions are now less by it, and `origin` is more.
        """
        moved = ffi.new("double[3]")
        components = [*vector("wanted", wanted, self._dimension), 0.0]
        self._call(lib.pbmpm_world_shift_origin, ffi.new("double[3]", components[:3]), moved)
        return tuple(plain(moved)[: self._dimension])
