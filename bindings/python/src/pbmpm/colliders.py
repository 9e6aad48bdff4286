"""Solid obstacles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._choice import Choice
from ._convert import Rotation, Vector, plain, sized
from ._ffi import ffi
from ._library import lib
from ._member import Member
from ._setters import number, one_of, real, setters_of, switch
from .errors import InvalidArgumentError
from .materials import Material
from .rigid import Mass, Submersion, mass_from_c, submersion_from_c
from .shapes import Baked, Shape, from_c, to_c
from .solids import Impulse, LoadedSolid, impulse_from_c

if TYPE_CHECKING:
    from .world import World


class Friction(Choice):
    """How matter moves along a surface."""

    COULOMB = ffi.integer_const("PBMPM_FRICTION_COULOMB")  #: up to the coefficient times the normal impulse
    STICK = ffi.integer_const("PBMPM_FRICTION_STICK")  #: with the surface, and it cannot leave
    SLIP = ffi.integer_const("PBMPM_FRICTION_SLIP")  #: freely


class TouchState(Choice):
    """What became of a touch since they were asked for before."""

    BEGAN = ffi.integer_const("PBMPM_TOUCH_BEGAN")  #: it is new
    STAYS = ffi.integer_const("PBMPM_TOUCH_STAYS")  #: it was there before
    ENDED = ffi.integer_const("PBMPM_TOUCH_ENDED")  #: it is no more


@dataclass(frozen=True)
class Touch:
    """Matter of a material at a collider."""

    state: TouchState  #: compared with the call before
    collider: Collider  #: that is touched
    material: Material | None  #: of what touches it; None when it was destroyed since
    particles: int  #: how many touch it now
    impulse: tuple[float, ...]  #: of all matter on the collider in the last step [N s], if it measures that


#: What a collider acts on: bits of groups, a material, or several.
Meets = int | Material | Iterable[Material]


def groups_of(world: World, meets: Meets | None) -> int | None:
    """The groups that are meant, bit by bit; InvalidArgumentError where they do not tell those materials from others."""
    if meets is None or isinstance(meets, int | np.integer):
        return meets
    chosen = [meets] if isinstance(meets, Material) else list(meets)
    if not chosen:
        raise InvalidArgumentError("meets: name at least one material; a sensor acts on none")
    groups = reduce(or_, (material.parameters.groups for material in chosen))
    indices = {material.index for material in chosen}
    if any(other.index not in indices and other.parameters.groups & groups for other in world.materials):
        raise InvalidArgumentError("meets: another material has the same groups; give each material `groups` of its own")
    return groups


def touch_from_c(world: World, touch: Any) -> Touch:
    """A C structure as a Touch."""
    collider = Collider(world, ffi.new("pbmpm_collider_id *", touch.collider)[0])
    material = Material(world, ffi.new("pbmpm_material_id *", touch.material)[0]) if touch.material.generation else None
    impulse = tuple(plain(touch.impulse)[: world.dimension])
    return Touch(TouchState(touch.state), collider, material, int(touch.particles), impulse)


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
        """The shape with its current pose; the rotation is a quaternion. Assigning replaces it."""
        found, dimension = self._form(), self._world.dimension
        if found.kind == ffi.integer_const("PBMPM_BAKED"):
            solid = LoadedSolid(self._world, found.baked)
            return Baked(plain(found.position)[:dimension], solid, plain(found.rotation))
        return from_c(found, dimension)

    @shape.setter
    def shape(self, value: Shape) -> None:
        self.change(shape=value)

    friction = one_of("friction", Friction, "How matter moves along its surface.")
    friction_coefficient = real("friction_coefficient", "Coulomb coefficient.")
    kinematic = switch("kinematic", "Whether `move()` may move it.")
    measures_impulse = switch("measures_impulse", "Whether `impulse` tells what matter does to it.")
    sensor = switch("sensor", "Whether it acts on nothing.")
    reports_touches = switch("reports_touches", "Whether `World.touches()` tells what touches it.")

    @property
    def meets(self) -> int:
        """Bit by bit, the groups of materials that it acts on; 0: all. Materials may be assigned; None stands for all."""
        return int(self._definition().meets)

    @meets.setter
    def meets(self, value: Meets | None) -> None:
        self.change(meets=0 if value is None else value)

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
        friction: Friction | str | None = None,
        friction_coefficient: float | None = None,
        kinematic: bool | None = None,
        measures_impulse: bool | None = None,
        meets: Meets | None = None,
        sensor: bool | None = None,
        reports_touches: bool | None = None,
    ) -> None:
        """Changes what is named, as when it was added; the rest stays. A new shape is there at once, without velocity."""
        values = {
            "friction": friction,
            "friction_coefficient": friction_coefficient,
            "kinematic": kinematic,
            "measures_impulse": measures_impulse,
            "meets": groups_of(self._world, meets),
            "sensor": sensor,
            "reports_touches": reports_touches,
        }
        definition = fill(self._definition(), values)
        self._apply("set", definition, ffi.NULL if shape is None else to_c(shape, self._world.dimension))

    def mass(self, density: float) -> Mass:
        """The mass properties of its shape at a density [kg/m^3]."""
        out = sized("pbmpm_mass_properties")
        self._world._call(lib.pbmpm_shape_mass, self._form(), density, out)
        return mass_from_c(out)

    def submerged(self, material: Material | None = None) -> Submersion:
        """The part of it that is under matter, also under what lies on it, or under one material."""
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


_SETTERS = {**setters_of(Collider), "meets": number("meets")}


def fill(definition: Any, values: Mapping[str, Any]) -> Any:
    """Writes the values that are not None into the C structure of a collider, and returns it."""
    for name, value in values.items():
        if value is not None:
            _SETTERS[name](definition, value, 0)
    return definition
