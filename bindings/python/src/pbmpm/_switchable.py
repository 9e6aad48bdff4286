"""Things in a world that have a shape and can be switched on and off: emitters, drains, forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from ._convert import assign, assign_vector
from ._member import Member
from .shapes import Shape, from_c

#: Writes one value into a C structure of a world with so many axes.
Setter = Callable[[Any, Any, int], None]


class Switchable(Member):
    """A member with a shape that acts while it is enabled."""

    __slots__ = ()
    _setters: ClassVar[Mapping[str, Setter]]  #: of what can be changed

    @classmethod
    def _fill(cls, definition: Any, dimension: int, values: Mapping[str, Any]) -> None:
        """Writes the values that are not None into the C structure."""
        for name, value in values.items():
            if name not in cls._setters:
                raise TypeError(f"this {cls._name} has no '{name}' to set")
            if value is not None:
                cls._setters[name](definition, value, dimension)

    def change(self, **values: Any) -> None:
        """Changes what is named as when it was added; counts are kept. Takes effect with the next step."""
        definition = self._definition()
        self._fill(definition, self._world.dimension, values)
        self._apply("set", definition)

    @property
    def shape(self) -> Shape:
        """The shape with its current pose; the rotation is a quaternion. Assigning replaces it."""
        return from_c(self._definition().shape, self._world.dimension)

    @shape.setter
    def shape(self, value: Shape) -> None:
        self.change(shape=value)

    @property
    def enabled(self) -> bool:
        """Whether it acts. Assigning switches it on and off."""
        return bool(self._definition().enabled)

    @enabled.setter
    def enabled(self, value: bool) -> None:
        self.change(enabled=value)


def set_enabled(out: Any, value: Any, dimension: int) -> None:
    """Writes whether a member acts."""
    out.enabled = bool(value)


def number(name: str) -> Setter:
    """Writes a number."""
    return lambda out, value, dimension: assign(out, name, value)


def axes(name: str) -> Setter:
    """Writes a vector."""
    return lambda out, value, dimension: assign_vector(out, name, value, dimension)
