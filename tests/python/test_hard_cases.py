"""The hard cases of the catalogue with each solver, at their own rates and iterations. Scenes, criteria and limits are
defined there."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy import laws
from pbmpm.lab.accuracy.elastic import strain
from pbmpm.lab.accuracy.elastic.theory import Solid
from pbmpm.lab.stability.cases import CASES, SOLVERS, Check, HardCase, Kind, Setting, find_case, rest
from pbmpm.lab.stability.cases.case import EXPLICIT, KnownFailure
from pbmpm.lab.stability.cases.compatible import balanced_strain, movable_strain, relaxed_strain, unremovable_strain
from pbmpm.lab.stability.cases.contrast import overturn_seconds
from pbmpm.lab.stability.cases.energy import energy_density
from pbmpm.lab.stability.cases.strain import BLOCK_CELLS, CELL, SCRAMBLE_SHARED, scrambled, strain_residual
from pbmpm.lab.stability.cases.volume import RECOVERED_SHARE
from pbmpm.lab.stability.cases.watch import make_world
from pbmpm.lab.stability.plan import Selection, plan

#: The explicit solver is the one to compare with: it is expected to fail.
TESTED_SOLVERS = tuple(solver for solver in SOLVERS if solver != EXPLICIT)


def _all_settings() -> Iterator[Any]:
    for case, solver in itertools.product(CASES, TESTED_SOLVERS):
        for setting in case.settings(solver=solver):
            reason = case.known_failure(setting)
            marks = [pytest.mark.xfail(reason=reason, strict=True, raises=AssertionError)] if reason else []
            if setting.dimension == 3:
                marks.append(pytest.mark.long)
            yield pytest.param(case, setting, id=f"{case.id}: {setting}", marks=marks)


#: Rates and iterations beside the cases' own, in 2D: from the softest that the law of stiffness lets pass to much stiffer.
OTHER_RATES = (
    ("H01", 60, 5),
    ("H03", 60, 1),
    ("H03", 120, 10),
    ("H03", 240, 2),
    ("H04", 240, 2),
    ("H08", 30, 1),
    ("H08", 240, 2),
    ("H08", 240, 10),
    ("H10", 60, 1),
    ("H16", 120, 10),
    ("H17", 15, 1),
    ("H17", 480, 5),
    ("H21", 480, 1),
)


def _other_settings() -> Iterator[Any]:
    for identifier, rate_hz, iterations in OTHER_RATES:
        case = find_case(identifier)
        for setting in case.settings(rate_hz, iterations):
            if setting.dimension == 2:
                yield pytest.param(case, setting, id=f"{identifier}: {setting}")


#: All that is asked for at fine settings only: volumes and shapes that come back, and rest. Stability is asked for at any.
GOALS = {
    "H01": {"mean volume ratio over the law's"},
    "H03": {"share of particles with J in [0.8, 1.2]", "occupied volume over the law's"},
    "H04": {"occupied over rest volume"},
    "H05": {"rms of |U V^T - F|", "rms of what corrections still move"},
    "H06": {"rms of |U V^T - F| in the end"},
    "H09": {"smallest J of the light block", "mean height of the heavy liquid over that of the light one"},
    "H13": {"change of length", "angular momentum lost beyond the law"},
    "H14": {"change of size"},
    "H16": {"share of particles with J in [0.8, 1.2]"},
    "H18": {"smallest J of 99 particles in 100"},
    "H19": {"drift of the height", "kinetic energy over m g H in the end"},
}


@pytest.mark.parametrize(("case", "setting"), [*_all_settings(), *_other_settings()])
def test_hard_case(case: HardCase, setting: Setting) -> None:
    outcome = case.run(setting)
    assert outcome.passed, outcome.description
    goals = {check.name.partition(" (")[0] for check in outcome.checks if check.kind is Kind.GOAL}
    assert goals <= GOALS.get(case.id, set())


@pytest.mark.parametrize(("rate_hz", "iterations"), [(15, 20), (30, 5)])
def test_a_jet_that_grazes_a_thin_wall_stays_before_it(rate_hz: float, iterations: int) -> None:
    """Thrown sideways by the ball's impact it moves along the wall by ten cells per step, and towards it by less than one: the
    flatter its way, the more steps the search for its end takes that trusts the distance alone."""
    setting = Setting("liquid", 2, "5 cells/step, wall of 0.2 cells", rate_hz, iterations, solver="primal")
    outcome = find_case("H08").run(setting)
    assert outcome.passed, outcome.description


def test_what_is_put_back_before_an_obstacle_far_away_keeps_every_bit() -> None:
    """A splash at 15 Hz is faster than half a cell per step, so that its way is followed up to the floor and the post. Seen from the world's origin the
    last bits of a place a million cells away are lost."""
    outcome = find_case("H21").run(Setting("liquid", 3, "a million cells away", 15, 20, solver="primal"))
    assert outcome.passed, outcome.description


def test_a_swing_gains_nothing_while_the_body_stiffens() -> None:
    """The energy of a swing goes with its frequency: in a body that stiffened by the factor e per swing it grew faster than backward Euler takes it."""
    outcome = find_case("H11").run(Setting("elastic", 2, "plain", 240, 1, solver="dual"))
    assert outcome.passed, outcome.description


@pytest.mark.parametrize("iterations", [5, 10])
def test_a_body_crushed_by_long_steps_stands_no_higher_once_stiff(iterations: int) -> None:
    """With all that bodies are asked for where falls per substep are short: 1.01 and 1.02 of the start's energy."""
    outcome = find_case("H11").run(Setting("elastic", 2, "plain", 15, iterations, solver="dual"))
    assert outcome.passed, outcome.description


