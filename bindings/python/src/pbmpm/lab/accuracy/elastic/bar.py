"""Axial vibration of a bar that is fixed at one end: a quarter wave of sound.

The bar is let go with the velocities of its first mode, so it swings at one frequency. With nu = 0 the motion is linear
at any amplitude, in both material models' limit of small strain and for the fixed corotated one exactly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...simulation import RunSettings
from .signal import Oscillation, fit_oscillation
from .stage import Record, Stage, lattice, run
from .theory import Solid, bar_angular_frequency

STRAIN = 0.01  # largest strain of the swing
WIDTH_CELLS = 4
PERIODS = 5.0
_SPEED_LIMIT = 20.0  # times the largest speed of the swing


@dataclass(frozen=True)
class Bar:
    """A bar along the first axis, fixed at 0."""

    solid: Solid
    length: float  #: [m]
    cells: int = 32  #: over the length

    @property
    def cell_size(self) -> float:
        return self.length / self.cells

    @property
    def frequency(self) -> float:
        """Of the exact motion [Hz]."""
        return bar_angular_frequency(self.solid, self.length) / (2.0 * math.pi)

    def swing(self, settings: RunSettings) -> tuple[Record, Oscillation | None]:
        """Lets the bar swing for PERIODS periods of the exact motion; the observed value is the mean place of the last
        cell of the bar along its axis [m]."""
        speed = STRAIN * math.sqrt(self.solid.slender_modulus / self.solid.density)
        wave = math.pi / (2.0 * self.length)
        dimension = self.solid.dimension
        size = np.array([self.length] + [WIDTH_CELLS * self.cell_size] * (dimension - 1))
        points = lattice([0.0] * dimension, size, self.cell_size)
        gradient = np.zeros((len(points), dimension, dimension))
        gradient[:, 0, 0] = speed * wave * np.cos(wave * points[:, 0])

        def velocity(places: np.ndarray) -> np.ndarray:
            along = np.zeros_like(places)
            along[:, 0] = speed * np.sin(wave * places[:, 0])
            return along

        with Stage(self.solid, self.cell_size, settings, len(points)) as stage:
            ids = stage.add_body(points, float(np.prod(size)), velocity, gradient)
            stage.clamp(axis=0, face=0.0, side=1)
            tip = ids[points[:, 0] > self.length - self.cell_size]
            seconds = PERIODS / self.frequency
            record = run(stage, seconds, lambda: stage.mean_position(tip)[0], _SPEED_LIMIT * speed)
        found = fit_oscillation(record.times, record.values, self.frequency) if record.stable else None
        return record, found


CLASSIC_BAR = Bar(Solid(young=100.0, poisson=0.0, density=1.0), length=25.0, cells=50)
"""The bar of the literature: it swings once in 10 s."""

STIFF_BAR = Bar(Solid(young=1e6, poisson=0.0, density=1000.0), length=1.0)
"""A bar of a size that games have: 7.906 Hz."""
