"""What a reference case is: a truth, a way to measure against it, and the settings at which it is measured.

A case gives errors of three kinds, which are kept apart:
- "model": against an experiment; what the equations, the grid and the solver together leave,
- "discretisation": against the exact solution of the equations; what the grid, the time step and the solver leave,
- "solver": against the same case on the same grid with the same time step and many iterations; what more iterations
  would remove.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, get_args

import numpy as np

from ..errors import InputError
from ..names import IntegratorName, PressureName, SolverName
from ..simulation import RunSettings
from .measures import Curve

ErrorKind = Literal["model", "discretisation", "solver"]

COURANT_SHARES = (0.8, 1.1, 1.7)
"""Rates of the explicit solver over that at which its fastest wave travels a cell per step."""


@dataclass(frozen=True)
class Setting:
    """Where a case is measured. Cells count over the case's own length."""

    solver: SolverName
    rate_hz: float
    iterations: int
    cells: int
    integrator: IntegratorName = "euler"
    pressure: PressureName = "particles"
    flip: float = 0.0
    sound: float = 0.0
    """Explicit solver, liquids: speed of sound over the fastest flow, which sets the bulk modulus; 0: as the case has it."""
    substeps: int = 1
    threads: int = 1

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return 1.0 / self.rate_hz

    @property
    def variant(self) -> str:
        """The solver with its options, as ``--solvers`` takes it: "dual-cells-flip0.9"."""
        return self.run_settings().solver_text() + (f"-sound{self.sound:g}" if self.sound else "")

    @property
    def work(self) -> float:
        """Expected cost, relative: an iteration costs about as much as a third of the rest of a substep."""
        return self.rate_hz * self.substeps * (self.iterations + 3)

    def run_settings(self) -> RunSettings:
        """What a simulation needs."""
        return RunSettings(
            self.rate_hz,
            self.substeps,
            self.iterations,
            self.threads,
            solver=self.solver,
            pressure=self.pressure,
            integrator=self.integrator,
            flip=self.flip,
        )

    def text(self) -> str:
        """For people."""
        return f"{self.variant}, {self.run_settings().pace_text()}, {self.cells} cells"

    def options(self) -> str:
        """The options of ``pbmpm accuracy CASE`` that measure this setting alone."""
        parts = [f"--solvers {self.variant} --rates {self.rate_hz:g} --iterations {self.iterations} --cells {self.cells}"]
        parts += [f"--substeps {self.substeps}"] if self.substeps > 1 else []
        parts += [f"--threads {self.threads}"] if self.threads != 1 else []
        return " ".join(parts)


def parse_variant(text: str) -> dict[str, Any]:
    """The fields of a Setting that a variant stands for; InputError when it is none."""
    solver, *options = text.split("-")
    if solver not in get_args(SolverName):
        raise InputError(f"'{solver}' is not a solver (there are: {', '.join(get_args(SolverName))})")
    fields: dict[str, Any] = {"solver": solver}
    for option in options:
        flip = re.fullmatch(r"flip(\d*\.?\d+)", option)
        sound = re.fullmatch(r"sound(\d*\.?\d+)", option)
        if option in get_args(PressureName):
            fields["pressure"] = option
        elif option in get_args(IntegratorName):
            fields["integrator"] = option
        elif flip and float(flip[1]) <= 1:
            fields["flip"] = float(flip[1])
        elif sound and solver == "explicit" and float(sound[1]) > 0:
            fields["sound"] = float(sound[1])
        else:
            raise InputError(f"'{option}' in '{text}' is not an option (there are: cells, bdf2, flip0.9; explicit: sound20)")
    return fields


def settings_of(
    variants: Iterable[str],
    rates: Iterable[float],
    iterations: Iterable[int],
    cells: Iterable[int],
    *,
    most_work: float = float("inf"),
    **fixed: Any,
) -> list[Setting]:
    """All combinations, without those whose ``work`` is larger than allowed. The explicit solver has no iterations: it is
    there once per rate."""
    rates, iterations, cells = list(rates), list(iterations), list(cells)
    made = []
    for size in cells:
        for variant in variants:
            fields = {**parse_variant(variant), **fixed}
            for rate in rates:
                for count in [1] if fields["solver"] == "explicit" else iterations:
                    made.append(Setting(rate_hz=rate, iterations=count, cells=size, **fields))
    return [setting for setting in made if setting.work <= most_work]


@dataclass(frozen=True)
class ErrorMeasure:
    """One way in which a case measures its error. The error is 0 when all is right, and in ``unit``."""

    name: str
    kind: ErrorKind
    unit: str
    meaning: str
    tolerance: float | None = None
    """What a good setting is expected to reach; None: not said."""


