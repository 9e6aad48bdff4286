"""A case and what is wanted of it: all of it is measured in one place, so that the costs of its solvers compare."""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import InputError
from .registry import find_cases
from .sweep import CaseReport, Choice, Sweep


@dataclass(frozen=True)
class Task:
    """One case to measure."""

    case: str
    choice: Choice
    seconds: float
    """For the search on a grid."""
    converged: bool
    """Whether converged solutions are computed, too."""


def measure_case(task: Task) -> CaseReport:
    """Searches, or measures the settings that were chosen; InputError when none is left."""
    (case,) = find_cases([task.case])
    sweep = Sweep(task.converged)
    if case.searched and task.choice.open:
        return sweep.search(case, task.seconds, task.choice.grids(case))
    settings = task.choice.settings(case)
    if not settings:
        raise InputError(f"{case.name}: no setting is left to measure")
    return sweep.run(case, settings)