@pytest.mark.parametrize(("rate_hz", "iterations"), [(15, 2), (30, 10), (30, 20), (60, 1), (120, 2)])
def test_liquid_let_go_from_between_walls_does_not_burst(rate_hz: float, iterations: int) -> None:
    """On the grid a sheet between walls that have closed is as dense when it is twice as wide: what pressed on until J followed threw it out at
    52 m/s. It leaves as fast as what falls from its height, be the steps few or many, and does not grow faster because it grew (30 Hz)."""
    setting = Setting("liquid", 2, "trapped between boxes", rate_hz, iterations, solver="paper")
    checks = find_case("H16").function(setting)
    assert all(check.passed for check in checks if check.kind is Kind.BOUND), checks


def test_crushed_liquid_leaves_no_faster_at_a_higher_rate_with_the_dual() -> None:
    """It was asked to grow by 0.3 per substep, however short that is: a sheet one cell wide parted at 31 m/s at 480 Hz."""
    checks = find_case("H16").function(Setting("liquid", 2, "trapped between boxes", 480, 5, solver="dual"))
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize(("iterations", "seed"), [(2, 1), (2, 3), (2, 4), (2, 5), (5, 4)])
def test_liquid_crushed_in_a_slit_does_not_burst_when_it_is_let_go(iterations: int, seed: int) -> None:
    """Between walls that have closed nothing answers to the growth that is asked for: pressures that were carried on in full added up from substep to
    substep and threw the liquid out at 33 to 82 m/s, where it may reach 21."""
    checks = find_case("H03").function(Setting("liquid", 2, "plain", 240, iterations, solver="dual", seed=seed))
    assert all(check.passed for check in checks if check.kind is Kind.BOUND), checks


@pytest.mark.parametrize(("rate_hz", "iterations", "seed"), [(15, 5, 2), (15, 10, 3), (60, 5, 1), (60, 10, 4), (240, 5, 1)])
def test_a_jet_flies_on_over_the_edge_of_a_wall(rate_hz: float, iterations: int, seed: int) -> None:
    """The far face of the edge, before which nothing is, held what slid over it: it stopped there, and pressures drove particles round the edge."""
    setting = Setting("liquid", 2, "5 cells/step, wall of 2 cells", rate_hz, iterations, solver="dual", seed=seed)
    checks = find_case("H08").function(setting)
    assert all(check.passed for check in checks), checks


def test_drops_behind_a_wall_are_not_driven_into_each_other_with_the_primal() -> None:
    """Nodes that flew where their forces led were one step of descent all at once: too long, it crushed drops to J = 0.4 behind the back of the energy check."""
    checks = find_case("H08").function(Setting("liquid", 2, "1 cells/step, wall of 1 cells", 15, 5, solver="primal"))
    assert all(check.passed for check in checks), checks


def test_feedback_gives_a_slumping_liquid_no_energy_with_the_primal() -> None:
    """What lowers J stores energy, which later comes out as motion: half as much again per step as there was, 1.5 % of all in 45 steps."""
    checks = find_case("H01").function(Setting("liquid", 2, "small column", 30, 5, solver="primal"))
    assert all(check.passed for check in checks if check.kind is Kind.BOUND), checks


@pytest.mark.parametrize(
    ("dimension", "rate_hz", "iterations"),
    [
        (2, 30, 1),
        (2, 30, 2),
        (2, 60, 1),
        (2, 60, 2),
        (3, 15, 1),
    ],
)
def test_crushed_liquid_leaves_no_faster_than_its_sound_with_the_primal(dimension: int, rate_hz: int, iterations: int) -> None:
    """What flies apart gains nothing on its way (60 Hz), the levels fling no droplets (30 Hz), and what a single iteration does too much of is taken
    back (15 Hz)."""
    setting = Setting("liquid", dimension, "trapped between boxes", rate_hz, iterations, solver="primal")
    for check in find_case("H16").function(setting):
        assert check.passed or check.kind == Kind.GOAL, check


@pytest.mark.parametrize(
    ("solver", "rate_hz", "iterations"),
    [("dual", 60.0, 5), ("dual", 60.0, 50), ("dual", 60.0, 200), ("dual", 240.0, 20), ("primal", 120.0, 20), ("primal", 480.0, 20)],
)
def test_a_bar_that_closes_faster_than_sound_does_not_pass_through_itself(solver: str, rate_hz: float, iterations: int) -> None:
    """Be iterations and steps few or many: no substep closes matter by more than it can take, and what closes faster than sound is stopped within a cell,
    before F forgets its shape."""
    setting = Setting("elastic", 2, "stretched to 10", rate_hz, iterations, solver=solver)
    checks = find_case("H14").function(setting)
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize(("dimension", "iterations"), [(2, 10), (3, 2)])
def test_a_block_between_walls_does_not_creep_round_their_corners(dimension: int, iterations: int) -> None:
    """Less than rounding adds up to in the 1200 steps."""
    setting = Setting("elastic", dimension, "short", 60.0, iterations, solver="dual")
    drift, *others = find_case("H19").function(setting)
    assert drift.figure < 2e-4
    assert all(check.passed for check in others), others


