"""The page of ``pbmpm accuracy``: a chart, a verdict and a table per case."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from plotly.offline import get_plotlyjs

from . import words
from .case_chart import accuracy_figure
from .page import save_page
from .rows import CaseRows, GridVerdict, cases_of, setting_of, verdicts_of

TITLE = "What accuracy costs"


def save_accuracy_page(report: dict[str, Any], command: str, options: str, path: Path) -> None:
    """Writes the page of a report, as ``pbmpm accuracy --json`` has it.

    Args:
        report: rows, cases, machine.
        command: what made it.
        options: those of them that choose what is measured, to measure one case again.
        path: the page.
    """
    cases = cases_of(report)
    save_page(
        "accuracy.html.j2",
        path,
        report,
        title=TITLE,
        command=command,
        plotly=get_plotlyjs(),
        stable_means=report["stable_means"],
        headings=words.HEADINGS,
        meaning=words.MEANING,
        counted=words.counted(verdicts_of(cases)),
        not_compared=words.not_compared(cases),
        cases=[_section(case, options) for case in cases],
    )


def _section(case: CaseRows, options: str) -> dict[str, Any]:
    figure = accuracy_figure(case)
    return {
        "name": case.name,
        "facts": case.facts,
        "chart": figure.to_html(full_html=False, include_plotlyjs=False, config={"displaylogo": False}),
        "compared": case.compared,
        "grids": [_grid(judged) for judged in case.verdicts()],
        "headings": [
            "setting",
            "ms per simulated second",
            "iterations used",
            *_error_headings(case),
            "stable",
            "command",
        ],
        "rows": [_row(case, row) for row in case.rows],
        "failed_count": len(case.failed),
        "measures": [_measure_text(measure) for measure in case.facts["errors"]],
        "command": f"pbmpm accuracy {case.name} {options}".strip(),
        "left_out": _left_out(case),
    }


def _grid(judged: GridVerdict) -> dict[str, Any]:
    """What was found on one grid: the verdict, what errors cost, the front."""
    verdict, unit = judged.verdict, judged.case.measure["unit"]
    solvers = list(verdict.levels[0].costs) if verdict.levels else []
    return {
        "title": f"{judged.cells} cells of {judged.cell_m:.3g} m",
        "passed": verdict.passed,
        "advice": words.advice_text(judged),
        "verdict_cells": words.verdict_cells(judged),
        "verdict_text": f"Verdict at {judged.cells} cells: {words.verdict_text(verdict)}",
        "solvers": solvers,
        "levels": [
            (words.error_text(level.error, unit), [words.cost_text(level.costs[solver]) for solver in solvers])
            for level in verdict.levels
        ],
        "front": [
            (point.setting, words.cost_text(point.cost), words.error_text(point.error, unit)) for point in verdict.front
        ],
    }


def _error_headings(case: CaseRows) -> list[str]:
    names = [measure["name"].replace("_", " ") for measure in case.facts["errors"]]
    return [*names, "distance from converged", "error when converged"]


def _row(case: CaseRows, row: dict[str, Any]) -> dict[str, Any]:
    unit = case.measure["unit"]
    used = row["iterations_used"]
    errors = [
        *(words.error_text(row["errors"].get(measure["name"]), measure["unit"]) for measure in case.facts["errors"]),
        *(words.error_text(row.get(key), unit) for key in ("solver_error", "converged_error")),
    ]
    return {
        "stable": row["stable"],
        "cells": [
            setting_of(row),
            "-" if row["ms_per_simulated_second"] is None else f"{row['ms_per_simulated_second']:.4g}",
            "-" if used is None else f"{used:.3g}",
            *errors,
            "yes" if row["stable"] else "; ".join(row["reasons"]),
            row["command"],
        ],
    }


def _measure_text(measure: dict[str, Any]) -> str:
    good = (
        f"; called good: {words.error_text(measure['tolerance'], measure['unit'])}" if measure.get("tolerance") else ""
    )
    return f"{measure['name'].replace('_', ' ')} ({measure['kind']} error): {measure['meaning']}{good}"


def _left_out(case: CaseRows) -> list[str]:
    """What the reader does not see: what the case says, settings without a figure, solvers that were not tried."""
    lines = [case.facts["notes"]] if case.facts["notes"] else []
    lines += case.facts.get("left_out", [])
    without = [row for row in case.rows if row["error"] is None or row["ms_per_simulated_second"] is None]
    if without:
        lines.append(
            f"{len(without)} settings broke before an error could be measured: crosses at the chart's upper edge."
        )
    missing = [solver for solver in ("paper", "dual", "primal", "explicit") if solver not in case.solvers]
    others = sorted({row["cells"] for row in case.rows} - set(case.grids))
    if others:
        lines.append(f"No verdict on {', '.join(map(str, others))} cells: there only what the grid adds was measured.")
    if missing:
        lines.append(f"Not in this sweep: {', '.join(missing)}.")
    return lines or ["Nothing that is known."]
