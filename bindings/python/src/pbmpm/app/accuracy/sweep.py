"""Measures a case at every combination of rate and iterations."""

from __future__ import annotations

from typing import Any, Protocol

import pbmpm

from ..machine import machine_facts
from ..progress import progress_bar
from ..simulation import RunSettings, versions
from .stability import DEFINITION


def default_sweep(quick: bool) -> tuple[list[float], list[int]]:
    """Rates and iterations that are measured unless others are asked for."""
    if quick:
        return [30.0, 60.0, 240.0], [1, 5, 10]
    return [30.0, 60.0, 120.0, 240.0, 480.0], [1, 2, 5, 10]


class Case(Protocol):
    """A reference case."""

    name: str

    def facts(self) -> dict[str, Any]:
        """Size, resolution and how time is measured."""

    def measure(self, settings: RunSettings) -> dict[str, Any]:
        """One row."""


def sweep(case: Case, rates: list[float], iterations: list[int], threads: int) -> dict[str, Any]:
    """The report of a case: one row per setting, cheap ones first. Rows may hold ``curves`` for the chart."""
    settings = [RunSettings(rate, 1, count, threads) for rate in rates for count in iterations]
    rows = []
    with progress_bar(sum(_work(item) for item in settings), "work", case.name) as bar:
        for item in settings:
            bar.set_postfix_str(item.text())
            rows.append(case.measure(item))
            bar.update(_work(item))
    return {
        "case": case.name,
        "rows": rows,
        **case.facts(),
        "stable_means": DEFINITION,
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), threads),
    }


def _work(settings: RunSettings) -> float:
    """Expected cost, relative: an iteration costs about as much as a third of the rest of a step."""
    return settings.rate_hz * (settings.iterations + 3)


def without_curves(report: dict[str, Any]) -> dict[str, Any]:
    """The report as it goes into JSON."""
    rows = [{key: value for key, value in row.items() if key != "curves"} for row in report["rows"]]
    return {**report, "rows": rows}


TABLES = {
    "dam-break": [
        ("Hz", "rate_hz", "{:g}", 1),
        ("N", "iterations", "{:d}", 1),
        ("ms/s", "ms_per_simulated_second", "{:.1f}", 1),
        ("front %", "front_rms", "{:.1f}", 100),
        ("shifted %", "front_rms_shifted", "{:.1f}", 100),
        ("shift", "shift", "{:+.3f}", 1),
        ("height", "height_rms", "{:.3f}", 1),
        ("volume %", "volume_error_rms", "{:.2f}", 100),
        ("settled %", "settled_volume", "{:.1f}", 100),
    ],
    "column": [
        ("Hz", "rate_hz", "{:g}", 1),
        ("N", "iterations", "{:d}", 1),
        ("ms/s", "ms_per_simulated_second", "{:.1f}", 1),
        ("height %", "height_error", "{:+.2f}", 100),
        ("no feedb.", "height_error_without_feedback", "{:+.2f}", 100),
        ("law %", "height_error_law", "{:+.2f}", 100),
        ("volume %", "volume_error_rms", "{:.2f}", 100),
        ("no feedb.", "volume_error_without_feedback", "{:.2f}", 100),
        ("law %", "volume_error_law", "{:.2f}", 100),
    ],
}
"""Columns of the printed table: heading, key, format, factor."""


def table(report: dict[str, Any]) -> str:
    """The rows as text; settings that are not stable stay in it and say why."""
    columns = TABLES[report["case"]]
    lines = ["  ".join(f"{heading:>9}" for heading, *_ in columns) + "  stable"]
    for row in report["rows"]:
        cells = []
        for _, key, form, factor in columns:
            cells.append(f"{'-' if row[key] is None else form.format(row[key] * factor):>9}")
        verdict = "yes" if row["stable"] else "FAILED: " + "; ".join(row["reasons"])
        lines.append("  ".join(cells) + "  " + verdict)
    return "\n".join(lines)