def test_what_stirs_evenly_does_not_warm() -> None:
    """Bursts that last for a tenth of a run: its second half is the livelier one in every other run, which is no sign of anything. Of halves alone nine of these
    would be told."""
    told = []
    for seed in range(200):
        random = np.random.default_rng(seed)
        level = itertools.chain.from_iterable(itertools.repeat(1e-4 * math.exp(burst), 40) for burst in iter(random.standard_normal, None))
        told.append(rest.warming(rest.look_until_it_tells(lambda level=level: next(level))) > 1.0)
    assert sum(told) <= 1  # one in 900 by chance, see RISING_PAIRS


@pytest.mark.parametrize("growth", [1.0005, 1.001, 1.01])
def test_what_warms_is_told_from_what_stirs(growth: float) -> None:
    """By a fifth in the short run, by half, or by 50 times, with noise of a third."""
    for seed in range(20):
        random, looks = np.random.default_rng(seed), itertools.count()
        energies = rest.look_until_it_tells(lambda: 1e-4 * growth ** next(looks) * math.exp(0.3 * random.standard_normal()))
        assert rest.warming(energies) > 1.0


def test_chance_alone_seldom_orders_the_parts_of_a_run() -> None:
    """Of all orders of ten parts, counted by their inversions."""
    counts = [1]
    for length in range(2, rest.BURSTS + 1):
        counts = [sum(counts[max(0, total - length + 1) : total + 1]) for total in range(len(counts) + length - 1)]
    assert sum(counts) == math.factorial(rest.BURSTS)
    inversions = math.comb(rest.BURSTS, 2) - rest.RISING_PAIRS
    assert sum(counts[: inversions + 1]) / sum(counts) == pytest.approx(1.0 / 900.0, rel=0.01)


def test_a_pool_that_comes_to_rest_late_gets_the_time() -> None:
    looks = itertools.count()
    energies = rest.look_until_it_tells(lambda: 1e-5 * math.exp(-next(looks) / 200.0))
    assert rest.LOOKS < len(energies) <= rest.LONGEST_TO_REST * rest.LOOKS
    assert rest.warming(energies) == 0.0


def test_bursts_are_bounded_by_what_a_step_lets_a_pool_fall() -> None:
    """Whenever they come, and if they last for a tenth of the run."""
    fall = rest.fall_energy(1.0 / 15.0)
    assert fall == pytest.approx((9.81 / 15.0) ** 2 / (2.0 * 9.81))
    energies = [0.1 * fall] * 400
    assert rest.bound_of_bursts(energies, fall).passed
    assert not rest.bound_of_bursts([*energies[:360], *[1.1 * fall] * 40], fall).passed


def test_a_light_liquid_grows_as_fast_as_the_heavy_one_above_it_presses() -> None:
    """Were its growth bounded by its own weight it would be crushed and stay below."""
    checks = find_case("H09").function(Setting("liquid", 2, "1:1000", 480.0, 5, solver="paper"))
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize(("rate_hz", "iterations", "variant"), [(120, 1, "1:100"), (240, 1, "1:1000"), (480, 1, "1:10000")])
def test_what_a_heavy_block_squeezes_out_is_no_faster_than_its_law_stores(rate_hz: float, iterations: int, variant: str) -> None:
    """With the paper's solver, whose law tears in tension: it flies to the ceiling. The bound is no loose one."""
    checks = find_case("H09").function(Setting("elastic", 2, variant, rate_hz, iterations, solver="paper"))
    assert all(check.passed for check in checks), checks
    assert checks[0].name == "highest speed over what the law stores"
    assert checks[0].figure > 0.7


@pytest.mark.parametrize(
    ("solver", "rate_hz", "iterations"),
    [("paper", 480, 2), ("dual", 60, 10), ("primal", 60, 10)],  # 58860 / 172800 of the modulus; for the others it does not matter
)
def test_a_light_block_that_bears_the_heavy_one_is_judged_by_the_height(solver: str, rate_hz: float, iterations: int) -> None:
    checks = find_case("H09").function(Setting("elastic", 2, "1:1000", rate_hz, iterations, solver=solver))
    assert "highest place over the start's height" in {check.name for check in checks}
    assert all(check.passed for check in checks), checks


@pytest.mark.long
def test_stiff_liquid_of_the_paper_forgets_that_it_was_crushed() -> None:
    """J of 0.9 passed for noise where the grid showed gaps. There it pressed with all that is allowed, and so did all below: 0.90 came back."""
    checks = find_case("H03").function(Setting("liquid", 3, "plain", 480, 20, solver="paper"))
    assert all(check.passed for check in checks), checks


def test_stiff_liquids_of_the_paper_do_not_lock() -> None:
    """Each particle held its own volume: what flowed bent like a jelly, and the liquids took 21 s."""
    setting = Setting("liquid", 2, "1:10", 480, 20, solver="paper")
    checks = find_case("H09").function(setting)
    assert "mean height of the heavy liquid over that of the light one" in {check.name for check in checks}
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize(
    ("solver", "dimension", "iterations", "seconds"),
    [("paper", 2, 5, 10.0), ("paper", 2, 20, 11.6), ("paper", 3, 20, 44.1), ("dual", 3, 20, 10.0)],
)
def test_liquids_get_time_to_change_places_by_what_damps_them(solver: str, dimension: int, iterations: int, seconds: float) -> None:
    assert overturn_seconds(Setting("liquid", dimension, "1:10", 480, iterations, solver=solver)) == pytest.approx(seconds, rel=0.01)


