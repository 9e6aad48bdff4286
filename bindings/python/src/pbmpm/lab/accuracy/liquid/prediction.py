"""Whether the error that the dual solver predicts for each step is its true one, in a column and in a dam break."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace

import pbmpm

from ...scenes.scene import Scene
from ...simulation import RunSettings, Simulation
from ..case import Case, Measurement, Setting, settings_of
from ..elastic.prediction import ERROR_KINDS, EXACT_ITERATIONS, ROUNDING, Agreement, Bodies, compare
from .column import Column
from .common import WATER
from .dam_break import DamBreak


class _Prediction(Case):
    """A case whose steps are each solved twice: as the setting says, and to the end."""

    dimension = 2
    kind = "liquid"
    searched = False
    truth = f"the same step from the same state with {EXACT_ITERATIONS} iterations"
    error_kinds = ERROR_KINDS
    length = 1.0
    notes = f"Steps whose true and predicted error are below {ROUNDING:g} cells are not judged: that is rounding."
    seconds = 0.8

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("dual",), (60,), (5, 20), (16,))
        return settings_of(("dual", "dual-cells"), (60, 120, 240), (5, 10, 20, 50), (16,))

    def converged(self, setting: Setting) -> Setting | None:
        return None

    @abstractmethod
    def scene(self, setting: Setting) -> Scene:
        """What is stepped."""

    def world(self, setting: Setting, target_error: float = 0.0) -> pbmpm.World:
        """The world before its first step."""
        return Simulation(self.scene(setting), replace(setting.run_settings(), target_error=target_error)).world

    def agreement(self, setting: Setting, steps: int) -> Agreement:
        """Of the first steps."""

        def make(settings: RunSettings) -> tuple[pbmpm.World, Bodies]:
            simulation = Simulation(self.scene(setting), settings)
            return simulation.world, [(simulation.materials[WATER], simulation.world.ids.copy())]

        return compare(make, setting.run_settings(), steps)

    def measure(self, setting: Setting) -> Measurement:
        return self.agreement(setting, max(1, round(self.seconds * setting.rate_hz))).measurement()


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
