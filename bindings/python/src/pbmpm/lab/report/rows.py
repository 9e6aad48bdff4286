"""The rows of an accuracy report as points of a front."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from .pareto import Point
from .verdict import ACCELERATED, Verdict, judge

#: An error below this is drawn and compared as if it were this: logarithms need a number above 0.
SMALLEST_ERROR = 1e-9


@dataclass(frozen=True)
class CaseRows:
    """What a report holds about one case."""

    facts: dict[str, Any]
    rows: list[dict[str, Any]]

    @property
    def name(self) -> str:
        return str(self.facts["case"])

    @property
    def measure(self) -> dict[str, Any]:
        """The error that charts and verdicts speak of: name, kind, unit, meaning, tolerance."""
        return dict(self.facts["errors"][0])

    @property
    def solvers(self) -> list[str]:
        """All solvers that were tried, accelerated ones first."""
        tried = {row["solver"] for row in self.rows}
        return sorted(tried, key=lambda solver: (solver not in ACCELERATED, solver))

    @property
    def measured(self) -> list[dict[str, Any]]:
        """The rows with a figure for cost and error."""
        return [row for row in self.rows if row["error"] is not None and row["ms_per_simulated_second"] is not None]

    @property
    def stable(self) -> list[dict[str, Any]]:
        """The measured rows that count."""
        return [row for row in self.measured if row["stable"]]

    @property
    def failed(self) -> list[dict[str, Any]]:
        """The rows that are not stable."""
        return [row for row in self.rows if not row["stable"]]

    @property
    def compared(self) -> bool:
        """Whether the case compares costs; claims, predictions and invariances do not."""
        return bool(self.facts.get("searched", True)) and not self.facts.get("not_compared")

    @property
    def grids(self) -> list[int]:
        """The grids on which solvers are compared, as far as there are rows for them; where there are none, those of all
        rows. Coarse ones first."""
        measured = {row["cells"] for row in self.rows}
        return sorted(measured & set(self.facts.get("compared_cells", ())) or measured)

    def verdicts(self) -> list[GridVerdict]:
        """What the stable rows say about the solvers, for each grid by itself."""
        return [GridVerdict(self, cells, self._verdict(cells)) for cells in self.grids]

    def _verdict(self, cells: int) -> Verdict:
        rows = [row for row in self.stable if row["cells"] == cells]
        solvers = {row["solver"] for row in self.rows if row["cells"] == cells}
        points, good = [point_of(row) for row in rows], self.measure.get("tolerance")
        converged = _least_converged([row for row in rows if row["solver"] in ACCELERATED])
        cut_short = [solver for grid, solver in self.facts.get("cut_short", ()) if grid == cells]
        return judge(points, [name for name in self.solvers if name in solvers], good, converged, cut_short)


def _least_converged(rows: list[dict[str, Any]]) -> float | None:
    """The least error of converged solutions. Not known where the best of the rows has none, nor any other that is as good:
    those of others may be the errors of coarser time steps."""
    best = min(rows, key=lambda row: (float(row["error"]), row.get("converged_error") is None), default=None)
    if best is None or best.get("converged_error") is None:
        return None
    return min(float(row["converged_error"]) for row in rows if row.get("converged_error") is not None)


@dataclass(frozen=True)
class GridVerdict:
    """The verdict of a case on one of its grids."""

    case: CaseRows
    cells: int
    verdict: Verdict

    @property
    def cell_m(self) -> float:
        """Grid spacing [m]."""
        return next(float(row["cell_m"]) for row in self.case.rows if row["cells"] == self.cells)


def point_of(row: dict[str, Any]) -> Point:
    """A row as a point of a front."""
    return Point(row["solver"], setting_of(row), row["ms_per_simulated_second"], max(row["error"], SMALLEST_ERROR), pace_of(row))


def pace_of(row: dict[str, Any]) -> str:
    """Hz x iterations, with substeps where there are some."""
    parts = [f"{row['rate_hz']:g}", *([f"{row['substeps']}"] if row.get("substeps", 1) > 1 else [])]
    return " x ".join([*parts, *([] if row["solver"] == "explicit" else [f"{row['iterations']}"])])


def setting_of(row: dict[str, Any]) -> str:
    """A row's setting for people."""
    substeps = f" x {row['substeps']} substeps" if row.get("substeps", 1) > 1 else ""
    iterations = "" if row["solver"] == "explicit" else f" x {row['iterations']} iterations"
    return (
        f"{row.get('variant', row['solver'])}, {row['rate_hz']:g} Hz{substeps}{iterations}, cell {row['cell_m']:.4g} m"
    )


def cases_of(report: dict[str, Any]) -> list[CaseRows]:
    """The cases of a report with their rows."""
    return [
        CaseRows(facts, [row for row in report["rows"] if row["case"] == facts["case"]]) for facts in report["cases"]
    ]


def verdicts_of(cases: Iterable[CaseRows]) -> list[GridVerdict]:
    """The verdicts of the cases that compare costs, grid by grid."""
    return [verdict for case in cases if case.compared for verdict in case.verdicts()]