@dataclass
class Measurement:
    """What one setting gave. A case that broke has None for what it could not measure."""

    errors: dict[str, float | None]
    """By name of the measure, in the order of the case; not negative."""
    ms_per_simulated_second: float | None
    iterations_used: float | None
    """Mean per substep."""
    predicted_error: float | None
    """Mean over the steps [cells]; 0 for solvers that predict none."""
    stable: bool
    reasons: list[str] = field(default_factory=list)
    """Why it is not stable."""
    extra: dict[str, Any] = field(default_factory=dict)
    """Further keys of the row."""
    observed: tuple[float, ...] | None = None
    """What the first error is computed from, for the distance from the converged solution."""
    curves: dict[str, Curve] = field(default_factory=dict)
    """Simulated curves by name of the panel."""


@dataclass(frozen=True)
class CurvePanel:
    """A picture of simulated curves over the truth."""

    name: str
    x_label: str
    y_label: str
    truth: Curve
    truth_label: str


class Case(ABC):
    """A reference case. Instances hold the sizes that can be chosen; they are cheap to make."""

    name: str
    title: str
    dimension: int
    kind: Literal["liquid", "elastic", "mixed", "granular"]
    truth: str
    """Source and units of what is right."""
    error_kinds: tuple[ErrorMeasure, ...]
    """The first one is the headline."""
    length: float
    """What the cells are counted over [m]."""
    length_name: str
    notes: str = ""
    """Tolerances, timing, and what was left out."""
    panels: tuple[CurvePanel, ...] = ()
    converged_iterations = 100
    slowest_hz = 15.0
    """No search below: what moves in steps that the eye counts is no animation, even where a state at rest would allow it."""
    patience = 1.0
    """Times the time for the search that dear cases get."""
    searched = True
    """Whether the full sweep goes on to search around the fronts. Claims, predictions and invariances have no front: nobody
    looks for the cheapest way to a claim."""
    not_compared = ""
    """Why a case that is no claim, prediction or invariance gives no verdict about costs."""
    finer: Mapping[int, float] = {}
    """Further grids on which the solvers are compared, beside the own one, since how cheap a solver is depends on the grid;
    for each, times the time for the search that it gets."""

    @abstractmethod
    def sweep(self, quick: bool) -> list[Setting]:
        """The settings that are measured unless others are asked for."""

    @abstractmethod
    def measure(self, setting: Setting) -> Measurement:
        """Runs one setting."""

    def solve(self, setting: Setting) -> Measurement:
        """Runs a converged setting, of which nobody looks at more than what is ``observed`` and the headline: a case of
        several runs need not do them all."""
        return self.measure(setting)

    def cell_size(self, setting: Setting) -> float:
        """Grid spacing [m]."""
        return self.length / setting.cells

    def converged(self, setting: Setting) -> Setting | None:
        """The setting that gives the solution that more iterations of this one tend to; None when there is none.

        The explicit solver has no iterations, and the paper's solver grows stiffer with them without end: for liquids it
        then tends to the incompressible one, for elastic bodies to a rigid one, which is no reference.
        """
        if setting.solver == "explicit" or (setting.solver == "paper" and self.kind != "liquid"):
            return None
        solver = "dual" if setting.solver == "paper" else setting.solver
        return replace(setting, solver=solver, iterations=self.converged_iterations)

    def distance(self, observed: tuple[float, ...], other: tuple[float, ...]) -> float:
        """How far two observations are apart, in the unit of the headline: root mean square by default."""
        return float(np.sqrt(np.mean((np.asarray(observed) - np.asarray(other)) ** 2)))

    @property
    def own_cells(self) -> int:
        """The grid of the sweep; others in it only show what the grid adds."""
        return self.sweep(False)[0].cells

    @property
    def compared_cells(self) -> tuple[int, ...]:
        """The grids on which solvers are compared, the own one first; none for cases without a verdict."""
        return (self.own_cells, *self.finer) if self.searched else ()

    def search_share(self, cells: int) -> float:
        """Times the time for the search that a grid gets."""
        return self.patience * self.finer.get(cells, 1.0)

    def start(self, cells: int) -> list[Setting]:
        """Where the search on a grid begins: the sweep of the own grid, carried over to this one.

        The explicit solver keeps its Courant numbers: its rates go with the cells. So do those of the paper's solver,
        whose stiffness goes with the square of rate times cell size.
        """
        scale = {"explicit": cells / self.own_cells, "paper": cells / self.own_cells}
        return [
            replace(setting, cells=cells, rate_hz=float(round(setting.rate_hz * scale[setting.solver])))
            if setting.solver in scale and cells != self.own_cells
            else replace(setting, cells=cells)
            for setting in self.sweep(False)
            if setting.cells == self.own_cells
        ]

    @property
    def headline(self) -> ErrorMeasure:
        """The measure that charts and rows show."""
        return self.error_kinds[0]
