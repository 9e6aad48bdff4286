"""``pbmpm stability``."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any, get_args

import click

from ..names import SolverName
from .options import EXIT_CHECK_FAILED, JSON_HELP, NameList, NumberList, OutputFile, WholeNumber, chosen_workers, emit_json, own_command, worker_options
from ..saved import file_to_resume

_SOLVERS = [name for name in get_args(SolverName) if name != "convergent"]  # that is one of the others


@click.command()
@click.argument("cases", metavar="[CASE]...", nargs=-1)
@click.option("--quick", is_flag=True, help="Each case at its own rate and iterations only.")
@click.option("--solvers", type=NameList(_SOLVERS), help="Solvers to run.  [default: all]")
@click.option("--rates", type=NumberList(float, 1e5), help="Steps per second.  [default: those of the map, 15 to 480]")
@click.option("--iterations", type=NumberList(int, 1000), help="Iterations per step.  [default: those of the map, 1 to 20]")
@click.option("--materials", type=NameList(["liquid", "elastic", "sand", "visco", "mixed"]), help="Kinds of matter.  [default: all]")
@click.option("--dims", type=NameList(["2", "3"]), help="Dimensions.  [default: both]")
@click.option("--variant", help="One variant of a case.  [default: all]")
@click.option("--seed", type=WholeNumber(0, 2**32 - 1), default=1, show_default=True, help="Of all random numbers.")
@worker_options("one per core")
@click.option("--all", "show_all", is_flag=True, help="Print the figures of cells that passed, too.")
@click.option(
    "--resume",
    is_flag=True,
    help="Keep the runs that the file of --json holds, show them too, and run what it has not; it is written while they run.",
)
@click.option("--html", type=OutputFile(), metavar="FILE", help="Write the map as a page.")
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def stability(
    cases: tuple[str, ...],
    json_target: str | None,
    html: Path | None,
    show_all: bool,
    resume: bool,
    processes: int | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Run the hard CASEs (H01, H03, ...; default: all) and print what passes and what does not.

    A case has bounds, which hold at every setting (nothing explodes, gains energy, is lost or leaves), and some have goals (of
    accuracy or recovery), which are stated for the case's own rate and iterations. Goals are judged there and wherever rate
    and iterations are both at least as high; at coarser settings, where a solve that is cut short cannot reach them, they are
    printed as figures, and only the bounds decide. For each cell that failed the figure that decided it is printed, with the
    command that runs it again.

    --quick runs each case at its own setting. Without it each case runs with every solver and material in 2D at all rates
    and iteration counts, and in 3D, whose kernels are the same text, at its own setting and at the four corners: the lowest
    and the highest rate with the fewest and the most iterations. What depends on neither rate nor iterations runs once. With
    --rates or --iterations all of them are run in 3D as well. Use --resume to run it in parts.

    Exit code 1 when a setting fails, other than for a reason that is known or with the explicit solver, which is there
    to be compared with.
    """
    from ..stability.result import counts
    from ..stability.table import cells_text, goals_text, map_text, summary

    to_resume = file_to_resume(json_target) if resume else None
    workers = chosen_workers(processes, scheduler, os.cpu_count() or 1)
    outcomes, report = _outcomes(_selection(cases, options), workers, to_resume)
    emit_json(report, json_target)
    if html is not None:
        from ..report.stability_page import save_stability_page

        save_stability_page(report, outcomes, own_command(), html)
    if json_target != "-":
        click.echo(map_text(outcomes))
        figures = cells_text(outcomes, show_all)
        if figures:
            click.echo(f"\n{'All cells' if show_all else 'Cells that failed'}:\n{figures}")
        goals = goals_text(outcomes)
        if goals:
            click.echo(f"\nGoals not reached at settings coarser than the case's own, where they do not count:\n{goals}")
        click.echo(f"\n{summary(outcomes)} ({report['wall_seconds']:.0f} s)")
    if any(map(counts, outcomes)):
        sys.exit(EXIT_CHECK_FAILED)


def _outcomes(selection: Any, workers: Any, to_resume: Path | None) -> tuple[list[Any], dict[str, Any]]:
    """Runs what is selected and not yet in the file to resume, which an interrupt leaves with all that was done; and the report."""
    from ..stability.plan import Run, plan
    from ..stability.record import Record
    from ..stability.sweep import sweep

    record = Record(to_resume)
    record.go_on()
    earlier = list(record.outcomes)
    done = {Run(outcome.case, outcome.setting) for outcome in earlier}
    try:
        new = sweep([run for run in plan(selection) if run not in done], workers, record.add)
    finally:
        record.save()
    record.outcomes = [*earlier, *new]
    return record.outcomes, record.report()


def _selection(cases: tuple[str, ...], options: dict[str, Any]) -> Any:
    from ..stability.cases import SOLVERS
    from ..stability.plan import DIMENSIONS, MATERIALS, Selection, cases_named

    return Selection(
        cases=cases_named(cases),
        solvers=options["solvers"] or SOLVERS,
        quick=options["quick"],
        rates=tuple(options["rates"] or ()) or None,
        iterations=tuple(options["iterations"] or ()) or None,
        materials=options["materials"] or MATERIALS,
        dimensions=tuple(map(int, options["dims"] or ())) or DIMENSIONS,
        variant=options["variant"],
        seed=options["seed"],
    )
