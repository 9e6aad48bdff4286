"""Reference cases of liquids at settings that take a second or two."""

from __future__ import annotations

import pytest

from pbmpm.app.accuracy.case import Setting
from pbmpm.app.accuracy.liquid.column import Column
from pbmpm.app.accuracy.liquid.dam_break import DamBreak


def test_dam_break_reaches_the_experiment_at_a_moderate_setting() -> None:
    measured = DamBreak(stability_seconds=2.0).measure(Setting("paper", 60.0, 10, 16))
    assert measured.errors["front_rms"] <= 0.10
    assert measured.errors["front_rms_shifted"] <= 0.05
    assert measured.errors["height_rms"] <= 0.12
    assert measured.reasons == []


def test_coarsest_dam_break_is_stable_for_20_seconds() -> None:
    measured = DamBreak(stability_seconds=20.0).measure(Setting("paper", 30.0, 1, 16))
    assert measured.stable, measured.reasons


@pytest.mark.parametrize(("rate", "iterations"), [(120.0, 10), (240.0, 2), (240.0, 5)])
def test_column_sinks_as_the_papers_law_says(rate: float, iterations: int) -> None:
    """Without volume feedback, as the law is derived. The feedback may change the height by a few percent."""
    measured = Column(seconds=4.0).measure(Setting("paper", rate, iterations, 16))
    row = measured.extra
    assert measured.stable, measured.reasons
    assert row["height_change_without_feedback"] == pytest.approx(row["height_change_law"], rel=0.1)
    assert row["volume_error_without_feedback"] == pytest.approx(row["volume_error_law"], rel=0.1)
    assert row["height_change"] == pytest.approx(row["height_change_law"], abs=0.05)
    assert row["settled_volume_error"] == pytest.approx(row["volume_error_law"], rel=0.25)
