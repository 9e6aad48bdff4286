"""Energy and stress of elastic bodies from the deformation gradients of their particles, and sums over a body.

The models are those of ``pbmpm_elastic_model``. Everything is computed here in double precision and apart from the
library, so that it can judge it.
"""

from __future__ import annotations

import numpy as np

from .theory import Solid

FIXED_COROTATED = "FCR"
NEO_HOOKEAN = "NH"


def rotations(deformations: np.ndarray) -> np.ndarray:
    """The rotation nearest to each F, with determinant 1."""
    left, _, right = np.linalg.svd(deformations)
    left[..., :, -1] *= np.linalg.det(left @ right)[..., None]
    return left @ right


def energy_and_stress(solid: Solid, model: str, deformations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stored energy per rest volume [J/m^d], and first Piola stress, its derivative by F [Pa]."""
    volume = np.linalg.det(deformations)
    inverse = np.swapaxes(np.linalg.inv(deformations), -1, -2)
    if model == FIXED_COROTATED:
        away, excess = deformations - rotations(deformations), volume - 1.0
        energy = solid.shear * np.sum(away**2, axis=(-2, -1)) + 0.5 * solid.lame * excess**2
        return energy, 2.0 * solid.shear * away + solid.lame * (excess * volume)[..., None, None] * inverse
    log = np.log(volume)
    square = np.sum(deformations**2, axis=(-2, -1)) - deformations.shape[-1]
    energy = 0.5 * solid.shear * square - solid.shear * log + 0.5 * solid.lame * log**2
    return energy, solid.shear * (deformations - inverse) + solid.lame * log[..., None, None] * inverse


def energy_density(solid: Solid, model: str, deformations: np.ndarray) -> np.ndarray:
    """Stored energy per rest volume [J/m^d]."""
    return energy_and_stress(solid, model, deformations)[0]


def piola_stress(solid: Solid, model: str, deformations: np.ndarray) -> np.ndarray:
    """First Piola stress [Pa]."""
    return energy_and_stress(solid, model, deformations)[1]


def strain_energy(solid: Solid, model: str, deformations: np.ndarray, masses: np.ndarray) -> float:
    """Of a body [J]; the rest volume of a particle is its mass over the density."""
    return float(np.sum(masses / solid.density * energy_density(solid, model, deformations)))


def kinetic_energy(velocities: np.ndarray, affine: np.ndarray, masses: np.ndarray, cell_size: float) -> float:
    """With the motion within each particle's neighbourhood: its second moment is m dx^2 / 4 per axis [J]."""
    inner = 0.25 * cell_size**2 * np.sum(affine**2, axis=(-2, -1))
    return 0.5 * float(np.sum(masses * (np.sum(velocities**2, axis=-1) + inner)))


def angular_momentum(
    positions: np.ndarray, velocities: np.ndarray, affine: np.ndarray, masses: np.ndarray, cell_size: float
) -> float:
    """About the centre of mass and, in 3D, the third axis, with the part within each particle's neighbourhood [J s]."""
    total = masses.sum()
    arm = positions - masses @ positions / total
    speed = velocities - masses @ velocities / total
    turning = arm[:, 0] * speed[:, 1] - arm[:, 1] * speed[:, 0]
    return float(np.sum(masses * (turning + 0.25 * cell_size**2 * (affine[:, 1, 0] - affine[:, 0, 1]))))
