"""Cases of violent contact: fast matter against walls, and obstacles that trap, cover or race through matter."""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt

import pbmpm

from ...accuracy.elastic.strain import FIXED_COROTATED, energy_and_stress
from ...accuracy.elastic.theory import Solid
from .case import ELASTIC, PAPER, Check, HardCase, Kind, Setting
from .compatible import balanced_strain, relaxed_strain
from .volume import PRESS_CELL, PRESS_HOLD_SECONDS, PRESS_SPEED, RECOVERED_RATIOS, RECOVERED_SHARE, release_speed
from .watch import ENERGY_ROUNDING, Watch, make_world, vector

# H08

CELL = 0.1  # [m]
BALL_CELLS = 6  # diameter
WALL_HALF_SIZE = 60  # cells
IMPACT_STEPS = 60  # the slowest ball touches after 3 and is spent after 20
WALLS = (2.0, 1.0, 0.2)  # cells
IMPACTS = {f"{speed:g} cells/step, wall of {wall:g} cells": (speed, wall) for wall in WALLS for speed in (0.5, 1, 5, 50)}


def hit_wall(setting: Setting) -> list[Check]:
    """H08: a ball flies into a thin box. It may not be found behind it, nor gain energy."""
    d = setting.dimension
    cells_per_step, wall_cells = IMPACTS[setting.variant]
    speed, thickness = cells_per_step * CELL / setting.dt, wall_cells * CELL
    with make_world(setting, CELL, max_displacement=64.0) as world:
        wall = pbmpm.Box(vector(d, 0.5 * thickness), vector(d, 0.5 * thickness, *[WALL_HALF_SIZE * CELL] * 2))
        collider = world.add_collider(wall)
        ball = pbmpm.Sphere(vector(d, -(0.5 * BALL_CELLS + 1.3) * CELL), 0.5 * BALL_CELLS * CELL)
        material = world.add_material(setting.parameters(CELL))
        world.fill(ball, material, velocity=vector(d, speed), seed=setting.seed)
        watch = Watch(world)
        energy = 0.5 * float(world.masses.array().sum()) * speed**2
        peak, through, inside = 0.0, 0, 0
        for _ in range(IMPACT_STEPS):
            peak = max(peak, watch.step(setting.dt).kinetic_energy / energy)
            positions = world.positions.array()
            opposite = (np.abs(positions[:, 1:]) < WALL_HALF_SIZE * CELL).all(axis=1)
            through = max(through, int((opposite & (positions[:, 0] > 0.5 * thickness)).sum()))
            inside = max(inside, len(collider.query()))
        return [
            Check("particles through the wall", through, 0),
            Check("particles inside the wall", inside, 0),
            Check("highest kinetic energy over the start's", peak, 1.0 + ENERGY_ROUNDING),
            *watch.checks(),
        ]


# H16

TANK_CELL = PRESS_CELL  # for the same reason as there
TANKS = {2: (64, 32, 0), 3: (32, 32, 8)}  # cells
BLOCK = 8 * TANK_CELL  # side length
BALL = 2.5 * TANK_CELL  # radius
OVERLAP = 1.0 * TANK_CELL
CLOSE_SECONDS = 1.0
BOX_WAY = 0.5 * (BLOCK + OVERLAP)
BOX_SPEED = BOX_WAY / CLOSE_SECONDS  # [m/s]
SETTLE_SECONDS = 1.5
FAST_CELLS = 100.0  # cells per step
FAST_STEPS = 20


def _tank_size(setting: Setting) -> list[float]:
    """Length, height and depth of the tank [m]."""
    return [cells * TANK_CELL for cells in TANKS[setting.dimension]]


def _tank(setting: Setting) -> pbmpm.World:
    return make_world(setting, TANK_CELL, gravity=True, size=_tank_size(setting))


