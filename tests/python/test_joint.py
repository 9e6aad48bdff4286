"""The joint solver, of islands of solids and liquid: what it promises beside tests/python/test_islands.py."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy.elastic.strain import FIXED_COROTATED, kinetic_energy, strain_energy
from pbmpm.lab.accuracy.elastic.theory import Solid

G, CELL, DT = 9.81, 0.05, 1 / 60


def basin(world: pbmpm.World, **collider: Any) -> list[pbmpm.Collider]:
    """Two walls and a floor of boxes, 1.2 m wide inside."""
    places = (((-0.1, 0.6), (0.1, 0.8)), ((1.3, 0.6), (0.1, 0.8)), ((0.6, -0.1), (0.8, 0.1)))
    return [world.add_collider(pbmpm.Box(at, half), **collider) for at, half in places]


def pool_with_body(world: pbmpm.World, density: float, young_modulus: float, velocity: tuple[float, float] = (0, 0)) -> tuple[pbmpm.Material, pbmpm.Material]:
    """Water of 8 cells, and a box of 6 that falls into it."""
    water, body = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=density, young_modulus=young_modulus))
    world.fill(pbmpm.Box((0.6, 0.2), (0.6, 0.2)), water, velocity=velocity)
    world.fill(pbmpm.Box((0.6, 0.6), (0.15, 0.15)), body, velocity=velocity)
    return water, body


def rms(world: pbmpm.World, less: tuple[float, float] = (0, 0)) -> float:
    """Of all particles' speeds."""
    return float(np.sqrt(((np.array(world.velocities) - less) ** 2).sum(1).mean()))


@pytest.mark.parametrize(("density", "young_modulus", "iterations"), [(50, 1e8, 5), (300, 1e8, 5), (2000, 1e8, 5), (500, 1e5, 2), (500, 1e5, 1), (500, 1e5, 20), (8000, 1e6, 5)])
def test_no_body_bursts(density: float, young_modulus: float, iterations: int) -> None:
    """From feathers to lead and from jelly to hard rubber: nothing moves faster than what fell from the top of the box, and what floats keeps its form."""
    with pbmpm.World(2, CELL, gravity=(0, -G), threads=1, iterations=iterations, domain=((0, 0), (1.2, 1.2))) as world:
        _, body = pool_with_body(world, density, young_modulus)
        fastest = 0.0
        for _ in range(180):
            world.step(DT)
            fastest = max(fastest, world.stats.max_speed)
        assert world.stats.solver == (pbmpm.Solver.CONVERGENT if iterations > 1 else pbmpm.Solver.PRIMAL)
        assert fastest < np.sqrt(2 * G * 1.2)
        stretch = np.linalg.svd(np.array(world.deformations)[np.array(world.material_indices).ravel() == body.index].reshape(-1, 2, 2), compute_uv=False)
        assert 0.75 < stretch.min() < stretch.max() < 1.25
        assert rms(world) < 0.5


def test_impulses_are_the_momentum_that_obstacles_take() -> None:
    """While a body falls into water between boxes, which gravity and they alone move: to rounding, of the momentum that passes in a step."""
    with pbmpm.World(2, CELL, gravity=(0, -G), threads=1, iterations=5, capacity=4000) as world:
        walls = basin(world, measures_impulse=True)
        pool_with_body(world, 800, 5e4)
        mass = world.stats.mass
        for _ in range(60):
            before = np.array(world.stats.momentum)[:2]
            world.step(DT)
            assert world.stats.solver in (pbmpm.Solver.CONVERGENT, pbmpm.Solver.PRIMAL)
            given = np.sum([np.array(wall.impulse.linear)[:2] for wall in walls], axis=0)
            change = np.array(world.stats.momentum)[:2] - before - mass * DT * np.array((0, -G))
            assert -given == pytest.approx(change, abs=1e-3 * mass * DT * G)


def test_a_tank_that_moves_takes_water_and_body_along() -> None:
    """At constant speed they come to rest in it; before, they were stirred at 0.6 m/s for ever."""
    speed = 1.0
    with pbmpm.World(2, CELL, gravity=(0, -G), threads=1, iterations=5, capacity=4000) as world:
        walls = basin(world, kinematic=True, friction=pbmpm.Friction.SLIP)
        starts = [np.array(wall.shape.position) for wall in walls]
        pool_with_body(world, 500, 5e4, (speed, 0))
        for step in range(480):
            for wall, start in zip(walls, starts, strict=True):
                wall.move((start[0] + speed * (step + 1) * DT, start[1]))
            world.step(DT)
        assert rms(world, (speed, 0)) < 0.05


