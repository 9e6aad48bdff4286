"""What a hard case is, and what running it gives.

A case has checks of two kinds. Bounds hold at any rate and iteration count: nothing explodes, gains energy, is lost or leaves.
Goals are of accuracy or recovery, and are stated for a setting: a solve that is cut short cannot reach them at 15 Hz with one
iteration, by its own law. They are judged at the case's own rate and iterations and wherever both are at least as fine; at
coarser settings they are shown as figures.
"""

from __future__ import annotations

import enum
import itertools
import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import pbmpm
from pbmpm.materials import Parameters

from ...accuracy import laws

LIQUID = "liquid"
ELASTIC = "elastic"
SAND = "sand"
VISCO = "visco"
MIXED = "mixed"  # all kinds of matter in one scene
SOLID_AND_LIQUID = (LIQUID, ELASTIC)
ALL_KINDS = (*SOLID_AND_LIQUID, SAND, VISCO)
_SOLIDS: dict[str, type[pbmpm.Elastic | pbmpm.Sand | pbmpm.Visco]] = {
    ELASTIC: pbmpm.Elastic,
    SAND: pbmpm.Sand,
    VISCO: pbmpm.Visco,
}
PAPER = "paper"
EXPLICIT = "explicit"
DUAL = "dual"
PRIMAL = "primal"
PHYSICAL_SOLVERS = (DUAL, PRIMAL, EXPLICIT)  # in which the matter has the moduli that it is given
SOLVERS = (PAPER, *PHYSICAL_SOLVERS)
SEED = 1  # of all random numbers, unless a setting has another

#: Stiffness of the matter where it is a parameter: sound travels half a cell in 1/240 s, whatever a cell measures, so that
#: the explicit solver can pass from about 240 Hz on.
SOUND_CELLS_PER_SECOND = 120.0


@dataclass(frozen=True)
class Setting:
    """One way to run a case."""

    material: str  #: one of ALL_KINDS, or MIXED
    dimension: int  #: 2 or 3
    variant: str  #: one of the case's variants
    rate_hz: float  #: steps per second
    iterations: int  #: per step
    relaxation: float | None = None  #: of the material; None: the library's default
    threads: int = 1  #: 0: one per core
    solver: str = PAPER  #: one of SOLVERS
    seed: int = SEED

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return 1.0 / self.rate_hz

    def parameters(self, cell_size: float, **changes: Any) -> Parameters:
        """The material on a grid, with changes of its parameters.

        The dual solver gets the liquid that it is made for, an incompressible one; the primal and the explicit solver
        need a compressible one.
        """
        if self.relaxation is not None:
            changes.setdefault("relaxation", self.relaxation)
        if self.material in _SOLIDS:
            changes.setdefault("young_modulus", sound_modulus(cell_size))
            return _SOLIDS[self.material](**changes)
        if self.solver in (PRIMAL, EXPLICIT):
            changes.setdefault("bulk_modulus", sound_modulus(cell_size))
        return pbmpm.Liquid(**changes)

    def expansion_speed(self, cell_size: float) -> float:
        """What squeezed matter may gain by expanding [m/s]: the speed of its pressure wave.

        Squeezed by a strain of nearly 1 it holds almost M/2 of energy per volume, M = rho c^2 the modulus of the pressure
        wave. What is incompressible stores none, nor does the paper's liquid, whose growth is bounded by its weight and motion.
        What the paper's elastic matter stores is not counted here: see `stored_speed`.
        """
        if self.solver == PAPER:
            return 0.0
        matter = self.parameters(cell_size)
        modulus = matter.bulk_modulus if isinstance(matter, pbmpm.Liquid) else _wave_modulus(matter)
        return math.sqrt(modulus / matter.density)

    def stored_speed(self, cell_size: float) -> float:
        """What elastic matter that was pressed flat may reach by the law of the paper's solver [m/s], which makes motion of all that it stores.

        That law stores more than Hooke's when it is pressed, and softens when it is stretched by more than 2, where its force (1 - 1/s) / s is the
        largest: what is squeezed out tears off and takes along what it stores. (So it does in an explicit simulation of the same energy,
        1/s + ln s - 1, without any iteration.)
        """
        matter = self.parameters(cell_size)
        if self.solver != PAPER or not isinstance(matter, pbmpm.Elastic):
            return 0.0
        stored = laws.stored_when_flattened(matter.strain_min, matter.relaxation, matter.rebound_max)
        return math.sqrt(2.0 * stored * laws.young_modulus_over_density(cell_size, self.dt, self.iterations, matter.relaxation))

    def __str__(self) -> str:
        return f"{self.variant}, {self.solver}, {self.material}, {self.dimension}D, {self.rate_hz:g} Hz x {self.iterations}"


