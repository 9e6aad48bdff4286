"""The map as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..hardcases import SOLVERS, Outcome, find_case
from .plan import Run
from .result import Cell, Line, LineKey, counts, lines_of

LEGEND = (
    "Marks: . passed in all variants, x failed, k failed for a known reason, e the explicit solver failed (it is there to be"
    " compared with); in each group one mark per iteration count."
)


def map_text(outcomes: Sequence[Outcome]) -> str:
    """A block per case, with a line per solver, material and dimension and a group of marks per rate."""
    lines = lines_of(outcomes, SOLVERS)
    parts = [LEGEND]
    for identifier in dict.fromkeys(key.case for key in lines):
        case = find_case(identifier)
        own = {key: line for key, line in lines.items() if key.case == identifier}
        parts += ["", f"{case.id} {case.title}", f"    {case.criterion}", *_block(own)]
    return "\n".join(parts)


def _block(lines: dict[LineKey, Line]) -> list[str]:
    places = sorted({place for line in lines.values() for place in line})
    rates = list(dict.fromkeys(rate for rate, _ in places))
    iterations = sorted({count for _, count in places})
    width = max(len(iterations), *(len(f"{rate:g} Hz") for rate in rates))
    heading = "  ".join(f"{f'{rate:g} Hz':<{width}}" for rate in rates)
    out = [f"    {'':<22}{heading}  (iterations: {', '.join(map(str, iterations))})"]
    for key, line in lines.items():
        groups = ("".join(_mark(line, rate, count) for count in iterations) for rate in rates)
        name = f"{key.solver} {key.material} {key.dimension}D"
        out.append(f"    {name:<22}" + "  ".join(f"{group:<{width}}" for group in groups))
    return out


def _mark(line: Line, rate: float, iterations: int) -> str:
    cell = line.get((rate, iterations))
    return " " if cell is None else cell.mark


def cell_text(cell: Cell) -> str:
    """The figure that decided a cell, and how to see it again."""
    outcome = cell.telling
    setting = outcome.setting
    share = f" [{len(cell.failed)} of {len(cell.outcomes)} variants]" if cell.failed else ""
    known = f"\n      known: {outcome.known_failure}" if outcome.known_failure else ""
    return (
        f"  {outcome.case} {setting.solver} {setting.material} {setting.dimension}D {setting.rate_hz:g} Hz x"
        f" {setting.iterations} '{setting.variant}'{share}\n      {outcome.telling}{known}\n"
        f"      {Run(outcome.case, setting).command}"
    )


def cells_text(outcomes: Sequence[Outcome], passed_too: bool) -> str:
    """The figures of all cells that failed, or of all."""
    cells = [cell for line in lines_of(outcomes, SOLVERS).values() for cell in line.values()]
    return "\n".join(cell_text(cell) for cell in cells if passed_too or cell.failed)


def summary(outcomes: Iterable[Outcome]) -> str:
    """One line per solver, and what makes the command fail."""
    outcomes = list(outcomes)
    lines = []
    for solver in SOLVERS:
        own = [outcome for outcome in outcomes if outcome.setting.solver == solver]
        if own:
            failed = [outcome for outcome in own if not outcome.passed]
            known = sum(bool(outcome.known_failure) for outcome in failed)
            reason = f", {known} for a known reason" if known else ""
            lines.append(f"{solver}: {len(own) - len(failed)} of {len(own)} runs passed; {len(failed)} failed{reason}")
    wrong = sum(map(counts, outcomes))
    lines.append(f"{wrong} failure{'s' if wrong != 1 else ''} that should not be")
    return "\n".join(lines)
