"""Small rigid bodies in water: which share of Archimedes' lift boxes and balls get that are held under water, and how fast floating balls turn.

`rigid_in_water.py [--iterations N]` prints both by size, at 60 Hz. Boxes are held as they lie on the grid, off it by 0.3 cells, and turned by 0.4 and 0.8 rad.
Balls float with half of water's density; nothing can turn what is round and slips. It takes two minutes.
"""

from __future__ import annotations

import argparse
import math
from statistics import mean

import numpy as np

from pbmpm import Box, Friction, Liquid, RigidBody, Sphere, World

CELL = 0.025
RATE_HZ = 60
GRAVITY = 9.81
HELD = ((0.0, 0.0), (0.0, 0.3), (0.4, 0.3), (0.8, 0.3))
"""Poses: angle [rad] and offset [cells]."""


def tank(dimension: int, width: float, depth: float, air: float, iterations: int) -> World:
    """Empty, as high as `depth` and `air` [m]."""
    high, gravity = [width] * dimension, [0.0] * dimension
    high[1], gravity[1] = depth + air, -GRAVITY
    return World(dimension, CELL, gravity=gravity, domain=([0.0] * dimension, high), iterations=iterations, capacity=1 << 17)


def pour(world: World, width: float, depth: float) -> None:
    """What obstacles leave free."""
    half = [0.5 * width] * world.dimension
    half[1] = 0.5 * depth
    world.fill(Box(half, half), world.add_material(Liquid()))


def pose(dimension: int, angle: float) -> float | tuple[float, ...]:
    """About an axis along no axis of the grid, in 3D."""
    axis = np.array([1.0, 0.3, 0.7]) / math.sqrt(1.58)
    return angle if dimension == 2 else (*(math.sin(0.5 * angle) * axis).tolist(), math.cos(0.5 * angle))


def lift(dimension: int, cells: int, ball: bool, angle: float, off: float, iterations: int) -> float:
    """Over that of Archimedes, in the second second."""
    side, lifts = cells * CELL, []
    width = side + 8 * CELL
    centre = [0.5 * width + off * CELL * share for share in (1.0, 0.7, 0.4)][:dimension]
    volume = side**dimension * ((math.pi / 4 if dimension == 2 else math.pi / 6) if ball else 1.0)
    shape = Sphere(centre, 0.5 * side) if ball else Box(centre, [0.5 * side] * dimension, rotation=pose(dimension, angle))
    with tank(dimension, width, width, 8 * CELL, iterations) as world:
        held = world.add_collider(shape, kinematic=True, measures_impulse=True, friction=Friction.SLIP)
        pour(world, width, width)
        for step in range(2 * RATE_HZ):
            world.step(1 / RATE_HZ)
            if step >= RATE_HZ:
                lifts.append(held.impulse.linear[1] * RATE_HZ)
    return mean(lifts) / (1000 * GRAVITY * volume)


def spin(dimension: int, cells: int, iterations: int) -> float:
    """Mean spin [rad/s] of a ball that was put on the water, from the third to the fifth second."""
    radius, spins = 0.5 * cells * CELL, []
    width, depth = 2 * radius + 10 * CELL, 2 * radius + 6 * CELL
    with tank(dimension, width, depth, 4 * radius, iterations) as world:
        pour(world, width, depth)
        ball = Sphere([0.5 * width, depth + radius, 0.5 * width][:dimension], radius)
        body = RigidBody(world.add_collider(ball, kinematic=True, measures_impulse=True, friction=Friction.SLIP), density=500)
        for step in range(5 * RATE_HZ):
            body.advance(1 / RATE_HZ)
            world.step(1 / RATE_HZ)
            if step >= 2 * RATE_HZ:
                spins.append(float(np.linalg.norm(body.angular_velocity)))
    return mean(spins)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--iterations", type=int, default=5)
    iterations = parser.parse_args().iterations
    print("lift over that of Archimedes\n" + "".join(f"{word:>14}" for word in ("cells", *(f"{angle:g} rad +{off:g}" for angle, off in HELD), "ball", "ball +0.3")))
    for dimension, sizes in ((2, (3, 4, 6, 10)), (3, (3, 4, 6, 8))):
        for cells in sizes:
            boxes = [lift(dimension, cells, False, angle, off, iterations) for angle, off in HELD]
            balls = [lift(dimension, cells, True, 0.0, off, iterations) for off in (0.0, 0.3)]
            print(f"{cells:>11} {dimension}D" + "".join(f"{share:14.3f}" for share in boxes + balls), flush=True)
    print(f"spin of balls [rad/s]\n{'cells':>14}{'spin':>14}")
    for dimension, sizes in ((2, (4, 6, 8, 10, 16, 24)), (3, (4, 6, 8, 10))):
        for cells in sizes:
            print(f"{cells:>11} {dimension}D{spin(dimension, cells, iterations):14.2f}", flush=True)


if __name__ == "__main__":
    main()
