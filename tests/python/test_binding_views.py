"""Views show the library's memory without copying, and expire."""

from __future__ import annotations

import gc
import weakref

import numpy as np
import pytest

import pbmpm
from pbmpm import Field, views
from pbmpm._ffi import ffi


def scattered(dimension: int, count: int = 20) -> np.ndarray:
    return np.random.default_rng(1).uniform(0.5, 1.5, (count, dimension)).astype(np.float32)


@pytest.fixture
def filled(world: pbmpm.World) -> pbmpm.World:
    """Some scattered elastic particles with velocities."""
    places = scattered(world.dimension)
    world.add_particles(world.add_material(pbmpm.Elastic(density=700)), places, places * 2, volumes=0.001)
    return world


def test_shapes_and_types_of_all_fields(filled: pbmpm.World) -> None:
    n, d = len(filled), filled.dimension
    filled.solver = pbmpm.Solver.DUAL
    filled.step(1e-4)  # makes the field of pressures
    filled.user_values = np.arange(n)
    expected = {
        Field.POSITION: ((n, d), np.float32),
        Field.VELOCITY: ((n, d), np.float32),
        Field.AFFINE_VELOCITY: ((n, d, d), np.float32),
        Field.VOLUME_RATIO: ((n,), np.float32),
        Field.DEFORMATION: ((n, d, d), np.float32),
        Field.MATERIAL: ((n,), np.uint32),
        Field.PARTICLE: ((n, 2), np.uint32),
        Field.MASS: ((n,), np.float32),
        Field.PRESSURE: ((n,), np.float32),
        Field.USER_VALUE: ((n,), np.uint32),
    }
    assert set(expected) == set(Field)
    for field, (shape, dtype) in expected.items():
        view = filled.view(field)
        assert (view.shape, view.dtype, len(view), view.field) == (shape, dtype, n, field)
        assert view.array().shape == shape


def test_values_arrive_through_the_strides(world: pbmpm.World) -> None:
    water = world.add_material(pbmpm.Liquid(density=700))
    places = scattered(world.dimension)
    volumes = np.linspace(0.001, 0.002, len(places), dtype=np.float32)
    ids = world.add_particles(water, places, places * 2, volumes)
    rows = world.find(ids)
    assert sorted(rows) == list(range(len(places)))
    np.testing.assert_allclose(world.positions[rows], places, atol=1e-6)
    np.testing.assert_array_equal(world.velocities[rows], places * 2)
    np.testing.assert_allclose(world.masses[rows], volumes * 700, rtol=1e-6)
    np.testing.assert_array_equal(world.ids[rows], ids)
    np.testing.assert_array_equal(world.volume_ratios.array(), 1)
    np.testing.assert_array_equal(world.material_indices.array(), water.index)
    np.testing.assert_array_equal(world.affine_velocities.array(), 0)


def test_matrices_are_row_major(filled: pbmpm.World) -> None:
    n, d = len(filled), filled.dimension
    matrices = np.arange(n * d * d, dtype=np.float32).reshape(n, d, d) / (n * d * d) + np.eye(d, dtype=np.float32)
    ids = filled.ids.copy()
    filled.affine_velocities = matrices
    filled.set(Field.DEFORMATION, matrices, ids)
    rows = filled.find(ids)
    np.testing.assert_allclose(filled.affine_velocities[rows], matrices, rtol=1e-6)
    np.testing.assert_allclose(filled.deformations[rows], matrices, rtol=1e-6)


@pytest.mark.parametrize("by_component", [False, True], ids=["by particle", "by component"])
@pytest.mark.parametrize(
    ("field", "shape"),
    [
        (Field.VELOCITY, (5, 3)),
        (Field.DEFORMATION, (5, 3, 3)),
        (Field.VOLUME_RATIO, (5,)),
        (Field.PARTICLE, (5, 2)),
        (Field.MATERIAL, (5,)),
    ],
)
def test_strides_of_any_storage(field: Field, shape: tuple[int, ...], by_component: bool) -> None:
    dtype = np.uint32 if field in (Field.PARTICLE, Field.MATERIAL) else np.float32
    values = np.arange(np.prod(shape), dtype=dtype).reshape(shape)
    rows = values.reshape(5, -1)
    storage = np.zeros((rows.shape[1], 8) if by_component else (8, rows.shape[1] + 3), dtype)
    window = storage[:, :5].T if by_component else storage[:5, : rows.shape[1]]
    window[:] = rows
    view = ffi.new("pbmpm_view *")
    view.count, view.components = rows.shape
    view.stride, view.component_stride = window.strides
    view.data = ffi.cast("void *", storage.ctypes.data)
    array = views._wrap(storage, field, 3, view)
    assert array.dtype == dtype and array.ctypes.data == storage.ctypes.data
    np.testing.assert_array_equal(array, values)


