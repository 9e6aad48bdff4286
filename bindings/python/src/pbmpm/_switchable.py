"""Things in a world that have a shape and can be switched on and off: emitters, drains, forces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ._convert import assign, initialised
from ._ffi import ffi
from ._fixed import nearest
from ._library import lib
from ._member import Member
from ._setters import Setter, setters_of, switch
from .shapes import Shape, from_c, to_c


class Switchable(Member):
    """A member with a shape that acts while it is enabled."""

    __slots__ = ()
    _has_shape = True
    _setters: ClassVar[Mapping[str, Setter]]  #: of what can be changed: its values

    def __init_subclass__(cls) -> None:
        cls._setters = setters_of(Switchable, cls)

    enabled = switch("enabled", "Whether it acts. Assigning switches it on and off.")

    @classmethod
    def _fill(cls, definition: Any, dimension: int, values: Mapping[str, Any]) -> Any:
        """Writes the values that are not None into the C structure. Returns that of the shape, null if none is named."""
        shape = ffi.NULL
        for name, value in values.items():
            if name == "shape":
                if value is not None:
                    shape = to_c(value, dimension)
                    cls._take_shape(definition)
                continue
            if name == "key":
                assign(definition, "key", value)
                continue
            if name not in cls._setters:
                raise TypeError(f"this {cls._name} has no '{name}' to set{nearest(name, ['shape', *cls._setters])}")
            if value is not None:
                cls._setters[name](definition, value, dimension)
        return shape

    @classmethod
    def _take_shape(cls, definition: Any) -> None:
        """What else changes when a shape is named."""

    @classmethod
    def _add(cls, world: Any, values: Mapping[str, Any]) -> Any:
        """Makes one in the world; returns its identifier."""
        definition = initialised(f"pbmpm_{cls._name}_def")
        shape = cls._fill(definition, world.dimension, values) or initialised("pbmpm_shape")
        out = ffi.new(f"pbmpm_{cls._name}_id *")
        world._call(getattr(lib, f"pbmpm_{cls._name}_create"), definition, shape, out)
        return out[0]

    def change(self, **values: Any) -> None:
        """Changes what is named as when it was added; counts are kept. Takes effect with the next step."""
        definition = self._definition()
        shape = self._fill(definition, self._world.dimension, values)
        self._apply("set", definition, shape)

    @property
    def shape(self) -> Shape:
        """The shape with its current pose; the rotation is a quaternion. Assigning replaces it."""
        return from_c(self._form(), self._world.dimension)

    @shape.setter
    def shape(self, value: Shape) -> None:
        self.change(shape=value)
