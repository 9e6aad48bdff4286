"""Charts of error against milliseconds per simulated second, as PNG."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from ..files import save_figure
from ..report.pareto import axis_span
from .case import CurvePanel, ErrorMeasure
from .sweep import CaseReport

REAL_TIME_MS = 1000.0
_COLOURS = ("#8a9bb0", "#2c7fb8", "#e8772e", "#7a3b9a", "#3c9a5c", "#b03a48", "#c2a83e", "#444444")
_FLOOR = 1e-6  # smallest error that a logarithmic axis shows


def save_chart(report: CaseReport, machine: dict[str, Any], path: Path) -> None:
    """Writes the chart of a case: its first errors, and its curves over the truth."""
    measures, panels = report.case.error_kinds[:2], report.case.panels
    count = len(measures) + len(panels)
    columns = min(2, count)
    lines = -(-count // columns)
    figure = Figure(figsize=(7.5 * columns, 5 * lines), layout="constrained")
    places = figure.subplots(lines, columns, squeeze=False).ravel()
    for place, measure in zip(places, measures):
        _error_panel(place, report, measure)
    for place, panel in zip(places[len(measures) :], panels):
        _curve_panel(place, report, panel)
    for place in places[count:]:
        place.set_visible(False)
    figure.suptitle(
        f"{report.case.title}; {machine['cpu']}, {machine['isa']}, {machine['threads']} thread(s),"
        f" {machine['date'][:10]}; crosses: not stable; figures: Hz x iterations",
        fontsize=10,
    )
    save_figure(figure, path, dpi=100)


def _error_panel(axes: Axes, report: CaseReport, measure: ErrorMeasure) -> None:
    name = measure.name
    groups: dict[tuple[str, int], list[dict[str, Any]]] = {}
    for row in report.rows:
        if row["errors"].get(name) is not None:
            groups.setdefault((row["variant"], row["cells"]), []).append(row)
    for colour, ((variant, cells), rows) in zip(_COLOURS * 4, groups.items()):
        for stable, marker in ((True, "o"), (False, "x")):
            chosen = [row for row in rows if row["stable"] is stable]
            costs = [row["ms_per_simulated_second"] for row in chosen]
            errors = [max(row["errors"][name], _FLOOR) for row in chosen]
            label = f"{variant}, {cells} cells" if stable else None
            axes.plot(costs, errors, color=colour, marker=marker, linestyle="", label=label)
            for row, cost, error in zip(chosen, costs, errors):
                text = f"{row['rate_hz']:g}x{row['iterations']}"
                axes.annotate(text, (cost, error), textcoords="offset points", xytext=(4, 4), fontsize=6, color=colour)
    if measure.tolerance is not None:
        axes.axhline(measure.tolerance, color="#444444", linewidth=0.8, linestyle="--")
    shown = axis_span((row["ms_per_simulated_second"] for rows in groups.values() for row in rows), REAL_TIME_MS)
    if shown[0] <= REAL_TIME_MS <= shown[1]:
        axes.axvline(REAL_TIME_MS, color="#b03a48", linewidth=1, linestyle=":", label="real time")
    axes.set(xscale="log", yscale="log", xlim=shown, title=f"{name}, {measure.kind}", xlabel="ms per simulated second")
    axes.xaxis.set_major_formatter(_plain)
    axes.xaxis.set_minor_formatter(lambda value, place: _plain(value, place) if f"{value:e}"[0] in "25" else "")
    axes.set_ylabel(f"error [{measure.unit}]")
    if measure.unit == "%":
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g}"))
        axes.yaxis.set_minor_formatter(FuncFormatter(lambda value, _: f"{100 * value:g}" if f"{value:e}"[0] in "25" else ""))
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(fontsize=8)


def _plain(value: float, _: object) -> str:
    return f"{value:g}"


def _curve_panel(axes: Axes, report: CaseReport, panel: CurvePanel) -> None:
    """Simulated curves of a few settings over the truth."""
    for colour, index in zip(_COLOURS[1:], _selection(report)):
        curve = report.measurements[index].curves.get(panel.name)
        if curve is not None:
            axes.plot(curve.times, curve.values, color=colour, label=report.settings[index].text())
    axes.plot(panel.truth.times, panel.truth.values, "ko", markersize=4, label=panel.truth_label)
    first, last = panel.truth.times[0], panel.truth.times[-1]
    margin = 0.1 * (last - first)
    axes.set_xlim(first - margin, last + margin)
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label)
    axes.grid(True, linewidth=0.3)
    axes.legend(fontsize=8)


def _selection(report: CaseReport) -> list[int]:
    """The cheapest and the best stable setting of each variant."""
    chosen: dict[int, None] = {}
    rows = [(index, row) for index, row in enumerate(report.rows) if row["stable"] and row["error"] is not None]
    for variant in dict.fromkeys(row["variant"] for _, row in rows):
        own = [(index, row) for index, row in rows if row["variant"] == variant]
        chosen[min(own, key=lambda item: item[1]["ms_per_simulated_second"])[0]] = None
        chosen[min(own, key=lambda item: item[1]["error"])[0]] = None
    return list(chosen)
