"""The workers that a command was given, and how runs get to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from typing import Any

from .attempt import Children, Terms
from .cluster import Cluster
from .facts import own_facts


@dataclass(frozen=True)
class Workers:
    """Who carries out runs."""

    processes: int = 1
    """Of this machine; 1: the calling process."""
    scheduler: str | None = None
    """Address of a Dask scheduler, whose workers take their place."""
    timed: bool = False
    """Whether times of runs count: then each has a core for itself, and all workers have the same CPU."""

    @property
    def several(self) -> bool:
        """Whether runs leave the calling process."""
        return self.scheduler is not None or self.processes > 1

    def carry_out(
        self,
        work: Callable[[Any], Any],
        items: Sequence[Any],
        told: Callable[[int, Any], None],
        order: Sequence[int] | None = None,
    ) -> None:
        """Does ``work(item)`` for each item, those first in the order first, and tells its index and the result as they come: Lost
        where its process died each time. ``work`` is a function of a module, which workers have too; items and results are
        pickled."""
        order = range(len(items)) if order is None else order
        if self.scheduler is not None:
            with Cluster(self.scheduler) as cluster:
                cluster.carry_out(work, items, told, order, Terms(self.timed, cluster.facts(self.timed)))
        elif self.processes > 1:
            self._carry_out_here(work, items, told, order)
        else:
            for index in order:
                told(index, work(items[index]))

    def _carry_out_here(
        self, work: Callable[[Any], Any], items: Sequence[Any], told: Callable[[int, Any], None], order: Sequence[int]
    ) -> None:
        children, terms = Children(), Terms(self.timed, own_facts())
        pool = ThreadPoolExecutor(self.processes)  # each thread waits for a process
        try:
            futures = {pool.submit(children.attempt, work, items[index], terms): index for index in order}
            for future in as_completed(futures):
                told(futures[future], future.result())
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            children.close()
