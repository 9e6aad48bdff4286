"""Verdicts in words, the same on a terminal and in the page."""

from __future__ import annotations

from collections.abc import Sequence

from .rows import CaseRows
from .verdict import ACCELERATED, NOT_REACHED, WANTED, Comparison, Verdict

HEADINGS = (
    "case",
    "error",
    "best accelerated",
    *(f"cheaper than {other}" for other in WANTED),
    "on the front",
    "verdict",
)


def error_text(value: float | None, unit: str) -> str:
    """An error with its unit, three digits; shares are shown in percent."""
    if value is None:
        return "-"
    if unit == "%":
        return f"{100 * value:.3g} %"
    return f"{value:.3g}" if unit in ("", "1") else f"{value:.3g} {unit}"


def cost_text(value: float | None) -> str:
    """Milliseconds per simulated second."""
    return NOT_REACHED if value is None else f"{value:.3g}"


def comparison_text(comparison: Comparison, unit: str) -> str:
    """How many times cheaper, and at which error; in brackets the range over all errors that both reach."""
    if not comparison.measured:
        return "not measured"
    if comparison.level is None:
        return "no stable accelerated setting"
    at = f"at {error_text(comparison.level, unit)}"
    if comparison.best_error is None:
        return f"{NOT_REACHED} {at}: never stable"
    if comparison.ratio is None:
        return f"{NOT_REACHED} {at}: ends at {error_text(comparison.best_error, unit)}"
    spread = ""
    if comparison.lowest_ratio is not None and comparison.highest_ratio is not None:
        spread = f" ({comparison.lowest_ratio:.2g} to {comparison.highest_ratio:.2g})"
    mark = "" if comparison.reached else f", below {comparison.wanted:g}x"
    return f"{comparison.ratio:.2g}x {at}{spread}{mark}"


def shortfalls(verdict: Verdict) -> list[str]:
    """Why a verdict is not passed; empty when it is."""
    if verdict.best_error is None:
        return ["no accelerated setting is stable"]
    said = []
    others = [name for name in verdict.solvers_on_front if name not in ACCELERATED]
    if others:
        said.append(f"{' and '.join(others)} on the front too")
    for comparison in verdict.comparisons:
        if not comparison.measured:
            said.append(f"{comparison.other} not measured")
        elif not comparison.reached:
            said.append(f"less than {comparison.wanted:g}x cheaper than {comparison.other}")
    return said


def verdict_text(verdict: Verdict) -> str:
    return "; ".join(shortfalls(verdict)) or "reached"


def verdict_cells(case: CaseRows, verdict: Verdict) -> list[str]:
    """One line of the table of verdicts."""
    unit = case.measure["unit"]
    return [
        case.name,
        case.measure["name"],
        error_text(verdict.best_error, unit),
        *(comparison_text(comparison, unit) for comparison in verdict.comparisons),
        ", ".join(verdict.solvers_on_front) or "-",
        verdict_text(verdict),
    ]


def verdict_table(verdicts: Sequence[tuple[CaseRows, Verdict]]) -> str:
    """All verdicts as text, with what they mean."""
    rows = [list(HEADINGS), *(verdict_cells(case, verdict) for case, verdict in verdicts)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADINGS))]
    lines = ["  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join([f"How many times cheaper the accelerated solvers are. {MEANING}", *lines, counted(verdicts)])


MEANING = (
    "Accelerated: dual and primal. Compared at the error that the case calls good, or, where they do not reach it, at the"
    " lowest that both reach; interpolated in logarithms along each solver's front. In brackets: the range over all errors"
    " that both reach."
)


def counted(verdicts: Sequence[tuple[CaseRows, Verdict]]) -> str:
    """How many cases are passed, and what that means."""
    passed = sum(verdict.passed for _, verdict in verdicts)
    wanted = " and ".join(f"{factor:g} times cheaper than the {other} solver" for other, factor in WANTED.items())
    return (
        f"{passed} of {len(verdicts)} cases: accelerated solvers alone on the front, and {wanted} or not reached by it."
    )
