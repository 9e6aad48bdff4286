"""``pbmpm accuracy``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from .options import (
    EXIT_CHECK_FAILED,
    JSON_HELP,
    Number,
    NumberList,
    OutputFile,
    OutputFolder,
    WholeNumber,
    chosen_timed_workers,
    emit_json,
    own_command,
    own_options,
    worker_options,
)
from ..saved import file_to_resume

if TYPE_CHECKING:
    from ..accuracy.sweep import CaseReport
    from ..workers.workers import Workers


class VariantList(click.ParamType):
    """Solvers with their options, separated by commas."""

    name = "s1,s2,..."

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[str]:
        from ..accuracy.case import parse_variant

        variants = list(dict.fromkeys(word.strip() for word in str(value).split(",")))
        try:
            for variant in variants:
                parse_variant(variant)
        except InputError as problem:
            self.fail(str(problem), param, ctx)
        return variants


@click.command()
@click.argument("names", metavar="[CASE]...", nargs=-1)
@click.option("--list", "only_list", is_flag=True, help="List the cases and end.")
@click.option("--solvers", type=VariantList(), help="Solvers with their options, as paper,dual,dual-cells-flip0.9,primal-bdf2.")
@click.option("--rates", type=NumberList(float, 1e5), help="Steps per second.")
@click.option("--iterations", type=NumberList(int, 1000), help="Iterations per substep.")
@click.option("--cells", type=NumberList(int, 1024), help="Cells over the length of the case; alone: search on these grids.")
@click.option("--finest", is_flag=True, help="Search only on the finest of the grids on which a case compares solvers.")
@click.option("--substeps", type=WholeNumber(1, 256), default=1, show_default=True, help="Substeps per step.")
@click.option(
    "--seconds",
    type=Number(1.0),
    default=30.0,
    show_default=True,
    help="Processor time per case and grid for the search around the fronts. Not with --quick or with chosen settings.",
)
@click.option("--quick", is_flag=True, help="Few settings, for a first look.")
@click.option(
    "--converged/--no-converged",
    default=None,
    help="Also solve each grid and rate with many iterations (search: those on the fronts), to tell the solver's error."
    "  [default: not with --quick]",
)
@click.option(
    "--from",
    "saved",
    multiple=True,
    type=click.Path(path_type=Path, dir_okay=False, exists=True),
    help="Show what --json wrote instead of measuring; can be given more than once.",
)
@click.option(
    "--resume", is_flag=True, help="Keep the cases that the file of --json holds already; it is written after each case."
)
@click.option("--threads", type=WholeNumber(0, 256), default=1, show_default=True, help="Threads; 0: one per core.")
@worker_options("1; else runs are timed at the same time, each on a core of its own")
@click.option("--chart", type=OutputFolder(), help="Folder for a PNG per case.")
@click.option("--html", type=OutputFile(), metavar="FILE", help="Write charts, verdicts and tables as a page.")
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def accuracy(
    names: tuple[str, ...],
    only_list: bool,
    json_target: str | None,
    chart: Path | None,
    html: Path | None,
    saved: tuple[Path, ...],
    processes: int | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Compare CASEs with experiments and theory: error against milliseconds, over rates, iterations, solvers and cells.

    Without CASE: all of them. Without chosen settings each case's own sweep is refined around the fronts of the solvers, on
    each grid on which the case compares them; what is not given is as each case has it. Exit code 1 when a setting is not
    stable; it stays in all tables and charts, marked. One worker measures all of a case. Costs are processor time with one
    thread, else wall time. At the end the verdict: how many times cheaper the dual and primal solvers are than the paper's and
    the explicit one at equal error, grid by grid.
    """
    from ..accuracy.registry import find_cases
    from ..accuracy.parts import merged

    cases = find_cases(names)
    if only_list:
        for case in cases:
            click.echo(f"{case.name:20} {case.dimension}D {case.kind:8} {case.title}")
        return
    if saved:
        if chart is not None:
            raise InputError("--chart needs the curves, which --json does not keep: measure, or use --html")
        whole, complete = merged(saved, [case.name for case in cases]), True
    else:
        workers = chosen_timed_workers(processes, scheduler, options["threads"])
        whole, complete = _measured(cases, options, workers, json_target, chart)
    stable = whole is None or _show(whole, names, json_target, html)
    if not (stable and complete):
        sys.exit(EXIT_CHECK_FAILED)


def _measured(
    cases: list[Any], options: dict[str, Any], workers: Workers, json_target: str | None, chart: Path | None
) -> tuple[dict[str, Any] | None, bool]:
    """Measures the cases, or those of them that an interrupted sweep has not. The report, in a file after each case; None when
    it holds none. And whether it holds all: a case whose process died is named instead."""
    from ..accuracy.registry import all_cases
    from ..accuracy.parts import begun, together
    from ..accuracy.sweep import report_of
    from ..accuracy.task import measure_case
    from ..progress import progress_bar
    from ..workers.attempt import Lost

    resume = options.pop("resume")
    asked, order = dict(options), list(dict.fromkeys(case.name for case in [*cases, *all_cases()]))
    whole = begun(file_to_resume(json_target), asked) if resume else None
    done = {facts["case"] for facts in whole["cases"]} if whole else set()
    tasks = _tasks([case.name for case in cases if case.name not in done], options)
    complete = True
    with progress_bar(len(tasks), "case", "accuracy", shown=workers.several) as bar:

        def note(index: int, report: Any) -> None:
            nonlocal whole, complete
            bar.update()
            if isinstance(report, Lost):
                complete = False
                click.echo(f"{tasks[index].case}: {report.reason}", err=True)
                return
            new = report_of([report], asked["threads"], asked)
            whole = together([whole, new] if whole else [new], order)
            emit_json(whole, json_target if json_target != "-" else None)
            _tell(report, whole["machine"], chart, json_target != "-")

        workers.carry_out(measure_case, tasks, note)
    return whole, complete


def _tell(report: CaseReport, machine: dict[str, Any], chart: Path | None, in_words: bool) -> None:
    """Each case's picture and table, as soon as they are there."""
    from ..accuracy.error_chart import save_chart
    from ..accuracy.table import legend, table

    case = report.case
    if chart is not None:
        save_chart(report, machine, chart / f"{case.name}.png")
    if in_words:
        click.echo(f"\n{case.name}: {case.title}\n  truth: {case.truth}\n{legend(report)}\n{table(report)}")


def _tasks(names: list[str], options: dict[str, Any]) -> list[Any]:
    """What is to be measured, as the options say."""
    from ..accuracy.sweep import Choice
    from ..accuracy.task import Task

    wanted = options.pop("converged")
    converged = not options["quick"] if wanted is None else wanted
    seconds = options.pop("seconds")
    choice = Choice(variants=options.pop("solvers"), **options)
    return [Task(name, choice, seconds, converged) for name in names]


def _show(whole: dict[str, Any], names: tuple[str, ...], json_target: str | None, html: Path | None) -> bool:
    """Rows, page and verdicts; whether all settings are stable."""
    from ..report.rows import cases_of
    from ..report.words import verdict_table

    emit_json(whole, json_target)
    if html is not None:
        from ..report.accuracy_page import save_accuracy_page

        options_kept = own_options(("--html", "--json", "--chart", "--from", "--processes", "--scheduler"), (*names, "--resume"))
        save_accuracy_page(whole, own_command(), options_kept, html)
    if json_target != "-":
        click.echo(f"\n{verdict_table(cases_of(whole))}")
    return all(row["stable"] for row in whole["rows"])
