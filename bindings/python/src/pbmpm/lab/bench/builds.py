"""What one build of the library costs over another.

A process loads one library, so each build has its turns as processes of their own: `pbmpm bench --rounds 3`. Both stand in each round, so that what
slows the machine down for a while slows both; the least times are disturbed least.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median
from typing import Any

import click

Key = tuple[str, int, str]
"""Material, dimension and solver."""

STEPS_PER_TURN = 3


def run_turn(library: Path, options: Sequence[str]) -> dict[str, Any]:
    """The report of one turn with a library, from a process of its own."""
    from pbmpm._library import PATH_VARIABLE

    command = [sys.executable, "-m", "pbmpm", "bench", "--rounds", str(STEPS_PER_TURN), "--json", "-", *options]
    result = subprocess.run(command, env=os.environ | {PATH_VARIABLE: str(library)}, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise click.ClickException(f"{library}: {result.stderr.strip()}")
    report: dict[str, Any] = json.loads(result.stdout)
    return report


def measure_builds(
    own: Path, other: Path, options: Sequence[str], rounds: int, tick: Callable[[], None], turn: Callable[..., dict[str, Any]] = run_turn
) -> dict[str, Any]:
    """Both builds in turns; ``tick`` is called twice per round."""
    reports: tuple[list[dict[str, Any]], list[dict[str, Any]]] = ([], [])
    for _ in range(rounds):
        for library, taken in zip((own, other), reports):
            taken.append(turn(library, options))
            tick()
    times, least = [[_times(taken, value) for taken in reports] for value in (_median_of, _least_of)]
    rows = [
        {
            "material": key[0],
            "dims": key[1],
            "solver": key[2],
            "ms_per_step": median(times[0][key]),
            "ms_per_step_other": median(times[1][key]),
            "times_as_long": median(a / b for a, b in zip(times[0][key], times[1][key])),
            "times_as_long_least": min(least[0][key]) / min(least[1][key]),
        }
        for key in times[0]
    ]
    return {"rows": rows, "strict": reports[0][0]["strict"], "strict_other": reports[1][0]["strict"]}


def _median_of(row: dict[str, Any]) -> float:
    return float(row["ms_per_step"])


def _least_of(row: dict[str, Any]) -> float:
    return float(1e-3 * row["iterations"] * row["particles"] / row["million_particle_iterations_per_second_max"])


def _times(reports: Sequence[dict[str, Any]], value: Callable[[dict[str, Any]], float]) -> dict[Key, list[float]]:
    """Milliseconds per step, turn by turn."""
    found: dict[Key, list[float]] = {}
    for report in reports:
        for row in report["rows"]:
            found.setdefault((row["material"], row["dims"], row["solver"]), []).append(value(row))
    return found


def build_name(strict: bool) -> str:
    """For a person."""
    return "strict" if strict else "ordinary"


def builds_text(report: dict[str, Any]) -> str:
    """The rows for a person."""
    machine = report["machine"]
    lines = [
        f"A step of this build ({build_name(report['strict'])}) over one of the other ({build_name(report['strict_other'])}): CPU time, median, and the"
        f" least over the least, of {report['rounds']} rounds in turns; {machine['cpu']}, {machine['isa']}, one thread, {machine['date'][:10]}"
    ]
    for row in report["rows"]:
        lines.append(
            f"  {row['material']} {row['dims']}D  {row['solver']:<12} {row['times_as_long']:.2f} times as long, {row['times_as_long_least']:.2f}"
            f"  ({row['ms_per_step']:.1f} ms, {row['ms_per_step_other']:.1f} ms)"
        )
    return "\n".join(lines)
