"""Single values of C structures, as tables by name have them, and as attributes of what a world holds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

from ._choice import Choice
from ._convert import Vector, assign, assign_vector, plain, shortest

#: Writes one value into a C structure of a world with so many axes.
Setter = Callable[[Any, Any, int], None]
Told = TypeVar("Told")
Taken = TypeVar("Taken")
Kind = TypeVar("Kind", bound=Choice)


def number(name: str) -> Setter:
    """Writes a number."""
    return lambda out, value, dimension: assign(out, name, value)


def flag(name: str) -> Setter:
    """Writes whether something is so."""

    def write(out: Any, value: Any, dimension: int) -> None:
        if value is None:
            raise TypeError(f"{name}: True or False is needed, not None")
        assign(out, name, bool(value))

    return write


def axes(name: str) -> Setter:
    """Writes a vector."""
    return lambda out, value, dimension: assign_vector(out, name, value, dimension)


def choice(name: str, kind: type[Choice]) -> Setter:
    """Writes a member of an enumeration."""
    return lambda out, value, dimension: assign(out, name, kind(value).value)


class Value(Generic[Told, Taken]):
    """An attribute of a member of a world: a value of its definition. Assigning changes it as `change()` does."""

    def __init__(self, write: Setter, read: Callable[[Any, Any], Told], about: str) -> None:
        self.write, self.read, self.__doc__ = write, read, about

    def __get__(self, member: Any, kind: type | None = None) -> Told:
        return self if member is None else self.read(member._definition(), member._world)  # type: ignore[return-value]

    def __set__(self, member: Any, value: Taken) -> None:
        definition = member._definition()
        self.write(definition, value, member._world.dimension)
        member._redefine(definition)


def real(name: str, about: str) -> Value[float, float]:
    """A number with a fraction."""
    return Value(number(name), lambda definition, world: shortest(getattr(definition, name)), about)


def whole(name: str, about: str) -> Value[int, int]:
    """A number without one."""
    return Value(number(name), lambda definition, world: int(getattr(definition, name)), about)


def switch(name: str, about: str) -> Value[bool, bool]:
    """Whether something is so."""
    return Value(flag(name), lambda definition, world: bool(getattr(definition, name)), about)


def components(name: str, about: str) -> Value[tuple[float, ...], Vector]:
    """A vector with a number per axis."""
    return Value(axes(name), lambda definition, world: tuple(plain(getattr(definition, name))[: world.dimension]), about)


def one_of(name: str, kind: type[Kind], about: str) -> Value[Kind, Kind | str]:
    """A member of an enumeration, or its name."""
    return Value(choice(name, kind), lambda definition, world: kind(getattr(definition, name)), about)


def setters_of(*kinds: type) -> dict[str, Setter]:
    """How the values of some classes are written, by name."""
    return {name: value.write for kind in kinds for name, value in vars(kind).items() if isinstance(value, Value)}
