"""``pbmpm bench``."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

import click

from ..options import JSON_HELP, NameList, emit_json
from .subjects import MATERIALS, QUICK_MATERIALS, VARIANTS


@click.command()
@click.option("--solvers", type=NameList(VARIANTS), help="Solvers to measure.  [default: all]")
@click.option("--materials", type=NameList(list(MATERIALS)), help=f"Kinds of matter.  [default: {','.join(QUICK_MATERIALS)}]")
@click.option("--dims", type=NameList(["2", "3"]), help="Dimensions.  [default: both]")
@click.option("--rounds", type=click.IntRange(1, 1000), default=5, show_default=True, help="Times that each solver has its turn.")
@click.option("--warmup-steps", type=click.IntRange(0, 10000), default=60, show_default=True, help="Motion before the measurement.")
@click.option("--lake", is_flag=True, help="Measure instead what a jelly in a lake costs over both by themselves.")
@click.option("--pool", is_flag=True, help="Measure instead a pool asleep against awake, and what one drop wakes in it.")
@click.option("--json", "json_target", metavar="FILE", help=JSON_HELP)
def bench(json_target: str | None, rounds: int, warmup_steps: int, lake: bool, pool: bool, **options: Any) -> None:
    """Measure what an iteration and a step cost, per particle, with each solver.

    Dam breaks and falling blocks, 40,000 to 200,000 particles, on one thread that stays on one core. The solvers step from the
    same state, in turns. PBMPM_ISA=sse4, avx2 or avx512 chooses the kernels.
    """
    import pbmpm

    from ..machine import machine_facts
    from ..progress import progress_bar
    from ..simulation import versions
    from .lake import LAKE_VARIANTS, lake_text
    from .measure import measure, pieces, pin
    from .pool import PACES, pool_text
    from .report import ratios_of, row_of, text_of

    variants = options["solvers"] or VARIANTS
    if lake and pool:
        raise click.UsageError("--lake and --pool measure different things: choose one.")
    if pool and (strange := [variant for variant in options["solvers"] or () if variant not in PACES]):
        raise click.UsageError(f"--pool measures {' and '.join(PACES)}, not {', '.join(strange)}.")
    if lake or pool:
        report = _pool_report(options["solvers"] or list(PACES), rounds) if pool else _lake_report(options["solvers"] or LAKE_VARIANTS, rounds)
        emit_json(report, json_target)
        if json_target != "-":
            click.echo((pool_text if pool else lake_text)(report["rows"]))
        return
    subjects = [(name, int(dims)) for dims in options["dims"] or ("3", "2") for name in options["materials"] or QUICK_MATERIALS]
    core, rows, ratios = pin(), [], []
    with progress_bar(len(subjects) * pieces(rounds), "round", "bench") as bar:
        for material, dimension in subjects:
            costs = measure(material, dimension, variants, rounds, warmup_steps, bar.update)
            rows += [row_of(material, dimension, own) for own in costs]
            ratios += ratios_of(material, dimension, costs)
    report = {
        "rows": rows,
        "ratios": ratios,
        "rounds": rounds,
        "warmup_steps": warmup_steps,
        "core": core,
        "compilers": _compilers(),
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), 1),
    }
    emit_json(report, json_target)
    if json_target != "-":
        click.echo(text_of(report))


def _lake_report(variants: Sequence[str], rounds: int) -> dict[str, Any]:
    from .lake import lake_pieces, lake_row, measure_lake

    def row_of(variant: str, tick: Callable[[], None]) -> dict[str, Any]:
        return lake_row(variant, measure_lake(variant, rounds, tick))

    return _scene_report("bench --lake", variants, rounds, lake_pieces(rounds), row_of)


def _pool_report(variants: Sequence[str], rounds: int) -> dict[str, Any]:
    from .pool import measure_pool, pool_pieces, pool_row

    def row_of(variant: str, tick: Callable[[], None]) -> dict[str, Any]:
        return pool_row(measure_pool(variant, rounds, tick))

    return _scene_report("bench --pool", variants, rounds, pool_pieces(), row_of)


def _scene_report(
    name: str, variants: Sequence[str], rounds: int, pieces: int, row_of: Callable[[str, Callable[[], None]], dict[str, Any]]
) -> dict[str, Any]:
    """The report of a scene that is measured with each solver by itself."""
    import pbmpm

    from ..machine import machine_facts
    from ..progress import progress_bar
    from ..simulation import versions
    from .measure import pin

    core = pin()
    with progress_bar(len(variants) * pieces, "round", name) as bar:
        rows = [row_of(variant, bar.update) for variant in variants]
    return {"rows": rows, "rounds": rounds, "core": core, "versions": versions(), "machine": machine_facts(pbmpm.isa(), 1)}


def _compilers() -> list[str]:
    """The compilers that left their names in the library."""
    from pbmpm._library import library_path

    found = re.findall(rb"GCC: \([^)]*\) ([\d.]+)|clang version ([\d.]+)|ISPC\), ([\d.]+)", library_path().read_bytes())
    names = ("gcc", "clang", "ISPC")
    return sorted({f"{name} {text.decode()}" for parts in found for name, text in zip(names, parts) if text})
