"""Steps in the background through Python."""

from __future__ import annotations

import time

import numpy as np
import pytest

import pbmpm


def twin(world: pbmpm.World) -> pbmpm.World:
    """The world of the fixture once more."""
    dimension = world.dimension
    lower, upper = world.domain or ((0.0,), (0.0,))
    made = pbmpm.World(dimension, 0.1, capacity=world.capacity, gravity=world.gravity, domain=(lower, upper), threads=1)
    made.fill(pbmpm.Box([1.0] * dimension, [0.2] * dimension), made.add_material(pbmpm.Liquid()))
    return made


def test_results_are_those_of_steps_that_wait(pool: pbmpm.World) -> None:
    with twin(pool) as other:
        for i in range(20):
            pool.step(0.01)
            other.step_begin(0.01)
            while not other.step_end(wait=bool(i % 2)):
                pass
            assert pool.hash() == other.hash()


def test_the_last_state_is_in_view_meanwhile(pool: pbmpm.World) -> None:
    pool.step(0.01)
    before = pool.positions.copy()
    old = pool.positions
    pool.step_begin(0.01)
    meanwhile = pool.positions
    assert old.expired and not meanwhile.expired
    assert np.array_equal(meanwhile.copy(), before) and len(pool) == len(before)
    assert pool.step_end()
    assert meanwhile.generation != pool.generation
    assert not np.array_equal(pool.positions.copy(), before)


def test_a_published_frame_stays_until_the_next_begin_but_one(pool: pbmpm.World) -> None:
    pool.step_begin(0.01)
    frame = pool.positions
    shown = frame.copy()
    assert pool.step_end()
    pool.remove_in(pbmpm.Sphere([1.0] * pool.dimension, 0.1))
    pool.step_begin(0.01)
    assert pool.step_end()
    assert not frame.expired and np.array_equal(frame.array(), shown) and not np.array_equal(frame, pool.positions)
    pool.step_begin(0.01)
    assert frame.expired
    with pytest.raises(pbmpm.ExpiredViewError):
        frame.array()
    assert pool.step_end()


def test_figures_of_the_step_before(pool: pbmpm.World) -> None:
    pool.step(0.01)
    before = pool.step_stats
    assert before.step_count == 1 and before.ms_total > 0 and not hasattr(before, "mass")
    assert all(getattr(pool.stats, name) == value for name, value in vars(before).items())
    pool.step_begin(0.01)
    assert pool.step_stats.step_count == 1
    assert pool.step_end()
    assert pool.step_stats.step_count == 2


def test_other_calls_are_refused(pool: pbmpm.World) -> None:
    pool.publish([pbmpm.Field.VELOCITY])
    pool.step_begin(0.01)
    assert pool.velocities.shape == (len(pool), pool.dimension)
    for call in (lambda: pool.positions, lambda: pool.step(0.01), lambda: pool.step_begin(0.01), lambda: pool.stats, pool.hash):
        with pytest.raises(pbmpm.BusyError):
            call()
    assert pool.step_end()
    with pytest.raises(pbmpm.InvalidArgumentError, match="none was begun"):
        pool.step_end()
    with pytest.raises(pbmpm.InvalidArgumentError, match="dt"):
        pool.step_begin(-1)


def test_whether_a_step_is_done(pool: pbmpm.World) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError, match="none was begun"):
        pool.step_done()
    pool.step_begin(0.01)
    while not pool.step_done():
        time.sleep(0)
    assert pool.step_done()
    assert pool.step_end(wait=False)


def test_closing_while_a_step_runs(pool: pbmpm.World) -> None:
    pool.step_begin(0.01)
    array = pool.positions.array()
    pool.close()
    with pytest.raises(pbmpm.ClosedError):
        pool.step_end()
    assert np.isfinite(array).all()


def test_positions_between_steps(pool: pbmpm.World) -> None:
    assert np.array_equal(pool.positions_at(0.5), pool.positions.copy())  # before any step
    pool.step(0.01)
    half = pool.positions.copy() - 0.005 * pool.velocities.copy()
    assert np.allclose(pool.positions_at(0.5), half, rtol=0, atol=1e-6)
    before = pool.positions_at(1.0)
    assert np.array_equal(before, pool.positions.copy())
    pool.step_begin(0.01)
    assert np.array_equal(pool.positions_at(1.0), before)
    assert pool.step_end()
    with pytest.raises(pbmpm.InvalidArgumentError, match="alpha"):
        pool.positions_at(1.5)


def test_records_for_a_gpu(pool: pbmpm.World) -> None:
    pool.step(0.01)
    records, d = pool.records(), pool.dimension
    assert records.dtype.itemsize == 28 and len(records) == len(pool)
    assert np.array_equal(records["position"][:, :d], pool.positions.array()) and not records["position"][:, d:].any()
    assert np.array_equal(records["velocity"][:, :d], pool.velocities.array()) and not records["velocity"][:, d:].any()
    assert np.array_equal(records["material"], pool.material_indices.array())
    assert np.array_equal(pool.records(0.5)["position"][:, :d], pool.positions_at(0.5))