@pytest.mark.parametrize(("cells", "rate_hz", "iterations"), [(12, 60.0, 5), (12, 480.0, 20), (16, 60.0, 20), (16, 480.0, 20)])
def test_transfers_damp_a_vortex_as_the_law_says(cells: int, rate_hz: float, iterations: int) -> None:
    """Of a liquid that is soft, so that constraints hardly matter, between walls without friction."""
    wave_number, seconds = math.pi / cells, 0.05
    axis = 0.5 * np.arange(2 * cells) + 0.25
    places = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    x, y = wave_number * places.T
    vortex = np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y)], axis=1)
    with pbmpm.World(2, 1.0, capacity=len(places), domain=([0.0, 0.0], [cells, cells]), iterations=iterations, solver=pbmpm.Solver.PAPER) as world:
        world.add_particles(world.add_material(pbmpm.Liquid(relaxation=0.01)), places, velocities=0.01 * vortex)
        energies = []
        for _ in range(max(3, round(seconds * rate_hz))):
            world.step(1.0 / rate_hz)
            energies.append(world.stats.kinetic_energy)
    measured = -0.5 * math.log(energies[-1] / energies[0]) * rate_hz / (len(energies) - 1)
    assert measured == pytest.approx(laws.transfer_damping(wave_number, 1.0, 1.0 / rate_hz, iterations), rel=0.2)


@pytest.mark.parametrize(("stretch", "relaxation", "rebound_max"), [(0.1, 1.5, 1.0), (0.7, 1.5, 1.0), (0.05, 1.0, 0.3), (0.2, 1.9, 10.0)])
def test_energy_of_flattened_matter_is_the_work_of_the_corrections(stretch: float, relaxation: float, rebound_max: float) -> None:
    """Summed over small steps of ln s, each with the correction that an iteration makes, over its relaxation."""
    edges = np.linspace(math.log(stretch), 0.0, 100_001)
    stretches = np.exp(0.5 * (edges[1:] + edges[:-1]))
    work = float((np.minimum(relaxation * (1.0 / stretches - 1.0), rebound_max) / relaxation * np.diff(edges)).sum())
    assert laws.stored_when_flattened(stretch, relaxation, rebound_max) == pytest.approx(work, rel=1e-5)


@pytest.mark.parametrize(("rate_hz", "iterations"), [(15, 10), (15, 20), (60, 5), (240, 20)])
def test_matter_that_was_pressed_flat_leaves_no_faster_than_by_what_it_stores(rate_hz: float, iterations: int) -> None:
    """One of 16 particles lies a cell beside the others, all pressed to strain_min. The growth of the many threw it, and its own did, by 1.6 times
    the speed of what all stored: iterations press on it as if it had not moved."""
    setting = Setting("elastic", 2, "", rate_hz, iterations, solver="paper")
    rows, columns = np.divmod(np.arange(256), 16)
    places = np.stack([np.where(columns == 0, 0.5, -0.5), 0.5 * rows], axis=1)
    with make_world(setting, 1.0, capacity=256) as world:
        world.add_particles(world.add_material(setting.parameters(1.0)), places, volumes=0.25)
        world.set(pbmpm.Field.DEFORMATION, np.tile(np.diag([0.1, 1.0]), (256, 1, 1)))
        fastest = 0.0
        for _ in range(10):
            world.step(setting.dt)
            fastest = max(fastest, world.stats.max_speed)
    assert fastest < setting.stored_speed(1.0)


@pytest.mark.parametrize("seed", [1, 3])
@pytest.mark.parametrize(("material", "iterations"), [("liquid", 20), ("elastic", 10), ("elastic", 20)])
def test_matter_from_between_boxes_does_not_burst_at_the_lowest_rate(material: str, iterations: int, seed: int) -> None:
    """Crushed liquid grew in several cells at once, which added up to more than its head drives; of elastic matter see the test above."""
    setting = Setting(material, 2, "trapped between boxes", 15.0, iterations, solver="paper", seed=seed)
    checks = find_case("H16").function(setting)
    assert all(check.passed for check in checks if check.kind is Kind.BOUND), checks


@pytest.mark.parametrize(("rate_hz", "iterations"), [(60, 10), (120, 10), (480, 20)])
def test_liquid_from_between_boxes_that_overlap_fills_its_volume_again(rate_hz: float, iterations: int) -> None:
    """Put on the surface of one of them it lay on a line, and fell as a sheet thinner than any cell."""
    setting = Setting("liquid", 2, "trapped between boxes", rate_hz, iterations, solver="paper")
    checks = find_case("H16").function(setting)
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize("overlap", [0.5, 1.0])  # cells
@pytest.mark.parametrize("tall", [8, 20])  # cells of liquid, in a slit for 32
def test_liquid_that_boxes_hold_shut_comes_to_rest(tall: int, overlap: float) -> None:
    """Where they overlap nothing is open. Volume feedback took that for compression: the liquid was asked to grow, and ran round at up to 93 m/s."""
    cell, rate, height = 0.5, 480, 16.0
    half, closes = (8 * cell, height), 4 + 0.5 * overlap  # each box closes by so many cells
    with pbmpm.World(2, cell, gravity=(0, -9.81), capacity=1000, domain=((0, 0), (32, height)), iterations=20, solver="dual", threads=1) as world:
        world.fill(pbmpm.Box((16, 0.5 * tall * cell), (4 * cell, 0.5 * tall * cell)), world.add_material(pbmpm.Liquid()), seed=1)
        boxes = [world.add_collider(pbmpm.Box((16 + side * 12 * cell, 2), half), kinematic=True) for side in (-1, 1)]
        speeds = []
        for step in range(3 * rate):
            for box, side in zip(boxes, (-1, 1), strict=True):
                box.move((16 + side * (12 - closes * min(1.0, (step + 1) / rate)) * cell, 2))
            world.step(1 / rate)
            speeds.append(world.stats.max_speed)
    assert max(speeds[2 * rate :]) < math.sqrt(2 * 9.81 * height)  # a fall through the tank


