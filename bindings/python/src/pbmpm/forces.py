"""Forces on matter besides gravity: winds, whirls, pushes, pulls, and a hand that grabs."""

from __future__ import annotations

from typing import Any

from ._choice import Choice
from ._convert import Vector, plain
from ._ffi import ffi
from ._member import WorldPart
from ._setters import components, one_of, real, switch
from ._switchable import Switchable
from .shapes import Shape


class ForceKind(Choice):
    """What a force does; `include/pbmpm/force.h` has the formulas."""

    UNIFORM = ffi.integer_const("PBMPM_FORCE_UNIFORM")  #: accelerates along `direction`
    RADIAL = ffi.integer_const("PBMPM_FORCE_RADIAL")  #: pushes away from the centre; pulls when negative
    VORTEX = ffi.integer_const("PBMPM_FORCE_VORTEX")  #: accelerates around the axis `direction` (2D: counter-clockwise)
    DRAG = ffi.integer_const("PBMPM_FORCE_DRAG")  #: drags towards `velocity` and `spin`: wind, a whirl, or a brake
    GRAB = ffi.integer_const("PBMPM_FORCE_GRAB")  #: matter takes on `velocity` and `spin`, and is held


class Falloff(Choice):
    """The share of a force at the distance d outside of its shape."""

    NONE = ffi.integer_const("PBMPM_FALLOFF_NONE")  #: all up to the range
    LINEAR = ffi.integer_const("PBMPM_FALLOFF_LINEAR")  #: 1 - d / range
    SMOOTH = ffi.integer_const("PBMPM_FALLOFF_SMOOTH")  #: (1 - (d / range)^2)^2
    INVERSE_SQUARE = ffi.integer_const("PBMPM_FALLOFF_INVERSE_SQUARE")  #: (1 + d / range)^-2, at any distance


class Force(Switchable):
    """A force in a world. Made by `World.add_force()`."""

    __slots__ = ()
    _name = "force"
    kind = one_of("kind", ForceKind, "What it does.")
    strength = real("strength", "Acceleration [m/s^2], or the coefficient of a drag [1/s].")
    everywhere = switch("everywhere", "Whether the shape only gives the centre.")
    falloff = one_of("falloff", Falloff, "How it fades outside of the shape.")
    range = real("range", "Of the falloff [m].")
    direction = components("direction", "Of a uniform force; in 3D the axis of a vortex, a drag or a grab; shape (d,).")
    velocity = components("velocity", "What drag and grab lead to, shape (d,) [m/s].")
    spin = real("spin", "What they lead to about the axis through the position of the shape [rad/s].")

    @classmethod
    def _take_shape(cls, definition: Any) -> None:
        definition.everywhere = 0

    @property
    def impulse(self) -> tuple[float, ...]:
        """What it added to the momentum of the matter in the last step, shape (d,) [kg m/s] (2D: per metre of depth)."""
        return tuple(plain(self._status().impulse)[: self._world.dimension])

    @property
    def nodes(self) -> int:
        """Nodes of the grid that felt it in the last substep."""
        return int(self._status().nodes)


class WorldForces(WorldPart):
    """The part of a `World` that has forces."""

    __slots__ = ()

    def add_force(
        self,
        kind: ForceKind | str,
        strength: float | None = None,
        *,
        shape: Shape | None = None,
        everywhere: bool | None = None,
        falloff: Falloff | str | None = None,
        range: float | None = None,
        direction: Vector | None = None,
        velocity: Vector | None = None,
        spin: float | None = None,
        enabled: bool | None = None,
        key: int = 0,
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
            key: what snapshots know it by, a number that no other force of the world has; 0: its place.
        """
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
            "key": key,
        }
        return Force(self, Force._add(self, values))  # type: ignore[arg-type]
