"""What sleeping does to the result: a pool that sleeps against one that stays awake."""

from __future__ import annotations

import numpy as np
import pytest

import pbmpm

CELL = 0.1  # [m]
DEPTH = 6  # cells
RATE = 60


def pool(solver: pbmpm.Solver, sleeping: bool) -> pbmpm.World:
    """A pool 12 cells wide, at random places, in 3D."""
    size = np.array([12, DEPTH, 12]) * CELL
    world = pbmpm.World(3, CELL, capacity=20_000, domain=((0, 0, 0), size * (1, 3, 1)), threads=1)
    world.gravity, world.solver, world.iterations = (0, -9.81, 0), solver, 10
    world.sleeping = sleeping
    world.fill(pbmpm.Box(size / 2, size / 2), world.add_material(pbmpm.Liquid()), seed=3)
    return world


def heights(world: pbmpm.World) -> tuple[float, float]:
    """Of the centre of mass and of the surface [cells]."""
    y = world.positions.array()[:, 1].astype(float) / CELL
    return float(y.mean()), float(np.percentile(y, 99))


def test_a_pool_asleep_stands_as_one_awake() -> None:
    """Matter below sleep_speed = 0.05 m/s stops where it is. What a pool at rest stirs is slower and goes nowhere; that moved
    the centre of mass by less than a fiftieth of a cell in 5 s, and the surface by less than a fifth."""
    with pool(pbmpm.Solver.DUAL, True) as asleep, pool(pbmpm.Solver.DUAL, False) as awake:
        for _ in range(5 * RATE):
            asleep.step(1 / RATE)
            awake.step(1 / RATE)
        assert asleep.stats.particles_asleep == len(asleep)
        assert awake.stats.particles_asleep == 0
        for slept, moved, bound in zip(heights(asleep), heights(awake), (0.02, 0.2), strict=True):
            assert slept == pytest.approx(moved, abs=bound)


def test_one_drop_wakes_what_it_touches_and_no_more() -> None:
    """Blocks beyond those that the drop stirs keep every bit; afterwards all sleep again. From a snapshot with the drop in the air it goes on the
    same, to the bit."""
    with pool(pbmpm.Solver.DUAL, True) as world:
        for _ in range(5 * RATE):
            world.step(1 / RATE)
        before = places_by_id(world)
        assert world.stats.particles_asleep == len(world)
        (water,) = world.query_region(pbmpm.Box([0.6, 0.3, 0.6], [1, 1, 1]))
        surface = heights(world)[1] * CELL
        drop = world.add_particles(water.material, [[0.6, surface + 2 * CELL, 0.6]], [[0, -3, 0]])
        woken, hashes = 0, []
        for _ in range(2):
            world.step(1 / RATE)
            woken += world.stats.blocks_woken
        half_asleep, sleepers = world.snapshot(), world.stats.particles_asleep
        for _ in range(3 * RATE):
            world.step(1 / RATE)
            woken += world.stats.blocks_woken
            hashes.append(world.hash())
        after = places_by_id(world)
        after.pop(tuple(drop[0].tolist()))
        assert woken > 0
        assert world.stats.particles_asleep == len(world)
        changed = np.array([before[key] for key in before if not np.array_equal(before[key], after[key])])
        assert 0 < len(changed) < len(before) / 4
        assert np.abs(changed[:, [0, 2]] - 0.6).max() < 4 * CELL + 4 * CELL  # its block and the next one
        assert 0 < sleepers < len(world)
        world.restore(half_asleep)
        for expected in hashes:
            world.step(1 / RATE)
            assert world.hash() == expected


def places_by_id(world: pbmpm.World) -> dict[tuple[int, int], np.ndarray]:
    """The position of each particle."""
    return {tuple(key): place for key, place in zip(world.ids.copy().tolist(), world.positions.copy(), strict=True)}


def test_to_remove_nothing_moves_no_row() -> None:
    """Nor when matter is about to wake: views that are still valid showed other rows."""
    with pbmpm.World(3, CELL, capacity=30_000, threads=1, sleeping=True, sleep_time=0.05) as world:
        world.fill(pbmpm.Box((0, 0, 0), (1, 0.4, 1)), world.add_material(pbmpm.Liquid()))
        for _ in range(6):
            world.step(1 / RATE)
        assert world.stats.particles_asleep == len(world)
        world.add_collider(pbmpm.Sphere((-1, 0, -1), 0.2))
        before = world.ids.array().copy()
        assert world.remove_in(pbmpm.Sphere((50, 0, 0), 0.1)) == 0
        world.remove(np.zeros((0, 2), np.uint32))
        assert np.array_equal(world.ids.array(), before)


TOWERS = {
    "rubber": pbmpm.Elastic(young_modulus=1e6),
    "clay": pbmpm.Visco(density=1000, young_modulus=1e6),
}


