"""Runs the cases of a map."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Any

import pbmpm

from .cases import Check, Outcome, find_case
from ..progress import progress_bar
from ..workers.attempt import Lost
from ..workers.workers import Workers
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


def sweep(runs: Sequence[Run], workers: Workers, told: Callable[[Outcome], None] = lambda _: None) -> list[Outcome]:
    """The outcomes in the order of the runs; `told` gets each as soon as it is there. Costly runs begin first, so that all
    workers end at the same time."""
    order = sorted(range(len(runs)), key=lambda index: -runs[index].work)
    outcomes: dict[int, Outcome] = {}
    with progress_bar(len(runs), "run", "stability") as bar:

        def note(index: int, result: Any) -> None:
            outcome = _failed(runs[index], result.reason, 0.0) if isinstance(result, Lost) else result
            outcomes[index] = outcome
            told(outcome)
            bar.set_postfix_str(f"{sum(not item.passed for item in outcomes.values())} failed", refresh=False)
            bar.update()

        workers.carry_out(run_one, runs, note, order)
    return [outcomes[index] for index in range(len(runs))]