def floats_in_a_lift(velocity: tuple[float, float]) -> np.ndarray:
    """Where a stiff body's middle is after each step [cells], seen from the basin that it floats in, which moves with all that is in it."""
    with pbmpm.World(2, CELL, gravity=(0, -G), threads=1, iterations=5, capacity=4000) as world:
        walls = basin(world, kinematic=True, friction=pbmpm.Friction.SLIP)
        starts = [np.array(wall.shape.position) for wall in walls]
        water, body = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=500, young_modulus=1e7))
        world.fill(pbmpm.Box((0.6, 0.3), (0.6, 0.3)), water, velocity=velocity)
        world.fill(pbmpm.Box((0.6, 0.75), (0.2, 0.1)), body, velocity=velocity)
        middles = []
        for step in range(90):
            way = np.array(velocity) * (step + 1) * DT
            for wall, start in zip(walls, starts, strict=True):
                wall.move((start[:2] + way).tolist())
            world.step(DT)
            middles.append(np.array(world.positions)[np.array(world.material_indices).ravel() == body.index].mean(axis=0) - way)
    return np.array(middles) / CELL


@pytest.mark.parametrize("cells", [1, -1, 2])
def test_a_body_floats_in_a_lift_as_at_rest(cells: int) -> None:
    """Lifts go by so many cells per step, so the grid sees the same. What comes in by rounding is 0.07 to 0.13 cells. The energy check saw another energy in a lift: with two
    cells per step the body went elsewhere by 1.4 to 5.4 cells."""
    apart = np.abs(floats_in_a_lift((0.0, cells * CELL / DT)) - floats_in_a_lift((0.0, 0.0)))
    assert apart.max() < 0.3


@pytest.mark.parametrize(("dimension", "cell"), [(2, 0.02), (3, 0.03)])
def test_what_falls_together_does_not_stir(dimension: int, cell: float) -> None:
    """A jelly under water, let go at rest: nothing presses. It moves by what noise of the filling the first steps even out. Where solids started as if they were held, it
    had 0.06 m/s in 2D and 0.11 in 3D after half a second."""
    half = 0.06
    with pbmpm.World(dimension, cell, gravity=(0, -G, 0)[:dimension], threads=1, iterations=5, capacity=4000) as world:
        water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(young_modulus=2e4))
        world.fill(pbmpm.Box((0,) * dimension, (half,) * dimension), jelly)
        world.fill(pbmpm.Box((0, half + 0.08, 0)[:dimension], (0.12, 0.08, 0.12)[:dimension]), water)
        for _ in range(30):
            world.step(DT)
        velocities = np.array(world.velocities)
        assert rms(world, tuple(velocities.mean(axis=0))) < 0.01


@pytest.mark.xfail(strict=True, reason="a pair that falls stirs while another one touches an obstacle: docs/limits.md")
@pytest.mark.parametrize(("dimension", "cell"), [(2, 0.02), (3, 0.03)])
def test_what_falls_does_not_stir_while_its_like_lies_on_a_floor(dimension: int, cell: float) -> None:
    """As above, with a second jelly under water three metres away, on a floor: the first pair falls as if it were alone. It has 0.2 to 0.3 m/s."""
    half, fastest = 0.06, 0.0
    with pbmpm.World(dimension, cell, gravity=(0, -G, 0)[:dimension], threads=1, iterations=5, capacity=10_000) as world:
        water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(young_modulus=2e4))
        for away in (0.0, 3.0):
            world.fill(pbmpm.Box((away, 0, 0)[:dimension], (half,) * dimension), jelly)
            world.fill(pbmpm.Box((away, half + 0.08, 0)[:dimension], (0.12, 0.08, 0.12)[:dimension]), water)
        world.add_collider(pbmpm.Box((3.0, -half - 0.1, 0)[:dimension], (0.3, 0.1, 0.3)[:dimension]))
        for _ in range(40):
            world.step(DT)
            velocities = np.array(world.velocities)[np.array(world.positions)[:, 0] < 1.5]
            fastest = max(fastest, float(np.sqrt(((velocities - velocities.mean(axis=0)) ** 2).sum(1).mean())))
        print(f"{dimension}D: rms speed up to {fastest:.3f} m/s")
        assert fastest < 0.01


