"""Words that files and options use for the members of the library's enumerations."""

from __future__ import annotations

from typing import Literal

SolverName = Literal["paper", "dual", "primal", "explicit", "convergent"]
PressureName = Literal["particles", "cells"]
IntegratorName = Literal["euler", "bdf2"]
