"""Between Python values and C structures. Everything that goes in is checked for its shape here; ranges, NaN and
infinity are the C library's to judge."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._ffi import ffi
from ._library import lib
from .errors import InvalidArgumentError, check

#: One number per axis of the world.
Vector = Sequence[float] | npt.NDArray[Any]
#: An angle [rad] about the third axis (all that 2D has), or a unit quaternion (x, y, z, w).
Rotation = float | Sequence[float] | npt.NDArray[Any]


def sized(name: str) -> Any:
    """A new structure with only its size set."""
    structure = ffi.new(f"{name} *")
    structure.size = ffi.sizeof(name)
    return structure


def sized_array(name: str, count: int) -> Any:
    """An array of structures whose first element says the size of all."""
    array = ffi.new(f"{name}[]", count)
    if count:
        array[0].size = ffi.sizeof(name)
    return array


def initialised(name: str) -> Any:
    """A new structure with the library's defaults."""
    structure = ffi.new(f"{name} *")
    check(getattr(lib, f"{name}_init")(structure, ffi.sizeof(name)))
    return structure


def plain(value: Any) -> Any:
    """A field of a C structure as a Python value: a number as it is, an array as a tuple (of the shortest numbers if
    it holds 32-bit floats)."""
    if isinstance(value, ffi.CData):
        shorten = ffi.typeof(value).item.cname == "float"
        return tuple(shortest(item) if shorten else item for item in value)
    return value


def shortest(value: float) -> float:
    """The shortest decimal number that is the same 32-bit float: 0.1 instead of 0.10000000149."""
    return float(str(np.float32(value)))


def assign(structure: Any, field: str, value: Any) -> None:
    """Sets a number in a C structure."""
    try:
        setattr(structure, field, value)
    except (OverflowError, TypeError) as problem:
        kind = InvalidArgumentError if isinstance(problem, OverflowError) else TypeError
        raise kind(f"{field}: {_numbers(structure, field)} is needed, not {value!r}") from None


def _numbers(structure: Any, field: str) -> str:
    """Which numbers a field of a C structure holds, in words."""
    ctype = dict(ffi.typeof(structure).item.fields)[field].type
    if ctype.cname in ("float", "double"):
        return "a number"
    lowest = -(1 << 8 * ffi.sizeof(ctype) - 1) if int(ffi.cast(ctype, -1)) < 0 else 0
    return f"a whole number in [{lowest}, {lowest + (1 << 8 * ffi.sizeof(ctype)) - 1}]"


def vector(name: str, value: Vector, dimension: int) -> list[float]:
    """The components of a vector with one number per axis."""
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (dimension,):
        raise InvalidArgumentError(f"{name}: {dimension} numbers are needed, not an array of shape {array.shape}")
    components: list[float] = array.tolist()
    return components


def assign_vector(structure: Any, field: str, value: Vector, dimension: int) -> None:
    """Sets the first components of an array in a C structure; those beyond the dimension keep their defaults."""
    target = getattr(structure, field)
    for i, component in enumerate(vector(field, value, dimension)):
        target[i] = component


def quaternion(rotation: Rotation) -> list[float]:
    """The quaternion (x, y, z, w) of a rotation."""
    if np.ndim(rotation) == 0:
        half = float(rotation) / 2  # type: ignore[arg-type]
        if math.isinf(half):
            raise InvalidArgumentError("rotation: the angle is infinite")
        return [0.0, 0.0, math.sin(half), math.cos(half)]
    return vector("rotation", rotation, 4)  # type: ignore[arg-type]


def floats(name: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.float32]:
    """A packed array of 32-bit floats with the given shape; -1 as its first number stands for
    any length."""
    try:
        with np.errstate(over="ignore"):  # becomes infinity, which the library refuses
            array = np.ascontiguousarray(values, dtype=np.float32)
    except (TypeError, ValueError) as problem:
        raise InvalidArgumentError(f"{name}: {problem}") from None
    wanted_shape = (*array.shape[:1], *shape[1:]) if shape[0] == -1 else shape
    if array.shape != wanted_shape:
        wanted = str(shape).replace("-1", "n")
        raise InvalidArgumentError(f"{name}: an array of shape {wanted} is needed, not {array.shape}")
    return array


def integers(name: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.uint32]:
    """A packed array of 32-bit unsigned integers with the given shape."""
    array = np.asarray(values)
    if array.shape != shape:
        raise InvalidArgumentError(f"{name}: an array of shape {shape} is needed, not {array.shape}")
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise InvalidArgumentError(f"{name}: 32-bit unsigned integers are needed")
    return np.ascontiguousarray(array, dtype=np.uint32)


def identifiers(ids: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """Particle identifiers as the packed array (n, 2) that the library reads."""
    array = np.asarray(ids)
    if array.size == 0:
        array = np.empty((0, 2), np.uint32)
    if array.ndim != 2 or array.shape[1] != 2:
        raise InvalidArgumentError(f"ids: an array of shape (n, 2) is needed, not {array.shape}")
    if array.dtype.kind not in "iu" or (array.size and (array.min() < 0 or array.max() > 0xFFFFFFFF)):
        raise InvalidArgumentError("ids: pairs of 32-bit unsigned integers (index, generation) are needed")
    return np.ascontiguousarray(array, dtype=np.uint32)


def pointer(ctype: str, array: npt.NDArray[Any] | None, writable: bool = False) -> Any:
    """A C pointer to the elements of a packed array, or null. It keeps the array alive."""
    return ffi.NULL if array is None else ffi.from_buffer(f"{ctype}[]", array, require_writable=writable)