def test_an_array_is_the_memory_itself(filled: pbmpm.World) -> None:
    first, second = filled.positions.array(), np.asarray(filled.positions)
    assert np.shares_memory(first, second)
    assert first.ctypes.data == second.ctypes.data
    assert first.strides == second.strides


def test_arrays_are_read_only(filled: pbmpm.World) -> None:
    array = filled.positions.array()
    with pytest.raises(ValueError, match="read-only"):
        array[0, 0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        array.flags.writeable = True


@pytest.mark.parametrize(
    "change",
    [
        lambda world: world.step(0.001),
        lambda world: world.remove(world.ids[:1]),
        lambda world: world.remove_in(pbmpm.Sphere([1.0] * world.dimension, 10)),
        lambda world: world.set(Field.VELOCITY, np.zeros(world.velocities.shape)),
        lambda world: world.fill(pbmpm.Sphere([1.0] * world.dimension, 0.2), world.add_material(pbmpm.Liquid())),
    ],
    ids=["step", "remove", "remove_in", "set", "fill"],
)
def test_a_view_expires_with_every_change(filled: pbmpm.World, change) -> None:
    view = filled.positions
    assert not view.expired
    change(filled)
    assert view.expired
    for use in (view.array, view.copy, lambda: view[0], lambda: np.asarray(view)):
        with pytest.raises(pbmpm.ExpiredViewError, match="POSITION has expired"):
            use()
    assert not filled.positions.expired


def test_a_refused_call_expires_nothing(filled: pbmpm.World) -> None:
    view = filled.positions
    with pytest.raises(pbmpm.InvalidArgumentError):
        filled.step(float("nan"))
    assert not view.expired


def test_indexing_gives_copies(filled: pbmpm.World) -> None:
    heights = filled.positions[:, 1]
    before = heights.copy()
    filled.step(0.01)
    np.testing.assert_array_equal(heights, before)
    assert not np.shares_memory(filled.positions[:], filled.positions.array())
    assert isinstance(filled.masses[0], np.float32)


def test_numpy_protocol(filled: pbmpm.World) -> None:
    view = filled.positions
    assert np.asarray(view, np.float64).dtype == np.float64
    assert not np.shares_memory(np.array(view), view.array())
    assert np.mean(view) == pytest.approx(view.array().mean())
    with pytest.raises(ValueError):
        view.__array__(np.float64, copy=False)


def test_a_view_says_where_the_methods_of_an_array_are(filled: pbmpm.World) -> None:
    with pytest.raises(AttributeError, match=r"no attribute 'mean'; array\(\).mean and copy\(\).mean are there"):
        _ = filled.positions.mean
    with pytest.raises(AttributeError, match="no attribute 'means'$"):
        _ = filled.positions.means


def test_views_of_an_empty_world(world: pbmpm.World) -> None:
    assert world.positions.array().shape == (0, world.dimension)
    assert world.ids.array().shape == (0, 2)
    assert len(world.masses) == 0


def test_arrays_outlive_the_world() -> None:
    world = pbmpm.World(2, 0.1, capacity=100, threads=1)
    world.add_particles(world.add_material(pbmpm.Liquid()), [(0.25, 0.5)])
    array, handle = world.positions.array(), weakref.ref(world._handle)
    del world
    gc.collect()
    np.testing.assert_allclose(array, [[0.25, 0.5]])
    part = array[:, 1]
    del array
    gc.collect()
    assert handle() is not None and part[0] == 0.5
    del part
    gc.collect()
    assert handle() is None


def test_closing_with_live_arrays(world: pbmpm.World, water: pbmpm.Material) -> None:
    world.add_particles(water, [[0.5] * world.dimension])
    view, array = world.positions, world.positions.array()
    world.close()
    assert view.expired and array[0, 0] == 0.5
    with pytest.raises(pbmpm.ClosedError):
        view.array()


def test_deformation_needs_an_elastic_material(pool: pbmpm.World) -> None:
    with pytest.raises(pbmpm.UnsupportedError):
        pool.view(Field.DEFORMATION)