def test_liquid_with_a_body_slips_at_any_friction() -> None:
    """Bit by bit as at walls without friction, where a jelly floats that touches no wall."""
    states = []
    for friction in ({"friction": pbmpm.Friction.SLIP}, {"friction_coefficient": 5.0}):
        with pbmpm.World(2, CELL, gravity=(2, -G), threads=1, iterations=5, capacity=4000) as world:
            basin(world, **friction)
            world.fill(pbmpm.Box((0.6, 0.2), (0.6, 0.2)), world.add_material(pbmpm.Liquid()))
            world.fill(pbmpm.Box((0.6, 0.45), (0.1, 0.1)), world.add_material(pbmpm.Elastic(density=300, young_modulus=5e4)))
            for _ in range(10):
                world.step(DT)
            states.append(np.array(world.positions))
    assert (states[0] == states[1]).all()


def late_speed_in_a_glass(density: float, young_modulus: float, place: float) -> float:
    """A jelly falls into a glass: the rms speed of the fifteenth second."""
    with pbmpm.World(2, 0.025, gravity=(0, -G), threads=1, iterations=5, capacity=4000, domain=((-0.25, 0), (0.25, 1))) as world:
        water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=density, young_modulus=young_modulus))
        world.fill(pbmpm.Box((0, 0.225), (0.25, 0.225)), water)
        world.fill(pbmpm.Box((place, 0.65), (0.1, 0.1)), jelly)
        for _ in range(840):
            world.step(DT)
        squares = []
        for _ in range(60):
            world.step(DT)
            squares.append(rms(world) ** 2)
        room = 2 * np.array(world.positions)[:, 1].mean() * 0.5
        assert 0.9 < room / (0.5 * 0.45 + 0.04) < 1.05
        return float(np.sqrt(np.mean(squares)))


@pytest.mark.long
def test_a_jelly_in_a_glass_comes_to_rest() -> None:
    """After the fall nothing drives it, but water of 18 cells is deep for 60 Hz: alone it goes on at 0.01 to 0.025 m/s. The heaviest jelly lies on the floor, crushed to two
    thirds of its volume. How a start goes on depends on the last bit: single ones have 0.004 to 0.052 m/s, 24 of them 0.020 on average with a deviation of 0.012, so 16
    stay below 0.03 by three deviations of their mean. Where liquid pushed without turning along, all spun at 1 m/s for ever."""
    matter = ((1000, 2e4), (1100, 1e5), (1500, 2e4), (500, 1e5))
    speeds = [late_speed_in_a_glass(*jelly, 0.02 + 1e-4 * start) for jelly in matter for start in range(4)]
    print(f"{min(speeds):.4f} to {max(speeds):.4f} m/s")
    assert np.mean(speeds) < 0.03
    assert max(speeds) < 0.1


@pytest.mark.parametrize(("rate", "iterations"), [(30, 10), (30, 20), (30, 40), (60, 20), (120, 20)])
@pytest.mark.parametrize("kind", ["elastic", "visco"])
def test_a_stiff_disc_that_drifts_against_water_is_not_driven(kind: str, rate: int, iterations: int) -> None:
    """Without gravity, at 0.1 m/s. With all of the liquid's impulse on nodes that stay the motion grew up to a thousandfold. Solids and liquid are solved one after the
    other, which still gives a half at most: twice as much is none of that."""
    h = 0.028
    stiff = dict(density=200, young_modulus=6e5)
    with pbmpm.World(2, h, gravity=(0, 0), threads=1, iterations=iterations, capacity=4000, domain=((0, 0), (8 * h, 8 * h)), domain_friction=0) as world:
        world.fill(pbmpm.Box((2.45 * h, 2.6 * h), (2.4 * h, 2.2 * h)), world.add_material(pbmpm.Liquid(density=120)))
        matter = pbmpm.Elastic(**stiff) if kind == "elastic" else pbmpm.Visco(yield_strain=0.005, **stiff)
        world.fill(pbmpm.Sphere((7.4 * h, 4.1 * h), 1.95 * h), world.add_material(matter), velocity=(-0.1, 0))
        start = world.stats.kinetic_energy
        for _ in range(rate):
            world.step(1 / rate)
            assert world.stats.kinetic_energy < 2 * start


