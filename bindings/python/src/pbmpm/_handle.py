"""Ownership of a world in the C library."""

from __future__ import annotations

from typing import Any

from ._ffi import ffi
from ._fixed import Bound
from ._library import lib
from .errors import check


class WorldHandle(Bound):
    """Owns one world of the C library and destroys it when nothing refers to the handle any more.

    The `World` holds it, and so does every array over the world's memory (as its base): the memory outlives the last
    array, whatever the garbage collector does.
    """

    __slots__ = ("id", "_destroy", "__weakref__")
    _instead = "World.snapshot() keeps the state of its world"

    def __init__(self, definition: Any) -> None:
        # Kept here because module globals may be gone when the interpreter ends.
        self._destroy: Any = None
        out = ffi.new("pbmpm_world_id *")
        check(lib.pbmpm_world_create(definition, out))
        self.id = out[0]
        self._destroy = lib.pbmpm_world_destroy

    def __del__(self) -> None:
        if self._destroy is not None:
            self._destroy(self.id)
