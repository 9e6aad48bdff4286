"""The sweep as a picture and as text."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from ..files import save_figure
from ..report.pareto import axis_span
from ..simulation import RunSettings
from .sweep import Result, Tuning

_COLOURS = {"paper": "#c8781e", "convergent": "#4a4a4a", "dual": "#1f6fb4", "primal": "#1d8a5b", "explicit": "#a0479a"}
_MARKERS = ("o", "s", "D", "^", "v", "P")
_SMALLEST_ERROR = 1e-6  # [cells]
_BROKEN_HEADROOM = 2.0  # how far above the highest error settings are drawn that have none, as a factor


def setting_text(settings: RunSettings) -> str:
    """A setting within one sweep, where the frame rate is the same for all."""
    count = "" if settings.solver == "explicit" else f" x {settings.iterations}"
    target = f", to {settings.target_error:g} cells" if settings.target_error else ""
    return f"{settings.solver_text()} {settings.substeps}{count}{target}"


def error_title(tuning: Tuning) -> str:
    """What the error is, for people."""
    if tuning.reference.by_particles:
        return "RMS distance of the particles from the converged solution [cells]"
    return "RMS distance of fronts, heights and kinetic energy from the converged solution [cells]"


def save_chart(tuning: Tuning, machine: dict[str, Any], path: Path) -> None:
    """Writes the chart as PNG: dots, crosses for settings that are not stable, the front and the budget. Settings that were
    given up have no error, and those whose process died no cost; they are in the table only."""
    figure = Figure(figsize=(10, 7), layout="constrained")
    axes = figure.add_subplot()
    drawn = [result for result in tuning.results if not result.too_dear and math.isfinite(result.cost)]
    _draw_settings(axes, drawn)
    if not drawn:
        axes.text(0.5, 0.5, "no setting was measured to its end: all are far too dear", transform=axes.transAxes, ha="center")
    _draw_front(axes, tuning.front())
    axes.axvline(tuning.plan.budget_ms, color="#b03a48", linestyle=":", label=f"budget: {tuning.plan.budget_ms:g} ms")
    if tuning.reference.floor > 0:
        axes.axhline(
            tuning.reference.floor, color="#777777", linestyle="--", linewidth=0.8, label="accuracy of the reference"
        )
    axes.set(
        xscale="log", yscale="log", xlabel=f"wall ms per frame, {_percentile_name(tuning)}", ylabel=error_title(tuning)
    )
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlim(axis_span((result.cost for result in drawn), tuning.plan.budget_ms))
    axes.legend(fontsize=8)
    axes.grid(True, which="both", linewidth=0.3)
    axes.set_title(
        f"{tuning.scene.name}, {tuning.plan.frame_rate:g} frames/s. {machine['cpu']}, {machine['isa']},"
        f" {machine['threads']} threads, {machine['date'][:10]}. Crosses: not stable. Labels: substeps x iterations",
        fontsize=8,
    )
    save_figure(figure, path)


def _draw_settings(axes: Axes, results: list[Result]) -> None:
    ceiling = _BROKEN_HEADROOM * max((result.error for result in results if math.isfinite(result.error)), default=1.0)
    groups: dict[str, list[Result]] = {}
    for result in results:
        groups.setdefault(result.settings.solver_text(), []).append(result)
    for marker, (name, members) in zip(itertools.cycle(_MARKERS), groups.items(), strict=False):
        colour = _COLOURS[members[0].settings.solver]
        for usable, shape in ((True, marker), (False, "x")):
            own = [result for result in members if result.usable is usable]
            errors = [_drawn(min(result.error, ceiling)) for result in own]
            costs = [result.cost for result in own]
            axes.plot(costs, errors, shape, color=colour, label=name if usable else None, markersize=6)


def _draw_front(axes: Axes, front: list[Result]) -> None:
    axes.plot([item.cost for item in front], [_drawn(item.error) for item in front], color="#777777", zorder=0)
    for item in front:
        place = (item.cost, _drawn(item.error))
        axes.annotate(setting_text(item.settings), place, textcoords="offset points", xytext=(5, 5), fontsize=7)


def _drawn(error: float) -> float:
    return max(_SMALLEST_ERROR, error)


def _percentile_name(tuning: Tuning) -> str:
    return "median" if tuning.plan.percentile == 50 else f"{tuning.plan.percentile:g}th percentile"


def table(tuning: Tuning) -> str:
    """All settings, cheap ones first; those on the front are starred."""
    front = {id(item) for item in tuning.front()}
    rows = [["", "setting", "error", "top", "median ms", "p99 ms", "used", "fits", ""]]
    for result in sorted(tuning.results, key=lambda item: item.cost):
        rows.append(
            [
                "*" if id(result) in front else "",
                setting_text(result.settings),
                f"{result.error:.3g}" if math.isfinite(result.error) else "-",
                f"{result.seen.cells:+.2f}" if result.seen else "-",
                f"{result.ms_median:.2f}",
                f"{result.ms_p99:.2f}",
                f"{result.iterations_used:.1f}",
                "yes" if result.cost <= tuning.plan.budget_ms else "no",
                "; ".join(result.reasons) or ("given up: far too dear" if result.too_dear else ""),
            ]
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return "\n".join(_line(row, widths) for row in rows)


def _line(row: list[str], widths: list[int]) -> str:
    """Words to the left, figures to the right."""
    star, setting, *figures, remark = row
    cells = [star.rjust(widths[0]), setting.ljust(widths[1])]
    cells += [figure.rjust(width) for figure, width in zip(figures, widths[2:-1], strict=True)]
    return "  ".join([*cells, remark]).rstrip()
