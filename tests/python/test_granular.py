"""Sand and viscoplastic matter as a user meets them: heaps, yield, energy, snapshots."""

from __future__ import annotations

import math

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy import granular, slump
from pbmpm.lab.accuracy.registry import find_cases

SOLVERS = [pbmpm.Solver.PAPER, pbmpm.Solver.DUAL, pbmpm.Solver.PRIMAL, pbmpm.Solver.EXPLICIT]
RATE = 480.0  # for the explicit solver: the wave takes 0.8 cells per step


def column(
    material: pbmpm.Sand | pbmpm.Visco, solver: pbmpm.Solver, dimension: int = 2, size: tuple[float, float] = (0.4, 0.4)
) -> pbmpm.World:
    """A column at the left wall on a rough floor, with cells of 5 cm."""
    depth = [0.2] * (dimension - 2)
    world = pbmpm.World(
        dimension,
        0.05,
        capacity=20000,
        gravity=[0.0, -9.81, 0.0][:dimension],
        domain=([0.0] * dimension, [2.0, 1.0, *depth][: dimension]),
        domain_friction=0.0,
        solver=solver,
        iterations=10,
        threads=1,
    )
    half = [0.5 * size[0], 0.5 * size[1], 0.1][:dimension]
    world.fill(pbmpm.Box(half, half), world.add_material(material))
    world.add_collider(
        pbmpm.Plane([0.0] * dimension, [0.0, 1.0, 0.0][:dimension]), friction=pbmpm.Friction.COULOMB, friction_coefficient=2.0
    )
    return world


def energy(world: pbmpm.World) -> float:
    return world.stats.kinetic_energy + world.stats.potential_energy


def sand(**changes: float) -> pbmpm.Sand:
    return pbmpm.Sand(density=1500.0, young_modulus=5e5, **changes)


def visco(**changes: float) -> pbmpm.Visco:
    return pbmpm.Visco(density=1500.0, young_modulus=5e5, **changes)


@pytest.mark.parametrize("solver", SOLVERS, ids=lambda solver: solver.name)
@pytest.mark.parametrize("material", [sand(), sand(cohesion=0.01), visco(yield_strain=0.005)], ids=["sand", "cohesive", "visco"])
def test_energy_never_grows(request: pytest.FixtureRequest, material: pbmpm.Sand | pbmpm.Visco, solver: pbmpm.Solver) -> None:
    if isinstance(material, pbmpm.Visco) and solver is pbmpm.Solver.EXPLICIT:
        request.applymarker(pytest.mark.xfail(reason="gains 1.9 %: without images behind the domain's walls the explicit solver lets clay bounce", strict=False))
    with column(material, solver) as world:
        highest = 1500.0 * 9.81 * 0.4 * 0.4 * 0.2
        for _ in range(240):
            world.step(1.0 / RATE)
            # an elastic body falling into place stores energy that stats do not count and gives it back
            assert energy(world) <= 1.005 * highest
            highest = min(highest, 1.005 * energy(world)) if world.stats.step_count > 120 else highest
        assert np.isfinite(world.positions.array()).all()
        assert world.stats.deleted_total == 0


def spread(material: pbmpm.Sand | pbmpm.Visco, dimension: int = 2, seconds: float = 1.0) -> tuple[float, float]:
    """Front and height of what a column became [m]."""
    with column(material, pbmpm.Solver.DUAL, dimension) as world:
        for _ in range(int(240 * seconds)):
            world.step(1.0 / 240.0)
        places = world.positions.array()
        return float(np.percentile(places[:, 0], 99.5)), float(places[:, 1].max())


@pytest.mark.parametrize("dimension", [2, 3])
def test_friction_holds_a_heap_up(dimension: int) -> None:
    common, rough = (spread(sand(friction_angle=math.radians(angle)), dimension) for angle in (30.0, 55.0))
    smooth = spread(sand(friction_angle=0.0), dimension, seconds=2.0)
    assert smooth[0] > 1.8  # it has run to the far wall, as a liquid does
    assert rough[0] < common[0] < 1.3
    assert smooth[1] < common[1] < rough[1]


def test_sand_in_a_gentle_heap_stays() -> None:
    """A wedge of 15 degrees of sand with 35 degrees does not creep: its centre sinks by what it is compressed by."""
    with column(sand(friction_angle=math.radians(35.0)), pbmpm.Solver.DUAL, size=(1.6, 0.4)) as world:
        places = world.positions.copy()
        above = places[:, 1] > 0.4 - places[:, 0] * math.tan(math.radians(15.0))
        world.remove(world.ids.copy()[above])
        start = world.positions.copy()[np.argsort(world.ids.copy()[:, 0])]
        for _ in range(240):
            world.step(1.0 / 240.0)
        moved = world.positions.copy()[np.argsort(world.ids.copy()[:, 0])] - start
        assert np.abs(moved).mean() < 0.01 and world.stats.max_speed < 0.02


