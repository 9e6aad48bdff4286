"""The ways in which a chart can show a case: by each of its errors, and by the distance from the converged solution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .pareto import Point, front_of
from .rows import CaseRows, point_of

CONVERGED_NAME = "distance from the converged solution"


@dataclass(frozen=True)
class View:
    """One error of all rows of a case."""

    name: str
    unit: str
    tolerance: float | None  #: the error that the case calls good
    rows: list[dict[str, Any]]
    errors: list[float | None]  #: of the rows
    grids: list[int]  #: on which solvers are compared [cells]

    @property
    def title(self) -> str:
        """For the axis."""
        return self.name if self.unit in ("%", "1", "") else f"{self.name} [{self.unit}]"

    def front(self, cells: int) -> list[Point]:
        """The stable settings on a grid that no other beats."""
        return front_of(
            point_of({**row, "error": error})
            for row, error in zip(self.rows, self.errors, strict=True)
            if row["cells"] == cells and row["stable"] and error is not None and row["ms_per_simulated_second"] is not None
        )


def views_of(case: CaseRows) -> list[View]:
    """The headline first; the converged solution only where the sweep has it."""
    views = [
        View(
            measure["name"].replace("_", " "),
            measure["unit"],
            measure.get("tolerance"),
            case.rows,
            [row["errors"].get(measure["name"]) for row in case.rows],
            case.grids,
        )
        for measure in case.facts["errors"]
    ]
    distances = [row.get("solver_error") for row in case.rows]
    if any(distance is not None for distance in distances):
        views.append(View(CONVERGED_NAME, case.measure["unit"], None, case.rows, distances, case.grids))
    return [view for view in views if any(error is not None for error in view.errors)] or views[:1]
