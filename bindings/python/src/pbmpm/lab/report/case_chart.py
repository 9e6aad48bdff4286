"""The chart of a case as an interactive figure: error against milliseconds, both logarithmic."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import plotly.graph_objects as go

from .pareto import Point, axis_span
from .rows import SMALLEST_ERROR, CaseRows, setting_of
from .views import View, views_of
from .words import error_text

REAL_TIME_MS = 1000.0
SOLVER_COLOURS = {"convergent": "#4a4a4a", "paper": "#c8781e", "dual": "#1f6fb4", "primal": "#1d8a5b", "explicit": "#a0479a"}
_OTHER_COLOUR = "#555555"
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "pentagon", "hexagon", "star", "triangle-down")
_LIMIT_COLOUR = "#b03a48"
_FRONT_COLOURS = ("rgba(40, 40, 40, 0.35)", "rgba(31, 111, 180, 0.3)", "rgba(200, 120, 30, 0.3)")  # of the grids, coarse first
_BROKEN_HEADROOM = 2.0  # how far above the highest error settings are drawn that have none, as a factor
_PLOT_HEIGHT, _ENTRY_HEIGHT = 420, 19  # pixels: of the plot with its axis, and of a line of the legend, which has an entry each on a narrow page
_LABEL_PLACES = ("top right", "bottom right")  # in turns, so that neighbours do not meet
_AXIS = {
    "type": "log",
    "dtick": "D2",
    "showline": True,
    "linecolor": "#888888",
    "ticks": "outside",
    "minor": {"ticks": "outside", "showgrid": True},
}


def accuracy_figure(case: CaseRows) -> go.Figure:
    """Dots: settings; crosses: not stable; wide lines: the front over all solvers on each grid; dashed: the error called
    good. A menu switches between the errors of the case."""
    views = views_of(case)
    traces = [_traces(view) for view in views]
    for number, group in enumerate(traces):
        for trace in group:
            trace.visible = number == 0
    figure = go.Figure([trace for group in traces for trace in group])
    figure.update_layout(
        template="plotly_white",
        height=_PLOT_HEIGHT + _ENTRY_HEIGHT * max(len(group) for group in traces),
        margin={"l": 70, "r": 20, "t": 60, "b": 60},
        legend={"font": {"size": 11}, "orientation": "h", "y": -0.2, "yanchor": "top"},
        hoverlabel={"align": "left"},
        annotations=[_real_time_text()],
        updatemenus=[_menu(views, [len(group) for group in traces])] if len(views) > 1 else [],
        **_layout(views[0]),
    )
    shown = axis_span((row["ms_per_simulated_second"] for row in case.rows if row["ms_per_simulated_second"] is not None), REAL_TIME_MS)
    figure.update_xaxes(title="milliseconds per simulated second", range=[math.log10(end) for end in shown], **_AXIS)
    figure.update_yaxes(**_AXIS)
    return figure


def _layout(view: View) -> dict[str, Any]:
    """What of the layout depends on the view."""
    return {
        "yaxis.title.text": view.title,
        "yaxis.tickformat": "~%" if view.unit == "%" else "~g",
        "shapes": _limit_lines(view.tolerance),
    }


def _menu(views: Sequence[View], counts: Sequence[int]) -> dict[str, Any]:
    buttons = []
    for number, view in enumerate(views):
        visible = [place == number for place, count in enumerate(counts) for _ in range(count)]
        buttons.append({"label": view.name, "method": "update", "args": [{"visible": visible}, _layout(view)]})
    return {"buttons": buttons, "x": 0, "xanchor": "left", "y": 1.02, "yanchor": "bottom"}


def _limit_lines(tolerance: float | None) -> list[dict[str, Any]]:
    real_time = {"type": "line", "x0": REAL_TIME_MS, "x1": REAL_TIME_MS, "y0": 0, "y1": 1, "yref": "paper"}
    lines = [{**real_time, "line": {"color": _LIMIT_COLOUR, "dash": "dot", "width": 2}}]
    if tolerance:
        good = {"type": "line", "x0": 0, "x1": 1, "xref": "paper", "y0": tolerance, "y1": tolerance}
        lines.append({**good, "line": {"color": "#666666", "dash": "dash", "width": 1}})
    return lines


def _real_time_text() -> dict[str, Any]:
    """Unlike lines, texts are placed by the logarithm on a logarithmic axis."""
    return {
        "x": math.log10(REAL_TIME_MS),
        "y": 1.0,
        "yref": "paper",
        "text": "real time at 60 Hz: 16.7 ms per frame",
        "textangle": -90,
        "yanchor": "top",
        "xanchor": "right",
        "showarrow": False,
        "font": {"color": _LIMIT_COLOUR, "size": 11},
    }


def _traces(view: View) -> list[go.Scatter]:
    """The fronts, for each solver with its options and cell size the dots, and the crosses."""
    rows = [(row, error) for row, error in zip(view.rows, view.errors, strict=True) if _has_place(row, error)]
    ceiling = _BROKEN_HEADROOM * max((_drawn(error) for _, error in rows if error is not None), default=1.0)
    groups: dict[str, list[tuple[dict[str, Any], float | None]]] = {}
    for row, error in rows:
        groups.setdefault(f"{row.get('variant', row['solver'])}, cell {row['cell_m']:.3g} m", []).append((row, error))
    traces = [_front(view.front(cells), f"front at {cells} cells", shade) for cells, shade in zip(view.grids, _FRONT_COLOURS)]
    for number, (name, members) in enumerate(groups.items()):
        own = [(row, error) for row, error in members if row["stable"]]
        if own:
            traces.append(_dots(name, own, _SYMBOLS[number % len(_SYMBOLS)], ceiling, view.unit))
    broken = [(row, error) for row, error in rows if not row["stable"]]
    return [*traces, _dots("not stable", broken, None, ceiling, view.unit)] if broken else traces


def _has_place(row: dict[str, Any], error: float | None) -> bool:
    """A setting that broke is drawn even without an error; one without a cost cannot be."""
    return row["ms_per_simulated_second"] is not None and (error is not None or not row["stable"])


def _drawn(error: float) -> float:
    return max(error, SMALLEST_ERROR)


def _dots(
    name: str, members: Sequence[tuple[dict[str, Any], float | None]], symbol: str | None, ceiling: float, unit: str
) -> go.Scatter:
    """Dots with a symbol, or crosses without one."""
    colours = [SOLVER_COLOURS.get(row["solver"], _OTHER_COLOUR) for row, _ in members]
    return go.Scatter(
        x=[row["ms_per_simulated_second"] for row, _ in members],
        y=[ceiling if error is None else _drawn(error) for _, error in members],
        mode="markers",
        name=name,
        marker={
            "symbol": symbol or "x-thin",
            "size": 8 if symbol else 10,
            "color": colours,
            "line": {"width": 0.5 if symbol else 2.5, "color": colours},
        },
        text=[_hover(row, error, unit) for row, error in members],
        hovertemplate="%{text}<extra></extra>",
    )


def _hover(row: dict[str, Any], error: float | None, unit: str) -> str:
    lines = [setting_of(row), f"{row['ms_per_simulated_second']:.4g} ms per simulated second"]
    lines.append("no error: it broke" if error is None else f"error {error_text(error, unit)}")
    if row.get("iterations_used") is not None:
        lines.append(f"iterations used {row['iterations_used']:.3g}")
    return "<br>".join([*lines, *(f"not stable: {reason}" for reason in row.get("reasons", []))])


def _front(front: Sequence[Point], name: str, colour: str) -> go.Scatter:
    return go.Scatter(
        x=[point.cost for point in front],
        y=[point.error for point in front],
        mode="lines+text",
        text=[point.pace for point in front],
        textposition=[_LABEL_PLACES[number % 2] for number in range(len(front))],
        textfont={"size": 10, "color": "#444444"},
        name=name,
        line={"color": colour, "width": 6},
        hoverinfo="skip",
    )
