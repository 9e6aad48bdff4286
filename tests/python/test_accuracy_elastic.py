"""The elastic reference cases: their scenes, and what the solvers must reach in them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy.case import Setting
from pbmpm.lab.accuracy.elastic import ELASTIC_CASES, strain
from pbmpm.lab.accuracy.elastic.bar import STIFF_BAR
from pbmpm.lab.accuracy.elastic.block import Block, uniaxial_stress, uniaxial_stretch
from pbmpm.lab.accuracy.elastic.beam_cases import AxialBar, CantileverCase
from pbmpm.lab.accuracy.elastic.body_cases import BlockCase, SpinningDiscCase, TwoDiscsCase
from pbmpm.lab.accuracy.elastic.case import integrator_of
from pbmpm.lab.accuracy.elastic.prediction import compare, copy_state
from pbmpm.lab.accuracy.elastic.references import uniaxial_curve
from pbmpm.lab.accuracy.elastic.stage import Record, Stage, disc, failures, lattice, run
from pbmpm.lab.accuracy.elastic.theory import Solid
from pbmpm.lab.simulation import RunSettings

SOFT = Solid(young=1e5, poisson=0.3, density=1000.0)
DUAL = RunSettings(240.0, 1, 20, 1, solver="dual")


# Scenes


def test_lattice_fills_a_box_with_two_particles_per_cell() -> None:
    points = lattice([0.0, 1.0], [1.0, 1.5], 0.25)
    assert points.shape == (8 * 4, 2)
    assert points.min(axis=0) == pytest.approx([0.0625, 1.0625])
    assert points.max(axis=0) == pytest.approx([0.9375, 1.4375])


@pytest.mark.parametrize("dimension, unit", [(2, math.pi), (3, 4.0 / 3.0 * math.pi)])
def test_disc_has_its_volume(dimension: int, unit: float) -> None:
    points = disc([0.5] * dimension, 1.0, 0.1)
    assert len(points) * 0.05**dimension == pytest.approx(unit, rel=0.01)
    assert np.linalg.norm(points - 0.5, axis=1).max() < 1.0


@pytest.mark.parametrize("axis, side", [(0, 1), (1, -1)])
def test_a_clamp_holds_a_body_against_weight_and_leaves_the_rest_free(axis: int, side: int) -> None:
    """A block of 4 x 4 cells hangs on, or stands out from, a clamp: the particles at the face stay, the others sink."""
    cell = 0.125
    points = lattice([0.0, 0.0], [0.5, 0.5], cell)
    with Stage(SOFT, cell, DUAL, len(points), gravity=[0.0, -10.0]) as stage:
        ids = stage.add_body(points, 0.25)
        stage.clamp(axis, face=0.0 if side > 0 else 0.5, side=side)
        record = run(stage, 0.5, lambda: 0.0, speed_limit=10.0)
        moved = stage.state(ids).positions - points
    assert record.stable
    distance = points[:, axis] if side > 0 else 0.5 - points[:, axis]
    near, far = distance < 0.25 * cell + 1e-6, distance > 0.5 - 0.5 * cell
    assert np.abs(moved[near]).max() < 0.1 * cell
    assert np.median(moved[far, 1]) < 2.0 * np.median(moved[near, 1]) < 0.0


def test_state_is_in_the_order_of_adding() -> None:
    points = lattice([0.0, 0.0], [1.0, 0.5], 0.125)
    with Stage(SOFT, 0.125, DUAL, len(points)) as stage:
        ids = stage.add_body(points, 0.5, lambda places: places + [1.0, 0.0], np.eye(2))
        state = stage.state(ids)
        assert state.positions == pytest.approx(points, abs=1e-6)
        assert state.velocities == pytest.approx(points + [1.0, 0.0], abs=1e-6)
        assert state.affine == pytest.approx(np.broadcast_to(np.eye(2), (len(points), 2, 2)))
        assert state.masses.sum() == pytest.approx(500.0, rel=1e-6)
        run(stage, 0.1, lambda: 0.0, speed_limit=10.0)
        # Order in memory changes, that of the identifiers does not: every particle has moved to the right.
        assert np.all(stage.state(ids).positions[:, 0] > points[:, 0])


def test_a_run_ends_when_it_is_too_fast_and_says_so() -> None:
    points = lattice([0.0, 0.0], [0.5, 0.5], 0.125)
    with Stage(SOFT, 0.125, DUAL, len(points), gravity=[0.0, -10.0]) as stage:
        stage.add_body(points, 0.25)
        record = run(stage, 1.0, lambda: 0.0, speed_limit=2.0)
        assert not record.stable
        assert "more than 2, at 0.2" in record.reasons[0]
        assert stage.world.stats.simulated_seconds < 0.22
    broken = record.measurement({"a": 1.0}, (1.0,))
    assert broken.errors == {"a": None} and broken.observed is None and not broken.stable


def test_failures_of_a_step() -> None:
    with pbmpm.World(2, 0.1) as world:
        good = world.stats
    assert failures(good, 1.0) == []
    assert "not finite" in failures(replace(good, max_speed=math.nan), 1.0)[0]
    assert "deleted" in failures(replace(good, deleted_total=1), 1.0)[0]


# Truths


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("model", [strain.FIXED_COROTATED, strain.NEO_HOOKEAN])
def test_uniaxial_law_is_that_of_the_table(dimension: int, model: str) -> None:
    solid = Solid(1.0, 0.3, 1.0, dimension)
    stress, _ = uniaxial_curve(dimension, 0.3, model)
    inside = (stress.times > 0.35) & (stress.times < 2.9)
    stretches, values = stress.times[inside], stress.values[inside]
    assert uniaxial_stress(solid, model, stretches) == pytest.approx(values, abs=2e-5)
    assert uniaxial_stretch(solid, model, values) == pytest.approx(stretches, abs=1e-4)
    with pytest.raises(ValueError, match="no stretch .* gives 100 Pa"):
        uniaxial_stretch(solid, model, np.array([0.1, 100.0]))


def test_all_cases_are_complete_and_distinct() -> None:
    cases = [make() for make in ELASTIC_CASES]
    assert len({case.name for case in cases}) == len(cases)
    for case in cases:
        assert case.truth and case.title and case.length > 0.0
        quick, full = case.sweep(True), case.sweep(False)
        assert quick and len(full) >= len(quick)
        assert len(set(full)) == len(full), f"{case.name}: a setting twice"
        assert len({measure.name for measure in case.error_kinds}) == len(case.error_kinds)


def test_the_explicit_solver_is_measured_on_both_sides_of_its_limit() -> None:
    case = AxialBar()
    rates = [setting.rate_hz for setting in case.sweep(False) if setting.solver == "explicit"]
    courant = [case.solid.pressure_wave_speed / (rate * case.length / case.cells[0]) for rate in rates]
    assert min(courant) < 0.6 and max(courant) > 1.0
    assert integrator_of(Setting("explicit", 60.0, 1, 8)) == "explicit"
    assert integrator_of(Setting("primal", 60.0, 1, 8, integrator="bdf2")) == "bdf2"


# The dual solver, where the bodies are soft enough for it


def test_dual_bar_swings_as_backward_euler_says() -> None:
    """480 Hz: 4 (c dt / dx)^2 = 18, of which 20 iterations hold all: the frequency is that of four times as many. What is left then is
    the clamp's softness, as if the bar were longer by less than half of one of its 32 cells."""
    few, many = (AxialBar().measure(Setting("dual", 480.0, count, 32)) for count in (20, 80))
    assert few.stable and many.stable
    assert abs(few.errors["frequency"] - many.errors["frequency"]) < 0.005
    assert few.errors["of_theory"] < 0.5 / 32
    assert many.errors["of_theory"] < 0.5 / 32


