"""Rigid bodies: obstacles with a mass, which matter pushes and which push matter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._choice import Choice
from ._convert import Vector, initialised, sized, vector
from ._ffi import ffi
from ._fixed import Bound

if TYPE_CHECKING:
    from .colliders import Collider


class Freedom(Choice):
    """How far a body may move, or turn."""

    ALL = ffi.integer_const("PBMPM_FREEDOM_ALL")  #: in every direction
    AXIS = ffi.integer_const("PBMPM_FREEDOM_AXIS")  #: along, or about, the axis alone
    PLANE = ffi.integer_const("PBMPM_FREEDOM_PLANE")  #: in every direction but along, or about, the axis
    NONE = ffi.integer_const("PBMPM_FREEDOM_NONE")  #: not at all


@dataclass(frozen=True)
class Mass:
    """Mass properties of a shape of even density; 2D: per metre of depth.

    Attributes:
        volume: [m^d].
        mass: [kg].
        centre: of mass [m], from the shape's position, in its own frame; three numbers.
        inertia: moments xx, yy, zz about the centre [kg m^2], in the shape's own frame; 2D: only zz, else 0.
        products: elements xy, yz, zx of the same tensor.
    """

    volume: float
    mass: float
    centre: tuple[float, ...]
    inertia: tuple[float, ...]
    products: tuple[float, ...]


@dataclass(frozen=True)
class Submersion:
    """The part of an obstacle that is under matter.

    Attributes:
        share: of its volume, in [0, 1].
        volume: [m^d].
        centre: of that volume [m], one number per axis; without any: of the obstacle.
        density: of the matter around [kg/m^3]; 0 without any.
    """

    share: float
    volume: float
    centre: tuple[float, ...]
    density: float


def mass_from_c(out: Any) -> Mass:
    """The mass properties that a C structure holds."""
    return Mass(out.volume, out.mass, tuple(out.centre), tuple(out.inertia), tuple(out.products))


def submersion_from_c(out: Any, dimension: int) -> Submersion:
    """The submersion that a C structure holds."""
    return Submersion(out.share, out.volume, tuple(out.centre)[:dimension], out.density)


def _three(name: str, value: Vector, dimension: int) -> list[float]:
    return [*vector(name, value, dimension), 0.0][:3]


class RigidBody(Bound):
    """An obstacle that moves as matter, gravity and the host push it. `advance()` it before each step of its world.

    Walls of the domain stop it, and rub on it with the geometric mean of both coefficients of friction: 0 by default, `World(domain_friction=...)`.
    It passes through other obstacles, rigid bodies too.

    Args:
        collider: kinematic, and measures its impulse; any shape but a plane.
        density: [kg/m^3]; its mass properties are those of its shape.
        mass: [kg] (2D: per metre of depth), in place of the density; spread evenly over the shape.
        moves: of its centre of mass; NONE: its pivot stays in place, as on a hinge.
        turns: 2D: NONE or ALL.
        pivot: with `moves` NONE: what stays, from the shape's position, in the shape's own frame [m].
        move_axis, turn_axis: in the world, one number per axis; `turn_axis` in 3D only.
        stays_inside: whether walls of the domain stop what of it touches them, without bounce. Not where `moves` is NONE.
    """

    __slots__ = ("_collider", "_definition", "_state")
    _instead = "its `state` can be kept and set again"

    def __init__(
        self,
        collider: Collider,
        *,
        density: float | None = None,
        mass: float | None = None,
        moves: Freedom | str = Freedom.ALL,
        turns: Freedom | str = Freedom.ALL,
        pivot: Vector | None = None,
        move_axis: Vector | None = None,
        turn_axis: Vector | None = None,
        stays_inside: bool = True,
    ) -> None:
        if (density is None) == (mass is None):
            raise TypeError("a body needs either a density or a mass")
        form = collider.mass(1.0)
        factor = density if mass is None else mass / form.volume
        self._collider = collider
        self._definition = initialised("pbmpm_rigid_def")
        self._state = sized("pbmpm_rigid_state")
        self._definition.moves, self._definition.turns = Freedom(moves).value, Freedom(turns).value
        self._definition.stays_inside = bool(stays_inside)
        self._definition.mass = factor * form.mass
        self._definition.centre = form.centre
        self._definition.inertia = [factor * value for value in form.inertia]
        self._definition.products = [factor * value for value in form.products]
        for name, value in (("pivot", pivot), ("move_axis", move_axis), ("turn_axis", turn_axis)):
            if value is not None:
                setattr(self._definition, name, _three(name, value, self._dimension))
        collider._body("begin", self._definition, self._state)

    @property
    def _dimension(self) -> int:
        return self._collider._world.dimension

    def advance(self, dt: float) -> None:
        """Moves the body on by `dt` seconds, and sends its obstacle there. To be called once before each step."""
        self._collider._body("advance", self._definition, self._state, dt)

    def push(self, force: Vector | None = None, torque: float | Vector | None = None) -> None:
        """Sets what the host pushes with from now on: a force at the centre of mass [N] and a torque [N m]; 2D: a number."""
        self._definition.force = [0.0] * 3 if force is None else _three("force", force, self._dimension)
        if torque is None:
            self._definition.torque = [0.0] * 3
        else:
            self._definition.torque = [0.0, 0.0, torque] if self._dimension == 2 else vector("torque", torque, 3)  # type: ignore[arg-type]

    def shift(self, moved: Vector) -> None:
        """To be called after `World.shift_origin()`, with what that returned."""
        for a, way in enumerate(vector("moved", moved, self._dimension)):
            self._state.position[a] -= way
            self._state.point[a] -= way

    @property
    def mass(self) -> float:
        """[kg]; 2D: per metre of depth."""
        return float(self._definition.mass)

    @property
    def virtual_mass(self) -> float:
        """What held its velocity back in the last `advance()` [kg]."""
        return float(self._state.virtual_mass)

    @property
    def position(self) -> tuple[float, ...]:
        """Of the shape [m], at the end of the next step."""
        return tuple(self._state.position)[: self._dimension]

    @property
    def rotation(self) -> tuple[float, ...]:
        """Quaternion (x, y, z, w)."""
        return tuple(self._state.rotation)

    @property
    def velocity(self) -> tuple[float, ...]:
        """Of the centre of mass [m/s]."""
        return tuple(self._state.velocity)[: self._dimension]

    @velocity.setter
    def velocity(self, value: Vector) -> None:
        self._state.velocity = _three("velocity", value, self._dimension)

    @property
    def angular_velocity(self) -> tuple[float, ...]:
        """[rad/s]; three numbers."""
        return tuple(self._state.angular_velocity)

    @angular_velocity.setter
    def angular_velocity(self, value: Vector) -> None:
        self._state.angular_velocity = vector("angular_velocity", value, 3)

    @property
    def state(self) -> bytes:
        """A copy of all that changes."""
        return bytes(ffi.buffer(self._state))

    @state.setter
    def state(self, value: bytes) -> None:
        ffi.memmove(self._state, value, ffi.sizeof("pbmpm_rigid_state"))
        self._collider.teleport(self.position, self.rotation)
