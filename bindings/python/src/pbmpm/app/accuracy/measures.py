"""Fronts, heights and their errors against measured curves."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import resources

import numpy as np

MIN_PARTICLES = 2
"""A slice one cell wide belongs to the body when it holds this many particles (half of a full cell at 2 per axis)."""

SHIFT_LIMIT = 0.5
_SHIFT_STEP = 0.005


def body_extent(coordinates: np.ndarray, cell_size: float, spacing: float) -> float:
    """How far a body of particles reaches from 0 along one axis [m].

    The axis is cut into slices one cell wide. The body goes on up to the first slice with fewer than MIN_PARTICLES
    particles, so drops that fly ahead do not count. Its end is the outermost particle of the last slice plus half the
    lattice spacing.
    """
    slices = np.floor(coordinates / cell_size).astype(np.int64)
    counts = np.bincount(np.maximum(slices, 0), minlength=1)
    gaps = np.nonzero(counts < MIN_PARTICLES)[0]
    last = (gaps[0] if len(gaps) else len(counts)) - 1
    if last < 0:
        return 0.0
    return float(coordinates[slices <= last].max()) + 0.5 * spacing


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
