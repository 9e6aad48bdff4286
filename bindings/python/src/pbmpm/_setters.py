"""How single values go into C structures, as tables by name have it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ._choice import Choice
from ._convert import assign, assign_vector

#: Writes one value into a C structure of a world with so many axes.
Setter = Callable[[Any, Any, int], None]


def number(name: str) -> Setter:
    """Writes a number."""
    return lambda out, value, dimension: assign(out, name, value)


def flag(name: str) -> Setter:
    """Writes whether something is so."""
    return lambda out, value, dimension: assign(out, name, bool(value))


def axes(name: str) -> Setter:
    """Writes a vector."""
    return lambda out, value, dimension: assign_vector(out, name, value, dimension)


def choice(name: str, kind: type[Choice]) -> Setter:
    """Writes a member of an enumeration."""
    return lambda out, value, dimension: assign(out, name, kind(value).value)
