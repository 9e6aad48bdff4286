"""Worlds from Python: life, settings, matter, obstacles, the step and what it tells."""

from __future__ import annotations

import dataclasses
import gc
import threading
import weakref
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

import pbmpm
from generator import parser
from pbmpm._ffi import ffi
from pbmpm.materials import Parameters
from pbmpm.settings import WorldSettings


def test_defaults_are_those_of_the_library() -> None:
    with pbmpm.World() as world:
        assert (world.dimension, world.cell_size, world.capacity) == (3, 0.1, 65536)
        assert (world.substeps, world.iterations, world.max_displacement) == (1, 5, 32)
        assert world.gravity == (0, 0, 0) and world.domain is None and world.origin == (0, 0, 0)
        assert world.memory_budget == 0 and len(world) == 0


def test_what_a_world_is_made_of() -> None:
    domain = ((-1.0, 0.0), (3.0, 2.0))
    with pbmpm.World(
        2, 0.05, capacity=77, domain=domain, domain_friction=0.3, origin=(1e6, -5.0), memory_budget=1 << 28, threads=2
    ) as world:
        assert (world.dimension, world.cell_size, world.capacity, world.threads) == (2, 0.05, 77, 2)
        assert world.domain == domain and world.domain_friction == 0.3
        assert world.origin == (1e6, -5.0) and world.memory_budget == 1 << 28


def test_settings_may_change_at_any_time(world: pbmpm.World) -> None:
    world.substeps, world.iterations, world.max_displacement = 3, 7, 2.5
    world.gravity = [0.5] * world.dimension
    assert (world.substeps, world.iterations, world.max_displacement) == (3, 7, 2.5)
    assert world.gravity == (0.5,) * world.dimension


def test_the_solver_may_change_at_any_time(pool: pbmpm.World) -> None:
    assert (pool.pressure, pool.integrator) == (pbmpm.Pressure.PARTICLES, pbmpm.Integrator.EULER)  # for the solver see test_defaults.py
    assert (pool.flip, pool.target_error, pool.time_budget_ms) == (0, 0, 0)
    pool.solver, pool.pressure, pool.integrator = pbmpm.Solver.DUAL, pbmpm.Pressure.CELLS, pbmpm.Integrator.BDF2
    pool.flip, pool.target_error, pool.time_budget_ms = 0.9, 0.01, 2.5
    assert (pool.solver, pool.pressure, pool.integrator) == (
        pbmpm.Solver.DUAL,
        pbmpm.Pressure.CELLS,
        pbmpm.Integrator.BDF2,
    )
    assert (pool.flip, pool.target_error, pool.time_budget_ms) == (0.9, 0.01, 2.5)
    with pytest.raises(pbmpm.InvalidArgumentError):
        pool.flip = 1.5
    with pytest.raises(ValueError):
        pool.solver = 7  # type: ignore[assignment]
    assert pool.flip == 0.9 and pool.solver is pbmpm.Solver.DUAL


def test_settings_given_to_the_constructor() -> None:
    with pbmpm.World(2, 0.1, capacity=10, solver=pbmpm.Solver.PRIMAL, integrator=pbmpm.Integrator.BDF2, flip=0.5) as world:
        assert (world.solver, world.integrator, world.flip) == (pbmpm.Solver.PRIMAL, pbmpm.Integrator.BDF2, 0.5)


def test_settings_have_every_field_of_the_header(root: Path) -> None:
    structures = {item.name: item for item in parser.parse(root / "include").structures}
    header = {field.name for field in structures["pbmpm_settings"].fields} - {"size"}
    assert header == {name for name in vars(WorldSettings) if isinstance(vars(WorldSettings)[name], property)}


def test_context_manager_closes() -> None:
    with pbmpm.World(2, 0.1, capacity=10) as world:
        handle = weakref.ref(world._handle)
        assert not world.closed
    assert world.closed and handle() is None
    world.close()
    with pytest.raises(pbmpm.ClosedError):
        world.step(0.01)
    assert repr(world) == "<pbmpm.World, closed>"


def test_an_error_in_the_body_goes_through() -> None:
    with pytest.raises(KeyError), pbmpm.World(2, 0.1, capacity=10) as world:
        raise KeyError
    assert world.closed


def test_a_forgotten_world_is_destroyed() -> None:
    world = pbmpm.World(2, 0.1, capacity=10)
    handle = weakref.ref(world._handle)
    del world
    gc.collect()
    assert handle() is None