@pytest.mark.parametrize("solver", [pbmpm.Solver.PAPER, pbmpm.Solver.DUAL], ids=lambda solver: solver.name)
def test_shaken_sand_does_not_grow(solver: pbmpm.Solver) -> None:
    """A bed 0.6 m deep on a floor that shakes by three times gravity for 3 s, and then lies still. What comes apart closes up again, all but
    for shear that holds grains apart; were expansion forgotten the bed would stand twice as high."""
    with pbmpm.World(
        2, 0.05, capacity=2000, gravity=[0, -9.81], domain=([0, -1], [1, 2]), domain_friction=0.3, solver=solver, iterations=10, threads=1
    ) as world:
        world.fill(pbmpm.Box([0.5, 0.3], [0.5, 0.3]), world.add_material(sand()))
        floor = world.add_collider(pbmpm.Box([0.5, -0.5], [0.6, 0.5]), kinematic=True)
        for step in range(1, 4 * 240 + 1):
            time = min(step / 240.0, 3.0)  # 12 whole swings
            floor.move([0.5, -0.5 + 0.05 * math.sin(8.0 * math.pi * time)])
            world.step(1.0 / 240.0)
        depth = 2.0 * float(world.positions.array()[:, 1].mean())
        assert 0.55 < depth < 0.6 * 1.4


def test_visco_stands_below_its_yield_strain_and_flows_beyond() -> None:
    """The largest shear stress under a column of height h is rho g h / 2; sqrt(2) mu yield_strain is borne."""
    shear_modulus = 5e5 / 2.6
    needed = 1500.0 * 9.81 * 0.4 / 2.0 / (math.sqrt(2.0) * shear_modulus)
    stiff, soft = spread(visco(yield_strain=3.0 * needed)), spread(visco(yield_strain=needed / 10.0, flow_rate=1e4))
    assert stiff[0] < 0.43 and stiff[1] > 0.37
    assert soft[0] > 0.6 and soft[1] < 0.33


@pytest.mark.parametrize("material", [sand(), visco(yield_strain=0.005)], ids=["sand", "visco"])
def test_parameters_and_snapshots_survive(material: pbmpm.Sand | pbmpm.Visco) -> None:
    with column(material, pbmpm.Solver.DUAL) as world:
        for _ in range(20):
            world.step(1.0 / RATE)
        kept = world.snapshot()
        hashes = []
        for _ in range(2):
            world.restore(kept)
            for _ in range(20):
                world.step(1.0 / RATE)
            hashes.append(world.hash())
        assert hashes[0] == hashes[1]
    other = pbmpm.World(2, 0.1, capacity=10)
    assert other.add_material(material).parameters == material
    other.close()


@pytest.mark.long
def test_the_column_collapses_as_in_experiments() -> None:
    (case,) = find_cases(["granular-column"])
    setting = case.sweep(quick=True)[0]
    measured = case.measure(setting)
    for measure in case.error_kinds:
        error = measured.errors[measure.name]
        assert error is not None and error <= measure.tolerance, (setting.text(), measure.name)
    assert case.solve(setting).observed == measured.observed  # of the run in 2D alone


@pytest.mark.long
def test_a_column_slumps_as_theory_says() -> None:
    (case,) = find_cases(["slump"])
    (setting,) = case.sweep(quick=True)
    errors = case.measure(setting).errors
    for measure in case.error_kinds:
        error = errors[measure.name]
        assert error is not None and error <= measure.tolerance, (measure.name, error)


def test_the_theory_of_the_slump() -> None:
    """Nothing yields in a column that is not higher than h0; one twice as high as h0 loses half of its height but for ln(2) / 2."""
    assert slump.theory(0.5) == slump.theory(0.7) == 0.0
    assert slump.theory(0.25) == pytest.approx(0.5 - 0.5 * math.log(2.0))
    assert slump.theory(1e-9) == pytest.approx(1.0, abs=1e-6)
    shear_modulus = slump.YOUNG_MODULUS / (2.0 * (1.0 + slump.POISSON_RATIO))
    stress = math.sqrt(2.0) * shear_modulus * slump.yield_strain_of(0.2)
    assert stress == pytest.approx(0.2 * slump.DENSITY * 9.81 * slump.HEIGHT)


def test_the_middle_of_the_band_is_no_error() -> None:
    low, high = granular.envelope("runout")
    assert granular.from_middle(0.5 * (low + high), "runout") == pytest.approx(0.0)
    assert granular.from_middle(high, "runout") == pytest.approx(granular.half_width("runout"))


