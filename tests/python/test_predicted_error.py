"""The predicted error of a step against the true one: its distance from the same step solved to the end."""

from __future__ import annotations

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy.case import Setting
from pbmpm.lab.accuracy.elastic.beam_cases import PredictionCase
from pbmpm.lab.accuracy.elastic.prediction import Agreement
from pbmpm.lab.accuracy.liquid.prediction import ColumnPrediction, DamBreakPrediction

SHARE = 0.8
"""Of the steps that must be predicted within a factor of 3."""

LIQUIDS = {"column": ColumnPrediction, "dam break": DamBreakPrediction}
STEPS = 30


@pytest.mark.parametrize("rate", [60, 120, 240])
@pytest.mark.parametrize("iterations", [5, 10])
@pytest.mark.parametrize("liquid", LIQUIDS)
def test_errors_of_liquids_are_predicted(liquid: str, iterations: int, rate: int) -> None:
    found = LIQUIDS[liquid]().agreement(Setting("dual", rate, iterations, 16), STEPS)
    assert found.share is not None and found.share >= SHARE, found.ratios


@pytest.mark.parametrize("rate", [60, 240])
def test_errors_of_pressures_in_cells_are_predicted(rate: int) -> None:
    found = DamBreakPrediction().agreement(Setting("dual", rate, 5, 16, pressure="cells"), STEPS)
    assert found.share is not None and found.share >= SHARE, found.ratios


@pytest.mark.parametrize("rate", [60, 120, 240])
def test_errors_of_a_beam_are_predicted(rate: int) -> None:
    case = PredictionCase()
    case.steps = STEPS
    wrong = case.measure(Setting("primal", rate, 5, 8)).errors["wrong"]
    assert wrong is not None and wrong <= 1.0 - SHARE


def test_half_of_predictions_that_are_wrong() -> None:
    """Judged: 6 times too large, right, 6 times too small, right; not judged: what is rounding."""
    true = np.array([1.0, 1.0, 6.0, 2.0, 1e-7])
    found = Agreement(np.array([6.0, 1.0, 1.0, 1.0, 1e-6]), true, 1.0, 5.0)
    errors = found.measurement().errors
    assert found.share == errors["wrong"] == 0.5 and errors["ratio_mid"] == 0.75
    assert errors["ratio_low"] < 0.5 and errors["ratio_high"] > 3.0
    assert Agreement(true[4:], true[4:], 1.0, 5.0).share is None


@pytest.mark.parametrize("threads", [2, 3])
def test_predictions_do_not_depend_on_threads(threads: int) -> None:
    """Also where each iteration is judged."""

    def predicted(count: int, target: float) -> list[float]:
        setting = Setting("dual", 60, 12, 16, threads=count)
        with ColumnPrediction().world(setting, target) as world:
            made = []
            for _ in range(5):
                world.step(setting.dt)
                made.append((world.stats.predicted_error, world.stats.iterations_used))
            return made

    for target in (0.0, 0.02):
        assert predicted(threads, target) == predicted(1, target)


def test_a_target_is_met_in_truth_too() -> None:
    """Iterations end by the predicted error: the true one then is at most the factor larger."""
    setting = Setting("dual", 60, 200, 16)
    target = 0.02
    with ColumnPrediction().world(setting, target) as world:
        for _ in range(10):
            world.step(setting.dt)
        ids, before = world.ids.copy(), world.snapshot()
        world.step(setting.dt)
        stats, reached = world.stats, world.positions.array()[world.find(ids)].copy()
        assert stats.stop == pbmpm.Stop.ERROR and 0.0 < stats.predicted_error < target
        world.restore(before)
        world.target_error, world.iterations = 0.0, 1000
        world.step(setting.dt)
        away = (reached - world.positions.array()[world.find(ids)]) / world.cell_size
        assert np.sqrt(np.mean(np.sum(away.astype(np.float64) ** 2, axis=1))) < 3.0 * target
