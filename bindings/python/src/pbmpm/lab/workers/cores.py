"""A core for a timed run alone."""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LOOK_AGAIN_SECONDS = 0.05



@contextmanager
def own_core() -> Iterator[None]:
    """Keeps the calling thread on a core that no other timed run of this machine has, and waits until there is one. Does nothing
    where the system binds no thread to a core: there the number of processes is all that keeps them apart."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    processor, hold = _take(allowed)
    try:
        os.sched_setaffinity(0, {processor})
        yield
    finally:
        os.sched_setaffinity(0, allowed)
        hold.close()


def _take(allowed: set[int]) -> tuple[int, socket.socket]:
    """A processor, and what is to be closed when it is no longer needed."""
    processors = _one_of_each_core(allowed)
    while True:
        for processor in processors:
            # A name that only one socket can have, and that is free again when its process ends, however it ends.
            hold = socket.socket(socket.AF_UNIX)
            try:
                hold.bind(f"\0pbmpm-core-{processor}")
            except OSError:
                hold.close()
            else:
                return processor, hold
        time.sleep(LOOK_AGAIN_SECONDS)


def _one_of_each_core(processors: set[int]) -> list[int]:
    """One of the processors that share a core: two runs on one core would slow each other down."""
    return sorted({min(_siblings(processor) & processors) for processor in processors})


def _siblings(processor: int) -> set[int]:
    path = Path(f"/sys/devices/system/cpu/cpu{processor}/topology/thread_siblings_list")
    try:
        spans = [part.split("-") for part in path.read_text(encoding="ascii").strip().split(",")]
        return {processor}.union(*(range(int(span[0]), int(span[-1]) + 1) for span in spans))
    except (OSError, ValueError):
        return {processor}
