"""Charts of error against milliseconds per simulated second."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from ..files import replace_when_complete
from .measures import SHIFT_LIMIT, dam_break_experiment

REAL_TIME_MS = 1000.0
FRONT_GATE, FRONT_GATE_SHIFTED = 0.10, 0.05
_COLOURS = ("#8a9bb0", "#2c7fb8", "#e8772e", "#7a3b9a", "#3c9a5c", "#b03a48")
_FLOOR = 1e-5  # smallest error that a logarithmic axis shows


def save_chart(report: dict[str, Any], path: Path) -> None:
    """Writes the chart of a report as PNG."""
    figure = Figure(figsize=(13, 9), layout="constrained")
    draw = {"dam-break": _dam_break, "column": _column}[report["case"]]
    draw(figure, report)
    machine = report["machine"]
    figure.suptitle(
        f"{report['case']}, cell {report['cell_size']:.4g} m. {machine['cpu']}, {machine['isa']},"
        f" {machine['threads']} thread(s), {machine['date'][:10]}. Crosses: not stable.",
        fontsize=10,
    )
    FigureCanvasAgg(figure)
    path.parent.mkdir(parents=True, exist_ok=True)
    with replace_when_complete(path) as temporary:
        figure.savefig(temporary, format="png", dpi=110)


def _dam_break(figure: Figure, report: dict[str, Any]) -> None:
    axes = figure.subplots(2, 2)
    _error_panel(
        axes[0, 0],
        report,
        "front_rms_shifted",
        f"front RMS, best time shift within {SHIFT_LIMIT:g}",
        FRONT_GATE_SHIFTED,
    )
    _error_panel(axes[0, 1], report, "front_rms", "front RMS, raw", FRONT_GATE)
    _curve_panel(axes[1, 0], report, "front", "T = t sqrt(2 g / a)", "front Z = x / a")
    _curve_panel(axes[1, 1], report, "height", "tau = t sqrt(g / a)", "height at the wall H = h / (2 a)")
    axes[1, 0].set_xlim(0, 4.2)
    axes[1, 0].set_ylim(0.9, 5.5)


def _column(figure: Figure, report: dict[str, Any]) -> None:
    axes = figure.subplots(2, 2)
    for row, (name, key) in enumerate((("settled height error", "height_error"), ("volume error RMS", "volume_error"))):
        with_feedback = "volume_error_rms" if key == "volume_error" else key
        _error_panel(axes[row, 0], report, with_feedback, f"{name} (lines: law)", law=f"{key}_law")
        _error_panel(
            axes[row, 1], report, f"{key}_without_feedback", f"{name}, without volume feedback", law=f"{key}_law"
        )


def _error_panel(
    axes: Axes, report: dict[str, Any], key: str, title: str, gate: float | None = None, law: str | None = None
) -> None:
    for colour, count in zip(_COLOURS, sorted({row["iterations"] for row in report["rows"]})):
        rows = [row for row in report["rows"] if row["iterations"] == count and row[key] is not None]
        stable = [row for row in rows if row["stable"]]
        failed = [row for row in rows if not row["stable"]]
        _points(
            axes, stable, key, color=colour, marker="o", linestyle="" if law else "-", label=f"{count} iteration(s)"
        )
        _points(axes, failed, key, color=colour, marker="x", linestyle="", markersize=10, markeredgewidth=2.5)
        if law:
            _points(axes, rows, law, color=colour, linestyle="-", linewidth=1)
        for row in rows:
            place = (row["ms_per_simulated_second"], max(abs(row[key]), _FLOOR))
            axes.annotate(
                f"{row['rate_hz']:g}", place, textcoords="offset points", xytext=(4, 4), fontsize=7, color=colour
            )
    if gate is not None:
        axes.axhline(gate, color="#444444", linewidth=0.8, linestyle="--")
    axes.axvline(
        REAL_TIME_MS, color="#b03a48", linewidth=1, linestyle=":", label="real time: 16.7 ms per frame at 60 Hz"
    )
    axes.set(xscale="log", yscale="log", title=title, xlabel="ms per simulated second (figures: Hz)", ylabel="error")
    percent = FuncFormatter(lambda value, _: f"{100 * value:g} %")
    axes.yaxis.set_major_formatter(percent)
    axes.yaxis.set_minor_formatter(percent)
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(fontsize=8)


def _points(axes: Axes, rows: list[dict[str, Any]], key: str, **style: Any) -> None:
    costs = [row["ms_per_simulated_second"] for row in rows]
    axes.plot(costs, [max(abs(row[key]), _FLOOR) for row in rows], **style)


def _curve_panel(axes: Axes, report: dict[str, Any], quantity: str, x_label: str, y_label: str) -> None:
    """Simulated curves of a few settings, from the cheapest to the best, over the measured points."""
    for colour, row in zip(_COLOURS[1:], _selection(report["rows"])):
        curve = row["curves"][quantity]
        axes.plot(curve.times, curve.values, color=colour, label=f"{row['rate_hz']:g} Hz x {row['iterations']}")
    measured = dam_break_experiment(quantity)
    axes.plot(measured.times, measured.values, "ko", markersize=4, label="Martin and Moyce 1952")
    axes.set(xlabel=x_label, ylabel=y_label)
    axes.grid(True, linewidth=0.3)
    axes.legend(fontsize=8)


def _selection(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Cheapest, middle, dearest, and the one with the best front."""
    ordered = sorted(rows, key=lambda row: row["rate_hz"] * row["iterations"])
    best = min(rows, key=lambda row: row["front_rms_shifted"])
    chosen = [ordered[0], ordered[len(ordered) // 2], ordered[-1], best]
    return list({id(row): row for row in chosen}.values())
