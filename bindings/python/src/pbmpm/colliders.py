"""Solid obstacles."""

from __future__ import annotations

import enum
from typing import Any

import numpy as np
import numpy.typing as npt

from ._convert import Rotation, Vector, assign, initialised, plain, shortest, sized
from ._ffi import ffi
from ._library import lib
from ._member import Member
from .materials import Material
from .rigid import Mass, Submersion, mass_from_c, submersion_from_c
from .shapes import Baked, Shape, from_c
from .solids import Impulse, LoadedSolid, impulse_from_c


class Friction(enum.Enum):
    """How matter moves along a surface."""

    COULOMB = ffi.integer_const("PBMPM_FRICTION_COULOMB")  #: up to the coefficient times the normal impulse
    STICK = ffi.integer_const("PBMPM_FRICTION_STICK")  #: with the surface, and it cannot leave
    SLIP = ffi.integer_const("PBMPM_FRICTION_SLIP")  #: freely


def definition(
    friction: Friction,
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

    def mass(self, density: float) -> Mass:
        """The mass properties of its shape at a density [kg/m^3]."""
        out = sized("pbmpm_mass_properties")
        self._world._call(lib.pbmpm_shape_mass, self._form(), density, out)
        return mass_from_c(out)

    def submerged(self, material: Material | None = None) -> Submersion:
        """The part of it that is under matter, or under one material."""
        out = sized("pbmpm_submersion")
        only = ffi.NULL if material is None else ffi.new("pbmpm_material_id *", material._id)
        self._apply("submerged", only, out)
        return submersion_from_c(out, self._world.dimension)

    def _body(self, verb: str, *arguments: Any) -> None:
        """Calls a function of rigid bodies."""
        self._world._call(getattr(lib, f"pbmpm_rigid_{verb}"), self._id, *arguments)

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
