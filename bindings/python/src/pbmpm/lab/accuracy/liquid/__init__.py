"""Reference cases of liquids."""

from __future__ import annotations

from .channel import Couette, Poiseuille
from .claims import RecoveryClaim, StabilityClaim, StiffnessClaim, VolumeClaim
from .column import Column
from .dam_break import DamBreak
from .drop import EllipticalDrop
from .invariance import Invariance
from .obstacle import ObstacleDamBreak
from .prediction import ColumnPrediction, DamBreakPrediction
from .vortex import TaylorGreen
from .wave import OffGridWave, StandingWave

LIQUID_CASES = (
    DamBreak,
    ObstacleDamBreak,
    Column,
    EllipticalDrop,
    StandingWave,
    OffGridWave,
    TaylorGreen,
    Couette,
    Poiseuille,
    Invariance,
    ColumnPrediction,
    DamBreakPrediction,
    StabilityClaim,
    StiffnessClaim,
    VolumeClaim,
    RecoveryClaim,
)
