"""Reference cases of liquids."""

from __future__ import annotations

from .channel import Couette, Poiseuille
from .column import Column
from .dam_break import DamBreak
from .drop import EllipticalDrop
from .invariance import Invariance
from .vortex import TaylorGreen
from .wave import StandingWave

LIQUID_CASES = (DamBreak, Column, EllipticalDrop, StandingWave, TaylorGreen, Couette, Poiseuille, Invariance)
