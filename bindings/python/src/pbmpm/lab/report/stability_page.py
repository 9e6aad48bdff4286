"""The page of ``pbmpm stability``: the map, and every failure with its figure and the command that replays it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..stability.cases import SOLVERS, Check, Outcome, find_case
from ..stability.plan import Run
from ..stability.result import Cell, Line, LineKey, lines_of
from ..stability.table import own_setting, summary
from .page import save_page

TITLE = "What stays stable"
_CLASSES = {".": "passed", "o": "bounds", "x": "failed", "k": "known", "e": "expected"}


def save_stability_page(report: dict[str, Any], outcomes: Sequence[Outcome], command: str, path: Path) -> None:
    """Writes the page of a map; ``command`` is what made it."""
    lines = lines_of(outcomes, SOLVERS)
    save_page(
        "stability.html.j2",
        path,
        report,
        title=TITLE,
        command=command,
        summary=summary(outcomes),
        cases=[
            _section(identifier, {key: line for key, line in lines.items() if key.case == identifier})
            for identifier in dict.fromkeys(key.case for key in lines)
        ],
    )


def _section(identifier: str, lines: dict[LineKey, Line]) -> dict[str, Any]:
    case = find_case(identifier)
    places = {place for line in lines.values() for place in line}
    rates, iterations = sorted({rate for rate, _ in places}), sorted({count for _, count in places})
    cells = [cell for line in lines.values() for cell in line.values()]
    failed = [outcome for cell in cells for outcome in cell.failed]
    coarse = [outcome for cell in cells for outcome in cell.bounds_only]
    return {
        "id": case.id,
        "title": case.title,
        "criterion": case.criterion,
        "origin": case.origin,
        "rates": [f"{rate:g}" for rate in rates],
        "iterations": iterations,
        "lines": [
            {
                "name": f"{key.solver}, {key.material}, {key.dimension}D",
                "groups": [[_cell(line.get((rate, count))) for count in iterations] for rate in rates],
            }
            for key, line in lines.items()
        ],
        "own": own_setting(case),
        "failed": [_row(outcome, outcome.telling) for outcome in failed],
        "coarse": [_row(outcome, check) for outcome in coarse for check in outcome.goals_missed],
    }


def _cell(cell: Cell | None) -> dict[str, str] | None:
    if cell is None:
        return None
    telling = cell.telling
    number, what = (len(cell.failed), "failed") if cell.failed else (len(cell.bounds_only), "without a goal")
    share = f"{number} of {len(cell.outcomes)} variants {what}\n" if number else ""
    return {
        "class": _CLASSES[cell.mark],
        "text": str(number) if number else "",
        "title": f"{telling.setting}\n{share}{telling.description}",
    }


def _row(outcome: Outcome, check: Check) -> dict[str, Any]:
    """A check of a run, and how to see it again."""
    setting = outcome.setting
    return {
        "solver": setting.solver,
        "setting": f"{setting.variant}, {setting.material}, {setting.dimension}D, {setting.rate_hz:g} Hz x {setting.iterations}",
        "check": check.name,
        "figure": f"{check.figure:.4g}",
        "limit": check.limit_text,
        "known": outcome.known_failure,
        "seed": setting.seed,
        "command": Run(outcome.case, setting).command,
    }
