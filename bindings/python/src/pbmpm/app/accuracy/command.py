"""``pbmpm accuracy``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from ..errors import InputError
from ..options import EXIT_CHECK_FAILED, JSON_HELP, NumberList, emit_json, own_command, own_options


class VariantList(click.ParamType):
    """Solvers with their options, separated by commas."""

    name = "s1,s2,..."

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[str]:
        from .case import parse_variant

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
@click.option("--cells", type=NumberList(int, 1024), help="Cells over the length of the case.")
@click.option("--substeps", type=click.IntRange(1, 256), default=1, show_default=True, help="Substeps per step.")
@click.option("--quick", is_flag=True, help="Few settings, for a first look.")
@click.option(
    "--converged/--no-converged",
    default=None,
    help="Also solve each grid and rate with many iterations, to tell the solver's error.  [default: not with --quick]",
)
@click.option("--threads", type=click.IntRange(0, 256), default=1, show_default=True, help="Threads; 0: one per core.")
@click.option("--chart", type=click.Path(path_type=Path, file_okay=False), help="Folder for a PNG per case.")
@click.option("--html", type=click.Path(path_type=Path, dir_okay=False), help="Write charts, verdicts and tables as a page.")
@click.option("--json", "json_target", metavar="FILE", help=JSON_HELP)
def accuracy(
    names: tuple[str, ...], only_list: bool, json_target: str | None, chart: Path | None, html: Path | None, **options: Any
) -> None:
    """Compare CASEs with experiments and theory: error against milliseconds, over rates, iterations, solvers and cells.

    Without CASE: all of them. What is not given is as each case has it. Exit code 1 when a setting is not stable; it stays
    in all tables and charts, marked. At the end the verdict: how many times cheaper the dual and primal solvers are than the
    paper's and the explicit one at equal error.
    """
    from ..report.rows import cases_of, verdicts_of
    from ..report.words import verdict_table
    from .chart import save_chart
    from .registry import find_cases
    from .sweep import Choice, Sweep, report_of
    from .table import legend, table

    cases = find_cases(names)
    if only_list:
        for case in cases:
            click.echo(f"{case.name:20} {case.dimension}D {case.kind:8} {case.title}")
        return
    wanted = options.pop("converged")
    converged = not options["quick"] if wanted is None else wanted
    choice = Choice(variants=options.pop("solvers"), **options)
    sweep, reports = Sweep(converged), []
    for case in cases:
        settings = choice.settings(case)
        if not settings:
            raise InputError(f"{case.name}: no setting is left to measure")
        report = sweep.run(case, settings)
        reports.append(report)
        if json_target != "-":
            click.echo(f"\n{case.name}: {case.title}\n  truth: {case.truth}\n{legend(report)}\n{table(report)}")
    whole = report_of(reports, options["threads"])
    if chart is not None:
        for report in reports:
            save_chart(report, whole["machine"], chart / f"{report.case.name}.png")
    emit_json(whole, json_target)
    if html is not None:
        from ..report.accuracy_page import save_accuracy_page

        options_kept = own_options(("--html", "--json", "--chart"), names)
        save_accuracy_page(whole, own_command(), options_kept, html)
    if json_target != "-":
        click.echo(f"\n{verdict_table(verdicts_of(cases_of(whole)))}")
    if not all(row["stable"] for row in whole["rows"]):
        sys.exit(EXIT_CHECK_FAILED)
