"""Measures cases at their settings and makes the rows of a report."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pbmpm

from ..machine import machine_facts
from ..progress import progress_bar
from ..simulation import versions
from .case import Case, Measurement, Setting, settings_of
from .explore import REFERENCE_SHARE, REFERENCES_SHARE, Explorer, LeftOut
from ..stability.judge import DEFINITION

TIMINGS = 2
"""Measurements of the settings on a front."""
STEADY_SECONDS = 5.0
"""A measurement that took this long is not repeated."""


@dataclass(frozen=True)
class Choice:
    """What a user wants measured; None: as each case says."""

    quick: bool = False
    variants: list[str] | None = None
    rates: list[float] | None = None
    iterations: list[int] | None = None
    cells: list[int] | None = None
    finest: bool = False
    """Only the finest of the grids on which a case compares solvers."""
    substeps: int = 1
    threads: int = 1

    def grids(self, case: Case) -> tuple[int, ...]:
        """On which to search; empty: as the case has it."""
        if self.cells is not None:
            return tuple(self.cells)
        return (max(case.compared_cells),) if self.finest else ()

    @property
    def open(self) -> bool:
        """Whether rates and iterations are left to the search."""
        return not self.quick and self._plain

    @property
    def _plain(self) -> bool:
        asked = (self.variants, self.rates, self.iterations)
        return all(values is None for values in asked) and (self.substeps, self.threads) == (1, 1)

    def settings(self, case: Case) -> list[Setting]:
        """The case's own sweep, or all combinations of what was asked for with what the sweep holds for the rest."""
        own = case.sweep(self.quick)
        if self._plain and self.cells is None:
            return own
        implicit = [setting for setting in own if setting.solver != "explicit"]
        made = []
        for variant in self.variants or _values(setting.variant for setting in own):
            like = [setting for setting in own if setting.variant == variant] or implicit
            made += settings_of(
                [variant],
                self.rates or _values(setting.rate_hz for setting in like),
                self.iterations or _values(setting.iterations for setting in like),
                self.cells or _values(setting.cells for setting in like),
                substeps=self.substeps,
                threads=self.threads,
            )
        return made


def _values(values: Iterable[Any]) -> list[Any]:
    """Each value once, in the order of its first appearance."""
    return list(dict.fromkeys(values))


@dataclass
class CaseReport:
    """What a sweep of one case gave."""

    case: Case
    settings: list[Setting]
    measurements: list[Measurement]
    rows: list[dict[str, Any]]
    left_out: list[LeftOut] = field(default_factory=list)
    """Settings that would have taken too long."""
    cut_short: list[tuple[int, str]] = field(default_factory=list)
    """Grids and solvers whose search had to end for want of time."""
    grids: tuple[int, ...] = ()
    """On which the solvers are compared [cells]; empty: as the case has it."""
    explored: bool = False
    """Whether each solver was searched for its best settings."""
    machine: dict[str, Any] = field(default_factory=lambda: machine_facts(pbmpm.isa(), 1))
    """Where it was measured."""

    def facts(self) -> dict[str, Any]:
        """What a report says about the case, once."""
        case = self.case
        return {
            "case": case.name,
            "title": case.title,
            "kind": case.kind,
            "dims": case.dimension,
            "truth": case.truth,
            "length": case.length,
            "length_name": case.length_name,
            "notes": case.notes,
            "errors": [vars(measure) for measure in case.error_kinds],
            "searched": case.searched,
            "not_compared": case.not_compared,
            "compared_cells": list(self.grids or case.compared_cells),
            "left_out": [left.text() for left in self.left_out],
            "cut_short": self.cut_short,
            "explored": self.explored,
        }