@pytest.mark.parametrize(("rate_hz", "iterations"), [(60, 10), (240, 10)])
def test_no_particle_of_a_full_box_stays_crushed(rate_hz: float, iterations: int) -> None:
    """J of what a jet crushes for a moment went down by a little in each substep, since what makes it grow again is bounded: to 0.14, where the grid
    held no more than elsewhere."""
    setting = Setting("liquid", 2, "jet, small box", rate_hz, iterations, solver="paper")
    checks = find_case("H18").function(setting)
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("iterations", [5, 20])
def test_a_lone_particle_keeps_a_spin_that_a_turn_can_follow(iterations: int, dimension: int) -> None:
    """With the paper's solver, whose corrections take no spin. A turn by t per substep has a displacement gradient with the skew part sin t: faster
    ones stretched the particle to strain_max. They are cut to 60 degrees, slower ones stay as they are."""
    dt, spins = 1 / 60, np.array([0.5, 0.8, 1.2, 2.0])
    with pbmpm.World(dimension, 0.05, capacity=10, iterations=iterations, solver=pbmpm.Solver.PAPER, threads=1) as world:
        places = np.full((len(spins), dimension), 0.015)
        places[:, 0] += np.arange(len(spins))
        world.add_particles(world.add_material(pbmpm.Elastic()), places)
        turns = np.zeros((len(spins), dimension, dimension))
        turns[:, 0, 1], turns[:, 1, 0] = -spins / dt, spins / dt
        world.set(pbmpm.Field.AFFINE_VELOCITY, turns)
        for _ in range(60):
            world.step(dt)
        skew = 0.5 * dt * (world.affine_velocities.array()[:, 1, 0] - world.affine_velocities.array()[:, 0, 1])
        np.testing.assert_allclose(skew, np.minimum(spins, np.sin(np.pi / 3)), rtol=1e-4)
        assert strain_residual(world) < 0.05


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("iterations", [5, 20, 50])
def test_a_lone_elastic_particle_comes_to_rest_with_any_number_of_iterations(iterations: int, dimension: int) -> None:
    """Extrapolation makes it tremble when the step is longer than 4/3: a strain of 1e-6 became 1 within ten steps."""
    with pbmpm.World(dimension, 0.05, capacity=10, iterations=iterations, solver=pbmpm.Solver.DUAL, threads=1) as world:
        world.add_particles(world.add_material(pbmpm.Elastic(young_modulus=1e6)), np.full((1, dimension), 0.015))
        noise = 1e-6 * np.random.default_rng(1).normal(size=(1, dimension, dimension))
        world.set(pbmpm.Field.DEFORMATION, np.eye(dimension) + noise)
        for _ in range(30):
            world.step(1 / 60)
        assert strain_residual(world) < 1e-6


def test_catalogue_is_complete_and_in_order() -> None:
    identifiers = [case.id for case in CASES]
    assert identifiers == [f"H{number:02}" for number in range(1, 23)]
    assert all(case.title and case.origin and case.criterion for case in CASES)


def test_every_known_failure_covers_a_setting_of_the_map() -> None:
    settings = {case.id: [run.setting for run in plan(Selection(cases=(case,)))] for case in CASES}
    for case in CASES:
        for known in case.known_failures:
            assert any(map(known.covers, settings[case.id])), known.reason


def test_known_failure_covers_what_it_names() -> None:
    known = KnownFailure("why", solvers=("paper",), variants=("clamp",), materials=("elastic",), rates_and_iterations=((60.0, 1),))
    setting = Setting("elastic", 2, "clamp", 60.0, 1)
    assert known.covers(setting)
    others = ({"solver": "dual"}, {"variant": "delete"}, {"material": "sand"}, {"rate_hz": 120.0}, {"iterations": 2})
    assert not any(known.covers(replace(setting, **other)) for other in others)


def test_known_failure_explains_its_check_alone() -> None:
    """Another check that fails, or a figure that is not finite, is a failure that should not be."""
    case = HardCase("H99", "title", "origin", "criterion", lambda _: [], known_failures=(KnownFailure("why", ("paper",), check="speed"),))
    setting = Setting("elastic", 2, "plain", 60.0, 5)

    def reason(**figures: float) -> str:
        return case.outcome(setting, [Check(name, figure, 1.0) for name, figure in figures.items()], 0.1).known_failure

    assert reason(speed=2.0, lost=0.0) == "why"
    assert reason(speed=2.0, lost=2.0) == reason(speed=math.nan, lost=0.0) == ""


def test_find_case() -> None:
    assert find_case("h03").id == "H03"
    with pytest.raises(ValueError, match="H99.*H01"):
        find_case("H99")


def test_unknown_variant_is_refused() -> None:
    with pytest.raises(ValueError, match="no variant"):
        CASES[0].run(Setting("liquid", 2, "nonsense", 60.0, 5))


def test_case_without_a_solver_is_refused() -> None:
    case = find_case("H22")
    assert list(case.settings(solver="paper")) == []
    with pytest.raises(ValueError, match="says nothing"):
        case.run(Setting("elastic", 2, case.variants[0], 60.0, 5))


