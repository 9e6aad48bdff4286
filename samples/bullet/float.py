"""Boxes of Bullet in a basin of water: the light one floats at its Archimedes depth, the heavy one sinks. See README.md.

The water is two-dimensional, and the boxes are a metre deep: nothing pushes them out of the plane.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass

import numpy as np
import pybullet

import pbmpm

GRAVITY = (0.0, -9.81, 0.0)
WATER = 1000.0  # [kg/m^3]
BASIN = np.array([(-1.5, -1.0), (1.5, 1.5)])  # corners [m]
SURFACE = 0.0  # height of the water before the boxes are in it [m]
DEPTH = 1.0  # of the boxes [m]: masses of a two-dimensional world are per metre
LIGHT, HEAVY = np.array([0.4, 0.24]), np.array([0.2, 0.2])  # half extents; the light one is flat enough to float upright
RATE, SUBSTEPS, ITERATIONS = 120, 4, 20


@dataclass
class Body:
    """A body of Bullet and the obstacle that stands for it in the water."""

    name: str
    density: float
    half: np.ndarray
    number: int
    collider: pbmpm.Collider


def make_basin() -> None:
    """Bullet's walls and floor: planes that look inward."""
    for axis in range(2):
        for corner, sign in zip(BASIN, (1.0, -1.0)):
            normal = np.zeros(3)
            normal[axis] = sign
            plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, planeNormal=normal.tolist())
            pybullet.createMultiBody(0.0, plane, basePosition=[*corner.tolist(), 0.0])


def make_box(
    world: pbmpm.World, name: str, density: float, half: np.ndarray, position: tuple[float, float]
) -> Body:
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[*half.tolist(), DEPTH / 2])
    mass = density * DEPTH * float(np.prod(2 * half))
    number = pybullet.createMultiBody(mass, shape, basePosition=[*position, 0.0])
    pybullet.changeDynamics(number, -1, linearDamping=0.0, angularDamping=0.0)
    collider = world.add_collider(
        pbmpm.Box(position, half), kinematic=True, measures_impulse=True, friction_coefficient=0.0
    )
    return Body(name, density, half, number, collider)


def predict(body: Body, dt: float) -> None:
    """Sends the obstacle where the body's velocity carries it."""
    position, rotation = pybullet.getBasePositionAndOrientation(body.number)
    velocity, spin = pybullet.getBaseVelocity(body.number)
    angle = pybullet.getEulerFromQuaternion(rotation)[2]
    body.collider.move(np.array(position[:2]) + dt * np.array(velocity[:2]), angle + dt * spin[2])


def push(body: Body, dt: float) -> None:
    """Gives Bullet what the water gave to the obstacle."""
    impulse = body.collider.impulse
    position = pybullet.getBasePositionAndOrientation(body.number)[0]
    force = [DEPTH * component / dt for component in impulse.linear]
    pybullet.applyExternalForce(body.number, -1, [*force, 0.0], position, pybullet.WORLD_FRAME)
    pybullet.applyExternalTorque(body.number, -1, [0.0, 0.0, DEPTH * impulse.angular[0] / dt], pybullet.WORLD_FRAME)


def height(body: Body) -> float:
    return float(pybullet.getBasePositionAndOrientation(body.number)[0][1])


def run(seconds: float, cell_size: float) -> tuple[dict[str, float], float, pbmpm.World, list[Body]]:
    """Mean heights over the last half of the time, and the level of the water with what the boxes displace."""
    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(*GRAVITY)
    pybullet.setTimeStep(1 / RATE)
    make_basin()
    world = pbmpm.World(
        2,
        cell_size,
        gravity=GRAVITY[:2],
        domain=(BASIN[0], BASIN[1]),
        solver=pbmpm.Solver.DUAL,
        substeps=SUBSTEPS,
        iterations=ITERATIONS,
    )
    low, high = BASIN[0], np.array([BASIN[1][0], SURFACE])
    water = world.add_material(pbmpm.Liquid(density=WATER))
    world.fill(pbmpm.Box((low + high) / 2, (high - low) / 2), water)
    bodies = [
        make_box(world, "light", 0.5 * WATER, LIGHT, (-0.6, 0.3)),
        make_box(world, "heavy", 2.0 * WATER, HEAVY, (0.7, 0.3)),
    ]
    dt, steps = 1 / RATE, int(seconds * RATE)
    heights: dict[str, list[float]] = {body.name: [] for body in bodies}
    for step in range(steps):
        for body in bodies:
            predict(body, dt)
        world.step(dt)
        for body in bodies:
            push(body, dt)
        pybullet.stepSimulation()
        for body in bodies:
            heights[body.name].append(height(body))
        if sys.stderr.isatty():
            print(f"\r{step + 1}/{steps}", end="", file=sys.stderr)
    displaced = sum(min(body.density / WATER, 1.0) * float(np.prod(2 * body.half)) for body in bodies)
    level = SURFACE + displaced / float((BASIN[1] - BASIN[0])[0])
    return {name: float(np.mean(rows[steps // 2 :])) for name, rows in heights.items()}, level, world, bodies


def picture(path: str, world: pbmpm.World, bodies: list[Body]) -> None:
    """Particles by speed, boxes in outline."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 8))
    place, speed = world.positions.copy(), np.linalg.norm(world.velocities.copy(), axis=1)
    axes.scatter(place[:, 0], place[:, 1], s=4, c=speed, cmap="Blues_r", vmax=2.0)
    for body in bodies:
        position, rotation = pybullet.getBasePositionAndOrientation(body.number)
        turn = np.array(pybullet.getMatrixFromQuaternion(rotation)).reshape(3, 3)[:2, :2]
        around = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]) * body.half
        corners = around @ turn.T + np.array(position[:2])
        axes.fill(corners[:, 0], corners[:, 1], facecolor="lightgrey", edgecolor="black")
        axes.annotate(body.name, position[:2], ha="center")
    axes.set_xlim(BASIN[0][0], BASIN[1][0])
    axes.set_ylim(BASIN[0][1], BASIN[1][1])
    axes.set_aspect("equal")
    figure.savefig(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--cell-size", type=float, default=0.04, help="[m]")
    parser.add_argument("--picture", metavar="FILE", help="write a picture of the end")
    options = parser.parse_args()
    heights, level, world, bodies = run(options.seconds, options.cell_size)
    draught, wanted = level - (heights["light"] - LIGHT[1]), 0.5 * 2 * LIGHT[1]
    floats = abs(draught / wanted - 1) < 0.05
    sinks = heights["heavy"] < BASIN[0][1] + HEAVY[1] + 0.02
    print(f"light box: {draught:.4f} m deep in the water, Archimedes says {wanted:.4f} m ({100 * (draught / wanted - 1):+.1f} %)")
    print(f"heavy box: {'on the ground' if sinks else 'not on the ground'} ({heights['heavy'] - HEAVY[1] - BASIN[0][1]:.3f} m above it)")
    if options.picture:
        picture(options.picture, world, bodies)
    return 0 if floats and sinks else 1


if __name__ == "__main__":
    sys.exit(main())