def _recovered(ratios: npt.NDArray[np.floating]) -> float:
    return float(((ratios > RECOVERED_RATIOS[0]) & (ratios < RECOVERED_RATIOS[1])).mean())


def _recoverable(world: pbmpm.World, setting: Setting) -> float:
    """The share of particles whose volume motion can bring back. What was pressed to a sheet moves as one: F of its particles, which were not
    pressed alike (strain_min ends it for some before others), goes on to differ by as much. The paper's solver grows until its corrections
    balance, the others until their energy is least: mu |F - R|^2 + lambda/2 (J - 1)^2. Without its second part other particles come back. Liquid has
    feedback for that."""
    if setting.material != ELASTIC:
        return 1.0
    parameters = setting.parameters(TANK_CELL)
    assert isinstance(parameters, pbmpm.Elastic)
    if setting.solver == PAPER:
        return _recovered(np.linalg.det(balanced_strain(world, parameters.rebound_max / parameters.relaxation)))
    solid = Solid(1.0, parameters.poisson_ratio, 1.0, setting.dimension)  # whatever its modulus: its energy alone acts
    return _recovered(np.linalg.det(relaxed_strain(world, functools.partial(energy_and_stress, solid, FIXED_COROTATED))))


def _free_speed(setting: Setting, pushed: float = PRESS_SPEED) -> float:
    """What matter of the tank may reach: the speed bound of the press (H03), with the fall from the tank's top."""
    return release_speed(setting, TANK_CELL, _tank_size(setting)[1], pushed)


