"""How many times cheaper the accelerated solvers are at equal error, computed from the rows of a sweep.

Accelerated are the dual and the primal solver. Each case gives one comparison per solver to compare with, at one error:
the one that the case calls good, if the accelerated solvers reach it, and else the lowest that both reach.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .pareto import Point, cost_of, front_of

ACCELERATED = ("dual", "primal")
#: How many times dearer each solver has to be at equal error.
WANTED = {"paper": 3.0, "explicit": 10.0}
NOT_REACHED = "not reached"
_LEVELS = 6  # at most, in the table of costs
_ROUND = (1.0, 2.0, 5.0)


@dataclass(frozen=True)
class Comparison:
    """The accelerated solvers against one other."""

    other: str
    wanted: float  #: times cheaper
    measured: bool  #: whether the sweep holds the other solver at all
    best_error: float | None = None  #: that the other reaches; None when none of its settings is stable
    level: float | None = None  #: the error at which they are compared
    cost: float | None = None  #: of the accelerated there [ms]
    other_cost: float | None = None  #: None: not reached
    lowest_ratio: float | None = None  #: over all errors that both reach
    highest_ratio: float | None = None

    @property
    def ratio(self) -> float | None:
        """How many times cheaper the accelerated solvers are at the level."""
        return None if self.cost is None or self.other_cost is None else self.other_cost / self.cost

    @property
    def reached(self) -> bool:
        """Whether the wanted ratio is reached; also when the other solver never gets to that error."""
        if not self.measured or self.cost is None:
            return False
        return self.ratio is None or self.ratio >= self.wanted


@dataclass(frozen=True)
class Level:
    """What one error costs each solver [ms]; None: not reached."""

    error: float
    costs: dict[str, float | None]


@dataclass(frozen=True)
class Verdict:
    """What a case says about the solvers."""

    front: tuple[Point, ...]  #: over all solvers
    best_error: float | None  #: of the accelerated solvers; None when none of their settings is stable
    comparisons: tuple[Comparison, ...]
    levels: tuple[Level, ...]

    @property
    def solvers_on_front(self) -> tuple[str, ...]:
        """In the order of their first point."""
        return tuple(dict.fromkeys(point.solver for point in self.front))

    @property
    def alone_on_front(self) -> bool:
        """Whether only accelerated solvers are on the front."""
        return bool(self.front) and all(point.solver in ACCELERATED for point in self.front)

    @property
    def passed(self) -> bool:
        """Alone on the front, and as many times cheaper as wanted."""
        return self.alone_on_front and all(comparison.reached for comparison in self.comparisons)


def judge(points: Sequence[Point], solvers: Sequence[str], good: float | None = None) -> Verdict:
    """The verdict over the stable points of a case.

    Args:
        points: what was measured.
        solvers: all that were tried, stable or not.
        good: the error that the case calls good; None when it calls none so.
    """
    accelerated = front_of(point for point in points if point.solver in ACCELERATED)
    fronts = {name: front_of(point for point in points if point.solver == name) for name in solvers}
    return Verdict(
        front=tuple(front_of(points)),
        best_error=accelerated[-1].error if accelerated else None,
        comparisons=tuple(_compare(accelerated, other, fronts.get(other), good) for other in WANTED),
        levels=tuple(
            Level(error, {name: cost_of(front, error) for name, front in fronts.items()})
            for error in round_levels([point.error for point in front_of(points)])
        ),
    )


def _compare(accelerated: list[Point], other: str, front: list[Point] | None, good: float | None) -> Comparison:
    measured, best = front is not None, front[-1].error if front else None
    if not accelerated or not measured:
        return Comparison(other, WANTED[other], measured, best)
    reachable = accelerated[-1].error
    shared = reachable if best is None else max(best, reachable)
    level = good if good is not None and good >= reachable else shared
    ratios = [
        ratio
        for error in _corners(accelerated, front or [], shared)
        if (ratio := _ratio(accelerated, front or [], error)) is not None
    ]
    return Comparison(
        other,
        WANTED[other],
        measured,
        best,
        level,
        cost=cost_of(accelerated, level),
        other_cost=cost_of(front or [], level),
        lowest_ratio=min(ratios, default=None),
        highest_ratio=max(ratios, default=None),
    )


def _corners(one: list[Point], two: list[Point], lowest: float) -> set[float]:
    """Errors at which the ratio of two costs can be extreme: it is monotonous between the corners of the fronts."""
    return {lowest, *(point.error for point in (*one, *two) if point.error >= lowest)}


def _ratio(accelerated: list[Point], front: list[Point], error: float) -> float | None:
    cost, other = cost_of(accelerated, error), cost_of(front, error)
    return None if cost is None or other is None else other / cost


def round_levels(errors: Sequence[float]) -> list[float]:
    """Round errors (1, 2, 5 times powers of ten) in the range of a front, largest first, thinned out to a handful."""
    if not errors:
        return []
    low, high = min(errors), max(errors)
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    inside = [step * 10.0**decade for decade in decades for step in _ROUND if low <= step * 10.0**decade <= high]
    thinning = math.ceil(len(inside) / _LEVELS) or 1
    return sorted(inside[::thinning], reverse=True) or [high]