def sound_modulus(cell_size: float) -> float:
    """Modulus of matter of the default density in which sound travels SOUND_CELLS_PER_SECOND: rho c^2."""
    return pbmpm.Liquid().density * (SOUND_CELLS_PER_SECOND * cell_size) ** 2


def _wave_modulus(matter: pbmpm.Elastic | pbmpm.Sand | pbmpm.Visco) -> float:
    """lambda + 2 mu."""
    ratio = matter.poisson_ratio
    return matter.young_modulus * (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio))


class Kind(enum.Enum):
    """Where a check decides."""

    BOUND = "bound"  #: at any rate and iteration count: stability
    GOAL = "goal"  #: at the case's own rate and iterations and at finer ones: accuracy and recovery


@dataclass(frozen=True)
class Check:
    """One figure beside its limit."""

    name: str
    figure: float
    limit: float
    at_least: bool = False  #: whether the limit is a lower one
    kind: Kind = Kind.BOUND

    @property
    def passed(self) -> bool:
        """False for figures that are not finite."""
        if not math.isfinite(self.figure):
            return False
        return self.figure >= self.limit if self.at_least else self.figure <= self.limit

    @property
    def limit_text(self) -> str:
        """The limit with its sign."""
        return f"{'>=' if self.at_least else '<='} {self.limit:g}"

    def text(self, judged: bool = True) -> str:
        """One line; a goal that is missed where it is not judged is no failure."""
        verdict = "ok" if self.passed else "FAILED" if judged else "not reached here"
        return f"{self.name}: {self.figure:.4g} ({verdict}, limit {self.limit_text})"


@dataclass(frozen=True)
class Outcome:
    """What came of a run. `figure` and `limit` are those of the first judged check that failed, or else of the first judged."""

    case: str
    setting: Setting
    checks: tuple[Check, ...]
    seconds: float  #: wall time
    known_failure: str = ""  #: why the setting is known to fail
    judges_goals: bool = True  #: whether the setting is fine enough for the goals to count

    @property
    def judged(self) -> tuple[Check, ...]:
        """The checks that decide: all bounds, and the goals where they count. That a figure is finite is a bound of its own."""
        return tuple(
            check
            for check in self.checks
            if self.judges_goals or check.kind is Kind.BOUND or not math.isfinite(check.figure)
        )

    @property
    def passed(self) -> bool:
        return all(check.passed for check in self.judged)

    @property
    def goals_missed(self) -> tuple[Check, ...]:
        """Goals that are not reached, whether they count here or not."""
        return tuple(check for check in self.checks if check.kind is Kind.GOAL and not check.passed)

    @property
    def telling(self) -> Check:
        """The check that says most."""
        judged = self.judged
        return next((check for check in judged if not check.passed), judged[0])

    @property
    def figure(self) -> float:
        return self.telling.figure

    @property
    def limit(self) -> float:
        return self.telling.limit

    @property
    def description(self) -> str:
        """All checks, one per line."""
        judged = self.judged
        return "\n".join(check.text(check in judged) for check in self.checks)


@dataclass(frozen=True)
class KnownFailure:
    """Settings of a case that do not pass, and why. None: all. With the name of a check only that check may fail, with a finite figure."""

    reason: str
    solvers: tuple[str, ...]
    variants: tuple[str, ...] | None = None
    materials: tuple[str, ...] | None = None
    rates_and_iterations: tuple[tuple[float, int], ...] | None = None  #: rates in Hz
    check: str | None = None

    def covers(self, setting: Setting) -> bool:
        """Whether a setting is one of them."""
        return (
            setting.solver in self.solvers
            and (self.variants is None or setting.variant in self.variants)
            and (self.materials is None or setting.material in self.materials)
            and (self.rates_and_iterations is None or (setting.rate_hz, setting.iterations) in self.rates_and_iterations)
        )

    def explains(self, failed: Iterable[Check]) -> bool:
        """Whether these checks may fail."""
        return self.check is None or all(check.name == self.check and math.isfinite(check.figure) for check in failed)


