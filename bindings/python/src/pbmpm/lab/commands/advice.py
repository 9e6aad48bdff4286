"""``pbmpm advice``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from .options import JSON_HELP, OutputFile, emit_json, own_command, pace_options, preset_option, run_settings, solver_options


@click.command()
@click.argument("scene_file", metavar="SCENE", type=click.Path(path_type=Path))
@pace_options
@solver_options
@preset_option
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def advice(scene_file: Path, json_target: str | None, **options: Any) -> None:
    """What a SCENE will not hold with its settings, and what would help.

    No step is made. 'pbmpm run' prints the same before a run, and after it what came true.
    """
    from ..advising import scene_advice
    from ..loading import load_scene

    scene = load_scene(scene_file)
    settings = run_settings(scene, {**options, "threads": 1})
    found = scene_advice(scene, settings)
    emit_json({"command": own_command(), "scene": scene.name, "advice": found.rows}, json_target)
    if json_target == "-":
        return
    for line in found.lines or ["nothing is foreseen; that does not promise that all goes well"]:
        click.echo(line)
