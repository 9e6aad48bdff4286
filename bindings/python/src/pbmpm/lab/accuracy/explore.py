"""Looks for the settings that are worth their time, by a local search along the fronts of error against cost.

A case's own sweep is measured first. Then, for each solver by itself, the neighbours of those settings are tried that no
other of its settings beats in both cost and error, as long as there is time (Pareto local search: L. Paquete, M. Chiarandini
and T. Stuetzle, "Pareto local optimum sets in the biobjective traveling salesman problem", 2004). Neighbours have the
next rate or number of iterations of a ladder, or another option that the case's sweep tries. Solvers get equal shares of
the time, whether they are ours or what ours are compared with; where the search begins costs some of them far more than
others, so it is not taken from the share.
"""

from __future__ import annotations

import math
import time
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import Any

from ..report.pareto import Point, front_of
from ..report.rows import point_of
from ..report.verdict import ACCELERATED, DECADE, good_error
from .case import Case, Setting, parse_variant

ITERATIONS = (1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200)
_EXPLICIT_STEP = 2.0 ** (1.0 / 3.0)  # between rates of the explicit solver: its cost is all that they change
_SOUND_STEP = 2.0
_SOUNDS = (2.5, 100.0)  # beyond: a liquid that is none, a modulus that changes nothing any more
_LONGEST_SHARE = 0.25  # of the time that one setting may take; those with which the search begins may take it all
REFERENCE_SHARE = 0.5  # that a converged solution may take: without that of the finest time steps the floor of the errors is that of coarse ones
REFERENCES_SHARE = 1.0  # that all converged solutions of a grid may take


@dataclass(frozen=True)
class LeftOut:
    """A setting that would have taken too long."""

    setting: Setting
    seconds: float
    """Predicted for the measurement, from another one of the same solver."""

    def text(self) -> str:
        """For people."""
        return f"{self.setting.text()}: would take {self.seconds:.0f} s to measure"


