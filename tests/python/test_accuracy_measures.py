"""How fronts, heights, shifts and stability are judged, on made-up motions with known answers."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from pbmpm.lab.accuracy import laws
from pbmpm.lab.accuracy.measures import (
    Curve,
    absolute_rms,
    best_shift,
    body_extent,
    dam_break_experiment,
    occupied_area,
    relative_rms,
)
from pbmpm.lab.stability.judge import ENERGY_TOLERANCE, StabilityJudge


def test_experiment_has_the_published_points() -> None:
    front, height = dam_break_experiment("front"), dam_break_experiment("height")
    assert len(front.times) == 15 and len(height.times) == 17
    assert (front.times[0], front.values[0]) == (0.41, 1.11)
    assert (front.times[-1], front.values[-1]) == (3.33, 4.11)
    assert (height.times[-1], height.values[-1]) == (7.4, 0.06)


def lattice(length: float, spacing: float) -> np.ndarray:
    return np.arange(0.5 * spacing, length, spacing).repeat(2)


def test_extent_of_a_body_ignores_drops_ahead() -> None:
    body = lattice(1.0, 0.05)
    assert body_extent(body, 0.1, 0.05) == pytest.approx(1.0)
    with_drops = np.concatenate([body, [1.45, 1.9, 1.91]])
    assert body_extent(with_drops, 0.1, 0.05) == pytest.approx(1.0)
    assert body_extent(np.array([]), 0.1, 0.05) == 0.0


def test_extent_of_a_body_of_several_rows_ignores_as_many_drops() -> None:
    rows = np.tile(lattice(1.0, 0.05), 8)
    with_drops = np.concatenate([rows, np.arange(1.01, 1.6, 0.02)])
    assert body_extent(with_drops, 0.1, 0.05, 8) == pytest.approx(1.0)
    assert body_extent(with_drops, 0.1, 0.05) > 1.5


def test_extent_takes_in_a_thin_tongue() -> None:
    tongue = np.arange(1.025, 1.6, 0.05)
    assert body_extent(np.concatenate([lattice(1.0, 0.05), tongue]), 0.1, 0.05) == pytest.approx(1.6)


def test_a_chance_hole_does_not_end_a_body() -> None:
    body = lattice(1.0, 0.05)
    assert body_extent(body[(body < 0.5) | (body > 0.6)], 0.1, 0.05) == pytest.approx(1.0)
    assert body_extent(body[(body < 0.5) | (body > 0.7)], 0.1, 0.05) == pytest.approx(0.5)


def test_occupied_area_does_not_depend_on_waves() -> None:
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.025, 2, 0.05), np.arange(0.005, 1, 0.01)))
    wave = 0.5 + 0.2 * np.sin(math.pi * np.floor(x / 0.1) / 10)
    assert occupied_area(np.stack([x, y * wave], axis=1), 0.1) == pytest.approx(np.mean(wave) * 2.0, rel=1e-6)


def test_errors_of_known_curves() -> None:
    measured = Curve(np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 4.0]))
    ten_percent_more = Curve(measured.times, 1.1 * measured.values)
    assert relative_rms(ten_percent_more, measured) == pytest.approx(0.1)
    assert absolute_rms(Curve(measured.times, measured.values - 0.25), measured) == pytest.approx(0.25)


@pytest.mark.parametrize("shift", [-0.3, 0.0, 0.175, 0.5])
def test_best_shift_is_found_with_its_sign(shift: float) -> None:
    """A simulation that runs ahead by the shift must be delayed by it: the shift is added to its time."""
    times = np.linspace(0, 6, 601)
    measured = Curve(np.linspace(1, 4, 13), 1 + 0.3 * np.linspace(1, 4, 13) ** 1.5)
    simulated = Curve(times - shift, 1 + 0.3 * times**1.5)
    found, error = best_shift(simulated, measured)
    assert found == pytest.approx(shift, abs=0.006)
    assert error < 2e-3


def test_the_law_is_the_familiar_one_for_stiff_liquids() -> None:
    modulus = laws.bulk_modulus_over_density(2, 1 / 32, 1 / 240, 500, 1.5)
    assert modulus == pytest.approx(1.5 * 500 / 32**2 * 240**2 / 8)
    mean_compression = 9.81 * 1.0 / (2 * modulus)  # 0.1 %: the next order of the law is 8/3 of its square
    profile = laws.column_profile(1.0, 9.81, modulus)
    assert laws.mean_compression(1.0, 9.81, modulus) == pytest.approx(mean_compression, rel=4 * mean_compression)
    assert profile[0] < profile[-1] < 1.0
    assert laws.settled_volume_error(1.0, 9.81, modulus) == pytest.approx(2 * mean_compression / math.sqrt(3), rel=6 * mean_compression)


def test_the_law_of_each_layer() -> None:
    """The strain 1/J - 1 at the pressure K (1/J - 1) / J carries the weight above, however soft the liquid."""
    profile = laws.column_profile(2.0, 10.0, 4.0)
    load = (1.0 / profile - 1.0) / profile
    weight = 10.0 * 2.0 * (1.0 - (np.arange(len(profile)) + 0.5) / len(profile)) / 4.0
    np.testing.assert_allclose(load, weight, rtol=1e-9)


def test_apparent_height_of_an_uncompressed_column_is_its_height() -> None:
    assert laws.apparent_height_ratio(np.ones(100)) == pytest.approx(1.0)
    assert laws.apparent_height_ratio(np.full(100, 0.8)) == pytest.approx(0.8)


def step(energy: float, deleted: int = 0, speed: float = 1.0) -> SimpleNamespace:
    return SimpleNamespace(
        kinetic_energy=0.25 * energy,
        potential_energy=0.75 * energy,
        deleted_total=deleted,
        max_speed=speed,
        volume_error_max=0.1,
        simulated_seconds=1.0,
    )


def judged(*steps: SimpleNamespace, settled: float = 1.0) -> list[str]:
    judge = StabilityJudge()
    judge.begin(100.0)
    for item in steps:
        judge.watch(item)
    judge.settle(settled, predicted=0.9)
    return judge.reasons


def test_judge() -> None:
    assert judged(step(100.0), step(100.0 * (1 + 0.9 * ENERGY_TOLERANCE)), step(20.0)) == []
    assert "energy" in judged(step(100.0 * (1 + 1.1 * ENERGY_TOLERANCE)), step(20.0))[0]
    assert "deleted" in judged(step(50.0, deleted=1))[0]
    assert "finite" in judged(step(50.0, speed=math.nan))[0]
    assert "settled" in judged(step(50.0), settled=1.4)[0]
    assert "settled" in judged(step(50.0), settled=0.2)[0]