@pytest.mark.parametrize("material", TOWERS)
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_tower_asleep_falls_when_its_floor_goes(dimension: int, material: str) -> None:
    """A part at the height h learns it when a wave has come there, after h / c. The call that takes the floor, and the waking, each take a substep more."""
    cell, gravity, high = (0.025, 9.81, 1.2) if dimension == 2 else (0.05, 9.81, 1.0)
    matter = TOWERS[material]
    with pbmpm.World(
        dimension,
        cell,
        gravity=(0, -gravity, 0)[:dimension],
        domain=((0, -1, 0)[:dimension], (1.2, 3, 1.2)[:dimension]),
        domain_friction=0.5,
        sleeping=True,
    ) as world:
        floor = world.add_collider(pbmpm.Box((0.6, 0.95, 0.6)[:dimension], (0.5, 0.05, 0.5)[:dimension]))
        body = pbmpm.Box((0.6, 1 + 0.5 * high, 0.6)[:dimension], (0.2, 0.5 * high, 0.2)[:dimension])
        world.fill(body, world.add_material(matter))
        for _ in range(5 * RATE):
            world.step(1 / RATE)
        assert world.stats.particles_asleep == len(world)
        floor.destroy()
        steps = 24
        for _ in range(steps):
            world.step(1 / RATE)
        nu = matter.poisson_ratio
        modulus = matter.young_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))  # lambda + 2 mu
        late = 0.5 * high * np.sqrt(1000 / modulus) + 2 / RATE
        fallen = -float(world.velocities[...][:, 1].mean())
        assert gravity * (steps / RATE - late) < fallen < gravity * steps / RATE * 1.02  # 2 %: what springs down at its foot


def drawn(sleeping: bool, speed: float) -> np.ndarray:
    """Places of a slab of 1.6 x 0.4 m, one end of which a hand has drawn by 10 cm; it lay still before, for 3 s."""
    with pbmpm.World(2, 0.05, gravity=(0, -9.81), domain=((0, 0), (4, 2)), domain_friction=0.5, sleeping=sleeping, threads=1) as world:
        world.fill(pbmpm.Box((1.5, 0.2), (0.8, 0.2)), world.add_material(pbmpm.Elastic(young_modulus=1e5)))
        ids = np.array(world.ids[...])
        for _ in range(3 * RATE):
            world.step(1 / RATE)
        assert world.stats.particles_asleep == (len(world) if sleeping else 0)
        place = 2.2
        hand = world.add_force("grab", shape=pbmpm.Sphere((place, 0.2), 0.15), velocity=(speed, 0))
        for _ in range(round(0.1 / speed * RATE)):
            hand.change(shape=pbmpm.Sphere((place, 0.2), 0.15))
            world.step(1 / RATE)
            place += speed / RATE
        return np.array(world.positions[...])[world.find(ids)]


@pytest.mark.parametrize("speed", [0.02, 0.08])
def test_a_slab_asleep_is_not_torn_by_a_slow_hand(speed: float) -> None:
    """Slower than sleep_speed or not: within a cell of where it is if it does not sleep. It was torn along an edge of blocks, 0.2 m apart."""
    assert np.abs(drawn(True, speed) - drawn(False, speed)).max() < 0.05


@pytest.mark.parametrize("material", [pbmpm.Elastic(young_modulus=1e5), pbmpm.Visco(density=1500)])
def test_what_sleeps_goes_with_a_slow_belt(material: pbmpm.Material) -> None:
    """At 0.02 m/s, below sleep_speed, all of it: a fifth of the way may be lost to slip. Its foot rode along, and the rest stayed."""
    with pbmpm.World(2, 0.05, gravity=(0, -9.81), domain=((0, -1), (4, 3)), sleeping=True, threads=1) as world:
        belt = world.add_collider(pbmpm.Box((2, -0.1), (1.5, 0.1)), kinematic=True, friction_coefficient=0.5)
        world.fill(pbmpm.Box((1.5, 0.4), (0.2, 0.4)), world.add_material(material))
        for _ in range(3 * RATE):
            world.step(1 / RATE)
        before = np.array(world.positions[...])
        way = 0.2
        for i in range(round(way / 0.02 * RATE)):
            belt.move((2 + 0.02 * (i + 1) / RATE, -0.1))
            world.step(1 / RATE)
        after = np.array(world.positions[...])
        assert 0.8 * way < after[:, 0].mean() - before[:, 0].mean() < 1.05 * way
        assert np.ptp(after[:, 0]) < np.ptp(before[:, 0]) + 0.05  # it did not come apart


@pytest.mark.parametrize("material", TOWERS)
def test_a_block_asleep_falls_when_its_ledge_goes(material: str) -> None:
    """So small that its foot could hang from what sleeps above it: it fell by a millimetre, and hung. One substep late."""
    with pbmpm.World(2, 0.025, gravity=(0, -9.81), domain=((0, 0), (2, 1.6)), sleeping=True, threads=1) as world:
        ledge = world.add_collider(pbmpm.Box((0.3, 0.95), (0.125, 0.05)))
        world.fill(pbmpm.Box((0.3, 1.125), (0.125, 0.125)), world.add_material(TOWERS[material]))
        for _ in range(150):
            world.step(1 / RATE)
        assert world.stats.particles_asleep == len(world)
        before = float(world.positions[...][:, 1].mean())
        ledge.destroy()
        for _ in range(15):
            world.step(1 / RATE)
        assert before - float(world.positions[...][:, 1].mean()) > 0.5 * 9.81 * 14 * 13 / RATE**2
