"""Solid obstacles."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._choice import Choice
from ._convert import Rotation, Vector, assign, initialised, plain, shortest, sized
from ._ffi import ffi
from ._library import lib
from ._member import Member
from .shapes import Baked, Shape, from_c, to_c
from .solids import Impulse, LoadedSolid, impulse_from_c


class Friction(Choice):
    """How matter moves along a surface."""

    COULOMB = ffi.integer_const("PBMPM_FRICTION_COULOMB")  #: up to the coefficient times the normal impulse
    STICK = ffi.integer_const("PBMPM_FRICTION_STICK")  #: with the surface, and it cannot leave
    SLIP = ffi.integer_const("PBMPM_FRICTION_SLIP")  #: freely


def definition(
    friction: Friction | str,
    friction_coefficient: float | None,
    kinematic: bool,
    measures_impulse: bool = False,
) -> Any:
    """The C structure of a collider."""
    out = initialised("pbmpm_collider_def")
    out.friction = Friction(friction).value
    if friction_coefficient is not None:
        assign(out, "friction_coefficient", friction_coefficient)
    out.kinematic = bool(kinematic)
    out.measures_impulse = bool(measures_impulse)
    return out


class Collider(Member):
    """An obstacle in a world. Made by `World.add_collider()`."""

    __slots__ = ()
    _name = "collider"
    _has_shape = True

    @property
    def identity(self) -> tuple[int, int]:
        """Index and generation, as `Advice.collider` has them."""
        return int(self._id.index), int(self._id.generation)

    @property
    def shape(self) -> Shape:
        """The shape with its current pose; the rotation is a quaternion."""
        found, dimension = self._form(), self._world.dimension
        if found.kind == ffi.integer_const("PBMPM_BAKED"):
            solid = LoadedSolid(self._world, found.baked)
            return Baked(plain(found.position)[:dimension], solid, plain(found.rotation))
        return from_c(found, dimension)

    @property
    def friction(self) -> Friction:
        return Friction(self._definition().friction)

    @property
    def friction_coefficient(self) -> float:
        """Coulomb coefficient."""
        return shortest(self._definition().friction_coefficient)

    @property
    def kinematic(self) -> bool:
        """Whether `move()` may move it."""
        return bool(self._definition().kinematic)

    @property
    def measures_impulse(self) -> bool:
        """Whether `impulse` tells what matter does to it."""
        return bool(self._definition().measures_impulse)

    @property
    def impulse(self) -> Impulse:
        """What matter gave to the obstacle in the last step."""
        out = sized("pbmpm_impulse")
        self._apply("impulse", out)
        return impulse_from_c(out, self._world.dimension)

    def change(
        self,
        *,
        shape: Shape | None = None,
        friction: Friction | None = None,
        friction_coefficient: float | None = None,
        kinematic: bool | None = None,
        measures_impulse: bool | None = None,
    ) -> None:
        """Changes what is named, as when it was added; the rest stays. A new shape is there at once, without velocity."""
        out = self._definition()
        if friction is not None:
            out.friction = Friction(friction).value
        if friction_coefficient is not None:
            assign(out, "friction_coefficient", friction_coefficient)
        if kinematic is not None:
            out.kinematic = bool(kinematic)
        if measures_impulse is not None:
            out.measures_impulse = bool(measures_impulse)
        self._apply("set", out, ffi.NULL if shape is None else to_c(shape, self._world.dimension))

    def move(self, position: Vector, rotation: Rotation | None = None) -> None:
        """Sets the pose that a kinematic obstacle shall have at the end of the next step; its velocity follows.

        Args:
            position: shape (d,) [m].
            rotation: angle [rad] in 2D, or a quaternion (x, y, z, w); None leaves it as it is.
        """
        self._set_pose("move", position, rotation)

    def teleport(self, position: Vector, rotation: Rotation | None = None) -> None:
        """Puts the obstacle somewhere at once, without velocity; static ones too. Arguments as for `move()`."""
        self._set_pose("teleport", position, rotation)

    def query(self) -> npt.NDArray[np.uint32]:
        """Identifiers of the particles inside, deeper than 1/100 cell: shape (n, 2), in storage order."""
        return self._world._query(lib.pbmpm_query_collider, self._id)