def test_closed_and_forgotten_worlds_make_room_for_others() -> None:
    for _ in range(ffi.integer_const("PBMPM_MAX_WORLDS")):
        pbmpm.World(2, 0.1, capacity=1, threads=1).close()
        pbmpm.World(2, 0.1, capacity=1, threads=1)


@pytest.mark.parametrize("parameters", [pbmpm.Liquid(500, viscosity=0.25), pbmpm.Elastic(2000, elasticity_ratio=0.5)])
def test_materials(world: pbmpm.World, parameters: pbmpm.Liquid | pbmpm.Elastic) -> None:
    material = world.add_material(parameters)
    assert material.parameters == parameters
    changed = dataclasses.replace(parameters, relaxation=1.25)
    material.parameters = changed
    assert material.parameters == changed
    material.destroy()
    with pytest.raises(pbmpm.InvalidIdError):
        material.destroy()


def test_strain_policy(world: pbmpm.World) -> None:
    parameters = pbmpm.Elastic(strain_policy=pbmpm.StrainPolicy.DELETE, condition_max=100)
    assert world.add_material(parameters).parameters == parameters


def test_the_kind_of_a_material_cannot_change(water: pbmpm.Material) -> None:
    with pytest.raises(pbmpm.PbmpmError):
        water.parameters = pbmpm.Elastic()


def test_effective_modulus_of_the_papers_solver(world: pbmpm.World) -> None:
    """density w N dx^2 / (4 d dt^2) for a liquid, density w N dx^2 / (4 dt^2) for an elastic body; dt is a substep's."""
    world.iterations, world.substeps, world.solver = 10, 2, pbmpm.Solver.PAPER
    young = 900 * 1.2 * 10 * 0.1**2 / (4 * 0.01**2)
    water = world.add_material(pbmpm.Liquid(density=900, relaxation=1.2, viscosity=0.25)).effective(0.02)
    jelly = world.add_material(pbmpm.Elastic(density=900, relaxation=1.2)).effective(0.02)
    assert water.bulk_modulus == pytest.approx(young / world.dimension, rel=1e-5)
    assert water.young_modulus == 0 and jelly.young_modulus == pytest.approx(young, rel=1e-5)
    assert water.kinematic_viscosity == pytest.approx(10 * 0.25 * 0.1**2 / (8 * 0.01), rel=1e-5)
    assert jelly.bulk_modulus == pytest.approx(young / {2: 2, 3: 3}[world.dimension], rel=1e-5)


def test_the_papers_solver_stands_for_a_kinematic_viscosity(dimension: int) -> None:
    """nu = N share dx^2 / (8 dt), so a nu and its share move bit for bit the same (all numbers are powers of two); a share
    is at most 1."""
    dt, share, nu = 2**-6, 0.25, 4 * 0.25 * 2**-6 / (8 * 2**-6)

    def run(liquid: pbmpm.Liquid) -> int:
        with pbmpm.World(dimension, 0.125, capacity=20_000, iterations=4, solver=pbmpm.Solver.PAPER, threads=1) as world:
            world.fill(pbmpm.Sphere([0.0] * dimension, 0.5), world.add_material(liquid))
            world.velocities = world.positions.copy()[:, ::-1]
            for _ in range(5):
                world.step(dt)
            return world.hash()

    thick = run(pbmpm.Liquid(kinematic_viscosity=nu))
    assert thick == run(pbmpm.Liquid(viscosity=share)) != run(pbmpm.Liquid())
    with pbmpm.World(dimension, 0.125, iterations=4, solver=pbmpm.Solver.PAPER) as world:
        syrup = world.add_material(pbmpm.Liquid(viscosity=0.5, kinematic_viscosity=1e3)).effective(dt)
    assert syrup.kinematic_viscosity == nu / share


def test_effective_modulus_of_other_solvers_is_the_materials_own(world: pbmpm.World) -> None:
    """The wave of pressure in a liquid runs at sqrt(K / rho)."""
    world.solver = pbmpm.Solver.EXPLICIT
    soft = world.add_material(pbmpm.Liquid(bulk_modulus=4e5, kinematic_viscosity=1e-3)).effective(0.002)
    assert (soft.bulk_modulus, soft.kinematic_viscosity) == (4e5, 1e-3)
    assert soft.courant == pytest.approx((4e5 / 1000) ** 0.5 * 0.002 / 0.1, rel=1e-5)
    stiff = world.add_material(pbmpm.Liquid()).effective(0.002)
    assert (stiff.bulk_modulus, stiff.courant) == (0, 0)
    assert world.add_material(pbmpm.Elastic(young_modulus=2e6)).effective(0.002).young_modulus == 2e6
    with pytest.raises(pbmpm.InvalidArgumentError):
        world.add_material(pbmpm.Liquid()).effective(0.0)