@pytest.mark.parametrize("solver, rate_hz", [("paper", 60), ("dual", 60), ("primal", 60), ("explicit", 480)])
def test_crowded_clay_makes_room(solver: str, rate_hz: int) -> None:
    """Three lumps of clay in one place, 12 particles per cell instead of 4. It parts until the grid holds 1.5 times what belongs there, and no
    faster than what falls from the top of the lump; without feedback it stays what it is. Cells at the edge are not full, so means lie below."""

    def settle(feedback: float) -> tuple[float, float]:
        with pbmpm.World(2, 0.05, gravity=(0, -9.81), capacity=2000, domain=((0, 0), (2, 1))) as world:
            world.solver, world.iterations = solver, 5
            clay = world.add_material(pbmpm.Visco(density=1300, volume_feedback=feedback))
            for seed in range(3):
                world.fill(pbmpm.Box((1, 0.25), (0.25, 0.25)), clay, seed=seed)
            fastest = 0.0
            for _ in range(3 * rate_hz):
                world.step(1 / rate_hz)
                fastest = max(fastest, world.stats.max_speed)
            cells = np.floor(world.positions.copy() / 0.05).astype(int)
            return 1200 / len(np.unique(cells, axis=0)), fastest

    crowded, _ = settle(0.0)
    parted, fastest = settle(pbmpm.Visco().volume_feedback)
    assert crowded > 2.2 * 4
    assert parted < 1.5 * 1.1 * 4
    assert fastest < math.sqrt(2 * 9.81 * 0.5)


def at_a_games_pace(dimension: int, cell: float, **changes: float) -> pbmpm.World:
    return pbmpm.World(
        dimension, cell, capacity=20000, gravity=[0.0, -9.81, 0.0][:dimension], solver=pbmpm.Solver.CONVERGENT, iterations=5, threads=1, **changes
    )


def speed(world: pbmpm.World) -> float:
    return math.sqrt(2.0 * world.stats.kinetic_energy / world.stats.mass)


@pytest.mark.parametrize(("dimension", "rate", "iterations"), [(2, 60.0, 5), (2, 240.0, 5), (3, 60.0, 5), (2, 60.0, 1), (2, 240.0, 1), (3, 60.0, 1)])
def test_a_column_slumps_and_rests_with_its_volume(dimension: int, rate: float, iterations: int) -> None:
    """Twice as high as wide, 30 degrees: runs out by 2.4 to 4.4 of its width (experiments), keeps 93 % of what its outline holds, and does not creep.

    With a single iteration it kept a tenth of its volume. Inertia is not promised there, but statics is: a heap at rest is no steeper than 30 degrees.
    Of the area A its foot is sqrt(2 A / tan 30), and all but 0.5 % of its grains lie within 1 - sqrt(0.005) of that.
    """
    statics = math.sqrt(2.0 * 0.93 * 2.0 / math.tan(math.radians(30.0))) * (1.0 - math.sqrt(0.005)) - 1.0  # 0.93: what the volume may lose
    shortest = 2.4 if iterations > 1 else statics
    cell = 0.02 if dimension == 2 else 0.04
    width = 10 * cell
    with at_a_games_pace(dimension, cell) as world:
        world.iterations = iterations
        axis = [0.0] * dimension
        world.add_collider(pbmpm.Plane(axis, [0.0, 1.0, 0.0][:dimension]), friction_coefficient=0.6)
        world.add_collider(pbmpm.Plane(axis, [1.0, 0.0, 0.0][:dimension]), friction=pbmpm.Friction.SLIP)
        if dimension == 3:
            world.add_collider(pbmpm.Plane(axis, [0.0, 0.0, 1.0]), friction=pbmpm.Friction.SLIP)
            world.add_collider(pbmpm.Plane([0.0, 0.0, 0.4], [0.0, 0.0, -1.0]), friction=pbmpm.Friction.SLIP)
        half = [width / 2, width, 0.2][:dimension]
        world.fill(pbmpm.Box(half, half), world.add_material(pbmpm.Sand(density=1600.0, young_modulus=1e6)))
        for _ in range(int(4 * rate)):
            world.step(1.0 / rate)
        front = float(np.percentile(world.positions.array()[:, 0], 99.5)) / width - 1.0
        x = np.linspace(0.5 * cell, 6.0 * width, 300)
        points = [[v, 0.0, 0.2][:dimension] for v in x]
        heights = np.clip(np.asarray(world.query_heights(points)), 0.0, 9.0)
        area = float(np.sum(0.5 * (heights[1:] + heights[:-1]) * np.diff(x))) / (2.0 * width**2)
        assert shortest < front < 4.4
        assert 0.93 < area < 1.1
        assert speed(world) < 0.003