def test_paper_bar_swings_with_the_modulus_of_its_iterations() -> None:
    """E = rho w N dx^2 / (4 dt^2), so sound travels sqrt(w N) / 2 cells per step."""
    _, found = STIFF_BAR.swing(RunSettings(240.0, 1, 20, 1, solver="paper"))
    cells_per_step = 0.5 * math.sqrt(1.5 * 20)
    assert found is not None
    # The law is that of smooth modes; the study of the method found 1 % between it and a bar.
    assert found.frequency == pytest.approx(cells_per_step * 240.0 / (4.0 * 32.0), rel=0.015)


def test_hanging_block_has_the_stretch_of_its_law() -> None:
    record, profile = Block(cells=16, width_cells=4).settle(RunSettings(60.0, 1, 40, 1, solver="dual"), 3.0)
    assert record.stable and profile is not None
    assert profile.truths.max() > 1.3
    # Layers of a cell, between 1.02 and 1.37 long: a tenth of a cell in the place of a row would be 0.1.
    assert profile.error < 0.04


def test_discs_meet_within_the_reach_of_the_grid_and_keep_their_momentum() -> None:
    found = TwoDiscsCase().measure(Setting("dual", 120.0, 10, 4))
    assert found.stable
    # Weights reach 1.5 cells from each disc; the disc is round, so the last node counts little.
    assert 0.0 < found.errors["gap_at_contact"] < 3.0
    assert found.errors["momentum"] < 1e-5
    assert found.errors["energy_gained"] < 1e-3
    assert found.errors["energy_lost"] < 0.8


def test_spinning_disc_keeps_its_size_when_solved() -> None:
    found = SpinningDiscCase().measure(Setting("dual", 240.0, 40, 10))
    assert found.stable
    # Spinning stretches a disc by about rho omega^2 R^2 / E = 0.8 %.
    assert found.errors["grown"] < 0.01


# The primal solver: what is promised


@pytest.mark.parametrize("rate", [120.0, 240.0, 480.0])
def test_primal_bar_swings_as_backward_euler_says_after_five_iterations(rate: float) -> None:
    found = AxialBar().measure(Setting("primal", rate, 5, 64))
    assert found.stable
    assert found.errors["of_theory"] < 0.015


