"""A plain description of a C API: what the parser produces and what every emitter reads.

All names are the C names. Documentation is the text of the ``/** ... */`` comment that belongs to the declaration,
without comment marks and leading stars, lines kept; an empty string when there is none.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any


class Kind(Enum):
    """What the innermost part of a type is."""

    VOID = "void"
    SCALAR = "scalar"  #: an arithmetic type of C: "float", "uint32_t", "size_t", "char", ...
    ENUM = "enum"
    STRUCT = "struct"
    CALLBACK = "callback"  #: a function type with a typedef name; it is always used through a pointer
    FUNCTION = "function"  #: a function type without a name (a function pointer in a structure)


@dataclass(frozen=True)
class Type:
    """A type: a base, then pointers, then (for a field or a parameter) an array length.

    Examples: ``float x[3]`` is SCALAR "float" with length 3; ``const float *x`` is SCALAR "float" with const and
    one pointer; ``const pbmpm_event **x`` is STRUCT "pbmpm_event" with const and two pointers;
    ``void (*f)(int)`` is FUNCTION with one pointer and its signature.
    A parameter with a length (``const float position[3]``) is passed as a pointer to that many elements.
    """

    kind: Kind
    name: str  #: name of the base type; empty for FUNCTION
    const: bool = False  #: the base type is const
    pointers: int = 0  #: levels of pointers on top of the base type
    length: int | None = None  #: number of array elements, None when it is not an array
    signature: Signature | None = None  #: FUNCTION only


@dataclass(frozen=True)
class Parameter:
    name: str
    type: Type


@dataclass(frozen=True)
class Signature:
    """Result and parameters of a function, callback or function pointer."""

    result: Type
    parameters: tuple[Parameter, ...]


@dataclass(frozen=True)
class Constant:
    """A number: a macro, or a member of an enumeration without a name."""

    name: str
    value: int
    doc: str = ""


@dataclass(frozen=True)
class Enumeration:
    """A named enumeration. Members keep the order of the header, the ``*_FORCE32`` one included: it makes the type
    32 bits wide and has no meaning of its own."""

    name: str
    members: tuple[Constant, ...]
    doc: str = ""


@dataclass(frozen=True)
class Field:
    name: str
    type: Type
    doc: str = ""


@dataclass(frozen=True)
class Structure:
    name: str
    fields: tuple[Field, ...]
    doc: str = ""


@dataclass(frozen=True)
class Callback:
    """A function type with a typedef name."""

    name: str
    signature: Signature
    doc: str = ""


@dataclass(frozen=True)
class Function:
    """An exported function."""

    name: str
    signature: Signature
    doc: str = ""


Declaration = Enumeration | Structure | Callback | Function


@dataclass(frozen=True)
class Api:
    """The whole API. ``declarations`` holds everything but the constants in the order of the headers, so that a name
    is declared before it is used; the properties below select from it."""

    constants: tuple[Constant, ...]
    declarations: tuple[Declaration, ...]

    def _select(self, kind: type) -> tuple[Any, ...]:
        return tuple(item for item in self.declarations if isinstance(item, kind))

    @property
    def enumerations(self) -> tuple[Enumeration, ...]:
        return self._select(Enumeration)

    @property
    def structures(self) -> tuple[Structure, ...]:
        return self._select(Structure)

    @property
    def callbacks(self) -> tuple[Callback, ...]:
        return self._select(Callback)

    @property
    def functions(self) -> tuple[Function, ...]:
        return self._select(Function)

    def constant(self, name: str) -> int:
        """The value of a constant; KeyError when there is none of that name."""
        for item in self.constants:
            if item.name == name:
                return item.value
        raise KeyError(name)
