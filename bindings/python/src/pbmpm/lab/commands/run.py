"""``pbmpm run``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from ..errors import InputError
from ..meshes import MESH_FORMATS
from .options import EXIT_CHECK_FAILED, EXIT_INTERRUPTED, JSON_HELP, Number, OutputFile, OutputFolder, TimeList, WholeNumber, emit_json, pace_options, preset_option, ready_folder, run_settings, solver_options


@click.command()
@click.argument("scene_file", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--seconds", type=Number(0, 1e6, min_open=True), help="Simulated time [s].  [default: the scene's]"
)
@pace_options
@solver_options
@preset_option
@click.option("--threads", type=WholeNumber(0, 256), default=0, show_default=True, help="Threads; 0: one per core.")
@click.option(
    "--output", type=OutputFolder(), help="Folder for files.  [default: NAME-output]"
)
@click.option("--ply", is_flag=True, help="Write a PLY file per frame.")
@click.option("--vtk", is_flag=True, help="Write a VTU file per frame and a PVD index for ParaView.")
@click.option("--mesh", is_flag=True, help="Write a file per frame with the surfaces of all materials: triangles, normals, colours. Only in 3D.")
@click.option(
    "--mesh-format", type=click.Choice(MESH_FORMATS), help="What --mesh writes, and implies it. PLY has velocities, too.  [default: ply]"
)
@click.option("--every", type=WholeNumber(1), help="Steps between PLY/VTK frames.  [default: 30 frames per second]")
@click.option(
    "--pictures", type=TimeList(), help="Times of PNG pictures [s]; '' for none.  [default: the scene's, with --output]"
)
@click.option("--video", type=OutputFile(suffix=".gif"), metavar="FILE", help="Write an animated GIF, 480 pixels wide, at the pace of the scene.")
@click.option(
    "--warmup-steps",
    type=WholeNumber(0),
    default=0,
    show_default=True,
    help="First steps to leave out of the timing.",
)
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def run(scene_file: Path, json_target: str | None, warmup_steps: int, **options: Any) -> None:
    """Simulate a scene file, ours or one of the EA demo.

    Files are written only with --output, --ply, --vtk, --mesh, --pictures or --video. Ctrl-C ends the run after the current step and
    leaves complete files.
    """
    from ..effects.catalogue import remarks
    from ..runner import run_scene
    from ..loading import load_scene
    from ..simulation import solved_with

    scene = load_scene(scene_file)
    settings, seconds = run_settings(scene, options), options["seconds"] or scene.seconds
    for note in [*scene.notes, *remarks(solved_with(scene, settings))]:
        click.echo(f"note: {note}", err=True)
    if warmup_steps >= seconds * settings.rate_hz:
        raise InputError("--warmup-steps: leaves no step to measure")
    output = _output(scene, settings, seconds, options)
    result = run_scene(scene, settings, seconds, output, warmup_steps, lambda line: click.echo(line, err=True))
    emit_json(result.report, json_target)
    if json_target != "-":
        click.echo(_summary(result.report))
        if output.folder is not None:
            click.echo(f"files: {output.folder}")
        if output.video is not None:
            click.echo(f"video: {output.video}")
    for problem in result.problems:
        click.echo(f"check failed: {problem}", err=True)
    if result.interrupted:
        sys.exit(EXIT_INTERRUPTED)
    if result.problems:
        sys.exit(EXIT_CHECK_FAILED)


def _output(scene, settings, seconds: float, options: dict[str, Any]):
    from ..runner import OutputOptions

    wanted = options["pictures"]
    mesh = options["mesh_format"] or ("ply" if options["mesh"] else None)
    if mesh and scene.dimension != 3:
        raise InputError("--mesh: surfaces are made in 3D; this scene is in 2D")
    if options["output"] is None and not (options["ply"] or options["vtk"] or mesh or wanted):
        return OutputOptions(video=options["video"])
    folder = options["output"] or Path(f"{scene.name}-output")
    ready_folder(folder)
    times = scene.picture_times(seconds) if wanted is None else wanted
    late = [time for time in times if time > seconds]
    if late:
        raise InputError(f"--pictures: {late[0]:g} s is after the end of the run at {seconds:g} s")
    every = options["every"] or max(1, round(settings.rate_hz / 30))
    return OutputOptions(folder, options["ply"], options["vtk"], mesh, every, times, options["video"])


def _summary(report: dict[str, Any]) -> str:
    """The report for a person."""
    rate = report["million_particle_iterations_per_second"]
    lines = [
        f"{report['scene']}: {report['particles']} particles, {report['simulated_seconds']:.3f} s in"
        f" {report['steps']} steps of {report['substeps']} x {report['iterations']} iterations ({report['solver']})"
        + (" (interrupted)" if report["interrupted"] else ""),
        f"at the end: volume error {100 * report['volume_error_rms']:.2f} % rms, {100 * report['volume_error_max']:.1f} % max; max speed {report['max_speed']:.3g} m/s"
        f" ({report['max_speed_over_run']:.3g} on the way); deleted {report['deleted']}, clamped {report['clamped']}",
    ]
    lines += [f"effects: {', '.join(report['effects'])}", _account(report)]
    if "emitted" in report:
        lines.append(
            f"emitted {report['emitted_mass']:.4g} kg, drained {report['drained_mass']:.4g} kg, killed"
            f" {report['killed_mass']:.4g} kg; {report['refused']} particles were not emitted for want of space, budget or room"
        )
    if rate is not None:
        machine = report["machine"]
        lines.append(
            f"{report['ms_per_simulated_second']:.0f} ms per simulated second, {1e3 / report['ms_per_simulated_second']:.3g} times real time,"
            f" {rate:.1f} million particle-iterations/s"
            f" ({machine['isa']}, {machine['threads']} threads, {machine['cpu']})"
        )
    return "\n".join(lines)


def _account(report: dict[str, Any]) -> str:
    account = report["account"]
    missing = f" and {account['missing']} MISSING" if account["missing"] else ""
    return (
        f"particles: {account['start']} at start + {account['emitted']} emitted - {account['drained']} drained"
        f" - {account['killed']} killed - {account['deleted']} deleted = {account['now']} now{missing}"
    )
