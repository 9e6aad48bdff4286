"""How far two runs of one scene are apart, in cells.

Where the motion is the same from run to run, particles are compared one by one. A splash is chaotic: after a while the
same particle is somewhere else in every run, however good, and only what many particles do together can be compared.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..scenes.scene import Scene
from .observe import Observation, Sample

#: Percentiles of the positions along each axis that are compared: the ends are the fronts, the middle is the mean height.
PERCENTILES = (1.0, 5.0, 10.0, 25.0, 50.0, 75.0, 90.0, 95.0, 99.0)
#: Two converged runs whose particles are closer than this [cells] move alike; beyond, the scene counts as chaotic.
ALIKE = 0.25


@dataclass(frozen=True)
class Distance:
    """Root mean squares over the samples."""

    particles: float | None  #: of the particles' distances [cells]; None where not the same particles are left
    spread: float  #: of the percentiles of the positions [cells]
    energy: float  #: of the kinetic energy as a height of fall [cells]; 0 without gravity
    crowding: float  #: of the crowding, over what the lattice has

    @property
    def statistics(self) -> float:
        """The distance of what many particles do together [cells]."""
        return math.hypot(self.spread, self.energy)

    def error(self, by_particles: bool) -> float | None:
        """The figure that settings are judged by."""
        return self.particles if by_particles else self.statistics


def distance(scene: Scene, one: Observation, other: Observation) -> Distance:
    """Between two runs with samples at the same times."""
    pairs = list(zip(one.samples, other.samples, strict=True))
    return Distance(
        _rms([_particles(a, b, scene.cell_size) for a, b in pairs]),
        _rms([_spread(a, b, scene.cell_size) for a, b in pairs]) or 0.0,
        _rms([_energy(a, b, scene) for a, b in pairs]) or 0.0,
        _rms([a.crowding - b.crowding for a, b in pairs]) or 0.0,
    )


def _rms(values: Sequence[float | None]) -> float | None:
    if any(value is None for value in values):
        return None
    return float(np.sqrt(np.mean(np.square(np.array(values, dtype=float)))))


def _particles(a: Sample, b: Sample, cell_size: float) -> float | None:
    if not np.array_equal(a.ids[:, 0], b.ids[:, 0]):
        return None
    offsets = a.positions.astype(float) - b.positions
    return float(np.sqrt((offsets**2).sum(axis=1).mean())) / cell_size


def _spread(a: Sample, b: Sample, cell_size: float) -> float:
    """Over percentiles, axes and materials: a material that keeps its place does not hide one that does not."""
    offsets = [_percentiles(a, material) - _percentiles(b, material) for material in np.unique(b.materials)]
    return float(np.sqrt(np.mean(np.square(offsets)))) / cell_size


def _percentiles(sample: Sample, material: int) -> npt.NDArray[np.float64]:
    return np.percentile(sample.positions[sample.materials == material].astype(float), PERCENTILES, axis=0)


def _energy(a: Sample, b: Sample, scene: Scene) -> float:
    """The kinetic energy of a fall of height H is m g H."""
    gravity = math.hypot(*scene.gravity)
    if gravity == 0.0:
        return 0.0
    return (a.kinetic_energy - b.kinetic_energy) / (b.mass * gravity * scene.cell_size)