@pytest.mark.parametrize("dimension", [2, 3])
def test_energy_of_a_stretched_cube_is_that_of_the_formula(dimension: int) -> None:
    """F = diag(2, 1, 1) with E = 26, nu = 0.3: mu = 10, lambda = 15."""
    stretched = np.diag([2.0, 1.0, 1.0][:dimension])[None]
    corotated = pbmpm.Elastic(young_modulus=26.0, poisson_ratio=0.3)
    assert energy_density(corotated, stretched) == pytest.approx(10 * 1 + 7.5 * 1)
    neo = pbmpm.Elastic(young_modulus=26.0, poisson_ratio=0.3, elastic_model=pbmpm.ElasticModel.NEO_HOOKEAN)
    assert energy_density(neo, stretched) == pytest.approx(5 * 3 - 10 * math.log(2) + 7.5 * math.log(2) ** 2)


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_motion_removes_strain_that_all_particles_share_and_not_what_differs_in_a_cell(dimension: int) -> None:
    """An even F = diag(2, 1, 1) is undone by u = -x/2. Of random F, entries in [-2, 2], a large part stays: the nodes of
    a block of 4 cells have (4 + 2)^d displacements per axis, its particles 2^d * 4^d * d numbers."""
    with pbmpm.World(dimension, 0.1, capacity=2000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Box([0.0] * dimension, [0.2] * dimension), world.add_material(pbmpm.Elastic()), seed=1)
        stretched = np.tile(np.diag([2.0, 1.0, 1.0][:dimension]), (len(world), 1, 1))
        world.set(pbmpm.Field.DEFORMATION, stretched)
        assert strain_residual(world) == pytest.approx(1.0)
        assert unremovable_strain(world) == pytest.approx(0.0, abs=1e-5)
        world.set(pbmpm.Field.DEFORMATION, np.random.default_rng(1).uniform(-2, 2, stretched.shape))
        assert 0.3 * strain_residual(world) < unremovable_strain(world) < 0.8 * strain_residual(world)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("rebound_max", [0.3, 1.0])
def test_the_strain_that_corrections_move_is_what_one_iteration_of_the_paper_moves(dimension: int, rebound_max: float) -> None:
    """From rest, with a relaxation of 1: the affine velocities times dt. The tolerance is that of single precision and of the kernels'
    rotations."""
    material = pbmpm.Elastic(relaxation=1.0, rebound_max=rebound_max)
    with pbmpm.World(dimension, 0.1, capacity=2000, iterations=1, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Box([0.03] * dimension, [0.2] * dimension), world.add_material(material), seed=1)
        random = np.random.default_rng(1).uniform(-0.3, 0.3, (len(world), dimension, dimension))
        world.set(pbmpm.Field.DEFORMATION, np.eye(dimension) + random)
        expected = movable_strain(world, rebound_max)
        world.step(1 / 60)
        moved = world.affine_velocities.array().astype(float) / 60
    assert expected > 0.02  # and so is no matter of rounding
    assert np.sqrt((moved**2).sum(axis=(1, 2)).mean()) == pytest.approx(expected, rel=1e-3)