def test_bdf2_bar_has_its_true_frequency() -> None:
    """1.35 % is the integrator's own, 0.5 % the softness of the clamp."""
    found = AxialBar().measure(Setting("primal", 240.0, 20, 64, integrator="bdf2"))
    assert found.stable
    assert found.errors["frequency"] < 0.02


def test_cantilever_hangs_as_the_elastica_says() -> None:
    found = CantileverCase().measure(Setting("primal", 60.0, 20, 8))
    assert found.stable
    assert found.errors["tip"] < 0.05


def test_both_integrators_of_a_cantilever_have_one_converged_solution() -> None:
    """At rest no integrator matters, and that is all it needs to measure: the tip is that of a whole measurement."""
    case = CantileverCase()
    euler = Setting("primal", 30.0, 5, 4)
    target = case.converged(euler)
    assert target is not None and case.converged(replace(euler, integrator="bdf2")) == target
    assert case.converged(replace(euler, solver="explicit")) is None
    small = replace(target, iterations=5)
    whole, alone = case.measure(replace(small, integrator="bdf2")), case.solve(small)
    assert alone.observed == whole.observed and set(alone.errors) == {"tip"}
    assert alone.stable and alone.errors["tip"] is not None and alone.errors["tip"] == whole.errors["tip"]


def test_a_swinging_beam_does_not_creep() -> None:
    """With F following the affine fit of the grid instead of the motion the middle of the swing sinks by 5 % more."""
    found = CantileverCase().measure(Setting("primal", 240.0, 20, 8, integrator="bdf2"))
    assert found.stable
    assert abs(found.errors["middle"] - found.errors["tip"]) < 0.02


@pytest.mark.parametrize("integrator", ["euler", "bdf2"])
def test_spinning_disc_is_braked_by_the_integrator_alone(integrator: str) -> None:
    """And not by backward Euler's chords, which took a third: bodies get back what inner forces took from their rotation."""
    found = SpinningDiscCase().measure(Setting("primal", 60.0, 20, 10, integrator=integrator))
    assert found.stable
    # A ring has no width and does not give; the disc gives 0.1 %.
    assert found.errors["of_theory"] < 0.01


@pytest.mark.parametrize("model", [strain.FIXED_COROTATED, strain.NEO_HOOKEAN])
@pytest.mark.parametrize("load, width", [(0.5, 4), (-0.25, 16)])
def test_blocks_obey_their_law(model: str, load: float, width: int) -> None:
    block = Block(model, load, cells=16, width_cells=width)
    record, profile = block.settle(RunSettings(60.0, 1, 20, 1, solver="primal"), 3.0)
    assert record.stable and profile is not None
    assert profile.error < 0.03


def test_a_hanging_block_does_not_tear_off_on_a_fine_grid() -> None:
    """Held over its own width alone it does, from its corners, and falls without stress: an error of 55 %."""
    block = Block(cells=96, width_cells=24)
    record, profile = block.settle(RunSettings(30.0, 1, 5, 1, solver="primal"), 3.0)
    assert record.stable and profile is not None
    assert profile.error < 0.02


def test_a_case_that_broke_keeps_its_row() -> None:
    found = BlockCase().measure(Setting("explicit", 60.0, 1, 16))
    assert not found.stable and found.reasons
    assert found.errors == {"stretch": None, "pulled": None, "pressed": None}


# Prediction


def made(settings: RunSettings) -> tuple[pbmpm.World, list[tuple[pbmpm.Material, np.ndarray]]]:
    points = lattice([0.0, 0.0], [1.0, 0.5], 0.125)
    stage = Stage(SOFT, 0.125, settings, len(points), gravity=[0.0, -10.0])
    ids = stage.add_body(points, 0.5)
    stage.clamp(0, 0.0, 1)
    return stage.world, [(stage.material, ids)]


def test_a_copied_state_goes_the_same_way() -> None:
    """Equal settings from equal states: equal motion, but for the order of sums.

    (Only liquids remember their iterations.)
    """
    one, bodies = made(DUAL)
    other, other_bodies = made(DUAL)
    with one, other:
        for _ in range(20):
            one.step(DUAL.dt)
        copy_state(one, bodies, other, other_bodies)
        one.step(DUAL.dt)
        other.step(DUAL.dt)
        rows, other_rows = one.find(bodies[0][1]), other.find(other_bodies[0][1])
        for field in (pbmpm.Field.POSITION, pbmpm.Field.DEFORMATION):
            first, second = one.view(field).array()[rows], other.view(field).array()[other_rows]
            assert np.abs(first - second).max() < 1e-5


def test_true_errors_fall_with_iterations() -> None:
    slow = replace(DUAL, rate_hz=15.0)
    few, many = (compare(made, replace(slow, iterations=count), steps=10) for count in (5, 40))
    assert many.true.mean() < 0.2 * few.true.mean()
    assert few.share is not None and 0.0 <= few.share <= 1.0


def test_record_without_failures_is_stable() -> None:
    assert Record(np.zeros(1), np.zeros(1), 0.0, 0.0, 0.0, 0).stable
