"""Hard cases: scenes that break simulations, each with a measurable criterion.

The catalogue is defined here once; tests and the command line run it.
"""

from .case import SOLVERS, Check, HardCase, Kind, Outcome, Setting
from .catalogue import CASES, find_case

__all__ = ["CASES", "SOLVERS", "Check", "HardCase", "Kind", "Outcome", "Setting", "find_case"]
