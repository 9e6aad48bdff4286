"""Reference cases of liquids at settings that take a second or two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy import laws
from pbmpm.lab.accuracy.case import Case, Setting
from pbmpm.lab.accuracy.liquid.channel import Couette, Poiseuille, couette, poiseuille
from pbmpm.lab.accuracy.liquid.claims import RecoveryClaim, VolumeClaim
from pbmpm.lab.accuracy.liquid.column import Column
from pbmpm.lab.accuracy.liquid.dam_break import DamBreak
from pbmpm.lab.accuracy.liquid.drop import EllipticalDrop, exact_axis
from pbmpm.lab.accuracy.liquid.invariance import Invariance
from pbmpm.lab.accuracy.liquid.obstacle import ObstacleDamBreak, measured_heights
from pbmpm.lab.accuracy.liquid.vortex import TaylorGreen
from pbmpm.lab.accuracy.liquid.wave import OffGridWave, StandingWave
from pbmpm.lab.stability.cases import find_case
from pbmpm.lab.stability.cases.volume import volume_at_rest


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


# Truths


def columns(path: Path) -> dict[str, np.ndarray]:
    """The columns of a reference file, whose header says where it is from."""
    names, *rows = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    return dict(zip(names, np.array(rows, dtype=np.float64).T))


def test_exact_axis_of_the_drop(root: Path) -> None:
    """The file was integrated with A0 = 100 1/s; the tolerance is its six digits."""
    file = columns(root / "tests/python/data/liquid_elliptical_drop_exact.csv")
    times = 100.0 * file["t_s"]
    inside = times <= 1.0
    np.testing.assert_allclose(exact_axis().at(times[inside]), file["a"][inside], atol=2e-6)


@pytest.mark.parametrize(("profile", "column"), [(couette, "couette_u_over_V0"), (poiseuille, "poiseuille_u_over_umax")])
def test_profiles_of_channels(root: Path, profile: Callable[..., np.ndarray], column: str) -> None:
    file = columns(root / "tests/python/data/viscous_startup_couette_poiseuille.csv")
    for time in sorted(set(file["T"])):
        rows = file["T"] == time
        np.testing.assert_allclose(profile(file["y"][rows], time), file[column][rows], atol=2e-6)


def test_gauges_of_the_tank_are_in_the_order_in_which_the_wave_reaches_them() -> None:
    heights = measured_heights()
    wet = [heights[place].times[np.argmax(heights[place].values > 0.01)] for place in (1.488, 0.992, 0.496)]
    assert wet == sorted(wet) and heights[2.638].values[0] == pytest.approx(0.55, abs=0.01)


def test_period_of_the_wave() -> None:
    assert 1 / OffGridWave().frequency == pytest.approx(1.668, abs=5e-4)
    assert 1 / StandingWave().frequency == pytest.approx(1.719, abs=5e-4)


# Runs


@pytest.mark.parametrize(
    ("case", "setting", "limits"),
    [
        pytest.param(EllipticalDrop(), Setting("dual", 60.0, 20, 16), {"axis_error": 0.02, "energy_error": 0.05}, id="drop"),
        pytest.param(
            TaylorGreen(),
            Setting("dual", 60.0, 50, 16, pressure="cells", flip=0.9),
            {"energy_lost": 0.10, "lost_to_iterations": 0.10},
            id="lively vortices",
        ),
        pytest.param(
            StandingWave(), Setting("dual", 60.0, 20, 12), {"period_error": 0.01, "damping": 0.02}, id="standing wave"
        ),
        pytest.param(Column(), Setting("dual", 60.0, 50, 32), {"height_error": 0.03}, id="column, 60 Hz x 50"),
        pytest.param(Column(), Setting("dual", 60.0, 100, 32), {"height_error": 0.005}, id="column, 60 Hz x 100"),
        pytest.param(Column(), Setting("dual", 240.0, 20, 32), {"height_error": 0.01}, id="column, 240 Hz x 20"),
        pytest.param(Couette(), Setting("dual", 60.0, 10, 12), {"profile_error": 0.02}, id="couette"),
        pytest.param(Poiseuille(), Setting("dual", 60.0, 10, 12), {"profile_error": 0.02}, id="poiseuille"),
        pytest.param(ObstacleDamBreak(), Setting("dual", 60.0, 5, 8), {"gauge_mae": 0.12}, id="dam break on a box"),
        pytest.param(
            DamBreak(),
            Setting("dual", 60.0, 5, 16),
            {"front_rms_shifted": 0.04, "height_rms": 0.1},
            id="dam break",
        ),
        pytest.param(
            Invariance(),
            Setting("dual", 120.0, 5, 12),
            {"galilean": 0.02, "turned_45": 0.03, "turned_90": 1e-5},
            id="invariance",
        ),
        pytest.param(RecoveryClaim(), Setting("dual", 60.0, 10, 16), {"volume_lost": 0.1}, id="recovery"),
    ],
)
def test_case_reaches_its_truth(case: Case, setting: Setting, limits: dict[str, float]) -> None:
    """Limits are those that the case itself calls good, or 2 % of the largest value where it names none."""
    measured = case.measure(setting)
    assert measured.stable, measured.reasons
    for name, limit in limits.items():
        error = measured.errors[name]
        assert error is not None and error <= limit, f"{name}: {error} is above {limit}"


def test_the_water_before_the_obstacle_has_room_between_walls_off_the_grid() -> None:
    """10.9 cells between the side walls: put in for all of them, the water has but 10.5, rises, and gains 2 % of its energy."""
    found = ObstacleDamBreak().measure(Setting("dual", 60.0, 5, 6))
    assert found.stable and found.extra["energy_peak"] == 0.0


def test_the_papers_column_is_softer() -> None:
    """Where the dual solver's height is right to half a percent, 60 Hz x 100."""
    assert Column().measure(Setting("paper", 60.0, 100, 32)).errors["height_error"] > 0.06


