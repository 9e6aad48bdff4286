"""Which runs a map consists of."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from ..errors import InputError
from .cases import CASES, SOLVERS, HardCase, Setting, find_case
from .cases.case import EXPLICIT, SEED

RATES = (15.0, 30.0, 60.0, 120.0, 240.0, 480.0)
ITERATIONS = (1, 2, 5, 10, 20)
MATERIALS = tuple(dict.fromkeys(material for case in CASES for material in case.materials))
DIMENSIONS = (2, 3)


@dataclass(frozen=True)
class Selection:
    """What to run. Rates or iterations that are given are run with all that is selected; without them each case runs at its own
    setting in the quick form and over the map in the full one."""

    cases: tuple[HardCase, ...] = CASES
    solvers: tuple[str, ...] = SOLVERS
    quick: bool = False
    rates: tuple[float, ...] | None = None
    iterations: tuple[int, ...] | None = None
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
    for solver in selection.solvers:
        if selection.quick or selection.rates or selection.iterations:
            yield from _chosen_settings(case, selection, solver)
        else:
            yield from _map_settings(case, solver)


def _chosen_settings(case: HardCase, selection: Selection, solver: str) -> Iterator[Setting]:
    """All variants at the rates and iterations that are given. What only the map has runs when it is named."""
    rates: Sequence[float | None] = selection.rates or ((None,) if selection.quick else _rates(case))
    counts: Sequence[int | None] = selection.iterations or ((None,) if selection.quick else ITERATIONS)
    variants = (selection.variant,) if selection.variant in case.all_variants else case.variants
    for rate, count in itertools.product(rates, (1,) if solver == EXPLICIT else counts):
        yield from case.settings(rate, count, solver, variants=variants)


def _map_settings(case: HardCase, solver: str) -> Iterator[Setting]:
    """What varies with the setting: in 2D at all rates with all iterations, in 3D at the corners of the map and at the case's own
    setting, for the kernels of both dimensions are one text. A ladder is climbed in full in both."""
    counts = (1,) if solver == EXPLICIT else ITERATIONS
    rates, own = _rates(case), (case.rate_hz, 1 if solver == EXPLICIT else case.iterations)
    in_3d = {*itertools.product((rates[0], rates[-1]), (counts[0], counts[-1])), own}
    spread = tuple(variant for variant in case.variants if variant not in case.fixed_variants) + case.map_variants
    for place in itertools.product(rates, counts):
        for setting in case.settings(*place, solver, variants=spread):
            if setting.dimension == 2 or case.ladder or place in in_3d:
                yield setting
    yield from case.settings(None, own[1], solver, variants=case.fixed_variants + case.long_variants)


def _rates(case: HardCase) -> tuple[float, ...]:
    """Those of the map and of the case's ladder; only its own for a case that does not care."""
    if case.has_own_steps:
        return (case.rate_hz,)
    return tuple(dict.fromkeys((*RATES, *(rate for rate, _ in case.ladder))))


def _why_empty(selection: Selection) -> str:
    variants = sorted({variant for case in selection.cases for variant in case.all_variants})
    if selection.variant is not None and selection.variant not in variants:
        return f"no variant '{selection.variant}'; there are: {', '.join(variants)}"
    return "none of these cases has these solvers, materials and dimensions"
