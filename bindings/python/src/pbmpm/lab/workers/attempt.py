"""One run in a process of its own, on this machine or on a worker of a cluster."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import InputError
from .child import Child, ChildDied
from .cores import own_core
from .facts import differences, own_facts

TRIES = 2
"""A run whose process died may have been killed from outside: it is tried again. If it dies again, it is given up."""


@dataclass(frozen=True)
class Lost:
    """In place of a result: why there is none."""

    reason: str


@dataclass(frozen=True)
class Terms:
    """On which runs are carried out."""

    timed: bool
    """Each has a core for itself."""
    facts: dict[str, str]
    """What a worker has to have, of `facts.own_facts`."""


class Children:
    """A process for each thread that asks for one. They outlive their runs, and end with `close` or with this process."""

    def __init__(self) -> None:
        self._own = _Own()
        self._all: set[Child] = set()
        self._closed = False

    def attempt(self, work: Callable[[Any], Any], item: Any, terms: Terms) -> Any:
        """``work(item)`` in the process of the calling thread; Lost when it dies each time. InputError when it is not on these
        terms."""
        for _ in range(TRIES):
            try:
                return self._fitting(terms).do(_on_own_core if terms.timed else _plainly, (work, item))
            except ChildDied:
                self._drop()
                if self._closed:
                    break
        return Lost("the process died")

    def close(self) -> None:
        """Ends the processes; what they run is lost."""
        self._closed = True
        for child in list(self._all):
            child.end()

    def _fitting(self, terms: Terms) -> Child:
        """The thread's process: a new one where it has none, or one of before the library was changed."""
        if self._own.child is None or differences(self._own.facts, terms.facts):
            self._drop()
            self._start()
        wrong = differences(self._own.facts, terms.facts)
        if wrong:
            raise InputError(f"the worker on {socket.gethostname()} would give other rows: {wrong}")
        assert self._own.child is not None
        return self._own.child

    def _start(self) -> None:
        self._own.child = child = Child()
        self._all.add(child)
        if self._closed:
            child.end()
        try:
            self._own.facts = child.do(_facts, None)
        except ChildDied:
            if not self._closed:
                raise InputError(f"{socket.gethostname()}: the process for runs does not start") from None
            raise

    def _drop(self) -> None:
        if self._own.child is not None:
            self._own.child.end()
            self._all.discard(self._own.child)
        self._own.child = None


class _Own(threading.local):
    child: Child | None = None
    facts: dict[str, str] = {}


def _plainly(task: tuple[Callable[[Any], Any], Any]) -> Any:
    work, item = task
    return work(item)


def _on_own_core(task: tuple[Callable[[Any], Any], Any]) -> Any:
    with own_core():
        return _plainly(task)


def _facts(_: None) -> dict[str, str]:
    return own_facts()