def test_sand_in_a_bin_stands_as_high_as_it_is() -> None:
    """A bed 25 cells deep, let go at 60 Hz x 5, was crushed to half its height. It rests within three seconds."""
    with at_a_games_pace(2, 0.02, domain=([0.0, 0.0], [0.8, 2.0])) as world:
        world.fill(pbmpm.Box([0.4, 0.25], [0.4, 0.25]), world.add_material(pbmpm.Sand(density=1600.0, young_modulus=1e6)))
        for _ in range(200):
            world.step(1.0 / 60.0)
        assert 0.95 < 4.0 * float(world.positions.array()[:, 1].mean()) < 1.05
        assert speed(world) < 0.005


@pytest.mark.parametrize(("dimension", "half", "drop"), [(2, 0.2, 0.1), (3, 0.16, 0.2)])
def test_sand_that_is_handed_to_the_primal_stays(dimension: int, half: float, drop: float) -> None:
    """A bed that fell into a bin stays within 1 mm/s once the primal has it: both solvers meet walls alike.

    Where only the primal let grains come nearer to walls, the bed spread into them, at 40 mm/s in 2D and 190 mm/s in 3D.
    """
    cell = 0.02 if dimension == 2 else 0.04
    bin_ = ([-half, 0.0, -half][:dimension], [half, 1.0, half][:dimension])
    with at_a_games_pace(dimension, cell, domain=bin_, domain_friction=0.4) as world:
        world.fill(pbmpm.Box([0.0, 0.1 + drop, 0.0][:dimension], [half, 0.1, half][:dimension]), world.add_material(pbmpm.Sand(density=1600.0, young_modulus=1e6)))
        flowed, fastest = False, None
        for _ in range(180):
            world.step(1.0 / 60.0)
            flowed = flowed or world.stats.solver == pbmpm.Solver.DUAL
            if flowed and world.stats.solver == pbmpm.Solver.PRIMAL:
                fastest = max(fastest or 0.0, speed(world))
        assert fastest is not None
        assert fastest < 1e-3


def test_a_snapshot_of_sand_goes_on_bit_for_bit() -> None:
    """What sand bears, its pressure too, is part of it."""
    with at_a_games_pace(2, 0.05, domain=([0.0, 0.0], [1.0, 2.0])) as world:
        world.fill(pbmpm.Box([0.3, 0.3], [0.3, 0.3]), world.add_material(sand()))
        for _ in range(20):
            world.step(1.0 / 60.0)
        before = world.snapshot()
        for _ in range(10):
            world.step(1.0 / 60.0)
        expected = world.hash()
        world.restore(before)
        for _ in range(10):
            world.step(1.0 / 60.0)
        assert world.hash() == expected


@pytest.mark.parametrize(("half", "high", "cohesion", "lift"), [(0.3, 0.15, 0.0, 0.5), (0.3, 0.15, 0.02, 0.5), (0.25, 0.2, 0.0, 0.5), (0.3, 0.15, 0.0, 1.0)])
def test_sand_in_a_bucket_rests_after_a_lift(half: float, high: float, cohesion: float, lift: float) -> None:
    """Jerked up by `lift` [m/s] for a second, it lies still 4 s later: 1 mm/s is what a heap may creep. The dual does not give back all of its volume at this depth, so it
    must not wait for that."""
    rate, wall = 60, 0.04
    with pbmpm.World(2, 0.025, gravity=(0, -9.81), domain=((0, 0), (1.6, 1.8)), domain_friction=0.5, threads=1) as world:
        base = np.array([0.8, 0.25])
        boards = [
            ((0, 0), (half + 2 * wall, wall)),
            ((-half - wall, 0.25 + wall), (wall, 0.25)),
            ((half + wall, 0.25 + wall), (wall, 0.25)),
        ]
        colliders = [world.add_collider(pbmpm.Box(tuple(base + way), size), kinematic=True) for way, size in boards]
        sand_in_it = world.add_material(pbmpm.Sand(density=1600, cohesion=cohesion))
        world.fill(pbmpm.Box((0.8, 0.25 + wall + high), (half, high)), sand_in_it)
        for i in range(int(6.5 * rate)):
            base[1] += lift / rate * float(1.5 <= i / rate < 2.5)
            for collider, (way, _) in zip(colliders, boards, strict=True):
                collider.move(tuple(base + way))
            world.step(1 / rate)
        velocity = world.velocities[...].astype(float)
        assert np.sqrt((velocity**2).sum(axis=1).mean()) < 1e-3
        assert world.volume_ratios[...].mean() > 0.95
