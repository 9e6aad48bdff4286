"""Words that files and options use for the members of the library's enumerations."""

from __future__ import annotations

from typing import Literal

SolverName = Literal["paper", "dual", "primal", "explicit", "convergent"]
PressureName = Literal["particles", "cells"]
IntegratorName = Literal["euler", "bdf2"]

EffectName = Literal[
    "liquid",
    "elastic",
    "sand",
    "visco",
    "viscosity",
    "kinematic_viscosity",
    "volume_feedback",
    "pressure_in_cells",
    "flip",
    "bdf2",
    "emitters",
    "drains",
    "kill_bounds",
    "uniform_force",
    "radial_force",
    "vortex_force",
    "drag_force",
    "grab_force",
    "obstacles",
    "moving_obstacles",
    "baked_solids",
    "rigid_bodies",
    "impulses",
    "sleeping",
]
"""Effects that a scene can have; what they are says `pbmpm.lab.effects.catalogue`."""