def _corotated(poisson_ratio: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Energy and stress of the fixed corotated model with E = 2: |F - R|^2 if Poisson's ratio is 0."""
    return functools.partial(strain.energy_and_stress, Solid(2.0, poisson_ratio, 1.0), strain.FIXED_COROTATED)


@pytest.mark.parametrize("dimension", [2, 3])
def test_where_energy_is_least_the_primal_moves_nothing(dimension: int) -> None:
    """But by the square of the strain, for places stay where they were. Where |F - R|^2 is least, which knows no Poisson's ratio, it moves much more."""
    moved = []
    for ratio in (None, 0.0, 0.3):
        soft = pbmpm.Elastic(young_modulus=1.0, poisson_ratio=0.3)  # a step shows its forces
        with pbmpm.World(dimension, 0.1, capacity=2000, iterations=20, threads=1, solver=pbmpm.Solver.PRIMAL) as world:
            world.fill(pbmpm.Box([0.03] * dimension, [{2: 0.2, 3: 0.15}[dimension]] * dimension), world.add_material(soft), seed=1)
            random = np.random.default_rng(1).uniform(-0.1, 0.1, (len(world), dimension, dimension))
            world.set(pbmpm.Field.DEFORMATION, np.eye(dimension) + random)
            if ratio is not None:
                world.set(pbmpm.Field.DEFORMATION, relaxed_strain(world, _corotated(ratio)))
            world.step(1 / 60)
            moved.append(np.abs(world.velocities.array()).max())
    at_first, of_strain, of_energy = moved
    assert of_energy < 0.05 * at_first
    assert of_strain > 0.1 * at_first


@pytest.mark.parametrize("dimension", [2, 3])
def test_corrections_balance_elsewhere_than_where_strain_is_least(dimension: int) -> None:
    """What is left of random F moves nothing; the least strain is less, and that moves."""
    with pbmpm.World(dimension, 0.1, capacity=2000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Box([0.03] * dimension, [0.15] * dimension), world.add_material(pbmpm.Elastic()), seed=1)
        random = np.random.default_rng(1).uniform(-0.3, 0.3, (len(world), dimension, dimension))
        world.set(pbmpm.Field.DEFORMATION, np.eye(dimension) + random)
        at_first, least = movable_strain(world, 1.0), unremovable_strain(world)
        balanced, relaxed = balanced_strain(world, 1.0), relaxed_strain(world, _corotated(0.0))
        world.set(pbmpm.Field.DEFORMATION, relaxed)
        assert strain_residual(world) < least  # which has the turns of the start
        of_least = movable_strain(world, 1.0)
        world.set(pbmpm.Field.DEFORMATION, balanced)
        assert movable_strain(world, 1.0) < 0.02 * at_first < of_least
        assert strain_residual(world) > least


@pytest.mark.parametrize(("rate_hz", "iterations", "share"), [(60, 20, 1.0), (240, 20, 0.855), (480, 10, 0.80)])
def test_a_sheet_grows_back_to_where_its_corrections_balance(rate_hz: float, iterations: int, share: float) -> None:
    """Pressed to no width in steps so short that strain_min does not make all its particles alike. What the law says, with the places that they
    have when they are let go, is within a hundredth of what comes of it."""
    _, recovered, *_ = find_case("H16").function(Setting("elastic", 2, "trapped between boxes", rate_hz, iterations, solver="paper"))
    law = recovered.limit / RECOVERED_SHARE
    assert law == pytest.approx(share, abs=0.02)
    assert recovered.figure == pytest.approx(law, abs=0.01)


@pytest.mark.parametrize("iterations", [10, 20])
def test_sheets_of_the_dual_grow_back_to_where_their_energy_is_least(iterations: int) -> None:
    """And not to where |F - R|^2 is: at 60 Hz x 20 that was 5 % more (seed 1) to 11 % less (seed 3) than what came back. Of 60 seeds 1 to 3 fall below the limit
    by up to 3 %, in any build: so four seeds are judged together."""
    found = [find_case("H16").function(Setting("elastic", 2, "trapped between boxes", 60, iterations, solver="dual", seed=seed))[1] for seed in (1, 2, 3, 4)]
    assert np.mean([recovered.figure for recovered in found]) >= np.mean([recovered.limit for recovered in found]), found


@pytest.mark.parametrize("model", list(pbmpm.ElasticModel))
def test_energy_is_zero_at_rest_turned_and_large_inside_out(model: pbmpm.ElasticModel) -> None:
    material = pbmpm.Elastic(young_modulus=26.0, poisson_ratio=0.3, elastic_model=model)
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    rest, turned, mirrored = energy_density(material, np.stack([np.eye(2), turn, np.diag([-1.0, 1.0])]))
    assert (rest, turned) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert mirrored > 10.0


def test_neo_hookean_energy_has_no_step_where_its_logarithm_is_continued() -> None:
    """The expansion is of second order: value and slope agree at J = 0.1."""
    neo = pbmpm.Elastic(young_modulus=26.0, poisson_ratio=0.3, elastic_model=pbmpm.ElasticModel.NEO_HOOKEAN)
    width = 1e-4
    low, middle, high = energy_density(neo, np.stack([np.diag([1.0, 0.1 + step * width]) for step in (-1, 0, 1)]))
    # The slope changes by width times the second derivative, about lambda (1 - ln J) / J^2 + mu / J^2 = 6,000.
    assert (high - middle) / width == pytest.approx((middle - low) / width, abs=2 * 6000 * width)


@pytest.mark.parametrize(
    ("figure", "limit", "at_least", "passed"),
    [(1.0, 1.0, False, True), (1.1, 1.0, False, False), (1.1, 1.0, True, True), (0.9, 1.0, True, False)],
)
def test_check_compares_with_its_limit(figure: float, limit: float, at_least: bool, passed: bool) -> None:
    assert Check("figure", figure, limit, at_least).passed is passed


@pytest.mark.parametrize("at_least", [False, True])
def test_check_of_nan_fails(at_least: bool) -> None:
    assert not Check("figure", float("nan"), 1.0, at_least).passed
    assert not Check("figure", float("inf"), 1.0, at_least).passed


def test_outcome_tells_the_check_that_failed() -> None:
    """A press at one iteration cannot bring the volume back in time, which counts from the case's own setting on."""
    case = find_case("H03")
    outcome = replace(case.run(next(case.settings(rate_hz=15.0, iterations=1))), judges_goals=True)
    assert not outcome.passed
    assert (outcome.figure, outcome.limit) == (outcome.telling.figure, outcome.telling.limit)
    assert "FAILED" in outcome.description


@pytest.mark.parametrize(("rate_hz", "iterations", "variant"), [(60, 1, "1:100"), (120, 1, "1:1000"), (480, 1, "1:10000")])
def test_a_heavy_liquid_does_not_rebound_by_the_volume_that_a_light_one_lost(rate_hz: int, iterations: int, variant: str) -> None:
    """With the dual solver. When feedback counts crushed light liquid in full, the heavy one gains 20, 44 and 40 % of energy."""
    highest, *others = find_case("H09").function(Setting("liquid", 2, variant, rate_hz, iterations, solver="dual"))
    assert highest.passed, highest
    assert all(check.passed for check in others if check.kind is Kind.BOUND), others


@pytest.mark.parametrize(
    ("rate_hz", "iterations", "variant"),
    [(60, 2, "1:10"), (60, 5, "1:10"), (60, 10, "1:10000"), (120, 5, "1:10000"), (240, 2, "1:10000"), (60, 20, "1:10000"), (240, 5, "1:10000")],
)
def test_heavy_and_light_liquid_change_places_without_a_bounce(rate_hz: int, iterations: int, variant: str) -> None:
    """With the dual solver. When the guess gives both the same multiplier, a tenth of the pressure to the light one at 1:10, that one is crushed,
    and throws the heavy one up (1.003 of the energy at 60 Hz x 2) or stays below (1:10,000). When it gives back what is missing in 1/60 s however far
    that is, the heavy one leaps at the start (1.005 at 60 Hz x 5). When pressures yield in the guess as if all were light, none bears the heavy one, and the
    light one stays crushed below (1:10,000 at 60 Hz x 10, 120 Hz x 5, 240 Hz x 2)."""
    checks = find_case("H09").function(Setting("liquid", 2, variant, rate_hz, iterations, solver="dual"))
    assert [check for check in checks if not check.passed] == []
    assert any(check.kind is Kind.GOAL for check in checks)


@pytest.mark.parametrize("ratio", [1, 10, 1000])
@pytest.mark.parametrize("dimension", [2, 3])
def test_feedback_of_a_heavy_liquid_counts_a_light_one_by_its_mass(dimension: int, ratio: int) -> None:
    """Both fill the same cells. In one substep at 60 Hz feedback moves J a share of the way to one over what the grid holds: 2 for the light
    one, 1 + 1/ratio for the heavy one. The lattice is even, so that nothing moves and the grid shows no noise."""
    cells = 6
    with pbmpm.World(
        dimension,
        1.0,
        capacity=8000,
        domain=([0.0] * dimension, [float(cells)] * dimension),
        solver=pbmpm.Solver.DUAL,
        threads=1,
    ) as world:
        axis = (np.arange(2 * cells) + 0.5) / 2.0
        places = np.stack(np.meshgrid(*[axis] * dimension), axis=-1).reshape(-1, dimension)
        liquids = [pbmpm.Liquid(density=100.0 * factor) for factor in (1, ratio)]
        light, heavy = (world.add_material(liquid) for liquid in liquids)
        for material in (light, heavy):
            world.add_particles(material, places, volumes=0.5**dimension)
        world.step(1 / 60)
        inside = (np.abs(world.positions.array() - 0.5 * cells) < 0.5 * cells - 2.0).all(axis=1)
        ratios, rows = world.volume_ratios.array(), world.material_indices.array()
        share = liquids[0].volume_feedback
        for material, held in ((light, 2.0), (heavy, 1.0 + 1.0 / ratio)):
            seen = ratios[inside & (rows == material.index)]
            assert len(seen)
            # Single precision. Without gravity the share begins where the grid holds more than 1.2, and is full when a tenth more is wrong.
            wanted = 1.0 - share * min(1.0, max(0.0, (1.0 / 1.2 - 1.0 / held) / 0.1)) * (1.0 - 1.0 / held)
            assert seen == pytest.approx(wanted, abs=1e-4)


def test_a_single_iteration_of_the_dual_bears_liquid_at_a_high_rate() -> None:
    """Its pressure is what it asks for times its stiffness. When that was bounded by 0.3 in 1/60 s a column's centre sank from 0.5 m to 0.15 m, not 0.32 m."""
    with pbmpm.World(2, 1.0 / 32.0, gravity=(0.0, -9.81), domain=([0.0, 0.0], [0.25, 2.0]), iterations=1, solver=pbmpm.Solver.DUAL, threads=1) as world:
        world.fill(pbmpm.Box([0.125, 0.5], [0.125, 0.5]), world.add_material(pbmpm.Liquid()), seed=1)
        for _ in range(480):
            world.step(1.0 / 240.0)
        assert world.positions.array()[:, 1].mean() > 0.25


@pytest.mark.parametrize(("solver", "rate_hz", "iterations"), [("dual", 240, 20), ("dual", 480, 10), ("primal", 480, 10)])
def test_what_is_left_of_one_random_strain_is_what_no_motion_removes(solver: str, rate_hz: int, iterations: int) -> None:
    """At first the nodes' motion can remove all of it but what the surface of the body holds; in the end almost nothing."""
    setting = Setting("elastic", 2, SCRAMBLE_SHARED, rate_hz, iterations, solver=solver)
    with make_world(setting, CELL) as world:
        side = BLOCK_CELLS[2] * CELL
        world.fill(pbmpm.Box([0.3 * CELL] * 2, [0.5 * side] * 2), world.add_material(setting.parameters(CELL)), seed=setting.seed)
        world.set(pbmpm.Field.DEFORMATION, scrambled(setting.variant, len(world), 2, setting.seed))
        at_first = strain_residual(world) - unremovable_strain(world)
        for _ in range(3 * rate_hz):
            world.step(setting.dt)
        residual, unremovable = strain_residual(world), unremovable_strain(world)
    assert at_first > 0.5
    assert 0.01 < residual < 1.05 * unremovable


@pytest.mark.parametrize("solver", [pbmpm.Solver.PAPER, pbmpm.Solver.DUAL, pbmpm.Solver.PRIMAL], ids=lambda s: s.name)
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_lone_solid_that_spins_fast_is_not_stretched(solver: pbmpm.Solver, dimension: int) -> None:
    """Two radians per step. It goes on at 60 degrees, which stretch by 1.3 what does not close; five iterations leave the dual 2.1. Unbounded it ends at
    strain_max, 20, whatever closes."""
    with pbmpm.World(dimension, 0.1, capacity=10, iterations=5, solver=solver) as world:
        world.add_particles(world.add_material(pbmpm.Elastic()), [[0.03] * dimension])
        spin = np.zeros((1, dimension, dimension))
        spin[0, 0, 1], spin[0, 1, 0] = 120.0, -120.0
        world.set(pbmpm.Field.AFFINE_VELOCITY, spin)
        for _ in range(120):
            world.step(1.0 / 60.0)
        assert np.linalg.svd(world.deformations.array()[0], compute_uv=False).max() < 2.5
        turn = world.affine_velocities.array()[0] / 60.0
        assert abs(turn[0, 1] - turn[1, 0]) <= 2.0 * np.sin(np.pi / 3.0) + 1e-5
