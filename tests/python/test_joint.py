"""The joint solver, of islands of solids and liquid: what it promises beside tests/python/test_islands.py."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pbmpm

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


@pytest.mark.parametrize(("density", "young_modulus"), [(1000, 2e4), (1100, 1e5), (1500, 2e4), (500, 1e5)])
def test_a_jelly_in_a_glass_comes_to_rest(density: float, young_modulus: float) -> None:
    """After the fall nothing drives it. Without the energy law it began to spin: 1 m/s for ever, by water that was crushed for it to three quarters."""
    with pbmpm.World(2, 0.025, gravity=(0, -G), threads=1, iterations=5, capacity=4000, domain=((-0.25, 0), (0.25, 1))) as world:
        water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=density, young_modulus=young_modulus))
        world.fill(pbmpm.Box((0, 0.225), (0.25, 0.225)), water)
        world.fill(pbmpm.Box((0.02, 0.65), (0.1, 0.1)), jelly)
        for _ in range(300):
            world.step(DT)
        assert rms(world) < 0.03
        room = 2 * np.array(world.positions)[:, 1].mean() * 0.5
        assert 0.9 < room / (0.5 * 0.45 + 0.04) < 1.05
