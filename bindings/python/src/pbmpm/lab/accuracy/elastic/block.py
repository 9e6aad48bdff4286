"""A block under its own weight: the whole curve of stress against stretch from one state at rest.

Hanging from its upper end or standing on a slippery floor, each layer of the block carries the weight of what is
beyond it, so by statics alone its nominal stress is known: P = rho g Y, with Y the rest distance from the free end.
Its stretch is measured from where the particles are, and compared with the stretch that the material's law gives for
P.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

import pbmpm

from ...simulation import RunSettings
from . import strain
from .stage import CLAMP_OVERLAP, Calmer, Record, Stage, lattice, run
from .theory import Solid, bar_angular_frequency

GRAVITY = 9.81
_FREE_END_CELLS = 2.0
_FLOOR_CELLS = 2.0
_SPEED_LIMIT = 10.0  # times the speed of a free fall over the height
_STRETCHES = (0.3, 3.0)  # of the search
_HALVINGS = 50  # of a bisection: to the rounding of double precision


def uniaxial_stress(solid: Solid, model: str, stretches: np.ndarray) -> np.ndarray:
    """Nominal stress of a block that is stretched along one axis while the others are free [Pa], for each stretch.

    The lateral stretch is where the lateral stress vanishes; that rises with it, so bisection finds it.
    """
    low, high = np.full(np.shape(stretches), 0.05), np.full(np.shape(stretches), 5.0)
    for _ in range(_HALVINGS):
        lateral = 0.5 * (low + high)
        axial, across = _axial_and_lateral(solid, model, stretches, lateral)
        low, high = np.where(across > 0.0, low, lateral), np.where(across > 0.0, lateral, high)
    return axial


def _axial_and_lateral(
    solid: Solid, model: str, stretches: np.ndarray, laterals: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    deformations = np.stack([stretches] + [laterals] * (solid.dimension - 1), axis=-1)[..., None] * np.eye(
        solid.dimension
    )
    stress = strain.piola_stress(solid, model, deformations)
    return stress[..., 0, 0], stress[..., 1, 1]


def uniaxial_stretch(solid: Solid, model: str, stresses: np.ndarray) -> np.ndarray:
    """The stretch under each nominal stress; ValueError outside [0.3, 3]."""
    least, most = uniaxial_stress(solid, model, np.array(_STRETCHES))
    outside = stresses[(stresses < least) | (stresses > most)]
    if len(outside):
        raise ValueError(f"no stretch in [{_STRETCHES[0]:g}, {_STRETCHES[1]:g}] gives {outside[0]:g} Pa")
    low, high = np.full(stresses.shape, _STRETCHES[0]), np.full(stresses.shape, _STRETCHES[1])
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        too_far = uniaxial_stress(solid, model, middle) > stresses
        low, high = np.where(too_far, low, middle), np.where(too_far, middle, high)
    return 0.5 * (low + high)


@dataclass(frozen=True)
class Profile:
    """Stretch of the layers of a block that carry a known stress."""

    stresses: np.ndarray  #: nominal [Pa], negative: pressed
    stretches: np.ndarray  #: measured
    truths: np.ndarray  #: of the material's law

    @property
    def error(self) -> float:
        """Root mean square error of the stretches over the largest change of length."""
        return float(np.sqrt(np.mean((self.stretches - self.truths) ** 2)) / np.abs(self.truths - 1.0).max())


@dataclass(frozen=True)
class Block:
    """A block along the second axis, from 0 up."""

    model: str = strain.FIXED_COROTATED
    load: float = 0.5
    """Stress at the held end over E: rho g height / E. Positive: it hangs; negative: it stands."""
    poisson: float = 0.3
    dimension: int = 2
    height: float = 1.0  #: [m]
    cells: int = 32  #: over the height
    width_cells: int = 8
    """A standing block must be about as wide as high: it buckles under 12 load (height / width)^2 > 7.84."""

    particles_per_axis: int = 3
    """With 2, layers that stretch by more than a fifth have less than two rows to a cell and stretch 5 % too far."""

    @property
    def cell_size(self) -> float:
        return self.height / self.cells

    @property
    def solid(self) -> Solid:
        density = 1000.0
        return Solid(density * GRAVITY * self.height / abs(self.load), self.poisson, density, self.dimension)

    def settle(self, settings: RunSettings, seconds: float) -> tuple[Record, Profile | None]:
        """Lets the block find its rest, where the integrator does not matter: backward Euler."""
        settings = replace(settings, integrator="euler")
        points = self._points()
        down = [0.0, -GRAVITY, 0.0][: self.dimension]
        with Stage(self.solid, self.cell_size, settings, len(points), down, self.model) as stage:
            ids = stage.add_body(points, len(points) * (self.cell_size / self.particles_per_axis) ** self.dimension)
            self._hold(stage)
            calmer = Calmer(stage, ids, bar_angular_frequency(self.solid, self.height) / (2.0 * math.pi))
            record = run(stage, seconds, calmer.look, _SPEED_LIMIT * (2.0 * GRAVITY * self.height) ** 0.5)
            profile = self._profile(points, stage.state(ids).positions) if record.stable else None
        return record, profile

    @property
    def _width(self) -> float:
        return self.width_cells * self.cell_size

    def _points(self) -> np.ndarray:
        """Of the block, around 0 along the other axes. One that hangs widens to twice its width towards its hold, as specimens
        of a tensile test do: it cannot narrow there, the strain at the corners would grow without end as cells get
        smaller, and it would tear off."""
        reach = self._width * (1.0 if self.load > 0.0 else 0.5)
        lower, upper = np.full(self.dimension, -reach), np.full(self.dimension, reach)
        lower[1], upper[1] = 0.0, self.height
        points = lattice(lower, upper, self.cell_size, self.particles_per_axis)
        shoulder = np.clip(1.0 - (self.height - points[:, 1]) / self._width, 0.0, 1.0) if self.load > 0.0 else 0.0
        half_width = 0.5 * self._width * (1.0 + shoulder**2)
        return points[np.abs(np.delete(points, 1, axis=1)).max(axis=1) < half_width]

    def _hold(self, stage: Stage) -> None:
        if self.load > 0.0:
            stage.clamp(axis=1, face=self.height, side=-1)
            return
        floor = [0.0, CLAMP_OVERLAP * self.cell_size, 0.0][: self.dimension]
        up = [0.0, 1.0, 0.0][: self.dimension]
        stage.world.add_collider(pbmpm.Plane(floor, up), friction=pbmpm.Friction.SLIP)

    def _profile(self, points: np.ndarray, places: np.ndarray) -> Profile:
        """Layers are pairs of neighbouring rows of particles; those near the ends are left out.

        At a held end the block cannot narrow, which is felt up to about its width away.
        """
        rows, row = np.unique(np.round(points[:, 1], 9), return_inverse=True)
        heights = np.bincount(row, weights=places[:, 1]) / np.bincount(row)
        gap = self.particles_per_axis  # rows a cell apart
        stretches = (heights[gap:] - heights[:-gap]) / (rows[gap:] - rows[:-gap])
        middles = 0.5 * (rows[gap:] + rows[:-gap])
        hangs = self.load > 0.0
        free_end = middles if hangs else self.height - middles
        held = self._width if hangs else _FLOOR_CELLS * self.cell_size
        far = (free_end > _FREE_END_CELLS * self.cell_size) & (self.height - free_end > held)
        stresses = np.sign(self.load) * self.solid.density * GRAVITY * free_end[far]
        truths = uniaxial_stretch(self.solid, self.model, stresses)
        return Profile(stresses, stretches[far], truths)