def test_a_material_in_use_stays(pool: pbmpm.World, water: pbmpm.Material) -> None:
    with pytest.raises(pbmpm.InUseError):
        water.destroy()
    pool.remove(pool.ids.copy())
    water.destroy()


def test_fill_counts(world: pbmpm.World, water: pbmpm.Material) -> None:
    box = pbmpm.Box([1.0] * world.dimension, [0.2] * world.dimension)
    added = world.fill(box, water, particles_per_axis=2, jitter=0.0)
    assert added == len(world) == 8**world.dimension
    assert np.abs(world.positions.array() - 1).max() <= 0.2 + 1e-6


def test_a_collider_leaves_a_place_out_of_a_fill(world: pbmpm.World, water: pbmpm.Material) -> None:
    """What is there already does not. On a lattice without jitter the fill has a hole of exactly the body's places."""
    d = world.dimension
    pool, body = pbmpm.Box([1.0] * d, [0.3] * d), pbmpm.Box([1.0] * d, [0.1] * d)
    jelly = world.add_material(pbmpm.Elastic())
    in_body = world.fill(body, jelly, jitter=0)
    assert world.fill(pool, water, jitter=0) == 12**d
    assert pbmpm.AdviceCode.OVERLAPS in {item.code for item in world.advice(1 / 60)}
    world.remove(world.ids.copy())
    hole = world.add_collider(body)
    assert world.fill(pool, water, jitter=0) == 12**d - in_body
    hole.destroy()
    assert world.fill(body, jelly, jitter=0) == in_body
    assert world.remove_in(body) == in_body
    assert world.fill(body, jelly, jitter=0) == in_body
    assert pbmpm.AdviceCode.OVERLAPS not in {item.code for item in world.advice(1 / 60)}


def test_equal_seeds_fill_equally(world: pbmpm.World, water: pbmpm.Material) -> None:
    hashes = []
    for seed in (9, 9, 10):
        world.fill(pbmpm.Sphere([1.0] * world.dimension, 0.2), water, seed=seed)
        hashes.append(world.hash())
        world.remove(world.ids.copy())
    assert hashes[0] == hashes[1] != hashes[2]


def test_fill_velocity_is_that_of_every_particle(world: pbmpm.World, water: pbmpm.Material) -> None:
    velocity = [1.0, 2.0, 3.0][: world.dimension]
    world.fill(pbmpm.Sphere([1.0] * world.dimension, 0.2), water, velocity=velocity)
    np.testing.assert_array_equal(world.velocities.array(), np.broadcast_to(velocity, world.velocities.shape))


def test_remove_find_and_query(world: pbmpm.World, water: pbmpm.Material) -> None:
    places = np.full((4, world.dimension), 0.5) + np.arange(4)[:, None] * 0.3
    ids = world.add_particles(water, places)
    inside = world.query(pbmpm.Sphere(places[2], 0.1))
    np.testing.assert_array_equal(inside, ids[2:3])
    world.remove(inside)
    assert len(world) == 3
    with pytest.raises(pbmpm.InvalidIdError):
        world.find(inside)
    assert world.remove_in(pbmpm.Box(places[0], [0.1] * world.dimension)) == 1
    assert sorted(map(tuple, world.ids[:])) == sorted(map(tuple, ids[[1, 3]]))


def test_adding_and_removing_nothing(world: pbmpm.World, water: pbmpm.Material) -> None:
    assert world.add_particles(water, np.empty((0, world.dimension))).shape == (0, 2)
    world.remove([])
    assert world.find([]).shape == (0,)
    assert world.query(pbmpm.Sphere([1.0] * world.dimension, 1)).shape == (0, 2)


def test_setting_some_particles(pool: pbmpm.World) -> None:
    ids = pool.ids[3:5]
    values = np.full((2, pool.dimension), 0.25)
    pool.set(pbmpm.Field.VELOCITY, values, ids)
    speeds = pool.velocities[:]
    assert np.count_nonzero(speeds) == values.size
    np.testing.assert_array_equal(speeds[pool.find(ids)], values)


