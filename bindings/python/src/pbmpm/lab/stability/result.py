"""What the runs of a map say: rows, cells and which failures count."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from .cases import Check, Outcome
from .cases.case import EXPLICIT
from .plan import Run


def counts(outcome: Outcome) -> bool:
    """Whether a failure makes the command fail: not where it is expected (the explicit solver) or known with a reason."""
    return not (outcome.passed or outcome.known_failure or outcome.setting.solver == EXPLICIT)


def row_of(outcome: Outcome) -> dict[str, Any]:
    """An outcome as it goes into JSON."""
    setting = outcome.setting
    return {
        "case": outcome.case,
        "solver": setting.solver,
        "material": setting.material,
        "dims": setting.dimension,
        "variant": setting.variant,
        "rate_hz": setting.rate_hz,
        "iterations": setting.iterations,
        "passed": bool(outcome.passed),
        **check_entry(outcome.telling),
        "goals_judged": outcome.judges_goals,
        "goals_reached": not outcome.goals_missed,
        "goals_missed": [check_entry(check) for check in outcome.goals_missed],
        "known_failure": outcome.known_failure,
        "seconds": outcome.seconds,
        "seed": setting.seed,
        "command": Run(outcome.case, setting).command,
    }


def check_entry(check: Check) -> dict[str, Any]:
    """A check as it goes into JSON."""
    return {
        "check": check.name,
        "kind": check.kind.value,
        "figure": float(check.figure),  # some are of numpy's types, which are no JSON
        "limit": float(check.limit),
        "limit_is_lowest": check.at_least,
    }


def report_of(outcomes: Sequence[Outcome], seconds: float) -> dict[str, Any]:
    """A map as it goes into JSON; it took so much wall time."""
    import pbmpm

    from ..machine import machine_facts
    from ..simulation import versions

    return {
        "rows": [row_of(outcome) for outcome in outcomes],
        "wall_seconds": seconds,
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), 1),
    }


@dataclass(frozen=True, order=True)
class LineKey:
    """One line of the map of a case."""

    case: str
    solver_place: int  #: in the order of the selection
    solver: str
    material: str
    dimension: int


@dataclass(frozen=True)
class Cell:
    """All variants of a case at one rate and iteration count."""

    outcomes: tuple[Outcome, ...]

    @property
    def failed(self) -> tuple[Outcome, ...]:
        return tuple(outcome for outcome in self.outcomes if not outcome.passed)

    @property
    def bounds_only(self) -> tuple[Outcome, ...]:
        """Those that passed without their goals, at a setting too coarse for these to count."""
        return tuple(outcome for outcome in self.outcomes if outcome.passed and outcome.goals_missed)

    @property
    def telling(self) -> Outcome:
        """The outcome that decides: a failure that counts, or else another failure, or one without its goals, or else the first."""
        return min(self.outcomes, key=lambda outcome: (not counts(outcome), outcome.passed, not outcome.goals_missed))

    @property
    def mark(self) -> str:
        """One character: passed (.), passed without goals that do not count there (o), failed (x), failed for a known reason (k),
        the explicit solver failed (e)."""
        if not self.failed:
            return "o" if self.bounds_only else "."
        if any(map(counts, self.failed)):
            return "x"
        return "k" if self.telling.known_failure else "e"


Line = dict[tuple[float, int], Cell]


def lines_of(outcomes: Iterable[Outcome], solvers: tuple[str, ...]) -> dict[LineKey, Line]:
    """The map: cells by line, and in it by rate and iterations."""
    collected: dict[LineKey, dict[tuple[float, int], list[Outcome]]] = defaultdict(lambda: defaultdict(list))
    for outcome in outcomes:
        setting = outcome.setting
        key = LineKey(outcome.case, solvers.index(setting.solver), setting.solver, setting.material, setting.dimension)
        collected[key][setting.rate_hz, setting.iterations].append(outcome)
    return {
        key: {place: Cell(tuple(found)) for place, found in sorted(cells.items())}
        for key, cells in sorted(collected.items())
    }
