"""``pbmpm tune``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from .options import (
    EXIT_CHECK_FAILED,
    JSON_HELP,
    Number,
    OutputFile,
    OutputFolder,
    WholeNumber,
    chosen_timed_workers,
    emit_json,
    ready_folder,
    worker_options,
)

_PERCENTILES = {"median": 50.0, "p99": 99.0}


@click.command()
@click.argument("scene_file", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--budget-ms",
    type=Number(0, 1e6, min_open=True),
    required=True,
    help="Wall time that a frame may take [ms].",
)
@click.option(
    "--frame-rate",
    type=Number(0.1, 1e4),
    default=60.0,
    show_default=True,
    help="Frames per simulated second.",
)
@click.option(
    "--seconds", type=Number(0, 1e6, min_open=True), help="Simulated time [s].  [default: the scene's]"
)
@click.option(
    "--fit",
    type=click.Choice(list(_PERCENTILES)),
    default="median",
    show_default=True,
    help="Frame time that has to keep the budget: the median, or what 99 of 100 frames keep.",
)
@click.option(
    "--reference-substeps", type=WholeNumber(2, 256), default=16, show_default=True, help="Of the reference."
)
@click.option(
    "--reference-iterations", type=WholeNumber(1, 1000), default=100, show_default=True, help="Of the reference."
)
@click.option("--threads", type=WholeNumber(0, 256), default=0, show_default=True, help="Threads; 0: one per core.")
@worker_options("1; else settings are timed at the same time, each on a core of its own")
@click.option(
    "--output",
    type=OutputFolder(),
    help="Folder for presets and chart.  [default: NAME-tune]",
)
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def tune(
    scene_file: Path, output: Path | None, json_target: str | None, processes: int | None, scheduler: str | None, **options: Any
) -> None:
    """Find settings for a SCENE that fit into a time budget per frame.

    The scene is solved as well as it goes, then with many combinations of solver, substeps and iterations on the same
    grid, and each is judged by its distance from the first. Calm scenes are compared particle by particle, chaotic ones by
    their fronts, heights and kinetic energy. Written are a chart and the presets low, medium and high (a quarter, half and
    all of the budget) and reference, for 'pbmpm run --preset'.

    Exit code 1 when nothing fits into the budget.
    """
    from ..loading import load_scene
    from ..advising import scene_advice
    from ..simulation import RunSettings
    from ..tune.sweep_chart import save_chart
    from ..tune.presets import presets, save_presets
    from ..tune.report import closing_line, report_of, text_of
    from ..tune.sweep import Plan
    from ..tune.sweep import tune as sweep

    scene = load_scene(scene_file)
    plan = Plan(
        seconds=options["seconds"] or scene.seconds,
        frame_rate=options["frame_rate"],
        budget_ms=options["budget_ms"],
        threads=options["threads"],
        percentile=_PERCENTILES[options["fit"]],
        reference_substeps=options["reference_substeps"],
        reference_iterations=options["reference_iterations"],
    )
    workers = chosen_timed_workers(processes, scheduler, plan.threads)
    folder = output or Path(f"{scene.name}-tune")
    ready_folder(folder)
    tuning = sweep(scene, plan, workers)
    report = report_of(tuning)
    made = presets(tuning, report["machine"])
    paths = save_presets(made, folder)
    save_chart(tuning, report["machine"], folder / "chart.png")
    emit_json(
        {**report, "presets": {level: preset.model_dump(mode="json") for level, preset in made.items()}}, json_target
    )
    if json_target != "-":
        click.echo(text_of(tuning, made, paths))
        for level, preset in made.items():
            for line in scene_advice(scene, RunSettings.of(scene, plan.threads, **preset.settings.changes())).lines:
                click.echo(f"advice at '{level}': {line}")
        click.echo(f"chart: {folder / 'chart.png'}")
    if "high" in made and (made["high"].ms_p99 or 0.0) > plan.budget_ms:
        click.echo(f"note: one frame in a hundred of 'high' takes {made['high'].ms_p99:.3g} ms or more", err=True)
    if "high" not in made:
        click.echo(f"check failed: {closing_line(tuning)}", err=True)
        sys.exit(EXIT_CHECK_FAILED)