@dataclass(frozen=True)
class HardCase:
    """A scene with a criterion. `function` runs it at a setting and returns its checks, the most telling one first; one of them
    at least is a bound."""

    id: str
    title: str
    origin: str  #: where the case comes from
    criterion: str
    function: Callable[[Setting], list[Check]]
    materials: tuple[str, ...] = (LIQUID, ELASTIC)
    dimensions: tuple[int, ...] = (2, 3)
    variants: tuple[str, ...] = ("plain",)
    rate_hz: float = 60.0
    iterations: int = 5
    ladder: tuple[tuple[float, int], ...] = ()  #: rates and iterations at which it always runs in 2D, instead of its own
    solvers: tuple[str, ...] = SOLVERS  #: for which the criterion means something
    makes_sense: Callable[[Setting], bool] = lambda _: True  #: for settings that have no meaning
    fixed_variants: tuple[str, ...] = ()  #: of the variants, those that the map leaves at the case's own rate and iterations,
    #: as they depend on neither, or because a smaller scene of map_variants takes their place at the others
    map_variants: tuple[str, ...] = ()  #: that only the full map runs, at its rates and iterations
    has_own_steps: bool = False  #: whether the scene gives the length of each step, so that the rate means nothing
    long_variants: tuple[str, ...] = ()  #: that only the full map runs, and only at the case's own rate and iterations
    known_failures: tuple[KnownFailure, ...] = ()

    @property
    def all_variants(self) -> tuple[str, ...]:
        """Those of the quick form, and those of the full map alone."""
        return self.variants + self.map_variants + self.long_variants

    def settings(
        self,
        rate_hz: float | None = None,
        iterations: int | None = None,
        solver: str = PAPER,
        *,
        variants: tuple[str, ...] | None = None,
    ) -> Iterator[Setting]:
        """All settings of the case, at its own rate and iterations or at others, for its variants or for some; none for a
        solver that it does not concern."""
        if solver not in self.solvers:
            return
        chosen = self.variants if variants is None else variants
        for material, dimension, variant in itertools.product(self.materials, self.dimensions, chosen):
            for rate, count in self._places(dimension, rate_hz, iterations):
                setting = Setting(material, dimension, variant, rate, count, solver=solver)
                if self.makes_sense(setting):
                    yield setting

    def _places(self, dimension: int, rate_hz: float | None, iterations: int | None) -> Iterable[tuple[float, int]]:
        if self.ladder and dimension == 2 and rate_hz is None:
            return dict.fromkeys((rate, iterations or count) for rate, count in self.ladder)
        return ((rate_hz or self.rate_hz, iterations or self.iterations),)

    def known_failure(self, setting: Setting, failed: Iterable[Check] = ()) -> str:
        """Why a setting is known to fail, with these checks; empty when it should pass."""
        checks = tuple(failed)
        return next((known.reason for known in self.known_failures if known.covers(setting) and known.explains(checks)), "")

    def judges_goals(self, setting: Setting) -> bool:
        """Whether goals count at a setting: at the case's own, and where both are at least as fine. A case with a ladder is
        judged in full on all of it. The explicit solver has no iterations."""
        if self.ladder:
            return True
        return setting.rate_hz >= self.rate_hz and (setting.solver == EXPLICIT or setting.iterations >= self.iterations)

    def outcome(self, setting: Setting, checks: Iterable[Check], seconds: float) -> Outcome:
        """What the checks of a run mean."""
        outcome = Outcome(self.id, setting, tuple(checks), seconds, judges_goals=self.judges_goals(setting))
        failed = [check for check in outcome.judged if not check.passed]
        return replace(outcome, known_failure=self.known_failure(setting, failed))

    def run(self, setting: Setting) -> Outcome:
        """Runs the case once."""
        if setting.variant not in self.all_variants or setting.material not in self.materials:
            raise ValueError(f"{self.id} has no variant '{setting.variant}' for {setting.material}")
        if setting.solver not in self.solvers:
            raise ValueError(f"{self.id} says nothing about the solver '{setting.solver}'")
        start = time.perf_counter()
        checks = self.function(setting)
        return self.outcome(setting, checks, time.perf_counter() - start)
