"""What effects cost, as a bar chart (PNG)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..files import save_figure
from .report import whole

_BARE, _ON, _IDLE, _OFF = "#8a9bb0", "#1f6fb4", "#b03a48", "#d9b382"
_LINE_INCHES = 0.3
_LABELS = {
    _BARE: "bare scene",
    _ON: "on",
    _IDLE: "on, and does nothing",
    _OFF: "off: what it would cost",
}


def save_chart(report: dict[str, Any], path: Path) -> None:
    """Writes the chart: time to the left, memory to the right, a bar per effect."""
    rows = report["rows"]
    figure = Figure(figsize=(12, 1.6 + _LINE_INCHES * len(rows)), layout="constrained")
    times, memory = figure.subplots(1, 2, sharey=True, width_ratios=(2, 1))
    _bars(times, rows, "percent_of_step", "percent of the scene's step (line: standard error)", "percent_error")
    _bars(memory, rows, "bytes_per_particle", "bytes per particle", None)
    times.set_yticks(range(len(rows)), [row["effect"] for row in rows])
    times.invert_yaxis()
    used = {_colour(row) for row in rows}
    handles = [Patch(color=colour, label=label) for colour, label in _LABELS.items() if colour in used]
    times.legend(handles=handles, fontsize=8, loc="lower right")
    machine = report["machine"]
    figure.suptitle(
        f"{report['scene']}, {report['particles']} particles: {report['scene_ns_per_particle_step']:.1f} ns per particle and step"
        f" ({report['solver']}, {report['rate_hz']:g} Hz x {report['iterations']}). {machine['cpu']}, {machine['isa']},"
        f" {machine['threads']} thread(s), {machine['date'][:10]}",
        fontsize=9,
    )
    save_figure(figure, path)


def _colour(row: dict[str, Any]) -> str:
    if "where" not in row:
        return _BARE
    if not row["on"]:
        return _OFF
    return _ON if row["called_for"] else _IDLE


def _bars(axes: Axes, rows: list[dict[str, Any]], key: str, label: str, error_key: str | None) -> None:
    values = [row[key] for row in rows]
    errors = [row[error_key] for row in rows] if error_key else None
    axes.barh(range(len(rows)), values, xerr=errors, color=[_colour(row) for row in rows], height=0.7)
    for place, value in enumerate(values):
        reach = value + (errors[place] if errors else 0.0)
        axes.annotate(
            f"{value:.1f}" if error_key else whole(value),
            (max(reach, 0.0), place),
            textcoords="offset points",
            xytext=(5, 0),
            va="center",
            fontsize=8,
        )
    axes.axvline(0.0, color="#444444", linewidth=0.8)
    axes.margins(x=0.12)
    axes.set_xlabel(label)
    axes.grid(True, axis="x", linewidth=0.3)
    axes.set_axisbelow(True)
