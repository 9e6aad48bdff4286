"""Bad input raises the right exception and changes nothing."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import pbmpm
from generator import parser
from pbmpm import errors
from pbmpm._ffi import ffi

NAN, INF = math.nan, math.inf


def test_every_result_has_its_exception(root: Path) -> None:
    (results,) = (item for item in parser.parse(root / "include").enumerations if item.name == "pbmpm_result")
    failures = [item for item in results.members if item.name.startswith("PBMPM_ERROR_")]
    assert len(failures) == 12
    for item in failures:
        with pytest.raises(pbmpm.PbmpmError) as caught:
            errors.check(item.value)
        assert type(caught.value) is not pbmpm.PbmpmError
        assert (caught.value.result, caught.value.result_name) == (item.value, item.name)
    errors.check(ffi.integer_const("PBMPM_OK"))


def test_a_result_of_a_later_library() -> None:
    with pytest.raises(pbmpm.PbmpmError) as caught:
        errors.check(4711)
    assert caught.value.result == 4711


def test_errors_carry_message_and_result(world: pbmpm.World) -> None:
    with pytest.raises(pbmpm.PbmpmError) as caught:
        world.step(NAN)
    assert caught.value.result_name == "PBMPM_ERROR_INVALID_ARGUMENT"
    assert "dt" in caught.value.message and str(caught.value) == caught.value.message
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize("dt", [0, -1, NAN, INF, 11, 1e300])
def test_bad_time_steps(world: pbmpm.World, dt: float) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.step(dt)
    assert world.stats.step_count == 0


@pytest.mark.parametrize(
    "arguments",
    [
        {"dimension": 4},
        {"cell_size": NAN},
        {"cell_size": 0},
        {"capacity": 0},
        {"capacity": -1},
        {"capacity": 1 << 40},
        {"threads": -1},
        {"domain": ((0, 0, 0), (0.1, 1, 1))},
        {"domain": ((0, 0), (1, 1))},
        {"domain": ((0, 0, 0), (1, 1, 1)), "domain_friction": -1},
        {"gravity": (0, NAN, 0)},
        {"gravity": (0, -9.81)},
        {"origin": (0, 0, INF)},
        {"substeps": 0},
        {"iterations": 0},
        {"iterations": 10_000},
        {"max_displacement": 0},
    ],
    ids=str,
)
def test_bad_worlds(arguments: dict) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError):
        pbmpm.World(**{"dimension": 3, "cell_size": 0.1, "capacity": 100, "threads": 1, **arguments})


def test_a_wrong_type_is_a_type_error(world: pbmpm.World, water: pbmpm.Material) -> None:
    with pytest.raises(TypeError):
        world.step("soon")
    with pytest.raises(TypeError, match="substeps"):
        world.substeps = 1.5
    with pytest.raises(TypeError, match="Plane, Box, Sphere, Capsule or Baked"):
        world.fill((0, 0), water)
    with pytest.raises(TypeError, match="a Material is needed"):
        world.add_particles(water.parameters, [[1.0] * world.dimension])
    with pytest.raises(TypeError, match="a Liquid, Elastic, Sand or Visco is needed"):
        world.add_material("water")


def test_refused_settings_change_nothing(world: pbmpm.World) -> None:
    gravity = world.gravity
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.gravity = [INF] * world.dimension
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.substeps = 1 << 40
    assert world.gravity == gravity and world.substeps == 1


@pytest.mark.parametrize("density", [0, -1, NAN, INF, 1e-9, 1e9])
def test_bad_densities(world: pbmpm.World, density: float) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.add_material(pbmpm.Liquid(density=density))


def good(world: pbmpm.World, count: int = 3) -> np.ndarray:
    return np.full((count, world.dimension), 1.0)


@pytest.mark.parametrize("bad", [NAN, INF, -INF, 1e300])
@pytest.mark.parametrize("name", ["positions", "velocities", "volumes"])
def test_arrays_with_bad_numbers(world: pbmpm.World, water: pbmpm.Material, name: str, bad: float) -> None:
    arrays = {"positions": good(world), "velocities": good(world), "volumes": np.ones(3)}
    arrays[name][1] = bad
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.add_particles(water, **arrays)
    assert len(world) == 0


@pytest.mark.parametrize("volumes", [0, -1.0, NAN, INF])
def test_bad_single_volume(world: pbmpm.World, water: pbmpm.Material, volumes: float) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.add_particles(water, good(world), volumes=volumes)


def test_arrays_of_wrong_shapes_are_named(world: pbmpm.World, water: pbmpm.Material) -> None:
    places, d = good(world), world.dimension
    cases = {
        "positions": {"positions": np.ones((3, d + 1))},
        "positions: an array": {"positions": np.ones(d)},
        "velocities": {"positions": places, "velocities": np.ones((2, d))},
        "volumes": {"positions": places, "volumes": np.ones((3, 1))},
    }
    for complaint, arguments in cases.items():
        with pytest.raises(pbmpm.InvalidArgumentError, match=complaint):
            world.add_particles(water, **arguments)
    with pytest.raises(pbmpm.InvalidArgumentError, match="positions"):
        world.add_particles(water, [["one"] * d])
    assert len(world) == 0


def test_shapes_of_another_dimension_are_named(world: pbmpm.World, water: pbmpm.Material) -> None:
    wrong = [0.5] * (5 - world.dimension)
    with pytest.raises(pbmpm.InvalidArgumentError, match="position"):
        world.fill(pbmpm.Sphere(wrong, 0.1), water)
    with pytest.raises(pbmpm.InvalidArgumentError, match="half_extents"):
        world.query(pbmpm.Box([0.5] * world.dimension, wrong))
    with pytest.raises(pbmpm.InvalidArgumentError, match="rotation"):
        world.add_collider(pbmpm.Box([0.5] * world.dimension, [0.5] * world.dimension, rotation=(0, 0, 1)))


@pytest.mark.parametrize(
    "shape",
    [
        pbmpm.Sphere((1, 1), NAN),
        pbmpm.Sphere((1, INF), 1),
        pbmpm.Sphere((1, 1), -1),
        pbmpm.Box((1, 1), (0, 1)),
        pbmpm.Box((1, 1), (1, 1), rotation=NAN),
        pbmpm.Box((1, 1), (1, 1), rotation=INF),
        pbmpm.Box((1, 1), (1, 1), rotation=(0, 0, 0, 0)),
        pbmpm.Capsule((1, 1), -1, 1),
        pbmpm.Plane((1, 1), (0, 0)),
    ],
    ids=str,
)
def test_bad_colliders(shape: pbmpm.Shape) -> None:
    with pbmpm.World(2, 0.1, capacity=10, threads=1) as world, pytest.raises(pbmpm.InvalidArgumentError):
        world.add_collider(shape)


def test_a_plane_cannot_be_filled(world: pbmpm.World, water: pbmpm.Material) -> None:
    up = [0.0, 1.0, 0.0][: world.dimension]
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.fill(pbmpm.Plane([0.0] * world.dimension, up), water)


def test_no_room(world: pbmpm.World, water: pbmpm.Material) -> None:
    box = pbmpm.Box([1.0] * world.dimension, [0.9] * world.dimension)
    said = "[0-9]{4,} more particles: 0 of 5000 in use; make the world with a capacity of at least [0-9]{4,}"
    with pytest.raises(pbmpm.CapacityError, match=said):
        world.fill(box, water, particles_per_axis=4)
    (event,) = world.events
    assert event.kind is pbmpm.EventKind.CAPACITY and event.count > world.capacity
    with pytest.raises(pbmpm.CapacityError):
        world.add_particles(water, good(world, world.capacity + 1))
    assert len(world) == 0


def test_positions_outside_the_domain(world: pbmpm.World, water: pbmpm.Material) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.add_particles(water, [[3.0] * world.dimension])


def test_made_up_identifiers(pool: pbmpm.World) -> None:
    count = len(pool)
    for call in (pool.remove, pool.find):
        with pytest.raises(pbmpm.InvalidIdError):
            call([(0, 0)])
        with pytest.raises(pbmpm.InvalidIdError):
            call(np.vstack([pool.ids[:1], [(123456, 7)]]))
    assert len(pool) == count


@pytest.mark.parametrize("ids", [[1, 2], [(1, 2, 3)], [(-1, 2)], [(1.0, 2.0)], [(1 << 40, 1)]], ids=str)
def test_malformed_identifiers(world: pbmpm.World, ids: list) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError, match="ids"):
        world.remove(ids)


def test_a_material_of_another_world(pool: pbmpm.World) -> None:
    with pbmpm.World(pool.dimension, 0.1, capacity=10, threads=1) as other:
        foreign = other.add_material(pbmpm.Liquid())
        with pytest.raises(pbmpm.InvalidIdError):
            pool.add_particles(foreign, good(pool))


def test_fields_that_cannot_be_set(pool: pbmpm.World) -> None:
    count = len(pool)
    for field in (pbmpm.Field.MASS, pbmpm.Field.MATERIAL):
        with pytest.raises((pbmpm.InvalidArgumentError, pbmpm.UnsupportedError)):
            pool.set(field, np.ones(count))
    with pytest.raises(pbmpm.InvalidArgumentError):
        pool.velocities = np.full((count, pool.dimension), NAN)
    with pytest.raises(pbmpm.InvalidArgumentError):
        pool.velocities = np.zeros((count + 1, pool.dimension))


def test_seed_out_of_range(world: pbmpm.World, water: pbmpm.Material) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError, match="seed"):
        world.fill(pbmpm.Sphere([1.0] * world.dimension, 0.1), water, seed=-1)
