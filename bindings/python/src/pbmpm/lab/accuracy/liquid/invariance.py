"""A drop in free space must not care where it drifts to or how it is turned: Galilean and rotation invariance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...simulation import Simulation
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from ..trial import Trial
from .common import kinetic_energy
from .drop import Stretch, drop_scene

STEPS = 100
DRIFT = (0.37, 0.21)  # [cells per step]


@dataclass(frozen=True)
class Invariance(Case):
    """The stretching drop: at rest, drifting, and turned."""

    radius: float = 1.0

    name = "invariance"
    title = "Galilean and rotation invariance of a drop, planar"
    dimension = 2
    kind = "liquid"
    truth = "exact: the same motion, carried along by 0.37 and 0.21 cells per step, or turned by 45 or 90 degrees; 100 steps"
    error_kinds = (
        ErrorMeasure("galilean", "discretisation", "cells", "RMS distance of the particles of the drifting drop", 0.02),
        ErrorMeasure("turned_45", "discretisation", "%", "|a_turned - a| / a at the end", 0.03),
        ErrorMeasure("turned_90", "discretisation", "%", "|a_turned - a| / a at the end: the grid is the same", 1e-5),
    )
    length_name = "radius of the drop"
    searched = False
    notes = "The rate sets how far the drop stretches in its 100 steps."

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.radius

    def sweep(self, quick: bool) -> list[Setting]:
        variants = ("paper", "dual", "dual-cells-flip0.9")
        if quick:
            return settings_of(variants, (120,), (5,), (12,))
        explicit = settings_of(("explicit",), (480, 960), (1,), (16,))
        return settings_of((*variants, "dual-cells"), (120, 240), (1, 5, 20), (16, 32)) + explicit

    def measure(self, setting: Setting) -> Measurement:
        run, places, axis = self._run(setting, Stretch())
        cell = self.cell_size(setting)
        drift = (DRIFT[0] * cell * setting.rate_hz, DRIFT[1] * cell * setting.rate_hz)
        _, drifted, _ = self._run(setting, Stretch(drift=drift))
        carried = np.array(drift) * STEPS * setting.dt
        turned = {angle: self._run(setting, Stretch(angle=math.radians(angle)))[2] for angle in (45, 90)}
        distance = float(np.sqrt(np.mean(np.sum((drifted - carried - places) ** 2, axis=1)))) / cell
        return run.measurement(
            {"galilean": distance, **{f"turned_{angle}": abs(turned[angle] / axis - 1.0) for angle in turned}},
            observed=(axis,),
        )

    def distance(self, observed: tuple[float, ...], other: tuple[float, ...]) -> float:
        """The axis alone says nothing about the headline's cells: relative difference of the axes."""
        return abs(observed[0] / other[0] - 1.0)

    def _run(self, setting: Setting, stretch: Stretch) -> tuple[Trial, np.ndarray, float]:
        """The run, its particles in the order of their identities, and the spread along the axis that shrinks."""
        found: list[tuple[np.ndarray, float]] = []

        def observe(simulation: Simulation) -> None:
            world = simulation.world
            order = np.argsort(world.ids.array()[:, 0])
            found[:] = [(world.positions.array()[order].astype(np.float64), float(stretch.spreads(simulation)[0]))]

        run = Trial(
            drop_scene("drop_invariance", setting, self.cell_size(setting), self.radius),
            setting,
            STEPS * setting.dt,
            start_energy=kinetic_energy,
            prepare=stretch.start,
            observe=observe,
            every=STEPS,
        )
        return run, *found[0]
