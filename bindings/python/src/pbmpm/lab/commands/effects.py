"""``pbmpm effects``."""

from __future__ import annotations

import sys
from importlib import resources
from pathlib import Path
from typing import Any

import click

from ..errors import InputError
from ..hints import not_one_of
from .options import EXIT_CHECK_FAILED, JSON_HELP, Number, OutputFile, WholeNumber, emit_json, pace_options, run_settings, solver_options

DEFAULT_SCENE = "workshop_2d.json"
"""A file of the package, the one of the samples."""
LONGEST_SETTLING = 2.0
"""[s] after which a scene is measured unless told otherwise, if half of its time is longer."""


@click.command()
@click.argument("scene_file", metavar="[SCENE]", required=False, type=click.Path(path_type=Path))
@click.option(
    "--at",
    type=Number(0, 1e6),
    help="Simulated time at which the scene is measured [s].  [default: half of the scene's, at most 2]",
)
@click.option("--rounds", type=WholeNumber(3, 1001), default=15, show_default=True, help="Turns of each comparison.")
@click.option("--only", metavar="e1,e2,...", help="Effects to measure.  [default: all]")
@pace_options
@solver_options
@click.option("--threads", type=WholeNumber(1, 256), default=1, show_default=True, help="Threads.")
@click.option("--list", "only_list", is_flag=True, help="List the effects, with those of the scene marked, and end.")
@click.option("--chart", type=OutputFile(), metavar="FILE", help="Write a bar chart (PNG).")
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def effects(
    scene_file: Path | None, at: float | None, rounds: int, only: str | None, only_list: bool, **options: Any
) -> None:
    """What each effect of a SCENE costs, and what others would.

    The scene is run to a moment. From there the same steps are made with and without each effect that it has, and with and
    without each that it could have, in turns; the bare scene has none. At the end a recommendation: which effects the
    scene calls for, which are on and do nothing, and what leaving the others out saves. Without SCENE: a scene with most
    effects in it.

    Exit code 1 when the scene breaks before it is measured.
    """
    from ..advising import scene_advice
    from ..effects.catalogue import effects_on
    from ..effects.cost_chart import save_chart
    from ..effects.measure import BrokenScene, Plan, measure, names
    from ..effects.report import report_of, text_of

    scene = _scene(scene_file)
    wanted = None if only is None else [word.strip() for word in only.split(",")]
    unknown = sorted(set(wanted or ()) - set(names()))
    if unknown:
        raise InputError(f"--only: {not_one_of(unknown[0], names())}")
    if only_list:
        on = effects_on(scene)
        click.echo("\n".join(f"{'*' if name in on else ' '} {name}" for name in names()))
        return
    chart, json_target = options.pop("chart"), options.pop("json_target")
    settings = run_settings(scene, options)
    plan = Plan(min(scene.seconds / 2, LONGEST_SETTLING) if at is None else at, rounds, wanted)
    try:
        report = report_of(measure(scene, settings, plan))
    except BrokenScene as problem:
        click.echo(f"check failed: {problem}", err=True)
        sys.exit(EXIT_CHECK_FAILED)
    emit_json(report, json_target)
    if chart is not None:
        save_chart(report, chart)
    if json_target != "-":
        click.echo(text_of(report))
        for line in scene_advice(scene, settings).lines:
            click.echo(f"advice: {line}")
        if chart is not None:
            click.echo(f"chart: {chart}")


def _scene(path: Path | None) -> Any:
    from ..loading import load_scene

    if path is not None:
        return load_scene(path)
    with resources.as_file(resources.files("pbmpm.lab") / "data" / DEFAULT_SCENE) as default:
        return load_scene(default)
