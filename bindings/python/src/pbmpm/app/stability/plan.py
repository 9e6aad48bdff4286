"""Which runs a map consists of."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from ..errors import InputError
from ..hardcases import CASES, SOLVERS, HardCase, Setting, find_case
from ..hardcases.case import EXPLICIT, SEED

RATES = (15.0, 30.0, 60.0, 120.0, 240.0, 480.0)
ITERATIONS = (1, 2, 5, 10, 20)
MATERIALS = tuple(dict.fromkeys(material for case in CASES for material in case.materials))
DIMENSIONS = (2, 3)


@dataclass(frozen=True)
class Selection:
    """What to run. None for rates and iterations: the quick form, in which each case runs at its own."""

    cases: tuple[HardCase, ...] = CASES
    solvers: tuple[str, ...] = SOLVERS
    rates: tuple[float, ...] | None = RATES
    iterations: tuple[int, ...] | None = ITERATIONS
    materials: tuple[str, ...] = MATERIALS
    dimensions: tuple[int, ...] = DIMENSIONS
    variant: str | None = None  #: None: all
    seed: int = SEED


@dataclass(frozen=True)
class Run:
    """One case at one setting."""

    case: str
    setting: Setting

    @property
    def work(self) -> float:
        """Expected cost, relative: a step costs about as much as three iterations, a third dimension four times as much."""
        return self.setting.rate_hz * (self.setting.iterations + 3) * (4.0 if self.setting.dimension == 3 else 1.0)

    @property
    def command(self) -> str:
        """What replays this run alone."""
        setting = self.setting
        return (
            f"pbmpm stability {self.case} --solvers {setting.solver} --materials {setting.material}"
            f" --dims {setting.dimension} --rates {setting.rate_hz:g} --iterations {setting.iterations}"
            f" --variant '{setting.variant}' --seed {setting.seed}"
        )


def cases_named(names: Sequence[str]) -> tuple[HardCase, ...]:
    """The cases with these numbers in the order of the catalogue; all when there are none."""
    try:
        wanted = {find_case(name).id for name in names}
    except ValueError as error:
        raise InputError(str(error)) from None
    return tuple(case for case in CASES if not wanted or case.id in wanted)


def plan(selection: Selection) -> list[Run]:
    """All runs of a selection; InputError when nothing fits."""
    runs = [Run(case.id, setting) for case in selection.cases for setting in _settings(case, selection)]
    if not runs:
        raise InputError(f"nothing to run: {_why_empty(selection)}")
    return runs


def _settings(case: HardCase, selection: Selection) -> Iterator[Setting]:
    for setting in _all_settings(case, selection):
        if (
            setting.material in selection.materials
            and setting.dimension in selection.dimensions
            and selection.variant in (None, setting.variant)
        ):
            yield replace(setting, seed=selection.seed)


def _all_settings(case: HardCase, selection: Selection) -> Iterator[Setting]:
    is_full = (selection.rates, selection.iterations) == (RATES, ITERATIONS)
    for solver in selection.solvers:
        for rate, iterations in _rates_and_iterations(case, selection, solver):
            yield from case.settings(rate, iterations, solver)
        if is_full or selection.variant in case.long_variants:
            yield from case.settings(solver=solver, long=True)


def _rates_and_iterations(
    case: HardCase, selection: Selection, solver: str
) -> Iterator[tuple[float | None, int | None]]:
    """The explicit solver does not iterate: it runs once per rate. The full form takes in all rates of a case's ladder."""
    rates: tuple[float | None, ...] = selection.rates or (None,)
    if rates == RATES:
        rates = tuple(dict.fromkeys((*RATES, *(rate for rate, _ in case.ladder))))
    counts: tuple[int | None, ...] = (1,) if solver == EXPLICIT else selection.iterations or (None,)
    return itertools.product(rates, counts)


def _why_empty(selection: Selection) -> str:
    variants = sorted({variant for case in selection.cases for variant in case.variants + case.long_variants})
    if selection.variant is not None and selection.variant not in variants:
        return f"no variant '{selection.variant}'; there are: {', '.join(variants)}"
    return "none of these cases has these solvers, materials and dimensions"
