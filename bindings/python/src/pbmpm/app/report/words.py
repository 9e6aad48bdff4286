"""Verdicts in words, the same on a terminal and in the page."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .rows import CaseRows
from .verdict import ACCELERATED, GOOD, LEVELS, NOT_REACHED, WANTED, Comparison, Verdict

HEADINGS = (
    "case",
    "error",
    "best accelerated",
    "compared over",
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
    """How many times cheaper, typically; in brackets the range over the errors that count."""
    if not comparison.measured:
        return "not measured"
    if comparison.median is None:
        return "no stable accelerated setting"
    if comparison.best_error is None:
        return f"{NOT_REACHED}: never stable"
    if math.isinf(min(comparison.ratios)):
        return f"{NOT_REACHED}: ends at {error_text(comparison.best_error, unit)}"
    typical = _ratio_text(comparison.median)
    spread = f" ({_ratio_text(min(comparison.ratios))} to {_ratio_text(max(comparison.ratios))})"
    mark = "" if comparison.reached else f", below {comparison.wanted:g}x"
    return f"{typical}{spread}{mark}"


def _ratio_text(ratio: float) -> str:
    return NOT_REACHED if math.isinf(ratio) else f"{ratio:.2g}x"


def range_text(verdict: Verdict, unit: str) -> str:
    """The errors that count."""
    if verdict.lowest is None or not verdict.good_reached:
        return f"{error_text(verdict.lowest, unit)}: {error_text(verdict.highest, unit)} not reached"
    return f"{error_text(verdict.highest, unit)} to {error_text(verdict.lowest, unit)}"


def shortfalls(verdict: Verdict) -> list[str]:
    """Why a verdict is not passed; empty when it is."""
    if verdict.best_error is None:
        return ["no accelerated setting is stable"]
    said = [] if verdict.good_reached else ["no accelerated setting is good"]
    said += ["grid too coarse: converged solutions are not good"] if verdict.too_coarse else []
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
        range_text(verdict, unit),
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
    "Accelerated: dual and primal. Compared on the case's own grid over the errors that count: from the one that the case calls"
    f" good ({100 * GOOD:g} % where it names none) down to a tenth of it or to what grid and time step leave to a"
    f" converged solution, whichever is higher; at {LEVELS} of them, interpolated in logarithms along each solver's front. The"
    " first figure is the median, in brackets the range."
)


def not_compared(cases: Sequence[CaseRows]) -> str:
    """The cases without a verdict; empty when there are none."""
    names = [case.name for case in cases if not case.compared]
    return f"No comparison of costs, so without a verdict: {', '.join(names)}." if names else ""


def counted(verdicts: Sequence[tuple[CaseRows, Verdict]]) -> str:
    """How many cases are passed, and what that means."""
    passed = sum(verdict.passed for _, verdict in verdicts)
    always = sum(verdict.always for _, verdict in verdicts)
    wanted = " and ".join(f"{factor:g} times cheaper than the {other} solver" for other, factor in WANTED.items())
    return (
        f"{passed} of {len(verdicts)} cases: accelerated solvers alone on the front, and typically {wanted} or not reached by"
        f" it; {always} of them at every error that counts."
    )
