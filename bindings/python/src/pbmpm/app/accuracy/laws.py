"""What the solver's own compressibility predicts.

After N iterations per substep of length dt with relaxation w on cells of size dx, a liquid acts with the bulk modulus
K = rho w N dx^2 / (4 d dt^2). A column of rest height h0 then stands so that each layer carries the weight above it:
1/J - 1 = rho g (h0 - X) / K for the layer at rest height X. For a stiff liquid its mean is the familiar
rho g h0 / (2 K); the functions below keep the whole profile, so that soft settings are predicted too.
"""

from __future__ import annotations

import numpy as np

_LAYERS = 2000


def bulk_modulus_over_density(dimension: int, cell_size: float, dt: float, iterations: int, relaxation: float) -> float:
    """K / rho [m^2/s^2]; ``dt`` is the length of a substep."""
    return relaxation * iterations * cell_size**2 / (4 * dimension * dt**2)


def column_profile(height: float, gravity: float, modulus: float) -> np.ndarray:
    """J of equally thick rest layers of a column at rest, from the bottom to the top."""
    rest_heights = (np.arange(_LAYERS) + 0.5) * height / _LAYERS
    return 1.0 / (1.0 + gravity * (height - rest_heights) / modulus)


def mean_compression(height: float, gravity: float, modulus: float) -> float:
    """How much of its rest height a column at rest has lost."""
    return 1.0 - float(column_profile(height, gravity, modulus).mean())


def apparent_height_ratio(volume_ratios: np.ndarray) -> float:
    """Twice the height of the centre of mass over the rest height, for layers with these J."""
    tops = np.cumsum(volume_ratios)
    middles = tops - 0.5 * volume_ratios
    return 2.0 * float(middles.mean()) / len(volume_ratios)


def settled_volume_error(height: float, gravity: float, modulus: float) -> float:
    """Root mean square of 1 - J over a settled column."""
    return float(np.sqrt(np.mean((1.0 - column_profile(height, gravity, modulus)) ** 2)))
