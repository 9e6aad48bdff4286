"""The map as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .cases import SOLVERS, Check, HardCase, Outcome, find_case
from .plan import Run
from .result import Cell, Line, LineKey, counts, lines_of

LEGEND = (
    "Marks: . passed in all variants, o passed its bounds, but a goal is not reached at this coarse setting, x failed, k failed for a"
    " known reason, e the explicit solver failed (it is there to be compared with); in each group one mark per iteration count.\n"
    "Bounds (nothing explodes, gains energy, is lost or leaves) are judged everywhere; goals (of accuracy and recovery) at a case's own"
    " setting and where rate and iterations are both at least as high."
)


def map_text(outcomes: Sequence[Outcome]) -> str:
    """A block per case with its own setting, with a line per solver, material and dimension and a group of marks per rate."""
    lines = lines_of(outcomes, SOLVERS)
    parts = [LEGEND]
    for identifier in dict.fromkeys(key.case for key in lines):
        case = find_case(identifier)
        own = {key: line for key, line in lines.items() if key.case == identifier}
        parts += ["", f"{case.id} {case.title} (own setting: {own_setting(case)})", f"    {case.criterion}", *_block(own)]
    return "\n".join(parts)


def own_setting(case: HardCase) -> str:
    """From where on a case's goals are judged."""
    return "the whole ladder" if case.ladder else f"{case.rate_hz:g} Hz x {case.iterations}"


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
        f" {setting.iterations} '{setting.variant}'{share}\n      {_figures(outcome)}{known}\n"
        f"      {Run(outcome.case, setting).command}"
    )


def _figures(outcome: Outcome) -> str:
    """What decided, and the goals that are missed without deciding."""
    idle = outcome.goals_missed if outcome.passed else ()
    return "\n      ".join([outcome.telling.text(), *(check.text(judged=False) for check in idle)])


def cells_text(outcomes: Sequence[Outcome], passed_too: bool) -> str:
    """The figures of all cells that failed, or of all."""
    cells = [cell for line in lines_of(outcomes, SOLVERS).values() for cell in line.values()]
    return "\n".join(cell_text(cell) for cell in cells if passed_too or cell.failed)


def goals_text(outcomes: Iterable[Outcome]) -> str:
    """The goals that settings coarser than the case's own do not reach: a line for each goal of a variant, with the worst figure
    and the settings."""
    found: dict[tuple[str, ...], list[tuple[Outcome, Check]]] = {}
    for outcome in outcomes:
        if outcome.passed:
            for check in outcome.goals_missed:
                found.setdefault((*_name(outcome), _family(check)), []).append((outcome, check))
    return "\n".join(_goal_line(" ".join(key), found[key]) for key in sorted(found))


def _name(outcome: Outcome) -> tuple[str, ...]:
    setting = outcome.setting
    return outcome.case, setting.solver, setting.material, f"{setting.dimension}D", f"'{setting.variant}'"


def _family(check: Check) -> str:
    """The name of a check without what it counted in brackets."""
    return check.name.partition(" (")[0]


def _goal_line(name: str, missed: list[tuple[Outcome, Check]]) -> str:
    worst = max((check for _, check in missed), key=lambda check: -check.figure if check.at_least else check.figure)
    places = sorted({(outcome.setting.rate_hz, outcome.setting.iterations) for outcome, _ in missed})
    where = ", ".join(f"{rate:g} Hz x {count}" for rate, count in places)
    return f"  {name}: worst {worst.figure:.4g} (limit {worst.limit_text})\n      at {where}"


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
            bounds_only = sum(outcome.passed and bool(outcome.goals_missed) for outcome in own)
            coarse = f" ({bounds_only} without a goal, at settings coarser than the case's own)" if bounds_only else ""
            lines.append(f"{solver}: {len(own) - len(failed)} of {len(own)} runs passed{coarse}; {len(failed)} failed{reason}")
    wrong = sum(map(counts, outcomes))
    lines.append(f"{wrong} failure{'s' if wrong != 1 else ''} that should not be")
    return "\n".join(lines)
