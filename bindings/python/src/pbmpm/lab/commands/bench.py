"""``pbmpm bench``."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import click

from .options import JSON_HELP, NameList, OutputFile, WholeNumber, emit_json
from ..bench.subjects import MATERIALS, QUICK_MATERIALS, VARIANTS

WARMUP_STEPS = 60

Report = dict[str, Any]
Measured = tuple[Report, str]
"""A report, and the same for a person."""


@click.command()
@click.argument("scene_files", metavar="[SCENE]...", nargs=-1, type=click.Path(path_type=Path))
@click.option("--solvers", type=NameList(VARIANTS), help="Solvers to measure.  [default: all]")
@click.option("--materials", type=NameList(list(MATERIALS)), help=f"Kinds of matter.  [default: {','.join(QUICK_MATERIALS)}]")
@click.option("--dims", type=NameList(["2", "3"]), help="Dimensions.  [default: both]")
@click.option("--rounds", type=WholeNumber(1, 1000), default=5, show_default=True, help="Times that each solver has its turn.")
@click.option("--warmup-steps", type=WholeNumber(0, 10000), help=f"Motion before the measurement.  [default: {WARMUP_STEPS}]")
@click.option("--lake", is_flag=True, help="Measure instead what a jelly in a lake costs over both by themselves.")
@click.option("--pool", is_flag=True, help="Measure instead a pool asleep against awake, and what one drop wakes in it.")
@click.option("--phases", is_flag=True, help="Measure instead where the time of a step goes, at 60 Hz x 5.")
@click.option("--roofline", is_flag=True, help="The same beside what one core can do; counts with Valgrind, for minutes.")
@click.option("--peers", is_flag=True, help="Measure instead beside Taichi's examples, in turns.")
@click.option("--peer-python", metavar="PYTHON", type=click.Path(exists=True, dir_okay=False, path_type=Path), help="A Python that has Taichi.  [default: this one]")
@click.option("--memory", is_flag=True, help="Measure instead the bytes that worlds take.")
@click.option("--against", metavar="LIBRARY", type=click.Path(exists=True, dir_okay=False, path_type=Path), help="Measure this build against another, in turns.")
@click.option("--json", "json_target", type=OutputFile(dash=True), metavar="FILE", help=JSON_HELP)
def bench(scene_files: tuple[Path, ...], json_target: str | None, rounds: int, **options: Any) -> None:
    """Measure what an iteration and a step cost, per particle, with each solver.

    Dam breaks and falling blocks, 40,000 to 200,000 particles, on one thread that stays on one core. The solvers step from the
    same state, in turns. PBMPM_ISA=sse4, avx2 or avx512 chooses the kernels.

    It says which build it measures, a strict one (PBMPM_STRICT) or an ordinary one. With --against it measures instead how many times as long
    a step takes with this build as with that of another library: what strictness costs.

    --phases, --roofline, --peers and --memory measure steps at the pace of a game: where their time goes, what share of a core's peak
    and bandwidth that is, how they compare with Taichi's examples (pip install 'pbmpm[peers]'), and what worlds take. --roofline counts
    operations and bytes with Valgrind and objdump; without them it leaves shares out.

    With SCENE files it measures instead how many times faster than real time each runs, as its file says and at the pace of a
    game, 60 Hz x 5.
    """
    chosen = [mode for mode in MODES if options[mode]]
    if len(chosen) > 1:
        raise click.UsageError(f"--{' and --'.join(chosen)} measure different things: choose one.")
    if options["peer_python"] and not options["peers"]:
        raise click.UsageError("--peer-python says how --peers runs, which is not there.")
    if scene_files:
        report, text = _scenes(scene_files, rounds, options)
    else:
        report, text = MODES[chosen[0]](rounds, options) if chosen else _matter(rounds, options)
    emit_json(report, json_target)
    if json_target != "-":
        click.echo(f"The library is a{' strict' if report['strict'] else 'n ordinary'} build.\n{text}")


def _matter(rounds: int, options: dict[str, Any]) -> Measured:
    """Each kind of matter with each solver."""
    from ..bench.measure import measure, pieces
    from ..bench.report import ratios_of, row_of, text_of

    warmup_steps, subjects = _warmup_steps(options), _subjects(options, ("3", "2"))
    ratios: list[dict[str, Any]] = []

    def rows(tick: Callable[[], None]) -> list[dict[str, Any]]:
        found = []
        for material, dimension in subjects:
            costs = measure(material, dimension, options["solvers"] or VARIANTS, rounds, warmup_steps, tick)
            found += [row_of(material, dimension, own) for own in costs]
            ratios.extend(ratios_of(material, dimension, costs))
        return found

    report = _report("bench", rounds, len(subjects) * pieces(rounds), rows)
    report |= {"ratios": ratios, "warmup_steps": warmup_steps, "compilers": _compilers()}
    return report, text_of(report)


def _builds(rounds: int, options: dict[str, Any]) -> Measured:
    """This build against another."""
    import pbmpm

    from ..machine import machine_facts
    from ..progress import progress_bar
    from ..simulation import versions
    from ..bench.builds import builds_text, measure_builds

    passed = [part for name in ("solvers", "materials", "dims") if options[name] for part in (f"--{name}", ",".join(options[name]))]
    passed += [] if options["warmup_steps"] is None else ["--warmup-steps", str(options["warmup_steps"])]
    with progress_bar(2 * rounds, "turn", "bench --against") as bar:
        report = measure_builds(pbmpm.library_path(), options["against"], passed, rounds, bar.update)
    report |= {"rounds": rounds, "versions": versions(), "machine": machine_facts(pbmpm.isa(), 1), "compilers": _compilers()}
    return report, builds_text(report)


def _water(rounds: int, options: dict[str, Any]) -> Measured:
    """The lake or the pool."""
    from ..bench.lake import LAKE_VARIANTS, lake_pieces, lake_row, lake_text, measure_lake
    from ..bench.pool import PACES, measure_pool, pool_pieces, pool_row, pool_text

    solvers, pool = options["solvers"], options["pool"]
    if pool and (strange := [variant for variant in solvers or () if variant not in PACES]):
        raise click.UsageError(f"--pool measures {' and '.join(PACES)}, not {', '.join(strange)}.")
    if pool:
        variants: Sequence[str] = solvers or list(PACES)
        report = _report(
            "bench --pool",
            rounds,
            len(variants) * pool_pieces(),
            lambda tick: [pool_row(measure_pool(variant, rounds, tick)) for variant in variants],
        )
        return report, pool_text(report["rows"])
    variants = solvers or LAKE_VARIANTS
    report = _report(
        "bench --lake",
        rounds,
        len(variants) * lake_pieces(rounds),
        lambda tick: [lake_row(variant, measure_lake(variant, rounds, tick)) for variant in variants],
    )
    return report, lake_text(report["rows"])


def _subjects(options: dict[str, Any], dims: Sequence[str]) -> list[tuple[str, int]]:
    """Kinds of matter and dimensions to measure; ``dims``: unless others are asked for."""
    return [(name, int(dimension)) for dimension in options["dims"] or dims for name in options["materials"] or QUICK_MATERIALS]


def _warmup_steps(options: dict[str, Any]) -> int:
    return WARMUP_STEPS if options["warmup_steps"] is None else int(options["warmup_steps"])


def _phases(rounds: int, options: dict[str, Any]) -> Measured:
    """Where the time of a step goes."""
    from ..bench.phases import measure_phases, phase_pieces, phase_rows, phases_text

    def rows(material: str, dimension: int, variants: Sequence[str], tick: Callable[[], None]) -> list[dict[str, Any]]:
        costs = measure_phases(material, dimension, variants, rounds, _warmup_steps(options), tick)
        return [row for own in costs for row in phase_rows(material, dimension, own)]

    report = _subject_report("bench --phases", rounds, options, ("3", "2"), lambda variants: phase_pieces(rounds), rows)
    return report, phases_text(report["rows"])


def _roofline(rounds: int, options: dict[str, Any]) -> Measured:
    """The same beside what a core can do."""
    import pbmpm

    from ..bench.counts import missing_tools
    from ..bench.roofline import COUNTED_ISAS, measure_roofline, roofline_pieces, roofline_text

    if not missing_tools() and pbmpm.isa() not in COUNTED_ISAS:
        raise click.UsageError(f"--roofline counts with Valgrind, which runs {' and '.join(COUNTED_ISAS)}, not {pbmpm.isa()}: set PBMPM_ISA=avx2.")

    def rows(material: str, dimension: int, variants: Sequence[str], tick: Callable[[], None]) -> list[dict[str, Any]]:
        return measure_roofline(material, dimension, variants, rounds, _warmup_steps(options), tick)

    report = _subject_report("bench --roofline", rounds, options, ("3",), lambda variants: roofline_pieces(rounds), rows)
    return report, roofline_text(report["rows"])


def _memory(rounds: int, options: dict[str, Any]) -> Measured:
    """Bytes of worlds."""
    from ..bench.memory import measure_memory, memory_pieces, memory_text

    steps = _warmup_steps(options)

    def rows(material: str, dimension: int, variants: Sequence[str], tick: Callable[[], None]) -> list[dict[str, Any]]:
        return measure_memory(material, dimension, variants, steps, tick)

    report = _subject_report("bench --memory", rounds, options, ("3",), memory_pieces, rows)
    return report, memory_text(report["rows"], steps)


def _peers(rounds: int, options: dict[str, Any]) -> Measured:
    """Beside Taichi's examples."""
    from ..bench.peers import PAIRS, RUNNER, measure_peer, peer_pieces, peers_text

    if options["solvers"]:
        raise click.UsageError("--peers measures the paper's and the convergent solver: --solvers cannot be used with it.")
    python = options["peer_python"] or sys.executable
    pairs = [pair for pair in PAIRS if pair[1] in (options["materials"] or QUICK_MATERIALS) and str(pair[2]) in (options["dims"] or ("2", "3"))]
    report = _report(
        "bench --peers",
        rounds,
        len(pairs) * peer_pieces(rounds),
        lambda tick: [
            row for pair in pairs for row in measure_peer([str(python), str(RUNNER), pair[0]], pair, rounds, _warmup_steps(options), tick)
        ],
    )
    report |= {"warmup_steps": _warmup_steps(options), "compilers": _compilers()}
    return report, peers_text(report["rows"])


