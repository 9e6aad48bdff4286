"""Fronts, heights and their errors against measured curves."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import resources

import numpy as np

MIN_PARTICLES = 2
"""A slice one cell wide belongs to the body when it holds this many particles."""

SHIFT_LIMIT = 0.5
_SHIFT_STEP = 0.005


def body_extent(coordinates: np.ndarray, cell_size: float, spacing: float, rows: int = 1) -> float:
    """How far a body of particles reaches from 0 along one axis [m].

    The axis is cut into slices one cell wide. The body goes on up to the first two slices in a row with fewer than
    MIN_PARTICLES particles, so drops that fly ahead do not count and a chance hole does not end it. Its end is the
    outermost particle of the last slice plus half the lattice spacing. ``rows``: so many stand side by side across the
    body, each of which has as many particles in a slice.
    """
    slices = np.maximum(np.floor(coordinates / cell_size), 0).astype(np.int64)
    filled = np.append(np.bincount(slices) >= rows * MIN_PARTICLES, [False, False])
    last = int(np.argmax(~filled[:-1] & ~filled[1:])) - 1
    inside = coordinates[slices <= last]
    return float(inside.max()) + 0.5 * spacing if len(inside) else 0.0


def occupied_area(positions: np.ndarray, cell_size: float) -> float:
    """The area that water above the floor takes [m^2], whatever waves it makes.

    Each column of cells counts as high as twice the mean height of its particles.
    """
    columns = np.maximum(np.floor(positions[:, 0] / cell_size), 0).astype(np.int64)
    counts = np.bincount(columns)
    heights = np.bincount(columns, weights=positions[:, 1])
    return 2.0 * cell_size * float(np.sum(heights / np.maximum(counts, 1)))


@dataclass(frozen=True)
class Curve:
    """A measured or simulated quantity over time, both dimensionless."""

    times: np.ndarray
    values: np.ndarray

    def at(self, times: np.ndarray) -> np.ndarray:
        """Linear between the points; constant before the first and after the last."""
        return np.interp(times, self.times, self.values)


def dam_break_experiment(quantity: str) -> Curve:
    """Martin and Moyce 1952, n^2 = 2, a = 2.25 in: "front" is Z(T), "height" is H(tau); see the file for the axes."""
    source = resources.files(__package__).joinpath("../data/dam_break_martin_moyce_1952.csv")
    rows = [line.split(",") for line in source.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    points = [(float(time), float(value)) for _, name, time, value, _ in rows[1:] if name == quantity]
    times, values = np.array(sorted(points)).T
    return Curve(times, values)


def relative_rms(simulated: Curve, measured: Curve, shift: float = 0.0) -> float:
    """RMS of (simulated - measured) / measured; ``shift`` is added to the simulation's time."""
    ratio = simulated.at(measured.times - shift) / measured.values - 1.0
    return float(np.sqrt(np.mean(ratio**2)))


def absolute_rms(simulated: Curve, measured: Curve) -> float:
    """RMS of simulated - measured."""
    return float(np.sqrt(np.mean((simulated.at(measured.times) - measured.values) ** 2)))


def best_shift(simulated: Curve, measured: Curve) -> tuple[float, float]:
    """The time shift within SHIFT_LIMIT that makes ``relative_rms`` smallest, and that error."""
    shifts = np.arange(-SHIFT_LIMIT, SHIFT_LIMIT + 0.5 * _SHIFT_STEP, _SHIFT_STEP)
    errors = [relative_rms(simulated, measured, shift) for shift in shifts]
    best = int(np.argmin(errors))
    return float(round(shifts[best], 6)), errors[best]
