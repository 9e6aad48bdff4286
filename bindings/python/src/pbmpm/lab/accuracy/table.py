"""The rows of a case as text."""

from __future__ import annotations

from typing import Any

from .sweep import CaseReport

_PLAIN_UNITS = {"%": (100.0, "{:.2f}")}


def table(report: CaseReport) -> str:
    """A heading and a line per setting; settings that are not stable stay in it and say why."""
    measures = report.case.error_kinds
    headings = ["solver", "Hz", "N", "cells", "ms/s", "used", *(measure.name for measure in measures)]
    split = any(row["solver_error"] is not None for row in report.rows)
    headings += ["solver err", "converged"] if split else []
    lines = [[*headings, "stable"]]
    for row in report.rows:
        errors = [_error(row["errors"].get(measure.name), measure.unit) for measure in measures]
        errors += [_error(row[key], row["error_unit"]) for key in ("solver_error", "converged_error")] if split else []
        lines.append([*_setting(row), *errors, "yes" if row["stable"] else "FAILED: " + "; ".join(row["reasons"])])
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]) - 1)]
    return "\n".join(_line(line, widths) for line in lines)


def legend(report: CaseReport) -> str:
    """What the columns of the errors mean."""
    return "\n".join(
        f"  {measure.name} [{measure.unit}], {measure.kind}: {measure.meaning}"
        + (f" (expected: at most {_error(measure.tolerance, measure.unit)})" if measure.tolerance is not None else "")
        for measure in report.case.error_kinds
    )


def _line(cells: list[str], widths: list[int]) -> str:
    first, *rest = (cell if column == 0 else cell.rjust(width) for column, (cell, width) in enumerate(zip(cells, widths)))
    return "  ".join([first.ljust(widths[0]), *rest, cells[-1]])


def _setting(row: dict[str, Any]) -> list[str]:
    used, cost = row["iterations_used"], row["ms_per_simulated_second"]
    rate = f"{row['rate_hz']:g}" + (f"x{row['substeps']}" if row["substeps"] > 1 else "")
    return [
        row["variant"],
        rate,
        str(row["iterations"]),
        str(row["cells"]),
        "-" if cost is None else f"{cost:.1f}",
        "-" if used is None else f"{used:.1f}",
    ]


def _error(value: float | None, unit: str) -> str:
    if value is None:
        return "-"
    factor, form = _PLAIN_UNITS.get(unit, (1.0, "{:.4g}"))
    return form.format(value * factor)
