"""Forces on matter besides gravity: winds, whirls, pushes, pulls, and a hand that grabs."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any

from ._convert import Vector, assign, assign_vector, initialised, plain, shortest, sized
from ._ffi import ffi
from ._library import lib
from .shapes import Shape, from_c, to_c

if TYPE_CHECKING:
    from .world import World


class ForceKind(enum.Enum):
    """What a force does; `include/pbmpm/force.h` has the formulas."""

    UNIFORM = ffi.integer_const("PBMPM_FORCE_UNIFORM")  #: accelerates along `direction`
    RADIAL = ffi.integer_const("PBMPM_FORCE_RADIAL")  #: pushes away from the centre; pulls when negative
    VORTEX = ffi.integer_const("PBMPM_FORCE_VORTEX")  #: accelerates around the axis `direction` (2D: counter-clockwise)
    DRAG = ffi.integer_const("PBMPM_FORCE_DRAG")  #: drags towards `velocity` and `spin`: wind, a whirl, or a brake
    GRAB = ffi.integer_const("PBMPM_FORCE_GRAB")  #: matter takes on `velocity` and `spin`


class Falloff(enum.Enum):
    """The share of a force at the distance d outside of its shape."""

    NONE = ffi.integer_const("PBMPM_FALLOFF_NONE")  #: all up to the range
    LINEAR = ffi.integer_const("PBMPM_FALLOFF_LINEAR")  #: 1 - d / range
    SMOOTH = ffi.integer_const("PBMPM_FALLOFF_SMOOTH")  #: (1 - (d / range)^2)^2
    INVERSE_SQUARE = ffi.integer_const("PBMPM_FALLOFF_INVERSE_SQUARE")  #: (1 + d / range)^-2, at any distance


class Force:
    """A force in a world. Made by `World.add_force()`."""

    __slots__ = ("_world", "_id")

    def __init__(self, world: World, identifier: Any) -> None:
        self._world = world
        self._id = identifier

    def _definition(self) -> Any:
        out = sized("pbmpm_force_def")
        out.shape.size = ffi.sizeof("pbmpm_shape")
        self._world._call(lib.pbmpm_force_get, self._id, out)
        return out

    def change(self, **values: Any) -> None:
        """Changes what is named, with the names of `World.add_force()`; takes effect with the next step."""
        definition = self._definition()
        _fill(definition, self._world.dimension, values)
        self._world._call(lib.pbmpm_force_set, self._id, definition)

    @property
    def kind(self) -> ForceKind:
        return ForceKind(self._definition().kind)

    @property
    def shape(self) -> Shape:
        """Its shape; the rotation is a quaternion."""
        return from_c(self._definition().shape, self._world.dimension)

    @property
    def strength(self) -> float:
        """Acceleration [m/s^2], or the coefficient of a drag [1/s]."""
        return shortest(self._definition().strength)

    @property
    def enabled(self) -> bool:
        """Whether it acts. Assigning switches it on and off."""
        return bool(self._definition().enabled)

    @enabled.setter
    def enabled(self, value: bool) -> None:
        self.change(enabled=value)

    @property
    def impulse(self) -> tuple[float, ...]:
        """What it added to the momentum of the matter in the last step, shape (d,) [kg m/s] (2D: per metre of depth)."""
        return tuple(plain(self._status().impulse)[: self._world.dimension])

    @property
    def nodes(self) -> int:
        """Nodes of the grid that felt it in the last substep."""
        return int(self._status().nodes)

    def _status(self) -> Any:
        out = sized("pbmpm_force_status")
        self._world._call(lib.pbmpm_force_status_get, self._id, out)
        return out

    def destroy(self) -> None:
        """Removes the force."""
        self._world._call(lib.pbmpm_force_destroy, self._id)

    def __repr__(self) -> str:
        return f"<pbmpm.Force {self._id.index}:{self._id.generation}>"


def _fill(out: Any, dimension: int, values: dict[str, Any]) -> None:
    """Writes the values that are not None into the C structure of a force."""
    for name, value in values.items():
        if value is None:
            continue
        if name == "shape":
            out.shape = to_c(value, dimension)[0]
            out.everywhere = 0
        elif name == "everywhere":
            out.everywhere = bool(value)
        elif name in ("direction", "velocity"):
            assign_vector(out, name, value, dimension)
        elif name == "kind":
            out.kind = ForceKind(value).value
        elif name == "falloff":
            out.falloff = Falloff(value).value
        elif name == "enabled":
            out.enabled = bool(value)
        elif name in ("range", "strength", "spin"):
            assign(out, name, value)
        else:
            raise TypeError(f"a force has no '{name}'")


class WorldForces:
    """The part of a `World` that has forces."""

    __slots__ = ()
    _dimension: int

    def _call(self, function: Any, *arguments: Any) -> Any:
        """Calls a function of the C library with this world."""
        raise NotImplementedError

    def add_force(
        self,
        kind: ForceKind,
        strength: float | None = None,
        *,
        shape: Shape | None = None,
        everywhere: bool | None = None,
        falloff: Falloff | None = None,
        range: float | None = None,
        direction: Vector | None = None,
        velocity: Vector | None = None,
        spin: float | None = None,
        enabled: bool | None = None,
    ) -> Force:
        """Adds a force. It acts on the grid before materials and obstacles do, in the blocks that it reaches.

        Args:
            kind: what it does.
            strength: acceleration [m/s^2], or the coefficient of a drag [1/s]; default 1.
            shape: where it acts, and the centre of what has one; None: everywhere, with the centre at the origin.
            everywhere: True: the shape only gives the centre.
            falloff: how it fades outside of the shape.
            range: of the falloff [m].
            direction: of a uniform force; in 3D the axis of a vortex, a drag or a grab; default the second axis.
            velocity: that drag and grab lead to [m/s].
            spin: that they lead to, about the axis through the shape's position [rad/s].
            enabled: whether it acts yet.
        """
        definition = initialised("pbmpm_force_def")
        values = {
            "kind": kind,
            "strength": strength,
            "shape": shape,
            "everywhere": everywhere,
            "falloff": falloff,
            "range": range,
            "direction": direction,
            "velocity": velocity,
            "spin": spin,
            "enabled": enabled,
        }
        _fill(definition, self._dimension, values)
        out = ffi.new("pbmpm_force_id *")
        self._call(lib.pbmpm_force_create, definition, out)
        return Force(self, out[0])  # type: ignore[arg-type]
