"""Cases of changing steps and far places: frame hitches, alternating rates, huge coordinates and denormal numbers."""

from __future__ import annotations

import math

import numpy as np

import pbmpm

from .case import Check, HardCase, Setting
from .watch import Watch, make_world, vector

CELL = 0.125  # [m], a power of two: whole cells are exact in single precision
BALL_CELLS = 6  # diameter

# H10

VELOCITY = (1.3, 0.4, 0.2)  # [m/s]
VELOCITY_ERROR = 1e-5  # relative
PLAIN, SLOW, FAST, LOW, HIGH = 1 / 60, 10 / 60, 0.1 / 60, 1 / 30, 1 / 240
SEQUENCES: dict[str, list[float]] = {
    "dt x 10": [PLAIN] * 20 + [SLOW] * 20 + [PLAIN] * 20,
    "dt / 10": [PLAIN] * 20 + [FAST] * 20 + [PLAIN] * 20,
    "alternating 1/30 and 1/240 s": [LOW, HIGH] * 60,
    "one step of 1 s": [PLAIN] * 10 + [1.0] + [PLAIN] * 10,
}
REFUSED_STEPS = (0.0, -0.01, math.nan, math.inf, 1e9)


def change_rate(setting: Setting) -> list[Check]:
    """H10: free flight of a body on a lattice; its velocity must not notice the steps."""
    d = setting.dimension
    with make_world(setting, CELL) as world:
        ball = pbmpm.Sphere([0.3 * CELL] * d, 0.5 * BALL_CELLS * CELL)
        world.fill(ball, world.add_material(setting.parameters(CELL)), velocity=VELOCITY[:d], jitter=0.0)
        watch, error = Watch(world), 0.0
        for dt in SEQUENCES[setting.variant]:
            watch.step(dt)
            error = max(error, float(np.abs(world.velocities.array() - VELOCITY[:d]).max()))
        accepted = 0
        for dt in REFUSED_STEPS:
            try:
                world.step(dt)
            except pbmpm.InvalidArgumentError:
                continue
            accepted += 1
        return [
            Check("change of velocity over speed", error / math.hypot(*VELOCITY[:d]), VELOCITY_ERROR),
            Check("impossible steps accepted", accepted, 0),
            *watch.checks(),
        ]


# H21

OFFSET_CELLS = 1_000_000
SHIFTED_SECONDS = 1.0
DENORMAL = 1e-40  # [m/s]


def _drop(world: pbmpm.World, setting: Setting, offset: float) -> Watch:
    """A block that falls on a floor and spreads around a post, far from zero."""
    d = setting.dimension
    place = vector(d, *[offset + 1.0] * 3)
    world.add_collider(pbmpm.Plane([offset] * d, vector(d, 0.0, 1.0)))
    world.add_collider(pbmpm.Sphere([offset + 1.0, offset, *[offset + 1.0] * 2][:d], 2.0 * CELL))
    world.fill(pbmpm.Box(place, [0.5] * d), world.add_material(setting.parameters(CELL)), jitter=0.0)
    watch = Watch(world)
    watch.run(SHIFTED_SECONDS, setting.dt)
    return watch


def far_away(setting: Setting) -> list[Check]:
    """H21: the same scene a million cells away. The shift is a whole number of cells, so all is exact that is reckoned from cells nearby, and no bit
    of any velocity may differ. (Nor would less do: a splash in steps of 1/15 s makes of a last bit a third of the highest speed in 3 steps.)"""
    offset = OFFSET_CELLS * CELL
    with make_world(setting, CELL, gravity=True) as near, make_world(setting, CELL, gravity=True) as far:
        _drop(near, setting, 0.0)
        watch = _drop(far, setting, offset)
        here, there = (np.argsort(world.ids.array()[:, 0], kind="stable") for world in (near, far))
        speeds = [world.velocities.array()[rows].astype(float) for world, rows in ((near, here), (far, there))]
        scale = max(1.0, float(np.abs(speeds[0]).max()))
        shift = far.positions.array()[there].astype(float) - offset - near.positions.array()[here]
        return [
            Check(
                "difference of velocities over the highest",
                float(np.abs(speeds[1] - speeds[0]).max()) / scale,
                0.0,
            ),
            # What a view rounds a position to there.
            Check("difference of positions [m]", float(np.abs(shift).max()), float(np.spacing(np.float32(offset)))),
            *watch.checks(),
        ]


def denormal(setting: Setting) -> list[Check]:
    """H21: velocities and gradients far below the normal range act like zero."""
    d = setting.dimension
    with make_world(setting, CELL) as world:
        world.fill(
            pbmpm.Sphere([0.3 * CELL] * d, 0.5 * BALL_CELLS * CELL),
            world.add_material(setting.parameters(CELL)),
            jitter=0.0,
        )
        count = len(world)
        world.velocities = np.full((count, d), DENORMAL)
        world.affine_velocities = np.full((count, d, d), DENORMAL)
        watch = Watch(world)
        watch.run(SHIFTED_SECONDS, setting.dt)
        return [Check("highest speed [m/s]", watch.fastest, VELOCITY_ERROR), *watch.checks()]


DENORMALS = "denormal velocities"
PLACES = {"a million cells away": far_away, DENORMALS: denormal}


def places(setting: Setting) -> list[Check]:
    """H21."""
    return PLACES[setting.variant](setting)


CASES = (
    HardCase(
        "H10",
        "Jumps of the time step",
        "frame hitches; state kept in units of displacement",
        "free flight: velocity unchanged to 1e-5; steps of no, negative or absurd length refused",
        change_rate,
        variants=tuple(SEQUENCES),
        has_own_steps=True,
    ),
    HardCase(
        "H21",
        "Huge coordinates and denormal numbers",
        "engine practice",
        "a scene shifted by a million cells moves the same to the last bit; denormals act like zero",
        places,
        variants=tuple(PLACES),
        fixed_variants=(DENORMALS,),  # a body at rest
    ),
)
