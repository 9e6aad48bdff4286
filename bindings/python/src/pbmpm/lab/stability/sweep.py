"""Runs the cases of a map in processes of their own, so that one that dies takes nothing with it."""

from __future__ import annotations

import math
import multiprocessing
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool

import pbmpm

from .cases import Check, Outcome, find_case
from ..progress import progress_bar
from .plan import Run


def run_one(run: Run) -> Outcome:
    """One run; an error of the library is an outcome too, as a check that failed."""
    case, start = find_case(run.case), time.perf_counter()
    try:
        return case.run(run.setting)
    except pbmpm.PbmpmError as error:
        return _failed(run, f"{type(error).__name__}: {error}", time.perf_counter() - start)


def _failed(run: Run, what: str, seconds: float) -> Outcome:
    check = Check(what, math.nan, 0.0)
    return find_case(run.case).outcome(run.setting, (check,), seconds)


def sweep(runs: Sequence[Run], processes: int, told: Callable[[Outcome], None] = lambda _: None) -> list[Outcome]:
    """The outcomes in the order of the runs; `told` gets each as soon as it is there. Costly runs begin first, so that all
    processes end at the same time."""
    order = sorted(range(len(runs)), key=lambda index: -runs[index].work)
    outcomes: dict[int, Outcome] = {}
    with progress_bar(len(runs), "run", "stability") as bar:
        for index, outcome in _outcomes(runs, order, processes):
            outcomes[index] = outcome
            told(outcome)
            bar.set_postfix_str(f"{sum(not item.passed for item in outcomes.values())} failed", refresh=False)
            bar.update()
    return [outcomes[index] for index in range(len(runs))]


def _outcomes(runs: Sequence[Run], order: list[int], processes: int) -> Iterator[tuple[int, Outcome]]:
    if processes == 1 or len(runs) == 1:
        for index in order:
            yield index, run_one(runs[index])
        return
    lost: list[int] = []
    with _pool(processes) as pool:
        futures = {pool.submit(run_one, runs[index]): index for index in order}
        try:
            for future in as_completed(futures):
                outcome = _result(future)
                if outcome is None:
                    lost.append(futures[future])
                else:
                    yield futures[future], outcome
        except BaseException:
            # Leaving the block waits for all runs that are queued or under way.
            pool.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()
            raise
    # A process that died took the pool and all waiting runs with it. Each of them gets a process for itself: the ones
    # that kill it are found, the others are done.
    for index in lost:
        with _pool(1) as pool:
            outcome = _result(pool.submit(run_one, runs[index]))
        yield index, outcome or _failed(runs[index], "the process died", 0.0)


def _result(future: Future[Outcome]) -> Outcome | None:
    try:
        return future.result()
    except BrokenProcessPool:
        return None


def _pool(processes: int) -> ProcessPoolExecutor:
    # Not forked: the library's threads do not survive a fork.
    return ProcessPoolExecutor(
        processes, mp_context=multiprocessing.get_context("spawn"), initializer=_leave_interrupts_to_the_parent
    )


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
