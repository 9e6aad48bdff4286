"""``pbmpm accuracy``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from .options import EXIT_CHECK_FAILED, JSON_HELP, NumberList, OutputFile, OutputFolder, emit_json, own_command, own_options
from ..saved import file_to_resume


if TYPE_CHECKING:
    from ..accuracy.sweep import CaseReport


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
@click.option("--substeps", type=click.IntRange(1, 256), default=1, show_default=True, help="Substeps per step.")
@click.option(
    "--seconds",
    type=click.FloatRange(1.0),
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
@click.option("--threads", type=click.IntRange(0, 256), default=1, show_default=True, help="Threads; 0: one per core.")
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
    **options: Any,
) -> None:
    """Compare CASEs with experiments and theory: error against milliseconds, over rates, iterations, solvers and cells.

    Without CASE: all of them. Without chosen settings each case's own sweep is refined around the fronts of the solvers, on
    each grid on which the case compares them; what is not given is as each case has it. Exit code 1 when a setting is not
    stable; it stays in all tables and charts, marked. Costs are processor time with one thread, else wall time. At the end
    the verdict: how many times cheaper the dual and primal solvers are than the paper's and the explicit one at equal
    error, grid by grid.
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
        whole = merged(saved, [case.name for case in cases])
    else:
        whole = _measured(cases, options, json_target, chart)
    _show(whole, names, json_target, html)


def _measured(cases: list[Any], options: dict[str, Any], json_target: str | None, chart: Path | None) -> dict[str, Any]:
    """Measures the cases, or those of them that an interrupted sweep has not; a file is written after each, and each one's
    table and picture as soon as they are there."""
    from ..accuracy.error_chart import save_chart
    from ..accuracy.registry import all_cases
    from ..accuracy.parts import begun, together
    from ..accuracy.sweep import report_of
    from ..accuracy.table import legend, table

    to_file, resume = json_target not in (None, "-"), options.pop("resume")
    asked, order = dict(options), list(dict.fromkeys(case.name for case in [*cases, *all_cases()]))
    whole = begun(file_to_resume(json_target), asked) if resume else None
    done = {facts["case"] for facts in whole["cases"]} if whole else set()
    for report in _reports([case for case in cases if case.name not in done], options):
        new = report_of([report], asked["threads"], asked)
        whole = together([whole, new] if whole else [new], order)
        emit_json(whole, json_target if to_file else None)
        case = report.case
        if chart is not None:
            save_chart(report, whole["machine"], chart / f"{case.name}.png")
        if json_target != "-":
            click.echo(f"\n{case.name}: {case.title}\n  truth: {case.truth}\n{legend(report)}\n{table(report)}")
    assert whole is not None
    return whole


def _reports(cases: list[Any], options: dict[str, Any]) -> Iterator[CaseReport]:
    """Runs the cases as the options say."""
    from ..accuracy.sweep import Choice, Sweep

    wanted = options.pop("converged")
    converged = not options["quick"] if wanted is None else wanted
    seconds = options.pop("seconds")
    choice = Choice(variants=options.pop("solvers"), **options)
    sweep = Sweep(converged)
    for case in cases:
        if case.searched and choice.open:
            yield sweep.search(case, seconds, choice.grids(case))
            continue
        settings = choice.settings(case)
        if not settings:
            raise InputError(f"{case.name}: no setting is left to measure")
        yield sweep.run(case, settings)


def _show(whole: dict[str, Any], names: tuple[str, ...], json_target: str | None, html: Path | None) -> None:
    """Rows, page and verdicts; ends the program with an exit code of its own when a setting is not stable."""
    from ..report.rows import cases_of
    from ..report.words import verdict_table

    emit_json(whole, json_target)
    if html is not None:
        from ..report.accuracy_page import save_accuracy_page

        options_kept = own_options(("--html", "--json", "--chart", "--from"), (*names, "--resume"))
        save_accuracy_page(whole, own_command(), options_kept, html)
    if json_target != "-":
        click.echo(f"\n{verdict_table(cases_of(whole))}")
    if not all(row["stable"] for row in whole["rows"]):
        sys.exit(EXIT_CHECK_FAILED)