@dataclass
class Sweep:
    """Runs cases, with each converged solution computed once."""

    with_converged: bool = False
    _converged: dict[tuple[str, Setting], Measurement] = field(default_factory=dict)

    def run(self, case: Case, settings: list[Setting]) -> CaseReport:
        """One row per setting, in their order. Rows keep what failed, marked. Nobody searched: what a solver does not reach
        with these settings it may reach with others."""
        measurements, rows = [], []
        with progress_bar(sum(item.work for item in settings), "work", case.name) as bar:
            for setting in settings:
                bar.set_postfix_str(setting.text())
                measurement = case.measure(setting)
                measurements.append(measurement)
                rows.append(row_of(case, setting, measurement, self._reference(case, setting)))
                bar.update(setting.work)
        tried = {(setting.cells, setting.solver) for setting in settings if case.searched}
        return CaseReport(case, settings, measurements, rows, cut_short=sorted(tried))

    def search(self, case: Case, seconds: float, grids: Sequence[int] = ()) -> CaseReport:
        """The case's own sweep and what lies around the fronts of its solvers, for about ``seconds`` of processor time per
        grid beyond the sweep, or as many times that as the case says: on the grids on which the case compares solvers, or
        on ``grids``.

        Settings on the fronts are measured TIMINGS times in all, and the cheapest counts: other programs only ever add to
        a cost, though less to the mean of a run that took STEADY_SECONDS. They and the good accelerated ones get their
        distance from the converged solution, as far as REFERENCES_SHARE of that time goes.
        """
        measurements: dict[Setting, Measurement] = {}
        rows: dict[Setting, dict[str, Any]] = {}
        left_out: list[LeftOut] = []
        cut_short: list[tuple[int, str]] = []
        with progress_bar(None, "settings", case.name) as bar:

            def measure(setting: Setting) -> dict[str, Any]:
                bar.set_postfix_str(setting.text())
                measurements[setting] = case.measure(setting)
                bar.update(1)
                return row_of(case, setting, measurements[setting], None)

            for cells in grids or case.compared_cells:
                explorer = Explorer(case, measure, seconds * case.search_share(cells), cells)
                explorer.run()
                cut_short += [(cells, solver) for solver in explorer.cut_short()]
                for setting in explorer.worthwhile():
                    bar.set_postfix_str(f"again: {setting.text()}")
                    explorer.rows[setting] = _again(explorer, setting, measurements[setting])
                bar.set_postfix_str("converged solutions")
                self._compare_with_converged(explorer, measurements)
                for setting in [] if grids else _beside(case, cells):
                    explorer.attempt(setting)
                rows |= explorer.rows
                left_out += explorer.left_out.values()
        settings = sorted(rows, key=lambda item: (item.variant, item.cells, item.rate_hz, item.iterations))
        found = [measurements[setting] for setting in settings]
        return CaseReport(case, settings, found, [rows[setting] for setting in settings], left_out, cut_short, tuple(grids), True)

    def _compare_with_converged(self, explorer: Explorer, measurements: Mapping[Setting, Measurement]) -> None:
        """Gives the rows for which there is time their distance from the converged solution."""
        case, spent = explorer.case, 0.0
        for setting in explorer.referenced():
            target = case.converged(setting)
            known = (case.name, target) in self._converged
            if not known and (spent >= REFERENCES_SHARE * explorer.seconds or not explorer.affordable(target, REFERENCE_SHARE)):
                continue
            begin = time.process_time()
            explorer.rows[setting] = row_of(case, setting, measurements[setting], self._reference(case, setting))
            spent += time.process_time() - begin

    def _reference(self, case: Case, setting: Setting) -> Measurement | None:
        target = case.converged(setting) if self.with_converged else None
        if target is None:
            return None
        key = (case.name, target)
        if key not in self._converged:
            self._converged[key] = case.solve(target)
        return self._converged[key]


def _again(explorer: Explorer, setting: Setting, found: Measurement) -> dict[str, Any]:
    """The row of a setting on a front, timed again unless it took long; its measurement gets the least cost."""
    case, costs = explorer.case, [found.ms_per_simulated_second]
    if explorer.spent[setting] < STEADY_SECONDS:
        costs += [case.measure(setting).ms_per_simulated_second for _ in range(TIMINGS - 1)]
    found.ms_per_simulated_second = min(cost for cost in costs if cost is not None)
    return row_of(case, setting, found, None)


def _beside(case: Case, cells: int) -> list[Setting]:
    """The settings of the sweep on grids on which nothing is compared; they go with the own grid."""
    return [item for item in case.sweep(False) if item.cells not in case.compared_cells] if cells == case.own_cells else []


def row_of(case: Case, setting: Setting, measurement: Measurement, converged: Measurement | None) -> dict[str, Any]:
    """One row of the report. ``error`` is the headline; ``solver_error`` and ``converged_error`` split it where the
    converged solution is known: how far this setting is from it, and how far it is from the truth."""
    headline = case.headline
    return {
        "case": case.name,
        "solver": setting.solver,
        "variant": setting.variant,
        "pressure": setting.pressure,
        "integrator": setting.integrator,
        "flip": setting.flip,
        "dims": case.dimension,
        "rate_hz": setting.rate_hz,
        "substeps": setting.substeps,
        "iterations": setting.iterations,
        "cells": setting.cells,
        "cell_m": case.cell_size(setting),
        "error": measurement.errors[headline.name],
        "error_name": headline.name,
        "error_kind": headline.kind,
        "error_unit": headline.unit,
        "errors": measurement.errors,
        "solver_error": _solver_error(case, measurement, converged),
        "converged_error": None if converged is None else converged.errors[headline.name],
        "truth": case.truth,
        "ms_per_simulated_second": measurement.ms_per_simulated_second,
        "iterations_used": measurement.iterations_used,
        "predicted_error": measurement.predicted_error,
        "stable": measurement.stable,
        "reasons": measurement.reasons,
        "command": f"pbmpm accuracy {case.name} {setting.options()}",
        **measurement.extra,
    }


def _solver_error(case: Case, measurement: Measurement, converged: Measurement | None) -> float | None:
    if converged is None or converged.observed is None or measurement.observed is None:
        return None
    return case.distance(measurement.observed, converged.observed)


def report_of(reports: list[CaseReport], threads: int, asked: dict[str, Any]) -> dict[str, Any]:
    """The whole report: all rows in one list, each case's facts, what was asked for, and the machine of all."""
    return {
        "rows": [row for report in reports for row in report.rows],
        "cases": [report.facts() for report in reports],
        "asked": asked,
        "stable_means": DEFINITION,
        "versions": versions(),
        "machine": {**reports[-1].machine, "threads": threads},
    }