def _subject_report(
    name: str,
    rounds: int,
    options: dict[str, Any],
    dims: Sequence[str],
    pieces: Callable[[Sequence[str]], int],
    rows: Callable[[str, int, Sequence[str], Callable[[], None]], list[dict[str, Any]]],
) -> Report:
    """Of each kind of matter, with the solvers that differ there; ``dims``: unless others are asked for."""
    from ..bench.phases import PHASE_VARIANTS
    from ..bench.subjects import applies

    if "explicit" in (options["solvers"] or ()):
        raise click.UsageError(f"{name} measures 60 Hz x 5, and the explicit solver has no iterations.")
    subjects = [
        (material, dimension, [variant for variant in options["solvers"] or PHASE_VARIANTS if applies(variant, material)])
        for material, dimension in _subjects(options, dims)
    ]
    report = _report(
        name,
        rounds,
        sum(pieces(variants) for *_, variants in subjects),
        lambda tick: [row for subject in subjects for row in rows(*subject, tick)],
    )
    return report | {"warmup_steps": _warmup_steps(options), "compilers": _compilers()}


def _scenes(scene_files: Sequence[Path], rounds: int, options: dict[str, Any]) -> Measured:
    """Whole scenes against real time."""
    from ..loading import load_scene
    from ..bench.scenes import measure_scenes, scene_pieces, scene_row, scenes_text

    if strange := [f"--{name.replace('_', '-')}" for name, value in options.items() if value is not None and value is not False]:
        raise click.UsageError(f"scenes run as their files say: {', '.join(strange)} cannot be used with them.")
    scenes = [load_scene(path) for path in scene_files]
    report = _report(
        "bench scenes",
        rounds,
        scene_pieces(scenes, rounds),
        lambda tick: [scene_row(own) for own in measure_scenes(scenes, rounds, tick)],
    )
    return report, scenes_text(report["rows"])


