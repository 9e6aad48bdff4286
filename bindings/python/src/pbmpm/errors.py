"""Exceptions: one class for each result of the C library, and those that only the binding knows."""

from __future__ import annotations

from ._ffi import ffi
from ._library import LibraryError, lib

__all__ = [
    "BusyError",
    "CapacityError",
    "ClosedError",
    "DamagedError",
    "ExpiredViewError",
    "ForeignError",
    "ForkedError",
    "InUseError",
    "InvalidArgumentError",
    "InvalidIdError",
    "LibraryError",
    "OutOfMemoryError",
    "PbmpmError",
    "ThreadError",
    "UnsupportedCpuError",
    "UnsupportedError",
]


class PbmpmError(Exception):
    """Base of all errors but `LibraryError`.

    Attributes:
        message: what went wrong.
        result: the number of the C library's result, or None for an error of the binding.
        result_name: its name ("PBMPM_ERROR_BUSY"), or an empty string.
    """

    _result_name = ""

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self.message = message
        self.result_name = self._result_name
        self.result = ffi.integer_const(self._result_name) if self._result_name else None


class InvalidArgumentError(PbmpmError, ValueError):
    """A value is NaN, infinite, outside its documented range, or an array has the wrong shape."""

    _result_name = "PBMPM_ERROR_INVALID_ARGUMENT"


class InvalidIdError(PbmpmError, LookupError):
    """An identifier is stale, of another world, or was never one."""

    _result_name = "PBMPM_ERROR_INVALID_ID"


class OutOfMemoryError(PbmpmError, MemoryError):
    """No memory, or the memory budget is used up."""

    _result_name = "PBMPM_ERROR_OUT_OF_MEMORY"


class CapacityError(PbmpmError):
    """More particles, materials, colliders or worlds than there is room for."""

    _result_name = "PBMPM_ERROR_CAPACITY"


class BusyError(PbmpmError):
    """Another thread is inside a call on the same world."""

    _result_name = "PBMPM_ERROR_BUSY"


class UnsupportedCpuError(PbmpmError):
    """The CPU lacks the instructions that the library needs at least."""

    _result_name = "PBMPM_ERROR_UNSUPPORTED_CPU"


class UnsupportedError(PbmpmError):
    """The library or this world does not have what was asked for."""

    _result_name = "PBMPM_ERROR_UNSUPPORTED"


class ThreadError(PbmpmError):
    """A worker thread could not be started."""

    _result_name = "PBMPM_ERROR_THREAD"


class InUseError(PbmpmError):
    """The object still has users, like a material that particles refer to."""

    _result_name = "PBMPM_ERROR_IN_USE"


class ForkedError(PbmpmError):
    """The world belongs to the parent process."""

    _result_name = "PBMPM_ERROR_FORKED"


class DamagedError(PbmpmError, ValueError):
    """Stored data is truncated or changed, or was never the library's."""

    _result_name = "PBMPM_ERROR_DAMAGED"


class ForeignError(PbmpmError, ValueError):
    """Stored data belongs to a world that was made in another way, or to another version of the library."""

    _result_name = "PBMPM_ERROR_FOREIGN"


class ClosedError(PbmpmError):
    """The world has been closed."""


class ExpiredViewError(PbmpmError):
    """The world has changed since the view was taken."""


_BY_RESULT = {ffi.integer_const(kind._result_name): kind for kind in PbmpmError.__subclasses__() if kind._result_name}


def check(result: int) -> None:
    """Raises the exception that belongs to a result of the C library; returns for success."""
    if result == 0:
        return
    name = ffi.string(lib.pbmpm_result_name(result)).decode()
    message = ffi.string(lib.pbmpm_last_error()).decode(errors="replace") or name
    kind = _BY_RESULT.get(result)
    if kind is not None:
        raise kind(message)
    error = PbmpmError(f"{message} ({name})")
    error.result, error.result_name = result, name
    raise error
