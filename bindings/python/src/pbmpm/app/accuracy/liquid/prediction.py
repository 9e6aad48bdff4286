"""Whether the error that the dual solver predicts for each step is its true one, in a column and in a dam break."""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

import pbmpm

from ...scene import Scene
from ...simulation import RunSettings, Simulation
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from ..elastic.prediction import EXACT_ITERATIONS, FACTOR, ROUNDING, Bodies, compare
from .column import Column
from .common import WATER
from .dam_break import DamBreak


class _Prediction(Case):
    """A case whose steps are each solved twice: as the setting says, and to the end."""

    dimension = 2
    kind = "liquid"
    searched = False
    truth = f"the same step from the same state with {EXACT_ITERATIONS} iterations"
    error_kinds = (
        ErrorMeasure("wrong", "solver", "%", f"share of the steps predicted wrong by more than {FACTOR:g} times", 0.2),
        ErrorMeasure("true_error", "solver", "cells", "median of the steps: distance from the same step solved to the end"),
    )
    length = 1.0
    notes = f"Steps whose true and predicted error are below {ROUNDING:g} cells are not judged: that is rounding."
    seconds = 0.8

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("dual",), (60,), (5, 20), (16,))
        return settings_of(("dual", "dual-cells"), (60, 240), (5, 10, 20, 50), (16,))

    def converged(self, setting: Setting) -> Setting | None:
        return None

    @abstractmethod
    def scene(self, setting: Setting) -> Scene:
        """What is stepped."""

    def measure(self, setting: Setting) -> Measurement:
        def make(settings: RunSettings) -> tuple[pbmpm.World, Bodies]:
            simulation = Simulation(self.scene(setting), settings)
            return simulation.world, [(simulation.materials[WATER], simulation.world.ids.copy())]

        found = compare(make, setting.run_settings(), max(1, round(self.seconds * setting.rate_hz)))
        return Measurement(
            errors={
                "wrong": None if found.share is None else 1.0 - found.share,
                "true_error": float(np.median(found.true)),
            },
            ms_per_simulated_second=found.ms_per_simulated_second,
            iterations_used=found.iterations_used,
            predicted_error=float(found.predicted.mean()),
            stable=True,
            extra={"median_ratio": found.median_ratio, "steps": len(found.true)},
        )


class ColumnPrediction(_Prediction):
    """Of the column from its release on."""

    name = "predicted-error-column"
    title = "Predicted and true error of the steps of a column of water"
    length_name = "height of the column"

    def scene(self, setting: Setting) -> Scene:
        return Column().scene(setting)


class DamBreakPrediction(_Prediction):
    """Of the dam break, in the tank in which the wave comes back."""

    name = "predicted-error-dam-break"
    title = "Predicted and true error of the steps of a dam break"
    length_name = "width of the column"

    def scene(self, setting: Setting) -> Scene:
        return DamBreak().scene(setting)
