"""``pbmpm stability``."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Any, get_args

import click

from ..names import SolverName
from ..options import EXIT_CHECK_FAILED, JSON_HELP, NameList, NumberList, emit_json, own_command

_SOLVERS = [name for name in get_args(SolverName) if name != "convergent"]  # that is one of the others


@click.command()
@click.argument("cases", metavar="[CASE]...", nargs=-1)
@click.option("--quick", is_flag=True, help="Each case at its own rate and iterations only.")
@click.option("--solvers", type=NameList(_SOLVERS), help="Solvers to run.  [default: all]")
@click.option("--rates", type=NumberList(float, 1e5), help="Steps per second.  [default: 15,30,60,120,240,480]")
@click.option("--iterations", type=NumberList(int, 1000), help="Iterations per step.  [default: 1,2,5,10,20]")
@click.option("--materials", type=NameList(["liquid", "elastic", "sand", "visco", "mixed"]), help="Kinds of matter.  [default: all]")
@click.option("--dims", type=NameList(["2", "3"]), help="Dimensions.  [default: both]")
@click.option("--variant", help="One variant of a case.  [default: all]")
@click.option("--seed", type=click.IntRange(0, 2**32 - 1), default=1, show_default=True, help="Of all random numbers.")
@click.option("--processes", type=click.IntRange(1, 256), help="Runs at the same time.  [default: one per core]")
@click.option("--all", "show_all", is_flag=True, help="Print the figures of cells that passed, too.")
@click.option("--html", type=click.Path(path_type=Path, dir_okay=False), help="Write the map as a page.")
@click.option("--json", "json_target", metavar="FILE", help=JSON_HELP)
def stability(
    cases: tuple[str, ...],
    json_target: str | None,
    html: Path | None,
    show_all: bool,
    processes: int | None,
    **options: Any,
) -> None:
    """Run the hard CASEs (H01, H03, ...; default: all) and print what passes and what does not.

    Each case runs with every solver, material and dimension at every rate and iteration count; that takes
    hours, so see --quick. For each cell that failed the figure that decided it is printed, with the command that runs it again.

    Exit code 1 when a setting fails, other than for a reason that is known or with the explicit solver, which is there
    to be compared with.
    """
    from .plan import plan
    from .result import counts
    from .sweep import sweep
    from .table import cells_text, map_text, summary

    selection = _selection(cases, options)
    start = time.perf_counter()
    outcomes = sweep(plan(selection), processes or os.cpu_count() or 1)
    seconds = time.perf_counter() - start
    report = _report(outcomes, seconds)
    emit_json(report, json_target)
    if html is not None:
        from ..report.stability_page import save_stability_page

        save_stability_page(report, outcomes, own_command(), html)
    if json_target != "-":
        click.echo(map_text(outcomes))
        figures = cells_text(outcomes, show_all)
        if figures:
            click.echo(f"\n{'All cells' if show_all else 'Cells that failed'}:\n{figures}")
        click.echo(f"\n{summary(outcomes)} ({seconds:.0f} s)")
    if any(map(counts, outcomes)):
        sys.exit(EXIT_CHECK_FAILED)


def _selection(cases: tuple[str, ...], options: dict[str, Any]) -> Any:
    from ..hardcases import SOLVERS
    from .plan import DIMENSIONS, ITERATIONS, MATERIALS, RATES, Selection, cases_named

    # The quick form leaves rates and iterations to the cases, unless they are asked for.
    rates, iterations = (None, None) if options["quick"] else (RATES, ITERATIONS)
    return Selection(
        cases=cases_named(cases),
        solvers=options["solvers"] or SOLVERS,
        rates=tuple(options["rates"] or ()) or rates,
        iterations=tuple(options["iterations"] or ()) or iterations,
        materials=options["materials"] or MATERIALS,
        dimensions=tuple(map(int, options["dims"] or ())) or DIMENSIONS,
        variant=options["variant"],
        seed=options["seed"],
    )


def _report(outcomes: list[Any], seconds: float) -> dict[str, Any]:
    import pbmpm

    from ..machine import machine_facts
    from ..simulation import versions
    from .result import row_of

    return {
        "rows": [row_of(outcome) for outcome in outcomes],
        "wall_seconds": seconds,
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), 1),
    }
