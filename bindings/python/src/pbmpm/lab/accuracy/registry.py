"""All reference cases, in the order in which they are listed."""

from __future__ import annotations

from ..errors import InputError
from ..._fixed import nearest
from .case import Case


def all_cases() -> list[Case]:
    """One of each, at their default sizes."""
    from . import elastic
    from .granular import GRANULAR_CASES
    from .liquid import LIQUID_CASES
    from .slump import SLUMP_CASES

    return [make() for make in (*LIQUID_CASES, *getattr(elastic, "ELASTIC_CASES", ()), *GRANULAR_CASES, *SLUMP_CASES)]


def find_cases(names: tuple[str, ...] | list[str]) -> list[Case]:
    """The cases of these names, or all without names; InputError names the one that is unknown."""
    cases = {case.name: case for case in all_cases()}
    unknown = [name for name in names if name not in cases]
    if unknown:
        raise InputError(f"there is no case '{unknown[0]}' (there are: {', '.join(cases)}){nearest(unknown[0], cases)}")
    return [cases[name] for name in names] if names else list(cases.values())
