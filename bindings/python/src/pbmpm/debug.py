"""What a host draws to see what the library sees."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._choice import Choice
from ._ffi import ffi
from ._library import lib
from ._member import WorldPart


class DebugPart(Choice):
    """What lines can show."""

    DOMAIN = ffi.integer_const("PBMPM_DEBUG_DOMAIN")  #: walls that are closed
    COLLIDERS = ffi.integer_const("PBMPM_DEBUG_COLLIDERS")
    EMITTERS = ffi.integer_const("PBMPM_DEBUG_EMITTERS")
    DRAINS = ffi.integer_const("PBMPM_DEBUG_DRAINS")
    FORCES = ffi.integer_const("PBMPM_DEBUG_FORCES")  #: those that are switched on
    KILL_BOUNDS = ffi.integer_const("PBMPM_DEBUG_KILL_BOUNDS")
    BLOCKS = ffi.integer_const("PBMPM_DEBUG_BLOCKS")  #: of the grid, with particles in the last substep
    ASLEEP = ffi.integer_const("PBMPM_DEBUG_ASLEEP")  #: blocks that sleep


_LINE = np.dtype([("ends", np.float32, (2, 3)), ("part", np.uint32)])


class WorldDebug(WorldPart):
    """The part of a `World` that shows what is in it."""

    __slots__ = ()

    def debug_lines(self, *parts: DebugPart) -> tuple[npt.NDArray[np.float32], npt.NDArray[Any]]:
        """Lines that show obstacles, regions and the grid.

        Args:
            parts: what to show; none: everything.

        Returns:
            The ends of n lines, shape (n, 2, d) [m], and the value of the `DebugPart` of each, shape (n,).
        """
        chosen = sum({DebugPart(part).value for part in parts or DebugPart})
        count = ffi.new("uint32_t *")
        self._call(lib.pbmpm_world_debug_lines, chosen, ffi.NULL, 0, count)
        lines = np.empty(count[0], _LINE)
        out = ffi.from_buffer("pbmpm_line[]", lines, require_writable=True) if len(lines) else ffi.NULL
        self._call(lib.pbmpm_world_debug_lines, chosen, out, len(lines), count)
        return lines["ends"][..., : self._dimension], lines["part"]