def spin_of(world: pbmpm.World, body: Any) -> float:
    at = world.find(body)
    r, v = np.array(world.positions)[at], np.array(world.velocities)[at]
    r, v = r - r.mean(0), v - v.mean(0)
    return float((r[:, 0] * v[:, 1] - r[:, 1] * v[:, 0]).sum() / (r**2).sum())


def turned(world: pbmpm.World, size: tuple[float, float], middle: tuple[float, float], half: float, spin: float, young_modulus: float) -> Any:
    """Fills a box with water and a square in it that turns."""
    h = world.cell_size
    places = np.stack(np.meshgrid(*(np.arange(h / 4, length, h / 2) for length in size), indexing="ij"), -1).reshape(-1, 2)
    r = places - middle
    inside = (abs(r) < half).all(1)
    turn = spin * np.stack([-r[:, 1], r[:, 0]], -1)
    body = world.add_particles(world.add_material(pbmpm.Elastic(young_modulus=young_modulus)), places[inside], velocities=turn[inside])
    world.add_particles(world.add_material(pbmpm.Liquid()), places[~inside])
    return body


@pytest.mark.parametrize(
    ("solver", "iterations", "most"), [(pbmpm.Solver.CONVERGENT, 5, 0.06), (pbmpm.Solver.CONVERGENT, 20, 0.06), (pbmpm.Solver.PRIMAL, 20, 0.2)]
)
def test_pressed_matter_does_not_spin_up(solver: pbmpm.Solver, iterations: int, most: float) -> None:
    """A jelly of eight cells that turns in the depth of a glass. Where its pressure turned it, it turned five to nine times faster after two seconds. The primal's pools
    stir by themselves."""
    h, spin = 0.025, 1.0
    with pbmpm.World(2, h, gravity=(0, -G), solver=solver, threads=1, iterations=iterations, capacity=4000, domain=((0, 0), (20 * h, 40 * h)), domain_friction=0) as world:
        jelly = turned(world, (20 * h, 20 * h), (10 * h, 9 * h), 4 * h, spin, 2e4)
        fastest = 0.0
        for _ in range(120):
            world.step(DT)
            fastest = max(fastest, abs(spin_of(world, jelly)))
        assert fastest < spin
        assert rms(world) < most


@pytest.mark.parametrize("young_modulus", [1e5, 1e6, 1e9])
@pytest.mark.parametrize("spin", [10.0, 20.0])
def test_stiff_bodies_that_spin_in_water_are_not_driven(spin: float, young_modulus: float) -> None:
    """Without gravity, in water with room above. Where the stretch of their chords counted as a couple, they burst at 50 m/s. Slow ones are driven a little still:
    turns_in_water of tests/field."""
    h = 0.025
    with pbmpm.World(2, h, gravity=(0, 0), threads=1, iterations=5, capacity=4000, domain=((0, 0), (24 * h, 32 * h)), domain_friction=0) as world:
        block = turned(world, (24 * h, 24 * h), (12 * h, 12 * h), 4 * h, spin, young_modulus)
        energy = float((np.array(world.velocities) ** 2).sum())
        for _ in range(120):
            world.step(DT)
            assert abs(spin_of(world, block)) < spin
            assert (np.array(world.velocities) ** 2).sum() < energy


