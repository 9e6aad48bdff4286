"""What the solver's own compressibility predicts.

After N iterations per substep of length dt with relaxation w on cells of size dx, a liquid acts with the bulk modulus
K = rho w N dx^2 / (4 d dt^2): a strain of 1/J - 1 gives the pressure K (1/J - 1) / J, since the impulse is that of the rest
volume and its gradient is over the present one. A column of rest height h0 then stands so that each layer carries the
weight above it: (1/J - 1) / J = q with q = rho g (h0 - X) / K for the layer at rest height X, so 1/J = (1 + sqrt(1 + 4 q)) / 2.
For a stiff liquid the mean of 1 - J is the familiar rho g h0 / (2 K); the functions below keep the whole profile, so that
soft settings are predicted too.
"""

from __future__ import annotations

import math

import numpy as np

_LAYERS = 2000


def bulk_modulus_over_density(dimension: int, cell_size: float, dt: float, iterations: int, relaxation: float) -> float:
    """K / rho [m^2/s^2]; ``dt`` is the length of a substep."""
    return relaxation * iterations * cell_size**2 / (4 * dimension * dt**2)


def young_modulus_over_density(cell_size: float, dt: float, iterations: int, relaxation: float) -> float:
    """E / rho [m^2/s^2] of the paper's elastic matter, the square of its speed of sound; ``dt`` is the length of a substep."""
    return relaxation * iterations * cell_size**2 / (4 * dt**2)


def stored_when_flattened(stretch: float, relaxation: float, rebound_max: float) -> float:
    """Energy of the paper's elastic matter that is pressed to `stretch` < 1 along one axis, over that of the modulus, E.

    An iteration changes D by w X with X = V^-1 - I, which acts as the Kirchhoff stress E (I - V^-1): 1/s - 1 times E for a stretch s. Its work over
    dD = ds/s is 1/s + ln s - 1. The part beyond |w X| = rebound_max is cut off: from s0 = 1 / (1 + rebound_max / w) on it stays the same and adds
    its work over ln(s0 / s). (An elastic solid of modulus E that is pressed flat holds E/2 by Hooke's law.)
    """
    pressed = rebound_max / relaxation
    softens = max(stretch, 1.0 / (1.0 + pressed))
    return 1.0 / softens + math.log(softens) - 1.0 + pressed * math.log(softens / stretch)


def transfer_damping(wave_number: float, cell_size: float, dt: float, rounds: int) -> float:
    """Rate at which a shear flow decays [1/s] whose stream function has the wave number k per axis of a plane, by `rounds` transfers to the nodes and
    back per substep; the paper's solver makes one per iteration.

    A round leaves what an affine fit over the stencil can tell: of such a flow 1 - 0.024 |k dx|^4 with |k|^2 = 2 k^2, which acts as a viscosity of
    0.024 N |k|^2 dx^4 / dt. That is of long waves: a vortex of 8 cells loses half of that by 20 rounds, over which the particles stay in place, and 1.5
    times as much by one.
    """
    return 0.024 * rounds * (2.0 * (wave_number * cell_size) ** 2) ** 2 / dt


#: Share of a particle's last pressure that a single iteration of the dual solver starts from.
CARRIED_SHARE = 0.45


def single_iteration_modulus_over_density(dimension: int, cell_size: float, dt: float, relaxation: float) -> float:
    """K / rho [m^2/s^2] of the dual solver's incompressible liquid at rest with one iteration.

    The iteration adds w/d (1/J - 1) to the pressure that it starts from, so at rest s = carried s + w/d (1/J - 1): 1 / (1 - carried)
    times what the paper's iteration, which starts from nothing, bears at the same J.
    """
    return bulk_modulus_over_density(dimension, cell_size, dt, 1, relaxation) / (1.0 - CARRIED_SHARE)


def column_profile(height: float, gravity: float, modulus: float) -> np.ndarray:
    """J of equally thick rest layers of a column at rest, from the bottom to the top."""
    rest_heights = (np.arange(_LAYERS) + 0.5) * height / _LAYERS
    load = gravity * (height - rest_heights) / modulus
    return 2.0 / (1.0 + np.sqrt(1.0 + 4.0 * load))


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
