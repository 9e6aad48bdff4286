"""Walls hold viscous liquids: plates that liquid slides between, at any angle, with the default friction; slip walls and water are not held."""

from __future__ import annotations

import math

import numpy as np
import pytest

import pbmpm
from pbmpm import Box, Friction, Plane, Solver

CELL, GAP, SPEED = 0.05, 8, 1.0  # [m], cells between the plates, [m/s]


def slide(dimension: int, degrees: float, nu: float, seconds: float, **options: object) -> tuple[float, float]:
    """Liquid that starts evenly along two plates: the share of its speed that is left, and what the plates say that they gave over what it lost."""
    settings = {"solver": Solver.CONVERGENT, "rate": 60, "iterations": 5, **options}
    angle, zeros = math.radians(degrees), [0.0] * (dimension - 2)
    along, up = (np.array([*vector, *zeros]) for vector in ((math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))))
    with pbmpm.World(dimension, CELL, gravity=tuple(-9.81 * up), solver=settings["solver"], iterations=settings["iterations"], capacity=40_000, threads=1) as world:
        kind = {"friction": settings["friction"]} if "friction" in settings else {}
        plates = [world.add_collider(Plane(side * 0.5 * GAP * CELL * up, -side * up), measures_impulse=True, **kind) for side in (-1, 1)]
        liquid = world.add_material(pbmpm.Liquid(kinematic_viscosity=nu))
        half = [(24 if dimension == 2 else 14) * CELL, 0.5 * GAP * CELL, *[3 * CELL] * (dimension - 2)]
        reach = 1.5 * (half[0] + half[1])
        spots = np.stack(np.meshgrid(*[np.arange(-size, size, CELL / 2) + CELL / 4 for size in [reach, reach, *half[2:]]], indexing="ij"), -1).reshape(-1, dimension)
        spots = spots[(abs(spots @ along) < half[0]) & (abs(spots @ up) < half[1])]
        world.add_particles(liquid, spots, velocities=np.tile(SPEED * along, (len(spots), 1)))
        first, given = np.asarray(world.stats.momentum)[:dimension] @ along, 0.0
        for _ in range(round(seconds * settings["rate"])):
            world.step(1 / settings["rate"])
            given += sum(np.asarray(plate.impulse.linear)[:dimension] @ along for plate in plates)
        left = np.asarray(world.stats.momentum)[:dimension] @ along
    return left / first, given / (first - left)


def left_between_plates(nu: float, seconds: float) -> float:
    """Of the mean speed, by the series of J. Fourier for plates without slip."""
    decay = math.pi**2 * nu * seconds / (GAP * CELL) ** 2
    return sum(8 / (math.pi * n) ** 2 * math.exp(-n * n * decay) for n in range(1, 40, 2))


@pytest.mark.parametrize(("dimension", "degrees"), [(2, 0), (2, 30), (2, 45), (3, 0), (3, 20)])
def test_plates_hold_viscous_liquid(dimension: int, degrees: float) -> None:
    """Within 0.05: what lies within half a cell of a plate moves as what lies before it, so a gap of eight cells is about a quarter of a cell too wide. What the plates
    gave is what the liquid lost, as sums of floats."""
    left, given = slide(dimension, degrees, 0.1, 0.2)
    assert left == pytest.approx(left_between_plates(0.1, 0.2), abs=0.05)
    assert given == pytest.approx(1.0, abs=1e-4)


def test_slip_walls_and_water_are_not_held() -> None:
    """Slip walls give nothing, to single precision. Water would lose 1 % here in a layer that is a hundredth of a cell thick: the grid's share of it is less."""
    assert slide(2, 0, 0.1, 0.2, friction=Friction.SLIP)[0] == pytest.approx(1.0, abs=1e-4)
    assert 0.99 < slide(2, 30, 1e-6, 0.2)[0] < 1.0


@pytest.mark.parametrize(("solver", "rate", "iterations"), [(Solver.DUAL, 240, 2), (Solver.CONVERGENT, 30, 10)])
def test_whatever_the_solver_and_the_rate(solver: Solver, rate: int, iterations: int) -> None:
    left, given = slide(2, 20, 0.1, 0.2, solver=solver, rate=rate, iterations=iterations)
    assert left == pytest.approx(left_between_plates(0.1, 0.2), abs=0.05)
    assert given == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("threads", [1, 3])
def test_walls_that_move_take_it_along(threads: int) -> None:
    """The same flow, seen by somebody who goes with the liquid: what it has of the plates' speed is what it lost between plates at rest."""
    with pbmpm.World(2, CELL, gravity=(0, -9.81), iterations=5, capacity=10_000, threads=threads) as world:
        centres = [np.array([0.0, side * (0.5 * GAP * CELL + 0.5)]) for side in (-1, 1)]
        plates = [world.add_collider(Box(centre, (9.0, 0.5)), kinematic=True) for centre in centres]
        world.fill(Box((0, 0), (24 * CELL, 0.5 * GAP * CELL)), world.add_material(pbmpm.Liquid(kinematic_viscosity=0.1)))
        for step in range(1, 13):
            for plate, centre in zip(plates, centres):
                plate.move(centre + (SPEED * step / 60, 0.0))
            world.step(1 / 60)
        gained = world.stats.momentum[0] / (world.stats.mass * SPEED)
    assert gained == pytest.approx(1.0 - slide(2, 0, 0.1, 0.2)[0], abs=0.01)


@pytest.mark.parametrize("friction", list(Friction))
@pytest.mark.parametrize("nu", [0.1, 20.0])
def test_rigid_bodies_yield_to_what_is_viscous(nu: float, friction: Friction) -> None:
    """A body that moves in a full tank of tar is stopped, and is not thrown back: it yields to viscosity within each stage, however light it is."""
    side = 32 * CELL
    with pbmpm.World(2, CELL, gravity=(0, 0), domain=((0, 0), (side, side)), iterations=5, capacity=10_000, threads=1) as world:
        tar, middle, half = world.add_material(pbmpm.Liquid(kinematic_viscosity=nu)), side / 2, 4 * CELL
        for y in (0.5 * (middle - half), side - 0.5 * (middle - half)):
            world.fill(Box((middle, y), (middle, 0.5 * (middle - half))), tar)
        for x in (0.5 * (middle - half), side - 0.5 * (middle - half)):
            world.fill(Box((x, middle), (0.5 * (middle - half), half)), tar)
        collider = world.add_collider(Box((middle, middle), (half, half)), kinematic=True, measures_impulse=True, friction=friction)
        body = pbmpm.RigidBody(collider, density=100)
        body.velocity = (0.0, SPEED / 2)
        speeds = []
        for _ in range(20):
            body.advance(1 / 60)
            world.step(1 / 60)
            speeds.append(body.velocity[1])
    assert speeds[0] == SPEED / 2 and abs(speeds[-1]) < 0.1 * SPEED
    assert min(speeds) > -0.1 * SPEED
