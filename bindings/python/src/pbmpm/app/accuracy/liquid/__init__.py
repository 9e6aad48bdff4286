"""Reference cases of liquids."""

from __future__ import annotations

from .column import Column
from .dam_break import DamBreak

LIQUID_CASES = (DamBreak, Column)