def test_the_papers_iterations_stop_the_vortices() -> None:
    """What must not be: with many iterations the paper's solver takes nearly all of the energy."""
    measured = TaylorGreen().measure(Setting("paper", 60.0, 50, 16))
    assert measured.errors["energy_lost"] > 0.9 and measured.errors["lost_to_iterations"] > 0.5


def test_volume_is_kept_by_what_the_grid_measures() -> None:
    measured = VolumeClaim().measure(Setting("paper", 60.0, 20, 8))
    assert measured.errors["lost_without_measure"] > 2 * measured.errors["volume_lost"]


@pytest.mark.parametrize(
    ("dimension", "cells", "rate_hz", "relaxation"), [(2, 8, 30, 1.5), (2, 8, 30, 1.0), (2, 12, 60, 1.5), (3, 6, 30, 1.5)]
)
def test_a_single_dual_iteration_bears_twice_what_the_papers_does(
    dimension: int, cells: int, rate_hz: int, relaxation: float
) -> None:
    """By the law, within the tenth that the layers at floor and surface make of so few cells. The paper's law is 1.7 times as much."""
    gravity, size = 9.81, [4.0, float(cells), 4.0][:dimension]
    with pbmpm.World(
        dimension,
        1.0,
        capacity=1000,
        gravity=[0.0, -gravity, 0.0][:dimension],
        domain=([0.0] * dimension, [4.0, 2.0 * cells, 4.0][:dimension]),
        solver=pbmpm.Solver.DUAL,
        iterations=1,
        threads=1,
    ) as world:
        half = [0.5 * length for length in size]
        world.fill(pbmpm.Box(half, half), world.add_material(pbmpm.Liquid(relaxation=relaxation)), seed=1)
        lost = []
        for step in range(20 * rate_hz):
            world.step(1 / rate_hz)
            if step >= 15 * rate_hz:
                lost.append(1.0 - float(world.volume_ratios.array().mean()))
    modulus = laws.single_iteration_modulus_over_density(dimension, 1.0, 1 / rate_hz, relaxation)
    assert np.mean(lost) == pytest.approx(laws.mean_compression(cells, gravity, modulus), rel=0.1)


def test_the_dual_dam_break_at_30_hz_needs_no_law_with_five_iterations() -> None:
    """An incompressible liquid keeps its volume; with one iteration alone it is judged by what that bears."""
    case = find_case("H01")
    setting = next(s for s in case.settings(30.0, 5, "dual") if s.dimension == 2)
    assert volume_at_rest(setting, 1.0, 16.0) == 1.0 > volume_at_rest(replace(setting, iterations=1), 1.0, 16.0)
    outcome = replace(case.run(setting), judges_goals=True)
    assert outcome.passed, outcome.description
