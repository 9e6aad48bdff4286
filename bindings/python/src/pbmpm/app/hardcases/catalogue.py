"""All hard cases, in the order of their numbers."""

from __future__ import annotations

from . import bad_input, energy, impact, overfull, rate, strain, volume
from .case import HardCase

CASES: tuple[HardCase, ...] = tuple(
    sorted(
        (*volume.CASES, *strain.CASES, *energy.CASES, *bad_input.CASES, *impact.CASES, *overfull.CASES, *rate.CASES),
        key=lambda case: case.id,
    )
)


def find_case(identifier: str) -> HardCase:
    """The case with this number ("H03"); ValueError with the list of all when there is none."""
    for case in CASES:
        if case.id == identifier.upper():
            return case
    raise ValueError(f"there is no hard case '{identifier}'; there are {', '.join(case.id for case in CASES)}")