@pytest.mark.parametrize("spin", [10.0, 20.0])
def test_a_rubber_ball_that_falls_spinning_into_water_stays_whole(spin: float) -> None:
    """Nothing gets faster than the fall and the spin explain."""
    h, radius = 0.05, 0.2
    with pbmpm.World(2, h, gravity=(0, -G), threads=1, iterations=5, capacity=4000, domain=((0, 0), (2, 3))) as world:
        world.fill(pbmpm.Box((1, 0.4), (1, 0.4)), world.add_material(pbmpm.Liquid()))
        places = np.stack(np.meshgrid(np.arange(0.8 + h / 4, 1.2, h / 2), np.arange(1.3 + h / 4, 1.7, h / 2), indexing="ij"), -1).reshape(-1, 2)
        r = places - (1, 1.5)
        inside = np.hypot(*r.T) < radius
        turn = spin * np.stack([-r[:, 1], r[:, 0]], -1)
        world.add_particles(world.add_material(pbmpm.Elastic(density=700, young_modulus=1e6)), places[inside], velocities=turn[inside])
        fastest = 0.0
        for _ in range(180):
            world.step(DT)
            fastest = max(fastest, world.stats.max_speed)
        assert fastest < np.sqrt(2 * G * 1.5) + spin * radius
        assert rms(world) < 0.5


@pytest.mark.parametrize(
    ("depth", "cell", "density", "young_modulus", "place"),
    [(30, 0.02, 1000, 2e4, 15), (40, 0.02, 500, 1e5, 45), (40, 0.02, 1000, 1e5, 20), (40, 0.03, 1500, 1e5, 45), (20, 0.025, 1100, 2e4, 25)],
)
def test_bodies_in_pools_too_deep_for_the_rate_stay_whole(depth: int, cell: float, density: float, young_modulus: float, place: int) -> None:
    """Such pools stir: 40 cells of 2 cm at 60 Hz x 5 by 0.09 m/s without a body, 40 of 3 cm with a block that sank by 0.06 to 0.36, as chance has it: with eight moduli within
    5 % by 0.23 in the mean. Where pressures turned with the liquid they threw it about at 28 m/s. Nothing is faster than what falls from the surface to the floor."""
    width, side = 24, 8
    places = np.stack(np.meshgrid(np.arange(0.25, width, 0.5) * cell, np.arange(0.25, place + side, 0.5) * cell, indexing="ij"), -1).reshape(-1, 2)
    inside = (abs(places - (width / 2 * cell, place * cell)) < side / 2 * cell).all(1)
    speeds = []
    for modulus in (0.98 * young_modulus, young_modulus, 1.02 * young_modulus):
        with pbmpm.World(2, cell, gravity=(0, -G), threads=1, iterations=5, domain=((0, 0), (width * cell, (depth + 40) * cell))) as world:
            world.add_particles(world.add_material(pbmpm.Liquid()), places[~inside & (places[:, 1] < depth * cell)])
            world.add_particles(world.add_material(pbmpm.Elastic(density=density, young_modulus=modulus)), places[inside])
            fastest = 0.0
            for _ in range(300):
                world.step(DT)
                fastest = max(fastest, world.stats.max_speed)
            assert fastest < np.sqrt(2 * G * depth * cell)
            speeds.append(rms(world))
    assert np.mean(speeds) < 0.3, speeds


@pytest.mark.long
def test_no_gap_stays_around_what_falls_into_water() -> None:
    """A gap displaces water, too. With one of g cells around it a cube of six cells and half of water's density floats as deep as (6 + 2 g)^2 (depth + g) = 6^3 / 2
    says: 0.38 of it is below the level with 0.25. It was 0.33 where nothing closed the gap, which has half a cell then."""
    h, side, depth = 0.06, 6, 10
    with pbmpm.World(3, h, gravity=(0, -G, 0), threads=1, iterations=5, domain=((0, 0, 0), (20 * h, 26 * h, 20 * h))) as world:
        water, body = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=500, young_modulus=5e4))
        world.fill(pbmpm.Box((10 * h, depth / 2 * h, 10 * h), (10 * h, depth / 2 * h, 10 * h)), water)
        world.fill(pbmpm.Box((10 * h, (depth + 1 + side / 2) * h, 10 * h), (side / 2 * h,) * 3), body)
        for _ in range(210):
            world.step(DT)
        level = world.query_heights([[x * h, 0, z * h] for x in (2, 3, 17, 18) for z in (2, 18)]).mean()
        heights = np.array(world.positions)[np.array(world.material_indices).ravel() == body.index][:, 1]
        assert 0.38 < (heights < level).mean() < 0.55