def _report(name: str, rounds: int, pieces: int, rows: Callable[[Callable[[], None]], list[dict[str, Any]]]) -> Report:
    """The rows with where they come from; this process stays on one core from now on."""
    import pbmpm

    from ..machine import machine_facts
    from ..progress import progress_bar
    from ..simulation import versions
    from ..bench.measure import pin

    core = pin()
    with progress_bar(pieces, "round", name) as bar:
        measured = rows(bar.update)
    return {"rows": measured, "rounds": rounds, "core": core, "strict": pbmpm.is_strict(), "versions": versions(), "machine": machine_facts(pbmpm.isa(), 1)}


MODES: dict[str, Callable[[int, dict[str, Any]], Measured]] = {
    "against": _builds,
    "lake": _water,
    "pool": _water,
    "phases": _phases,
    "roofline": _roofline,
    "peers": _peers,
    "memory": _memory,
}
"""By the option that chooses it, what is measured instead of each kind of matter with each solver."""


def _compilers() -> list[str]:
    """The compilers that left their names in the library."""
    from pbmpm._library import library_path

    found = re.findall(rb"GCC: \([^)]*\) ([\d.]+)|clang version ([\d.]+)|ISPC\), ([\d.]+)", library_path().read_bytes())
    names = ("gcc", "clang", "ISPC")
    return sorted({f"{name} {text.decode()}" for parts in found for name, text in zip(names, parts) if text})