@dataclass
class Explorer:
    """The search over one case's settings."""

    case: Case
    measure: Callable[[Setting], dict[str, Any]]
    """Measures a setting and gives its row."""
    seconds: float
    """Processor time for the search around the fronts, after that for the settings with which it begins."""
    cells: int
    """The grid that is searched."""
    rows: dict[Setting, dict[str, Any]] = field(default_factory=dict)
    left_out: dict[Setting, LeftOut] = field(default_factory=dict)
    spent: dict[Setting, float] = field(default_factory=dict)
    """Processor time that measuring each took [s]."""
    _begun: set[Setting] = field(default_factory=set)
    """With which the search began."""
    _points: dict[str, dict[Setting, Point]] = field(default_factory=dict)
    """Stable settings, by solver."""
    _around: dict[Setting, list[Setting]] = field(default_factory=dict)
    """Neighbours."""
    _variants: dict[str, list[str]] = field(default_factory=dict)

    def run(self) -> None:
        """Measures where the case says that the search begins, then around the fronts. Of the own grid all settings are
        measured as long as there is time; on others those of the accelerated solvers must leave some for the search, which
        finds their further variants as neighbours."""
        start = self.case.start(self.cells)
        own_grid = self.cells == self.case.own_cells
        self._variants = {
            solver: list(dict.fromkeys(item.variant for item in start if item.solver == solver))
            for solver in dict.fromkeys(item.solver for item in start)
        }
        for setting in sorted(start, key=lambda item: item.work):
            first = setting.variant == self._variants[setting.solver][0]
            if own_grid or setting.solver not in ACCELERATED or (first and self.affordable(setting)):
                self.attempt(setting, 1.0)
        self._begun = set(self.spent)
        self._search()

    def _search(self) -> None:
        while True:
            # The solver that has had the least time goes next.
            for solver in sorted(self._variants, key=self._searched):
                following = next(self._candidates(solver), None)
                if following is not None and self._searched(solver) < self.seconds / len(self._variants):
                    self.attempt(following)
                    break
            else:
                return

    def cut_short(self) -> list[str]:
        """The solvers that time did not suffice for: settings were left out, or the search had not ended. What they do not
        reach may still be within their reach."""
        left = {setting.solver for setting in self.left_out if setting.cells == self.cells}
        return [name for name in self._variants if name in left or next(self._candidates(name), None) is not None]

    def worthwhile(self) -> list[Setting]:
        """The settings on the fronts of the solvers, as far as their errors matter for the verdict."""
        return [setting for solver in self._variants for setting in self._front(solver)]

    def referenced(self) -> list[Setting]:
        """Whose converged solutions are wanted, the most wanted first: all accelerated settings that are good, the best ones
        before the others, and then what else is worthwhile.

        The verdict's floor is the least error of the converged solutions. Were it only those of the front, a cost that other
        programs have raised could take a setting off it and move the floor; errors do not depend on who else runs.
        """
        good = good_error(self.case.headline.tolerance)
        points = {item: point for name in ACCELERATED for item, point in self._points.get(name, {}).items()}
        found = sorted((item for item in points if points[item].error <= good), key=lambda item: points[item].error)
        return list(dict.fromkeys(found + self.worthwhile()))

    def affordable(self, setting: Setting | None, share: float = _LONGEST_SHARE) -> bool:
        """Whether measuring a setting takes no more than this share of the case's time."""
        return setting is not None and self._expected_seconds(setting) <= share * self.seconds

    def attempt(self, setting: Setting, share: float = _LONGEST_SHARE) -> None:
        """Measures a setting, unless that would take more than this share of the time: then it is left out."""
        if not self.affordable(setting, share):
            self.left_out[setting] = LeftOut(setting, self._expected_seconds(setting))
            return
        begin = time.process_time()
        row = self.rows[setting] = self.measure(setting)
        self.spent[setting] = time.process_time() - begin
        if setting.cells == self.cells and counts(row):
            self._points.setdefault(setting.solver, {})[setting] = point_of(row)

    def _searched(self, solver: str) -> float:
        """Processor time that the search has spent on a solver [s], without where it began."""
        return sum(self.spent[item] for item in self.spent if item.solver == solver and item not in self._begun)

    def _expected_seconds(self, setting: Setting) -> float:
        """What measuring a setting will take, judged by the one of the same solver and grid with the most similar work;
        0 when there is none."""

        def unlike(item: Setting) -> float:
            return abs(math.log(item.work / setting.work))

        like = [item for item in self.spent if (item.solver, item.cells) == (setting.solver, setting.cells)]
        if not like:
            return 0.0
        nearest = min(like, key=unlike)
        return self.spent[nearest] * setting.work / nearest.work

    def _front(self, solver: str) -> list[Setting]:
        """Of one solver on the grid that is searched, from somewhat above the error that is called good to the least that the
        verdict looks at and one below it; when none is that good, the best one."""
        points = self._points.get(solver, {})
        settings = {id(point): setting for setting, point in points.items()}
        front = front_of(points.values())
        good = good_error(self.case.headline.tolerance)
        near = [point for point in front if good / DECADE <= point.error <= 2.0 * good]
        below = [point for point in front if point.error < good / DECADE][:1]
        return [settings[id(point)] for point in near + below or front[-1:]]

    def _candidates(self, solver: str) -> Iterator[Setting]:
        """What has not been tried around the front, a neighbour of each in turn."""
        front = self._front(solver)
        for setting in front:
            if setting not in self._around:
                self._around[setting] = list(self._neighbours(setting))
        around = [self._around[setting] for setting in front]
        for turn in zip_longest(*around):
            for setting in turn:
                if setting is None or setting.rate_hz < self.case.slowest_hz:
                    continue
                if setting not in self.rows and setting not in self.left_out:
                    yield setting

    def _neighbours(self, setting: Setting) -> Iterator[Setting]:
        if setting.solver == "explicit":
            yield from _explicit_neighbours(setting)
            return
        slower, faster = replace(setting, rate_hz=next_rate(setting.rate_hz, False)), replace(
            setting, rate_hz=next_rate(setting.rate_hz, True)
        )
        fewer, more = next_iterations(setting.iterations, False), next_iterations(setting.iterations, True)
        yield slower
        yield replace(setting, iterations=fewer)
        yield replace(faster, iterations=fewer)
        yield replace(slower, iterations=more)
        yield replace(setting, iterations=more)
        yield faster
        for variant in self._variants[setting.solver]:
            plain = replace(setting, integrator="euler", pressure="particles", flip=0.0)
            yield replace(plain, **parse_variant(variant))


def counts(row: dict[str, Any]) -> bool:
    """Whether a row has a place on a front."""
    return bool(row["stable"]) and row["error"] is not None and row["ms_per_simulated_second"] is not None


def next_rate(rate: float, up: bool) -> float:
    """The next of 60 Hz and 90 Hz times powers of two."""
    step = math.floor(math.log2(rate / 60.0))
    ladder = [base * 2.0**power for power in range(step - 2, step + 3) for base in (60.0, 90.0)]
    return ladder[bisect_right(ladder, rate * (1.0 + 1e-9))] if up else ladder[bisect_left(ladder, rate * (1.0 - 1e-9)) - 1]


def next_iterations(count: int, up: bool) -> int:
    """The next on the ladder; the ends stay."""
    place = bisect_right(ITERATIONS, count) if up else bisect_left(ITERATIONS, count) - 1
    return ITERATIONS[min(max(place, 0), len(ITERATIONS) - 1)]


def _explicit_neighbours(setting: Setting) -> Iterator[Setting]:
    """Other rates, and other moduli at the same Courant number."""
    for factor in (1.0 / _EXPLICIT_STEP, _EXPLICIT_STEP):
        yield replace(setting, rate_hz=float(round(setting.rate_hz * factor)))
    for factor in (1.0 / _SOUND_STEP, _SOUND_STEP):
        if setting.sound and _SOUNDS[0] <= setting.sound * factor <= _SOUNDS[1]:
            yield replace(setting, sound=setting.sound * factor, rate_hz=float(round(setting.rate_hz * factor)))
