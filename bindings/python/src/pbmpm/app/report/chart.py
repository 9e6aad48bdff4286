"""The chart of a case as an interactive figure: error against milliseconds, both logarithmic."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import plotly.graph_objects as go

from .pareto import Point
from .rows import SMALLEST_ERROR, CaseRows, setting_of
from .verdict import Verdict
from .words import error_text

REAL_TIME_MS = 1000.0
SOLVER_COLOURS = {"paper": "#c8781e", "dual": "#1f6fb4", "primal": "#1d8a5b", "explicit": "#a0479a"}
_OTHER_COLOUR = "#555555"
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "pentagon", "hexagon", "star", "triangle-down")
_LIMIT_COLOUR = "#b03a48"
_FRONT_COLOUR = "rgba(40, 40, 40, 0.35)"
_BROKEN_HEADROOM = 2.0  # how far above the highest error settings are drawn that have none, as a factor


def accuracy_figure(case: CaseRows, verdict: Verdict) -> go.Figure:
    """Dots: settings; crosses: not stable; grey line: the front over all solvers; dashed: the error called good."""
    figure = go.Figure()
    _add_front(figure, verdict.front)
    groups = _groups(case.rows)
    ceiling = _BROKEN_HEADROOM * max((_shown(row) for row in case.measured), default=1.0)
    for number, (name, rows) in enumerate(groups.items()):
        symbol = _SYMBOLS[number % len(_SYMBOLS)]
        _add_dots(figure, name, [row for row in rows if row["stable"]], symbol, ceiling, case.measure["unit"])
        _add_dots(figure, name, [row for row in rows if not row["stable"]], "x", ceiling, case.measure["unit"])
    _add_limits(figure, case)
    measure = case.measure
    figure.update_layout(
        template="plotly_white",
        height=520,
        margin={"l": 70, "r": 20, "t": 20, "b": 60},
        legend={"orientation": "v", "font": {"size": 11}},
        hoverlabel={"align": "left"},
    )
    figure.update_xaxes(type="log", title="wall milliseconds per simulated second", **_AXIS)
    percent = {"tickformat": "~%"} if measure["unit"] == "%" else {}
    figure.update_yaxes(type="log", title=_title(measure), **_AXIS, **percent)
    return figure


_AXIS = {
    "dtick": "D2",
    "showline": True,
    "linecolor": "#888888",
    "ticks": "outside",
    "minor": {"ticks": "outside", "showgrid": True},
}


def _title(measure: dict[str, Any]) -> str:
    unit = "" if measure["unit"] in ("%", "1", "") else f" [{measure['unit']}]"
    return f"{measure['name'].replace('_', ' ')}{unit}"


def _groups(rows: Iterable[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Rows by solver with its options and cell size, in the order of their first appearance."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        groups.setdefault(f"{row.get('variant', row['solver'])}, cell {row['cell_m']:.3g} m", []).append(row)
    return groups


def _shown(row: dict[str, Any]) -> float:
    return max(row["error"], SMALLEST_ERROR)


def _add_dots(
    figure: go.Figure, name: str, rows: Sequence[dict[str, Any]], symbol: str, ceiling: float, unit: str
) -> None:
    rows = [row for row in rows if row["ms_per_simulated_second"] is not None]
    if not rows:
        return
    broken = symbol == "x"
    figure.add_scatter(
        x=[row["ms_per_simulated_second"] for row in rows],
        y=[ceiling if row["error"] is None else _shown(row) for row in rows],
        mode="markers",
        name=f"{name}: not stable" if broken else name,
        marker={
            "symbol": "x-thin" if broken else symbol,
            "size": 10 if broken else 8,
            "color": SOLVER_COLOURS.get(rows[0]["solver"], _OTHER_COLOUR),
            "line": {"width": 2.5 if broken else 0.5, "color": SOLVER_COLOURS.get(rows[0]["solver"], _OTHER_COLOUR)},
        },
        text=[_hover(row, unit) for row in rows],
        hovertemplate="%{text}<extra></extra>",
    )


def _hover(row: dict[str, Any], unit: str) -> str:
    lines = [setting_of(row), f"{row['ms_per_simulated_second']:.4g} ms per simulated second"]
    lines.append("no error: it broke" if row["error"] is None else f"error {error_text(row['error'], unit)}")
    if row.get("iterations_used") is not None:
        lines.append(f"iterations used {row['iterations_used']:.3g}")
    return "<br>".join([*lines, *(f"not stable: {reason}" for reason in row.get("reasons", []))])


def _add_front(figure: go.Figure, front: Sequence[Point]) -> None:
    if front:
        figure.add_scatter(
            x=[point.cost for point in front],
            y=[point.error for point in front],
            mode="lines",
            name="front over all solvers",
            line={"color": _FRONT_COLOUR, "width": 6},
            hoverinfo="skip",
        )


def _add_limits(figure: go.Figure, case: CaseRows) -> None:
    figure.add_vline(x=REAL_TIME_MS, line={"color": _LIMIT_COLOUR, "dash": "dot"})
    # Unlike lines, annotations are placed by the logarithm on a logarithmic axis.
    figure.add_annotation(
        x=math.log10(REAL_TIME_MS),
        y=1.0,
        yref="paper",
        text="real time at 60 Hz: 16.7 ms per frame",
        textangle=-90,
        yanchor="top",
        xanchor="right",
        showarrow=False,
        font={"color": _LIMIT_COLOUR, "size": 11},
    )
    tolerance = case.measure.get("tolerance")
    if tolerance is not None:
        figure.add_hline(y=tolerance, line={"color": "#666666", "dash": "dash", "width": 1})