def test_setters_take_all_particles(pool: pbmpm.World) -> None:
    places = pool.positions[:] + np.float32(0.1)
    ids = pool.ids[:]
    pool.positions = places
    np.testing.assert_allclose(pool.positions[pool.find(ids)], places, atol=1e-6)
    pool.velocities = np.ones_like(places)
    np.testing.assert_array_equal(pool.velocities[:], 1)


def test_matter_falls(pool: pbmpm.World) -> None:
    before = pool.positions[:, 1].mean()
    for _ in range(10):
        pool.step(0.01)
    fallen = before - pool.positions[:, 1].mean()
    assert fallen == pytest.approx(10 * 0.1**2 / 2, rel=0.15)
    np.testing.assert_allclose(pool.velocities[:, 1].mean(), -1, rtol=0.01)


def test_identifiers_stay_with_their_particles(pool: pbmpm.World) -> None:
    ids = pool.ids[:]
    indices = pool.positions[pool.find(ids)][:, 0]
    pool.step(1e-4)
    np.testing.assert_allclose(pool.positions[pool.find(ids)][:, 0], indices, atol=1e-3)


@pytest.mark.parametrize(
    "shape",
    [
        pbmpm.Plane((0.5, 0.1), (0.0, 2.0)),
        pbmpm.Box((0.5, 0.25), (0.25, 0.5), rotation=0.5),
        pbmpm.Sphere((0.5, 0.5), 0.125),
        pbmpm.Capsule((0.5, 0.25), 0.25, 0.125, rotation=(0, 0, 0, 1)),
    ],
    ids=lambda shape: type(shape).__name__,
)
def test_collider_shapes_come_back(shape: pbmpm.Shape) -> None:
    with pbmpm.World(2, 0.1, capacity=10) as world:
        collider = world.add_collider(shape, friction=pbmpm.Friction.STICK, friction_coefficient=0.5)
        assert collider.friction is pbmpm.Friction.STICK
        assert collider.friction_coefficient == 0.5 and not collider.kinematic
        found = collider.shape
        assert type(found) is type(shape)
        for item in dataclasses.fields(shape):
            if item.name not in ("rotation", "normal"):
                assert getattr(found, item.name) == pytest.approx(getattr(shape, item.name))


def test_an_angle_becomes_a_quaternion() -> None:
    with pbmpm.World(2, 0.1, capacity=10) as world:
        collider = world.add_collider(pbmpm.Box((0, 0), (1, 1), rotation=np.pi / 2))
        assert collider.shape.rotation == pytest.approx((0, 0, np.sqrt(0.5), np.sqrt(0.5)))


def test_collider_moves(pool: pbmpm.World) -> None:
    start, end = [1.0] * pool.dimension, [1.25] * pool.dimension
    collider = pool.add_collider(pbmpm.Sphere([5.0] * pool.dimension, 0.1), kinematic=True)
    assert collider.kinematic and len(collider.query()) == 0
    collider.teleport(start)
    assert collider.shape.position == pytest.approx(start)
    assert len(collider.query()) > 0
    collider.move(end, rotation=(0, 0, 0, 1))
    pool.step(0.01)
    assert collider.shape.position == pytest.approx(end)
    collider.destroy()
    with pytest.raises(pbmpm.InvalidIdError):
        collider.query()


def test_a_static_collider_cannot_move(world: pbmpm.World) -> None:
    collider = world.add_collider(pbmpm.Sphere([1.0] * world.dimension, 0.1))
    with pytest.raises(pbmpm.InvalidArgumentError):
        collider.move([1.5] * world.dimension)


def test_statistics_have_every_field_of_the_header(root: Path) -> None:
    structures = {item.name: item for item in parser.parse(root / "include").structures}
    for name, mirror in (("pbmpm_stats", pbmpm.Stats), ("pbmpm_event", pbmpm.Event)):
        header = [field.name for field in structures[name].fields if field.name != "size"]
        assert sorted(header) == sorted(field.name for field in dataclasses.fields(mirror))


