"""All hard cases, in the order of their numbers."""

from __future__ import annotations

import re

from . import bad_input, changes, contrast, energy, impact, ladder, overfull, rate, rest, shape, strain, volume
from ...._fixed import nearest
from .case import HardCase

_MODULES = (bad_input, changes, contrast, energy, impact, ladder, overfull, rate, rest, shape, strain, volume)
CASES: tuple[HardCase, ...] = tuple(sorted((case for module in _MODULES for case in module.CASES), key=lambda case: case.id))


def find_case(identifier: str) -> HardCase:
    """The case with this number ("H03" or "h3"); ValueError with the list of all when there is none."""
    wanted = re.sub(r"^H(\d)$", r"H0\1", identifier.upper())
    for case in CASES:
        if case.id == wanted:
            return case
    known = [case.id for case in CASES]
    raise ValueError(f"there is no hard case '{identifier}'; there are {', '.join(known)}{nearest(identifier, known)}")
