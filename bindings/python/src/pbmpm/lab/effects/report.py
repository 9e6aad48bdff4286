"""The costs of effects as JSON and as text."""

from __future__ import annotations

from typing import Any

import pbmpm

from ..machine import machine_facts
from ..simulation import versions
from .advice import advice_of, advice_text, is_sure
from .catalogue import presences, remarks
from .measure import Measurement

METHOD = (
    "CPU time of the process in the library's calls; scene and variant in turns from the same state, median of the ratios;"
    " percent of the step of the scene as it is"
)


def report_of(measured: Measurement) -> dict[str, Any]:
    """The report: rows, sums, the recommendation, and how it was measured."""
    rows = [{**cost.as_row(), "dims": measured.scene.dimension} for cost in measured.costs]
    return {
        "scene": measured.scene.name,
        "dimension": measured.scene.dimension,
        **measured.settings.as_dict(),
        "at_seconds": measured.time,
        "particles": measured.particles,
        "rows": rows,
        "scene_ns_per_particle_step": measured.nanoseconds,
        "scene_bytes_per_particle": measured.bytes_per_particle,
        "control_percent_of_step": measured.control_percent,
        "interplay_ns_per_particle_step": measured.interplay,
        "interplay_percent_of_step": 100 * measured.interplay / measured.nanoseconds,
        "left_out": measured.left_out,
        "remarks": remarks(measured.scene),
        "advice": advice_of([item.effect.name for item in presences(measured.scene) if item.called_for], rows[1:]),
        "method": METHOD,
        "steps_per_turn": measured.steps_per_turn,
        "rounds": measured.rounds,
        "pinned": measured.pinned,
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), measured.settings.threads),
    }


def text_of(report: dict[str, Any]) -> str:
    """The report for a person: table, sums, recommendation."""
    machine = report["machine"]
    lines = [
        f"{report['scene']} ({report['dimension']}D) at {report['at_seconds']:.3g} s: {report['particles']} particles,"
        f" {report['solver']}, {report['rate_hz']:g} Hz, {report['substeps']} x {report['iterations']} iterations",
        f"{report['scene_ns_per_particle_step']:.1f} ns per particle and step, {report['scene_bytes_per_particle']:.0f} bytes per"
        f" particle ({machine['isa']}, {machine['threads']} thread(s), {machine['cpu']}, {machine['date'][:10]})",
        "",
        table(report["rows"]),
        f"interplay of the effects that are on: {report['interplay_percent_of_step']:+.1f} %; the scene over itself:"
        f" {report['control_percent_of_step']:+.1f} %",
        *(f"not measured: {name}: {why}" for name, why in report["left_out"].items()),
        "",
        *report["remarks"],
        advice_text(report["advice"]),
    ]
    return "\n".join(lines)


def table(rows: list[dict[str, Any]]) -> str:
    """One line per row; costs that cannot be told from none are in brackets."""
    lines = [["effect", "on", "ns", "% of step", "+-", "bytes", ""]]
    for row in rows:
        percent = f"{row['percent_of_step']:.1f}"
        lines.append(
            [
                row["effect"],
                "yes" if row["on"] else "no",
                f"{row['ns_per_particle_step']:.2f}",
                percent if is_sure(row) else f"({percent})",
                f"{row['percent_error']:.1f}",
                whole(row["bytes_per_particle"]),
                row["description"] + (f": {row['tried_as']}" if row.get("tried_as") else ""),
            ]
        )
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return "\n".join(_line(line, widths) for line in lines)


def whole(value: float) -> str:
    """A number of bytes; less than half a byte is none, and has no sign."""
    return str(round(value))


def _line(line: list[str], widths: list[int]) -> str:
    """Words to the left, figures to the right."""
    name, on, *figures, remark = line
    cells = [name.ljust(widths[0]), on.ljust(widths[1])]
    cells += [figure.rjust(width) for figure, width in zip(figures, widths[2:-1], strict=True)]
    return "  ".join([*cells, remark]).rstrip()
