"""Runs on the workers of a Dask cluster. Each worker gives them to processes of its own, as this machine does, so that a crash of
a run ends no worker; Dask runs again what was on a worker that is lost."""

from __future__ import annotations

import importlib
import logging
import time
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError
from typing import Any

from ..errors import InputError
from ..machine import cpu_model
from .attempt import Children, Lost, Terms
from .facts import own_facts

ANSWER_SECONDS = 30
"""In which a scheduler has to answer, and a worker to be there."""
LOOK_SECONDS = 0.05


class Cluster:
    """The workers of a scheduler. Use it as a context manager."""

    def __init__(self, address: str) -> None:
        """InputError where Dask is missing, nobody answers or there is no worker."""
        try:
            import distributed
        except ImportError:
            raise InputError("--scheduler needs Dask: pip install 'pbmpm[cluster]'") from None
        self._dask, self._address = distributed, address
        logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what matters of it is said by exceptions
        try:
            self._client = distributed.Client(address, timeout=ANSWER_SECONDS, set_as_default=False)
        except (OSError, ValueError) as problem:
            raise InputError(f"no Dask scheduler answers at {address}: {problem}") from None
        try:
            self._need_worker()
            self._need_package()
        except BaseException:
            self._client.close()
            raise

    def _need_worker(self) -> None:
        try:
            self._client.wait_for_workers(1, timeout=ANSWER_SECONDS)
        except self._dask.TimeoutError:
            raise InputError(f"the scheduler at {self._address} has no worker") from None

    def _need_package(self) -> None:
        """Dask would only say that it cannot read what it is sent."""
        try:
            self._client.run_on_scheduler(importlib.import_module, __name__)
            self._client.run(importlib.import_module, __name__)
        except ImportError as problem:
            raise InputError(f"the scheduler or a worker has not this pbmpm: {problem}") from None

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()

    def facts(self, timed: bool) -> dict[str, str]:
        """What all workers must have: what this process has. Where times count also the CPU of one of them, which may be
        another than here."""
        facts = {name: fact for name, fact in own_facts().items() if name != "CPU"}
        return {**facts, "CPU": self._result(self._client.submit(cpu_model, pure=False))} if timed else facts

    def carry_out(
        self, work: Callable[[Any], Any], items: Sequence[Any], told: Callable[[int, Any], None], order: Sequence[int], terms: Terms
    ) -> None:
        """Tells the index and the result of each item as they come; those first in the order begin first."""
        futures = {
            self._client.submit(_attempt, work, items[index], terms, pure=False, priority=-place): index
            for place, index in enumerate(order)
        }
        done = self._dask.as_completed(list(futures), loop=self._client.loop)
        while futures:
            self._wait(done)
            for future in done.next_batch(block=False):
                told(futures.pop(future), self._result(future))
                future.release()

    def _wait(self, done: Any) -> None:
        """Until a run is done; InputError when no worker is left."""
        looked = time.monotonic()
        while not done.has_ready():
            time.sleep(LOOK_SECONDS)
            if time.monotonic() - looked > ANSWER_SECONDS:
                self._need_worker()
                looked = time.monotonic()

    def _result(self, future: Any) -> Any:
        try:
            return future.result()
        except self._dask.KilledWorker as problem:
            return Lost(f"each worker that tried it was lost: {problem}")
        except CancelledError:
            raise InputError(f"the scheduler at {self._address} is gone") from None


_children = Children()
"""Of a worker of the cluster."""


def _attempt(work: Callable[[Any], Any], item: Any, terms: Terms) -> Any:
    return _children.attempt(work, item, terms)
