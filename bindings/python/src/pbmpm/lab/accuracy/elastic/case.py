"""What the reference cases of elastic bodies have in common."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import replace

import pbmpm

from ..case import COURANT_SHARES, Case, Setting, settings_of
from .theory import Integrator, Solid

IMPLICIT = ("paper", "dual", "primal", "primal-bdf2")
_CONVERGED_ITERATIONS = 100
"""Of the primal solver, with which these cases do not change any more."""


def integrator_of(setting: Setting) -> Integrator:
    """What the time steps of a setting do, whatever the iterations leave."""
    return "explicit" if setting.solver == "explicit" else setting.integrator


def relative(value: float | None, truth: float) -> float | None:
    """Error as a share of the truth."""
    return None if value is None else abs(value / truth - 1.0)


class ElasticCase(Case):
    """What the cases of elastic bodies share: the converged solution is that of the primal solver.

    The dual solver has the same equations, but would need thousands of iterations for stiff bodies.
    """

    kind = "elastic"
    dimension = 2
    converged_iterations = _CONVERGED_ITERATIONS

    rates: tuple[float, ...] = (30.0, 120.0)
    iterations: tuple[int, ...] = (2, 5, 20)
    cells: tuple[int, ...]
    """The first is the one at which rates and iterations are swept; the others show the grid's share."""
    grid_setting = ("primal-bdf2", 240.0, 20)
    """Variant, rate and iterations at which the other cell sizes are measured."""
    quick_rates: tuple[float, ...] = (60.0, 240.0)
    quick_iterations: tuple[int, ...] = (5, 20)
    variants: tuple[str, ...] = IMPLICIT

    def sweep(self, quick: bool) -> list[Setting]:
        rates, iterations = (self.quick_rates, self.quick_iterations) if quick else (self.rates, self.iterations)
        made = settings_of(self.variants, rates, iterations, self.cells[:1])
        made += [] if quick else self.matched()
        made += settings_of(["explicit"], self.explicit_rates(quick), [1], self.cells[:1])
        if not quick:
            variant, rate, count = self.grid_setting
            made += settings_of([variant], [rate], [count], self.cells[1:])
        return made

    def explicit_rates(self, quick: bool) -> list[float]:
        """Rates around that at which sound travels a cell per step."""
        limit = self.solid.pressure_wave_speed * self.cells[0] / self.length
        return [float(math.ceil(share * limit)) for share in (COURANT_SHARES[-1:] if quick else COURANT_SHARES)]

    def matched(self) -> list[Setting]:
        """The paper's solver at the rates at which its law of stiffness, E = w N rho dx^2 / (4 dt^2), gives this body's
        modulus: dt = dx / 2 sqrt(w N rho / E). It has no other way to a modulus; which one that is, the user must know."""
        if not self.searched or self.kind != "elastic" or "paper" not in self.variants:
            return []
        cells, relaxation = self.cells[0], pbmpm.Elastic().relaxation
        speed = math.sqrt(self.solid.slender_modulus / self.solid.density)
        slowest = 2.0 * speed * cells / self.length
        rates = {count: round(slowest / math.sqrt(relaxation * count)) for count in (1, 5, 20)}
        return [Setting("paper", float(rate), count, cells) for count, rate in rates.items()]

    def start(self, cells: int) -> list[Setting]:
        """On other grids than the own one without the dual solver, which stiff bodies of many cells are no matter for."""
        made = super().start(cells)
        return made if cells == self.own_cells or self.kind != "elastic" else [item for item in made if item.solver != "dual"]

    @property
    @abstractmethod
    def solid(self) -> Solid:
        """The material of the body."""

    def converged(self, setting: Setting) -> Setting | None:
        if setting.solver in ("explicit", "paper"):
            return None
        return replace(setting, solver="primal", iterations=self.converged_iterations)