def trap(setting: Setting) -> list[Check]:
    """Two boxes close on a block until they overlap, stay as long as the press (H03) does, and vanish.

    What a gap squeezes out while it closes is faster than its walls by its length over its width, without bound, and is not what is judged: while the
    boxes stay, jets fall back.
    """
    d, (length, height, depth) = setting.dimension, _tank_size(setting)
    with _tank(setting) as world:
        centre = vector(d, 0.5 * length, 0.5 * BLOCK, 0.5 * depth)
        material = world.add_material(setting.parameters(TANK_CELL))
        body = vector(d, 0.5 * BLOCK, 0.5 * BLOCK, 0.5 * min(BLOCK, depth))
        world.fill(pbmpm.Box(centre, body), material, seed=setting.seed)
        watch, half = Watch(world), vector(d, BLOCK, height, height)
        offset = 0.5 * BLOCK + half[0]
        boxes = [
            world.add_collider(pbmpm.Box([centre[0] + s * offset, *centre[1:]], half), kinematic=True) for s in (-1, 1)
        ]
        steps = round(CLOSE_SECONDS / setting.dt)
        for step in range(steps):
            for box, side in zip(boxes, (-1, 1), strict=True):
                box.move([centre[0] + side * (offset - BOX_WAY * (step + 1) / steps), *centre[1:]])
            watch.step(setting.dt)
        watch.run(PRESS_HOLD_SECONDS, setting.dt)
        recoverable = _recoverable(world, setting)
        for box in boxes:
            box.destroy()
        watch.forget()
        watch.run(10 * setting.dt, setting.dt)
        fastest = watch.fastest
        shares = []
        for _ in range(round(SETTLE_SECONDS / setting.dt)):
            watch.step(setting.dt)
            shares.append(_recovered(world.volume_ratios.array()))
        # The median: the released liquid comes back from the tank's walls as a wave, which compresses it for a moment.
        share = float(np.median(shares[len(shares) // 2 :]))
        limit = math.hypot(_free_speed(setting, BOX_SPEED), setting.stored_speed(TANK_CELL))  # it was pressed flat
        return [
            Check("speed in the first 10 steps of release [m/s]", fastest, limit),
            Check(
                f"share of particles with J in [0.8, 1.2] ({recoverable:.3g} can be there)",
                share,
                RECOVERED_SHARE * recoverable,
                at_least=True,
                kind=Kind.GOAL,
            ),
            *watch.checks(),
        ]


def _pool(world: pbmpm.World, setting: Setting) -> Watch:
    length, _, depth = _tank_size(setting)
    half = vector(setting.dimension, 0.5 * length, 0.5 * BLOCK, 0.5 * depth)
    world.fill(pbmpm.Box(half, half), world.add_material(setting.parameters(TANK_CELL)), seed=setting.seed)
    return Watch(world)


def cover(setting: Setting) -> list[Check]:
    """A ball appears inside the matter: that leaves it without a burst."""
    d, (length, _, depth) = setting.dimension, _tank_size(setting)
    with _tank(setting) as world:
        watch = _pool(world, setting)
        watch.run(0.5, setting.dt)
        ball = world.add_collider(pbmpm.Sphere(vector(d, 0.5 * length, 0.5 * BLOCK, 0.5 * depth), BALL))
        watch.forget()
        watch.run(1.0, setting.dt)
        return [
            Check("highest speed [m/s]", watch.fastest, _free_speed(setting)),
            Check("particles left inside", len(ball.query()), 0),
            *watch.checks(),
        ]


def race(setting: Setting) -> list[Check]:
    """A ball goes to and fro at 100 cells per step through the matter."""
    d = setting.dimension
    with _tank(setting) as world:
        watch = _pool(world, setting)
        place = vector(d, 0.0, 0.5 * BLOCK, 0.5 * _tank_size(setting)[2])
        ball = world.add_collider(pbmpm.Sphere(place, BALL), kinematic=True)
        for step in range(FAST_STEPS):
            ball.move([(FAST_CELLS * TANK_CELL if step % 2 == 0 else 0.0), *place[1:]])
            watch.step(setting.dt)
        ball.destroy()
        watch.run(SETTLE_SECONDS, setting.dt)
        return watch.checks()


def refuse(setting: Setting) -> list[Check]:
    """Obstacles without size, turned inside out, or without direction are refused."""
    d, accepted = setting.dimension, 0
    shapes = (
        pbmpm.Box([0.0] * d, [0.0] * d),
        pbmpm.Box([0.0] * d, [-1.0] * d),
        pbmpm.Sphere([0.0] * d, 0.0),
        pbmpm.Sphere([0.0] * d, -1.0),
        pbmpm.Capsule([0.0] * d, -1.0, 1.0),
        pbmpm.Plane([0.0] * d, [0.0] * d),
        pbmpm.Box([0.0] * d, [1.0] * d, rotation=(0.0, 0.0, 0.0, 0.0)),
    )
    with _tank(setting) as world:
        watch = _pool(world, setting)
        for shape in shapes:
            try:
                world.add_collider(shape)
            except (pbmpm.PbmpmError, ValueError):
                continue
            accepted += 1
        watch.step(setting.dt)
        return [Check("impossible obstacles accepted", accepted, 0), *watch.checks()]


IMPOSSIBLE = "impossible shapes"
OBSTACLES = {"trapped between boxes": trap, "ball appears": cover, "100 cells/step": race, IMPOSSIBLE: refuse}


def obstacles(setting: Setting) -> list[Check]:
    """H16."""
    return OBSTACLES[setting.variant](setting)


CASES = (
    HardCase(
        "H08",
        "Impact on thin walls at up to 50 cells per step",
        "high-speed scenes of rigid-body engines and of incremental potential contact",
        "nothing through or inside the wall, kinetic energy never above the start's",
        hit_wall,
        variants=tuple(IMPACTS),
    ),
    HardCase(
        "H16",
        "Obstacles that trap, appear, race, or cannot be",
        "C. Lewin, A Position Based Material Point Method, 2024, section 1",
        "finite, nothing lost or outside; no burst when released; impossible obstacles refused",
        obstacles,
        variants=tuple(OBSTACLES),
        fixed_variants=(IMPOSSIBLE,),  # they are refused whatever the steps are
    ),
)
