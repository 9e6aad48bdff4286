"""Where a smooth function is least."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

PAIRS = 8  # of steps and changes of the slope that are remembered
MOST_STEPS = 1000
SLOPE_LEFT = 1e-2  # of the first slope
ENOUGH = 1e-4  # share of the promised decrease (Armijo)
SHORTEST = 1e-8  # of a step


def _direction(slope: Array, pairs: list[tuple[Array, Array]]) -> Array:
    """Against it is the next step: L-BFGS (Liu, Nocedal 1989), which begins with the slope."""
    direction, shares = slope.copy(), []
    for step, change in reversed(pairs):
        shares.append(float((step * direction).sum() / (step * change).sum()))
        direction -= shares[-1] * change
    if pairs:
        step, change = pairs[-1]
        direction *= float((step * change).sum() / (change**2).sum())
    for (step, change), share in zip(pairs, reversed(shares), strict=True):
        direction += step * (share - float((change * direction).sum() / (step * change).sum()))
    return direction


def least(function: Callable[[Array], tuple[float, Array]], start: Array) -> Array:
    """The nearest place downhill where the function, which gives its value and its slope, has a hundredth of the slope that it has at the start."""
    place, (value, slope) = start, function(start)
    pairs: list[tuple[Array, Array]] = []
    goal = SLOPE_LEFT * float(np.linalg.norm(slope))
    for _ in range(MOST_STEPS):
        if np.linalg.norm(slope) <= goal:
            break
        direction, share = _direction(slope, pairs), 1.0
        promised = float((slope * direction).sum())
        while True:
            next_value, next_slope = function(place - share * direction)
            if next_value <= value - ENOUGH * share * promised or share < SHORTEST:
                break
            share *= 0.5
        step, change = -share * direction, next_slope - slope
        if (step * change).sum() > 0.0:
            pairs = [*pairs[1 - PAIRS :], (step, change)]
        place, value, slope = place + step, next_value, next_slope
    return place
