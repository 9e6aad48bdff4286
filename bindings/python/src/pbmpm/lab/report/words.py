"""Verdicts in words, the same on a terminal and in the page."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .pareto import Point, cost_of, front_of
from .rows import CaseRows, GridVerdict, point_of, verdicts_of
from .verdict import ACCELERATED, GOOD, LEVELS, NOT_REACHED, WANTED, Comparison, Verdict

HEADINGS = (
    "case",
    "cells",
    "cell [m]",
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
    typical = ("at least " if comparison.at_least else "") + _ratio_text(comparison.median)
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


def advice_text(judged: GridVerdict) -> str:
    """What to take, and what the others need for the same error: "dual, 60 Hz x 5 iterations: 0.6 % for 26 ms per simulated second"."""
    stable = [point_of(row) for row in judged.case.stable if row["cells"] == judged.cells]
    own = front_of(point for point in stable if point.solver in ACCELERATED)
    if not own:
        return "No accelerated setting is stable here."
    chosen = next((point for point in own if point.error <= judged.verdict.highest), own[-1])
    unit = judged.case.measure["unit"]
    said = f"{chosen.setting}: {error_text(chosen.error, unit)} for {chosen.cost:.3g} ms per simulated second"
    others = [_other_text(other, front_of(point for point in stable if point.solver == other), chosen.error, unit) for other in WANTED]
    return "; ".join([said, *(text for text in others if text)]) + "."


_OTHERS = {"paper": "the paper's solver", "explicit": "the explicit solver"}


def _other_text(other: str, front: Sequence[Point], error: float, unit: str) -> str:
    if not front:
        return ""
    cost = cost_of(front, error)
    if cost is None:
        return f"{_OTHERS[other]} gets to {error_text(front[-1].error, unit)} at best"
    return f"{_OTHERS[other]} needs {cost:.3g} ms for that"


def verdict_cells(judged: GridVerdict) -> list[str]:
    """One line of the table of verdicts."""
    case, verdict, unit = judged.case, judged.verdict, judged.case.measure["unit"]
    return [
        case.name,
        str(judged.cells),
        f"{judged.cell_m:.3g}",
        case.measure["name"],
        error_text(verdict.best_error, unit),
        range_text(verdict, unit),
        *(comparison_text(comparison, unit) for comparison in verdict.comparisons),
        ", ".join(verdict.solvers_on_front) or "-",
        verdict_text(verdict),
    ]


def verdict_table(cases: Sequence[CaseRows]) -> str:
    """All verdicts as text, with what they mean."""
    verdicts = verdicts_of(cases)
    rows = [list(HEADINGS), *(verdict_cells(judged) for judged in verdicts)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADINGS))]
    lines = ["  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    advised = [f"{judged.case.name}, {judged.cells} cells: {advice_text(judged)}" for judged in verdicts]
    said = ["What to take:", *advised, "", f"How many times cheaper the accelerated solvers are. {MEANING}", *lines, counted(verdicts)]
    return "\n".join(said + not_compared(cases))


MEANING = (
    "Accelerated: dual and primal. Compared grid by grid over the errors that count: from the one that the case calls"
    f" good ({100 * GOOD:g} % where it names none) down to a tenth of it or to what grid and time step leave to a"
    f" converged solution, whichever is higher; at {LEVELS} of them, interpolated in logarithms along each solver's front. The"
    " first figure is the median, in brackets the range; at least: time did not suffice to search that solver to the end."
)


def not_compared(cases: Sequence[CaseRows]) -> list[str]:
    """The cases without a verdict, or with one about a few settings alone, and why."""
    said = [f"{case.name}: no verdict: {case.facts['not_compared']}" for case in cases if case.facts.get("not_compared")]
    few = [case.name for case in cases if case.compared and not case.facts.get("explored", True)]
    if few:
        said.append(
            "Few settings, as --quick or options chose them, and no search for better ones, so that these verdicts say nothing about"
            f" the solvers: {', '.join(few)}."
        )
    claims = [case.name for case in cases if not case.compared and not case.facts.get("not_compared")]
    return said + ([f"No comparison of costs, so without a verdict: {', '.join(claims)}."] if claims else [])


def counted(verdicts: Sequence[GridVerdict]) -> str:
    """How many cases are passed, and what that means."""
    cases = {judged.case.name for judged in verdicts}
    passed = {judged.case.name for judged in verdicts if judged.verdict.passed}
    grids = sum(judged.verdict.passed for judged in verdicts)
    always = sum(judged.verdict.always for judged in verdicts)
    wanted = " and ".join(f"{factor:g} times cheaper than the {other} solver" for other, factor in WANTED.items())
    return (
        f"{len(passed)} of {len(cases)} cases, on {grids} of {len(verdicts)} grids: accelerated solvers alone on the front, and"
        f" typically {wanted} or not reached by it; on {always} grids at every error that counts."
    )
