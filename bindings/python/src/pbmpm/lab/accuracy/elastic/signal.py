"""Frequencies, amplitudes and means of measured oscillations."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

_FREQUENCIES, _DECAYS = 121, 9  # of the first search
_ZOOM_ROUNDS = 300
_ZOOM_END = 1e-7  # relative step of the frequency
_MIN_SAMPLES = 6


@dataclass(frozen=True)
class Oscillation:
    """value(t) = offset + amplitude exp(-decay t) cos(2 pi frequency t + phase), fitted to samples."""

    frequency: float  #: [Hz]
    decay: float  #: [1/s]
    amplitude: float  #: at time 0
    offset: float
    residual: float  #: root mean square misfit over the root mean square of the samples around their mean


def fit_oscillation(times: np.ndarray, values: np.ndarray, expected: float) -> Oscillation | None:
    """The damped oscillation that fits best; None when there is none to fit.

    Frequency and decay are searched, from 1/20 to 4 times the expected frequency and from growth to damping within a
    quarter of a period; amplitude, phase and offset follow for each pair by linear least squares.
    """
    if len(times) < _MIN_SAMPLES or not np.all(np.isfinite(values)) or np.ptp(values) == 0.0:
        return None
    times = times - times[0]
    nyquist = 0.5 * (len(times) - 1) / times[-1]
    frequencies = np.geomspace(0.05 * expected, min(4.0 * expected, nyquist), _FREQUENCIES)
    decays = expected * np.concatenate([[-0.2, 0.0], np.geomspace(0.02, 4.0, _DECAYS - 2)])
    trials = [(_misfit(times, values, f, d)[0], f, d) for f in frequencies for d in decays]
    _, frequency, decay = min(trials)
    reach = (frequency * (frequencies[1] / frequencies[0] - 1.0), max(0.2 * expected, abs(decay)))
    frequency, decay = _zoom(times, values, (frequency, decay), reach)
    squares, (cosine, sine, offset) = _misfit(times, values, frequency, decay)
    spread = float(np.sum((values - values.mean()) ** 2))
    return Oscillation(frequency, decay, math.hypot(cosine, sine), float(offset), math.sqrt(squares / spread))


def _misfit(times: np.ndarray, values: np.ndarray, frequency: float, decay: float) -> tuple[float, np.ndarray]:
    """Sum of squares that is left, and the coefficients of cosine, sine and constant."""
    envelope = np.exp(-np.clip(decay * times, -50.0, 50.0))
    angle = 2.0 * math.pi * frequency * times
    basis = np.stack([envelope * np.cos(angle), envelope * np.sin(angle), np.ones_like(times)])
    coefficients = np.linalg.lstsq(basis @ basis.T, basis @ values, rcond=None)[0]
    return float(np.sum((values - coefficients @ basis) ** 2)), coefficients


def _zoom(
    times: np.ndarray, values: np.ndarray, start: tuple[float, float], reach: tuple[float, float]
) -> tuple[float, float]:
    """Walks from the best pair so far to better neighbours, with smaller steps where there is none."""
    here = (_misfit(times, values, *start)[0], *start)
    for _ in range(_ZOOM_ROUNDS):
        around = [
            (here[1] + across * reach[0], here[2] + along * reach[1])
            for across in (-1, 0, 1)
            for along in (-1, 0, 1)
            if (across or along) and here[1] + across * reach[0] > 0.0
        ]
        best = min((_misfit(times, values, *pair)[0], *pair) for pair in around)
        if best[0] < here[0]:
            here = best
        elif reach[0] < _ZOOM_END * here[1]:
            break
        else:
            reach = (0.5 * reach[0], 0.5 * reach[1])
    return here[1], here[2]


@dataclass(frozen=True)
class Swing:
    """A steady oscillation between two turning points."""

    mean: float  #: half way between the turning points
    amplitude: float  #: half their distance
    frequency: float | None  #: [Hz]; None with fewer than two crossings of the mean in one direction


def measure_swing(times: np.ndarray, values: np.ndarray) -> Swing:
    """Turning points are the extremes; the frequency is that of the upward crossings of the mean between them."""
    low, high = float(values.min()), float(values.max())
    mean = 0.5 * (low + high)
    below = values < mean
    rises = np.flatnonzero(below[:-1] & ~below[1:])
    share = (mean - values[rises]) / (values[rises + 1] - values[rises])
    crossings = times[rises] + share * (times[rises + 1] - times[rises])
    frequency = (len(crossings) - 1) / (crossings[-1] - crossings[0]) if len(crossings) > 1 else None
    return Swing(mean, 0.5 * (high - low), None if frequency is None else float(frequency))