def test_enumerations_have_every_member_of_the_header(root: Path) -> None:
    enumerations = {item.name: item for item in parser.parse(root / "include").enumerations}
    mirrors = {
        "pbmpm_field": pbmpm.Field,
        "pbmpm_friction": pbmpm.Friction,
        "pbmpm_strain_policy": pbmpm.StrainPolicy,
        "pbmpm_event_kind": pbmpm.EventKind,
        "pbmpm_solver": pbmpm.Solver,
        "pbmpm_pressure": pbmpm.Pressure,
        "pbmpm_integrator": pbmpm.Integrator,
        "pbmpm_stop": pbmpm.Stop,
        "pbmpm_elastic_model": pbmpm.ElasticModel,
    }
    for name, mirror in mirrors.items():
        members = enumerations[name].members[:-1]  # the last one only sets the width
        assert sorted(item.value for item in members) == sorted(item.value for item in mirror)


def test_materials_have_every_field_of_the_header(root: Path) -> None:
    structures = {item.name: item for item in parser.parse(root / "include").structures}
    header = {field.name for field in structures["pbmpm_material_def"].fields} - {"size", "kind", "key", "user_data", "reserved"}
    assert header == {field.name for kind in get_args(Parameters) for field in dataclasses.fields(kind)}


def test_statistics(pool: pbmpm.World) -> None:
    assert pool.stats.particle_count == len(pool) and pool.stats.step_count == 0
    pool.step(0.01)
    stats = pool.stats
    assert stats.step_count == 1 and stats.simulated_seconds == pytest.approx(0.01)
    assert stats.mass == pytest.approx(pool.masses.array().sum(dtype=np.float64), rel=1e-6)
    assert len(stats.momentum) == 3 and stats.momentum[1] == pytest.approx(-0.1 * stats.mass, rel=0.01)
    assert stats.max_speed == pytest.approx(0.1, rel=0.05)


def test_pressures_of_the_dual_solver(pool: pbmpm.World) -> None:
    """A block of 0.4 m under the pressure of its own weight: none at the top, rho g h at the floor."""
    with pytest.raises(pbmpm.UnsupportedError, match="dual"):
        pool.pressures.array()
    pool.positions = pool.positions.array() - np.array([0.0, 0.8, 0.0][: pool.dimension])
    pool.solver, pool.iterations = pbmpm.Solver.DUAL, 100
    for _ in range(2):
        pool.step(0.002)
    heights, pressures = pool.positions.array()[:, 1], pool.pressures.array()
    assert pressures.min() >= 0
    assert pressures[heights > 0.35].mean() < pressures[heights < 0.05].mean() <= 1.2 * 1000 * 10 * 0.4
    pool.set(pbmpm.Field.PRESSURE, np.full(len(pool), 50.0))
    np.testing.assert_array_equal(pool.pressures.array(), 50.0)


def test_slowing_a_particle_is_told(world: pbmpm.World, water: pbmpm.Material) -> None:
    world.max_displacement = 1
    sideways = [1e4] + [0.0] * (world.dimension - 1)
    ids = world.add_particles(water, [[1.0] * world.dimension], velocities=[sideways])
    world.step(0.01)
    event = next(item for item in world.events if item.kind is pbmpm.EventKind.SPEED_CLAMPED)
    assert event.count == 1 and event.particle == tuple(ids[0])
    assert len(event.position) == world.dimension
    assert world.stats.clamped_total >= 1 and world.events_missed == 0


def test_hash_tells_states_apart(pool: pbmpm.World) -> None:
    first = pool.hash()
    assert pool.hash() == first
    pool.step(0.01)
    assert pool.hash() != first


def test_equal_calls_give_equal_hashes() -> None:
    hashes = set()
    for threads in (1, 2):
        with pbmpm.World(2, 0.1, capacity=1000, gravity=(0, -10), domain=((0, 0), (2, 2)), threads=threads) as world:
            world.fill(pbmpm.Box((1, 1), (0.3, 0.3)), world.add_material(pbmpm.Liquid()))
            for _ in range(20):
                world.step(0.01)
            hashes.add(world.hash())
    assert len(hashes) == 1


def test_worlds_step_at_the_same_time() -> None:
    worlds = [pbmpm.World(2, 0.1, capacity=1000, gravity=(0, -10), threads=1) for _ in range(2)]
    for world in worlds:
        world.fill(pbmpm.Box((1, 1), (0.3, 0.3)), world.add_material(pbmpm.Liquid()))

    def run(world: pbmpm.World) -> None:
        for _ in range(50):
            world.step(0.01)

    workers = [threading.Thread(target=run, args=(world,)) for world in worlds]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert [world.stats.step_count for world in worlds] == [50, 50]
    assert worlds[0].hash() == worlds[1].hash()