def wave_heights(with_float: bool) -> list[float]:
    """Of each half period of three: how high a wave of one cell still stands, in a tank of 50 x 20 cells. The float is a jelly of six cells in its middle."""
    h, width, depth, height = 0.04, 2.0, 0.8, 0.04
    number = np.pi / width
    half_period = np.pi / np.sqrt(G * number * np.tanh(number * depth))
    with pbmpm.World(2, h, gravity=(0, -G), threads=1, iterations=5, domain=((0, 0), (width, 2 * depth))) as world:
        places = np.stack(np.meshgrid(np.arange(0.5, 100) * h / 2, np.arange(0.5, 60) * h / 2, indexing="ij"), -1).reshape(-1, 2)
        inside = (abs(places - (width / 2, depth)) < 3 * h).all(1) & with_float
        below = places[:, 1] < depth + height * np.cos(number * places[:, 0])
        world.add_particles(world.add_material(pbmpm.Liquid()), places[below & ~inside])
        if with_float:
            world.add_particles(world.add_material(pbmpm.Elastic(density=500, young_modulus=5e4)), places[inside])
        tilt = []
        for _ in range(round((6 * half_period + 0.15) / DT)):
            world.step(DT)
            left, right = (world.query_heights([[x, 0] for x in place]).mean() for place in ((0.06, 0.1, 0.14), (1.86, 1.9, 1.94)))
            tilt.append(abs(left - right) / 2)
    return [max(tilt[round((n * half_period - 0.15) / DT) : round((n * half_period + 0.15) / DT)]) / height for n in range(1, 7)]


def test_a_wave_goes_on_beside_a_float() -> None:
    """As high as without one. Where velocities paid for all that was gained, it kept a third of its height over three periods."""
    assert wave_heights(with_float=True) == pytest.approx(wave_heights(with_float=False), rel=0.1)


@pytest.mark.parametrize("young_modulus", [1e4, 1e6])
def test_a_jelly_that_starts_afloat_rests(young_modulus: float) -> None:
    """In a glass of 18 cells, half of it in the water; what it does for four seconds is to settle."""
    h = 0.0125
    with pbmpm.World(2, 2 * h, gravity=(0, -G), threads=1, iterations=5, domain=((0, 0), (40 * h, 80 * h))) as world:
        places = np.stack(np.meshgrid(np.arange(0.5, 40) * h, np.arange(0.5, 60) * h, indexing="ij"), -1).reshape(-1, 2)
        inside = (abs(places - (20 * h, 36 * h)) < 8 * h).all(1)
        world.add_particles(world.add_material(pbmpm.Elastic(density=500, young_modulus=young_modulus)), places[inside])
        world.add_particles(world.add_material(pbmpm.Liquid()), places[~inside & (places[:, 1] < 36 * h)])
        for _ in range(300):
            world.step(DT)
        assert rms(world) < 0.005


@pytest.mark.parametrize("velocity", [(0.3, -0.3), (0.44, -0.49), (0.0, -0.9)])
def test_a_stiff_body_that_hits_water_and_floor_gains_nothing_in_any_step(velocity: tuple[float, float]) -> None:
    """With what it stores: as stiff as the iterations hold, so that its modulus is its own. A step gained up to a tenth of the start's energy, for eddies, counted with the body's
    motion beside the water, were said to pay. What is allowed are the eddies' own."""
    solid = Solid(6.5e5, 0.36, 317.0)
    with pbmpm.World(2, CELL, threads=1, iterations=5, solver=pbmpm.Solver.CONVERGENT, domain=((0, 0), (0.7, 0.7))) as world:
        rubber = world.add_material(pbmpm.Elastic(density=solid.density, young_modulus=solid.young, poisson_ratio=solid.poisson))
        world.fill(pbmpm.Box((0.185, 0.225), (0.16, 0.1)), rubber, velocity=velocity)
        world.fill(pbmpm.Box((0.5, 0.34), (0.125, 0.195)), world.add_material(pbmpm.Liquid(density=5700)))

        def energy() -> float:
            masses, of_body = world.masses.array().ravel(), world.material_indices.array().ravel() == rubber.index
            moves = kinetic_energy(world.velocities.array(), world.affine_velocities.array(), masses, CELL)
            return moves + strain_energy(solid, FIXED_COROTATED, world.deformations.array()[of_body], masses[of_body])

        energies = [energy()]
        for _ in range(20):
            world.step(DT)
            energies.append(energy())
    assert np.diff(energies).max() < 0.005 * energies[0]
