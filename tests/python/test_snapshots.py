"""Snapshots through Python."""

from __future__ import annotations

import numpy as np
import pytest

import pbmpm

STEPS = 60


def test_a_restored_world_goes_on_as_the_saved_one(pool: pbmpm.World) -> None:
    for _ in range(5):
        pool.step(0.01)
    saved = pool.snapshot()
    there = pool.hash()
    hashes = []
    for _ in range(STEPS):
        pool.step(0.01)
        hashes.append(pool.hash())
    pool.gravity = [1.0] * pool.dimension
    pool.restore(saved)
    assert pool.hash() == there and pool.stats.step_count == 5
    for expected in hashes:
        pool.step(0.01)
        assert pool.hash() == expected


def test_matter_that_is_growing_stiffer_goes_on_doing_so(dimension: int) -> None:
    """Raised iterations take effect over some dozens of steps: where they are is part of the state."""
    with pbmpm.World(dimension, 0.1, capacity=4000, iterations=1) as world:
        world.fill(pbmpm.Box([0.5] * dimension, [0.3] * dimension), world.add_material(pbmpm.Elastic()), velocity=[1.0] * dimension)
        world.affine_velocities = np.tile(np.diag([3.0, -3.0, 0.0][:dimension]), (len(world), 1, 1))
        world.step(0.01)
        world.iterations = 20
        for _ in range(5):
            world.step(0.01)
        saved = world.snapshot()
        world.step(0.01)
        expected = world.hash()
        for _ in range(STEPS):
            world.step(0.01)
        world.restore(saved)
        world.step(0.01)
        assert world.hash() == expected


def test_another_world_of_the_same_making(dimension: int) -> None:
    def make() -> pbmpm.World:
        world = pbmpm.World(dimension, 0.1, capacity=4000, gravity=[0, -10, 0][:dimension])
        water = world.add_material(pbmpm.Liquid())
        world.add_collider(pbmpm.Plane([0.0] * dimension, [0, 1, 0][:dimension]))
        world.fill(pbmpm.Box([0.5] * dimension, [0.3] * dimension), water)
        return world

    with make() as one, make() as other:
        for _ in range(10):
            one.step(0.01)
        other.restore(bytes(one.snapshot()))
        assert np.array_equal(one.ids.copy(), other.ids.copy())
        for _ in range(STEPS):
            one.step(0.01)
            other.step(0.01)
            assert one.hash() == other.hash()


def test_sizes(pool: pbmpm.World) -> None:
    assert pool.snapshot_bytes_per_particle == {2: 60, 3: 92}[pool.dimension]
    assert len(pool.snapshot()) == pool.snapshot_bytes > len(pool) * pool.snapshot_bytes_per_particle
    buffer = bytearray(pool.snapshot_bytes + 100)
    assert pool.snapshot_into(buffer) == pool.snapshot_bytes
    assert pool.snapshot_into(memoryview(buffer)[4:]) == pool.snapshot_bytes
    with pytest.raises(pbmpm.CapacityError, match="bytes"):
        pool.snapshot_into(bytearray(10))


def test_damage_and_foreign_worlds(pool: pbmpm.World) -> None:
    saved = pool.snapshot()
    before = pool.hash()
    for spoilt in (b"", b"nonsense", saved[:-1], bytes(saved[:50]) + b"!" + bytes(saved[51:])):
        with pytest.raises(pbmpm.DamagedError):
            pool.restore(spoilt)
    with pbmpm.World(5 - pool.dimension, 0.1) as other, pytest.raises(pbmpm.ForeignError, match="2D|3D"):
        other.restore(saved)
    with pbmpm.World(pool.dimension, 0.2) as other, pytest.raises(pbmpm.ForeignError, match="cell size"):
        other.restore(saved)
    assert pool.hash() == before


def test_views_expire(pool: pbmpm.World) -> None:
    saved = pool.snapshot()
    view = pool.positions
    pool.restore(saved)
    assert view.expired
