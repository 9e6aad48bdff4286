"""Saving the state of a world and going back to it."""

from __future__ import annotations


from ._ffi import ffi
from ._library import lib
from ._member import WorldPart


class WorldSnapshots(WorldPart):
    """What a `World` can do with snapshots."""

    __slots__ = ()

    def _snapshot_size(self) -> tuple[int, int]:
        total, each = ffi.new("uint64_t *"), ffi.new("uint32_t *")
        self._call(lib.pbmpm_snapshot_size, total, each)
        return int(total[0]), int(each[0])

    @property
    def snapshot_bytes(self) -> int:
        """How large a snapshot is now."""
        return self._snapshot_size()[0]

    @property
    def snapshot_bytes_per_particle(self) -> int:
        """How many bytes of a snapshot each particle takes: 60 in 2D and 92 in 3D; more with elastic materials (16 and 36), once
        the dual solver was used (4), and once the primal solver was used with BDF2 (52 and 100)."""
        return self._snapshot_size()[1]

    def snapshot(self) -> bytearray:
        """The state of now, to go back to with `restore()`: particles with their identifiers, settings, poses of
        obstacles, counters. A world that is restored goes on bit for bit as the one that was saved."""
        data = bytearray(self.snapshot_bytes)
        self.snapshot_into(data)
        return data

    def snapshot_into(self, buffer: bytearray | memoryview) -> int:
        """Writes a snapshot into memory that is there already.

        Args:
            buffer: at least `snapshot_bytes` long, writable.

        Returns:
            How many bytes were written.

        Raises:
            CapacityError: there is less room.
        """
        written = ffi.new("uint64_t *")
        room = ffi.from_buffer("char[]", buffer, require_writable=True)
        self._call(lib.pbmpm_snapshot_save, room, len(room), written)
        return int(written[0])

    def restore(self, snapshot: bytes | bytearray | memoryview, *, keep_parameters: bool = False) -> None:
        """Puts the world back into the state of a snapshot: its own, or that of a world that was made by the same calls.
        Views expire, and the settings are the snapshot's.

        Materials, colliders, emitters, drains and forces are found by their `key`, or by their place where they have none.

        Args:
            snapshot: from `save()`.
            keep_parameters: for saves of before a patch. Settings, kill bounds, materials (not their density), obstacles, and
                what emitters, drains and forces are defined by stay the world's; poses and counts are the snapshot's. Things
                that only one of both has are left as they are.

        Raises:
            DamagedError: it is truncated, a byte has changed, or it is no snapshot.
            ForeignError: dimension, cell size, domain, materials or obstacles are other ones, or the format is of
                another version.
            CapacityError: it has more particles than there is room for.
        """
        data = ffi.from_buffer("char[]", snapshot)
        flags = ffi.integer_const("PBMPM_RESTORE_KEEP_PARAMETERS") if keep_parameters else 0
        self._call(lib.pbmpm_snapshot_restore, data, len(data), flags)
