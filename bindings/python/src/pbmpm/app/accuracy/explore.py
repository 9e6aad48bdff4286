"""Looks for the settings that are worth their time, by a local search along the fronts of error against cost.

A case's own sweep is measured first. Then, for each solver by itself, the neighbours of those settings are tried that no
other of its settings beats in both cost and error, as long as there is time (Pareto local search: L. Paquete, M. Chiarandini
and T. Stuetzle, "Pareto local optimum sets in the biobjective traveling salesman problem", 2004). Neighbours have the
next rate or number of iterations of a ladder, or another option that the case's sweep tries. Solvers get equal shares of
the time, whether they are ours or what ours are compared with.
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
from ..report.verdict import DECADE, good_error
from .case import Case, Setting, parse_variant

ITERATIONS = (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200)
_EXPLICIT_STEP = 2.0 ** (1.0 / 3.0)  # between rates of the explicit solver: its cost is all that they change
_SOUND_STEP = 2.0
_SOUNDS = (2.5, 100.0)  # beyond: a liquid that is none, a modulus that changes nothing any more
_LONGEST_SHARE = 0.25  # of a case's time that one setting may take; those of the case's own sweep may take it all


@dataclass(frozen=True)
class LeftOut:
    """A setting that would have taken too long."""

    setting: Setting
    seconds: float
    """Predicted for the measurement, from another one of the same solver."""

    own: bool = False
    """Whether it is on the case's own grid and of its own sweep: without it, what its solver reaches is not known."""

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
    """Processor time for the search."""
    rows: dict[Setting, dict[str, Any]] = field(default_factory=dict)
    left_out: dict[Setting, LeftOut] = field(default_factory=dict)
    _spent: dict[Setting, float] = field(default_factory=dict)
    _points: dict[str, dict[Setting, Point]] = field(default_factory=dict)
    """Stable settings on the own grid, by solver."""
    _around: dict[Setting, list[Setting]] = field(default_factory=dict)
    """Neighbours."""
    _variants: dict[str, list[str]] = field(default_factory=dict)

    def run(self) -> None:
        """Measures the case's sweep on its own grid, then around the fronts, then the other grids."""
        own = self.case.sweep(False)
        for setting in sorted(own, key=lambda item: item.work):
            if setting.cells == self.case.own_cells:
                self._try(setting, 1.0)
        self._variants = {
            solver: list(dict.fromkeys(item.variant for item in own if item.solver == solver))
            for solver in dict.fromkeys(item.solver for item in own)
        }
        self._search()
        for setting in own:
            if setting.cells != self.case.own_cells:
                self._try(setting)

    def _search(self) -> None:
        while True:
            # The solver that has had the least time goes next.
            for solver in sorted(self._variants, key=self._spent_on):
                following = next(self._candidates(solver), None)
                if following is not None and self._spent_on(solver) < self.seconds / len(self._variants):
                    self._try(following)
                    break
            else:
                return

    def worthwhile(self) -> list[Setting]:
        """The settings on the fronts of the solvers, as far as their errors matter for the verdict."""
        return [setting for solver in self._variants for setting in self._front(solver)]

    def affordable(self, setting: Setting | None, share: float = _LONGEST_SHARE) -> bool:
        """Whether measuring a setting takes no more than this share of the case's time."""
        return setting is not None and self._expected_seconds(setting) <= share * self.seconds

    def _try(self, setting: Setting, share: float = _LONGEST_SHARE) -> None:
        if not self.affordable(setting, share):
            own = share == 1.0
            self.left_out[setting] = LeftOut(setting, self._expected_seconds(setting), own)
            return
        begin = time.process_time()
        row = self.rows[setting] = self.measure(setting)
        self._spent[setting] = time.process_time() - begin
        if setting.cells == self.case.own_cells and counts(row):
            self._points.setdefault(setting.solver, {})[setting] = point_of(row)

    def _spent_on(self, solver: str) -> float:
        return sum(seconds for setting, seconds in self._spent.items() if setting.solver == solver)

    def _expected_seconds(self, setting: Setting) -> float:
        """What measuring a setting will take, judged by the one of the same solver and grid with the most similar work;
        0 when there is none."""

        def unlike(item: Setting) -> float:
            return abs(math.log(item.work / setting.work))

        like = [item for item in self._spent if (item.solver, item.cells) == (setting.solver, setting.cells)]
        if not like:
            return 0.0
        nearest = min(like, key=unlike)
        return self._spent[nearest] * setting.work / nearest.work

    def _front(self, solver: str) -> list[Setting]:
        """Of one solver on the case's own grid, from somewhat above the error that is called good to the least that the
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
