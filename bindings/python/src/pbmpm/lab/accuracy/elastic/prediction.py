"""How well a step's predicted error tells its true one.

Two worlds go in lockstep. Before each step the second takes over the state of the first; the first then steps with the
setting under test, the second with very many iterations. The root mean square distance of their particles afterwards
is the true error of the solution of that step, which the first has predicted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

import pbmpm

from ...meter import stepping_clock
from ...simulation import RunSettings
from ..case import ErrorMeasure, Measurement

FACTOR = 3.0
"""Prediction and truth agree when neither is more than this many times the other."""

EXACT_ITERATIONS = 1000
"""How the true solution of a step is found."""

ROUNDING = 2e-6
"""Errors below this [cells] are not judged: positions are rounded to about 1e-7 of a cell and sums of displacements to
some times that."""

ERROR_KINDS = (
    ErrorMeasure("wrong", "solver", "%", f"share of the steps predicted wrong by more than {FACTOR:g} times", 0.2),
    ErrorMeasure("true_error", "solver", "cells", "median of the steps: distance from the same step solved to the end"),
    ErrorMeasure("ratio_low", "solver", "times", "predicted over true: of a tenth of the steps it is less"),
    ErrorMeasure("ratio_mid", "solver", "times", "predicted over true: median"),
    ErrorMeasure("ratio_high", "solver", "times", "predicted over true: of a tenth of the steps it is more"),
)
"""How well errors are predicted, and how the ratio of prediction and truth is distributed."""

Bodies = list[tuple[pbmpm.Material, np.ndarray]]
"""Materials with the identifiers of their particles."""

Make = Callable[[RunSettings], tuple[pbmpm.World, Bodies]]
"""Builds a world; bodies and particles are in an order that does not depend on the settings."""


@dataclass(frozen=True)
class Agreement:
    """Predicted and true errors of the steps of a run [cells]."""

    predicted: np.ndarray
    true: np.ndarray
    ms_per_simulated_second: float
    iterations_used: float  #: per step, mean

    @property
    def ratios(self) -> np.ndarray:
        """Predicted over true, of the steps that are judged."""
        judged = np.maximum(self.true, self.predicted) > ROUNDING
        return self.predicted[judged] / np.maximum(self.true[judged], 1e-12)

    @property
    def share(self) -> float | None:
        """Of the judged steps: how many were predicted within FACTOR; None when none was judged."""
        ratios = self.ratios
        return float(np.mean((ratios >= 1.0 / FACTOR) & (ratios <= FACTOR))) if len(ratios) else None

    def measurement(self) -> Measurement:
        """Of a case whose measures are ERROR_KINDS."""
        ratios, share = self.ratios, self.share
        low, mid, high = np.percentile(ratios, (10, 50, 90)).tolist() if len(ratios) else (None, None, None)
        return Measurement(
            errors={
                "wrong": None if share is None else 1.0 - share,
                "true_error": float(np.median(self.true)),
                "ratio_low": low,
                "ratio_mid": mid,
                "ratio_high": high,
            },
            ms_per_simulated_second=self.ms_per_simulated_second,
            iterations_used=self.iterations_used,
            predicted_error=float(self.predicted.mean()),
            stable=True,
            extra={"steps": len(self.true)},
        )


def compare(make: Make, settings: RunSettings, steps: int, exact_iterations: int = EXACT_ITERATIONS) -> Agreement:
    """Runs both worlds; the second one does ``exact_iterations``."""
    world, bodies = make(settings)
    with world:
        other, other_bodies = make(replace(settings, iterations=exact_iterations, target_error=0.0))
        with other:
            rows = [_step_both(world, bodies, other, other_bodies, settings) for _ in range(steps)]
    predicted, true, seconds, used = np.array(rows).T
    return Agreement(predicted, true, 1e3 * float(seconds.mean()) / settings.dt, float(used.mean()))


def _step_both(
    world: pbmpm.World, bodies: Bodies, other: pbmpm.World, other_bodies: Bodies, settings: RunSettings
) -> tuple[float, float, float, float]:
    """Predicted and true error of one step of ``world`` [cells], its time [s], and its iterations."""
    clock, dt = stepping_clock(settings.threads), settings.dt
    copy_state(world, bodies, other, other_bodies)
    begin = clock()
    world.step(dt)
    seconds = clock() - begin
    other.step(dt)
    away = _places(world, bodies) - _places(other, other_bodies)
    stats = world.stats
    true = float(np.sqrt(np.mean(np.sum(away**2, axis=1))) / world.cell_size)
    return stats.predicted_error, true, seconds, float(stats.iterations_used)


def _places(world: pbmpm.World, bodies: Bodies) -> np.ndarray:
    rows = world.find(np.concatenate([ids for _, ids in bodies]))
    return world.positions.array()[rows].astype(np.float64)


def copy_state(source: pbmpm.World, bodies: Bodies, target: pbmpm.World, target_bodies: Bodies) -> None:
    """Makes the particles of ``target`` those of ``source``: everything that a step of backward Euler starts from."""
    for (material, ids), (_, target_ids) in zip(bodies, target_bodies):
        rows = source.find(ids)
        liquid = isinstance(material.parameters, pbmpm.Liquid)
        shape = pbmpm.Field.VOLUME_RATIO if liquid else pbmpm.Field.DEFORMATION
        for field in (pbmpm.Field.POSITION, pbmpm.Field.VELOCITY, pbmpm.Field.AFFINE_VELOCITY, shape):
            target.set(field, source.view(field).array()[rows], target_ids)
