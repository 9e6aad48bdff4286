"""How many times cheaper the accelerated solvers are at equal error, computed from the rows of a sweep.

Accelerated are the dual and the primal solver. One rule for all cases:

- Each grid is judged by itself: on a coarser one everything is cheaper, and how fine a grid has to be is another
  question. What a solver costs at an error depends on the grid, so a verdict is about the grid that it names.
- Errors that count lie within a decade: from the one that the case calls good (GOOD where it names none) down to a tenth
  of it, or to what the grid and the time step leave to a converged solution, whichever is higher: that is the floor. Cheap
  answers that are worse than good are no answers. An error below the floor counts as the floor: it is luck, a figure that
  passes through the truth on its way to another value. Where the accelerated solvers do not get down to the floor, the
  ratios are taken as far down as they get.
- A solver that was not searched to the end, and does not get to an error, costs there at least what its best setting does.
- At LEVELS errors, evenly in logarithms, the cost of each solver is read from its own front, and the ratios of the other's
  cost to that of the accelerated solvers are taken; the other's is infinite where it does not get so far. The verdict is
  about the median of these ratios; the lowest and highest are told beside it.
- The front over all solvers must hold accelerated ones alone, among the errors that count.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from .pareto import Point, cost_of, front_of

ACCELERATED = ("dual", "primal")
#: How many times dearer each solver has to be at equal error.
WANTED = {"paper": 3.0, "explicit": 10.0}
NOT_REACHED = "not reached"
GOOD = 0.05  #: where a case does not say which error it calls good
DECADE = 10.0
LEVELS = 21
_SHOWN_LEVELS = 6  # at most, in the table of costs
_ROUND = (1.0, 2.0, 5.0)


def good_error(tolerance: float | None) -> float:
    """The error that counts as good."""
    return tolerance or GOOD


@dataclass(frozen=True)
class Comparison:
    """The accelerated solvers against one other."""

    other: str
    wanted: float  #: times cheaper
    measured: bool  #: whether the sweep holds the other solver, and enough of it to compare
    best_error: float | None = None  #: that the other reaches; None when none of its settings is stable
    ratios: tuple[float, ...] = ()  #: its cost over that of the accelerated, from the largest error down; may be infinite
    at_least: bool = False  #: whether ratios are bounds from below, where a search had to end before it got so far

    @property
    def median(self) -> float | None:
        """The typical ratio; infinite when the other does not reach most of the errors; None when nothing was compared."""
        return sorted(self.ratios)[len(self.ratios) // 2] if self.ratios else None

    @property
    def reached(self) -> bool:
        """Whether the accelerated solvers are typically as many times cheaper as wanted."""
        return self.median is not None and self.median >= self.wanted

    @property
    def always(self) -> bool:
        """Whether they are so at every error."""
        return bool(self.ratios) and min(self.ratios) >= self.wanted


@dataclass(frozen=True)
class Level:
    """What one error costs each solver [ms]; None: not reached."""

    error: float
    costs: dict[str, float | None]


@dataclass(frozen=True)
class Verdict:
    """What a case says about the solvers."""

    front: tuple[Point, ...]  #: over all solvers
    counted: tuple[Point, ...]  #: the front of the errors that count, those below the floor raised to it
    best_error: float | None  #: of the accelerated solvers; None when none of their settings is stable
    highest: float  #: error that counts
    lowest: float | None  #: error that counts; None without a stable accelerated setting
    too_coarse: bool  #: whether even converged solutions are not good: an error that is, is luck
    comparisons: tuple[Comparison, ...]
    levels: tuple[Level, ...]

    @property
    def solvers_on_front(self) -> tuple[str, ...]:
        """Among the errors that count, in the order of their first point."""
        return tuple(dict.fromkeys(point.solver for point in self.counted))

    @property
    def alone_on_front(self) -> bool:
        """Whether only accelerated solvers are there."""
        return bool(self.solvers_on_front) and all(name in ACCELERATED for name in self.solvers_on_front)

    @property
    def good_reached(self) -> bool:
        """Whether the accelerated solvers reach the error that is called good."""
        return self.best_error is not None and self.best_error <= self.highest

    @property
    def passed(self) -> bool:
        """A good error reached and not by luck, alone on the front, and typically as many times cheaper as wanted."""
        meant = self.good_reached and not self.too_coarse
        return meant and self.alone_on_front and all(item.reached for item in self.comparisons)

    @property
    def always(self) -> bool:
        """The same, and as many times cheaper at every error that counts."""
        return self.passed and all(item.always for item in self.comparisons)


def judge(
    measured: Sequence[Point],
    solvers: Sequence[str],
    good: float | None = None,
    converged: float | None = None,
    cut_short: Collection[str] = (),
) -> Verdict:
    """The verdict over the stable points of a case.

    Args:
        measured: all on the same grid.
        solvers: all that were tried, stable or not.
        good: the error that the case calls good; None when it calls none so.
        converged: the least error that converged solutions of the accelerated solvers have; None when it is not known.
        cut_short: solvers whose search had to end for want of time. What they do not reach they may still reach, but not
            for less than their best setting costs, as far as anybody knows: the ratio is at least that.
    """
    highest = good_error(good)
    floor = min(max(highest / DECADE, converged or 0.0), highest)
    accelerated = front_of(point for point in measured if point.solver in ACCELERATED)
    best = accelerated[-1].error if accelerated else None
    errors = _errors_that_count(highest, floor, best)
    fronts = {name: front_of(point for point in measured if point.solver == name) for name in solvers}
    counted = front_of(replace(point, error=max(point.error, floor)) for point in measured)
    return Verdict(
        front=tuple(front_of(measured)),
        counted=tuple(point for point in counted if point.error <= highest),
        best_error=best,
        highest=highest,
        lowest=errors[-1] if errors else None,
        too_coarse=converged is not None and converged > highest,
        comparisons=tuple(_compare(accelerated, other, fronts.get(other), errors, other in cut_short) for other in WANTED),
        levels=tuple(
            Level(error, {name: cost_of(front, error) for name, front in fronts.items()})
            for error in round_levels([point.error for point in front_of(measured)])
        ),
    )


def _errors_that_count(highest: float, floor: float, best: float | None) -> list[float]:
    """From the largest down to the floor or the best of the accelerated solvers; that alone, where it is not a good one."""
    if best is None:
        return []
    if best >= highest:
        return [best]
    lowest = max(best, floor)
    return [max(highest * (lowest / highest) ** (step / (LEVELS - 1)), lowest) for step in range(LEVELS)]


def _compare(
    accelerated: list[Point], other: str, front: list[Point] | None, errors: list[float], cut_short: bool
) -> Comparison:
    ratios, bounded = [], False
    for error in errors if front is not None else []:
        own, others = cost_of(accelerated, error), cost_of(front or [], error)
        if own is None:
            continue
        if others is None and cut_short:
            others, bounded = front[-1].cost if front else None, True
        if others is not None or not cut_short:
            ratios.append(math.inf if others is None else others / own)
    measured = front is not None and not (cut_short and errors and not ratios)
    return Comparison(other, WANTED[other], measured, front[-1].error if front else None, tuple(ratios), bounded)


def round_levels(errors: Sequence[float]) -> list[float]:
    """Round errors (1, 2, 5 times powers of ten) in the range of a front, largest first, thinned out to a handful."""
    if not errors:
        return []
    low, high = min(errors), max(errors)
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    inside = [step * 10.0**decade for decade in decades for step in _ROUND if low <= step * 10.0**decade <= high]
    thinning = math.ceil(len(inside) / _SHOWN_LEVELS) or 1
    return sorted(inside[::thinning], reverse=True) or [high]
