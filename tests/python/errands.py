"""Work for test_workers.py, in a module that processes which are started anew find."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path


class Unpicklable(Exception):
    """An error that cannot be made again from its message."""

    def __init__(self, one: str, two: str) -> None:
        super().__init__(f"{one} {two}")


def double(number: int) -> int:
    """Also prints, as runs may."""
    print("a run talks")
    return 2 * number


def die_at_three(number: int) -> int:
    if number == 3:
        os._exit(9)
    return 2 * number


def die_once(mark: str) -> str:
    """Dies, and when it is tried again does not."""
    if not Path(mark).exists():
        Path(mark).touch()
        os._exit(9)
    return "done"


def note_and_die(notes: str) -> None:
    with Path(notes).open("a", encoding="utf-8") as file:
        file.write("tried\n")
    os._exit(9)


def fail(kind: str) -> None:
    raise ValueError("plain") if kind == "plain" else Unpicklable("very", "odd")


def process(_: object) -> int:
    return os.getpid()


def sleep(mark: str) -> None:
    """Longer than a test waits; says that it has begun, and by which process."""
    Path(mark).write_text(str(os.getpid()), encoding="utf-8")
    time.sleep(600.0)


@dataclass(frozen=True)
class Placed:
    """Where and when a run ran."""

    processors: set[int]
    begin: float
    end: float


def core(seconds: float) -> Placed:
    """What a run may use that takes so long."""
    begin = time.monotonic()
    time.sleep(seconds)
    return Placed(os.sched_getaffinity(0), begin, time.monotonic())
