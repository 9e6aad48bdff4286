"""Cases of bad or odd input: values that are no numbers, and seedings that nobody would choose."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import fields

import numpy as np

import pbmpm

from .case import Check, HardCase, Setting
from .watch import Watch, make_world, vector

CELL = 0.1  # [m]
BOX = 1.6  # [m], domain
SIDE = 0.8  # [m], block in its lower middle
NOT_NUMBERS = (math.nan, math.inf, -math.inf)

Call = Callable[[], object]


def _block(world: pbmpm.World, material: pbmpm.Material, seed: int) -> None:
    d = world.dimension
    world.fill(pbmpm.Box([0.5 * BOX, 0.5 * SIDE, 0.5 * BOX][:d], [0.5 * SIDE] * d), material, seed=seed)


# H07


def _with_value(values: np.ndarray, bad: float) -> np.ndarray:
    """A copy with one bad entry in the last row."""
    spoilt = np.array(values, dtype=float)
    spoilt.reshape(-1)[-1] = bad
    return spoilt


def _bad_particles(world: pbmpm.World, material: pbmpm.Material, bad: float) -> Iterator[Call]:
    inside, at_rest = np.full((3, world.dimension), 0.5 * BOX), np.zeros((3, world.dimension))
    yield lambda: world.add_particles(material, _with_value(inside, bad))
    yield lambda: world.add_particles(material, inside, velocities=_with_value(at_rest, bad))
    yield lambda: world.add_particles(material, inside, volumes=_with_value(np.full(3, CELL), bad))
    yield lambda: world.add_particles(material, inside, volumes=bad)
    yield lambda: world.fill(pbmpm.Sphere(vector(world.dimension, bad), CELL), material)
    yield lambda: world.fill(pbmpm.Sphere(vector(world.dimension, CELL), bad), material)
    yield lambda: world.fill(
        pbmpm.Sphere(vector(world.dimension, CELL), CELL), material, velocity=[bad] * world.dimension
    )


def _bad_state(world: pbmpm.World, material: pbmpm.Material, bad: float) -> Iterator[Call]:
    is_liquid = isinstance(material.parameters, pbmpm.Liquid)
    field = pbmpm.Field.VOLUME_RATIO if is_liquid else pbmpm.Field.DEFORMATION
    for name in (pbmpm.Field.POSITION, pbmpm.Field.VELOCITY, pbmpm.Field.AFFINE_VELOCITY, field):
        spoilt = _with_value(world.view(name).copy(), bad)
        yield lambda name=name, spoilt=spoilt: world.set(name, spoilt)  # type: ignore[misc]


def _bad_obstacles(world: pbmpm.World, moving: pbmpm.Collider, bad: float) -> Iterator[Call]:
    d = world.dimension
    place, turned = [0.0] * d, bad if d == 2 else (0.0, 0.0, bad, 1.0)
    yield lambda: moving.move([bad] * d)
    yield lambda: moving.move(place, turned)
    yield lambda: moving.teleport([bad] * d)
    yield lambda: moving.teleport(place, turned)
    yield lambda: world.add_collider(pbmpm.Sphere([bad] * d, CELL))
    yield lambda: world.add_collider(pbmpm.Sphere(place, bad))
    yield lambda: world.add_collider(pbmpm.Box(place, [bad] * d))
    yield lambda: world.add_collider(pbmpm.Plane(place, [bad] * d))
    yield lambda: world.add_collider(pbmpm.Capsule(place, bad, CELL))


def _bad_settings(world: pbmpm.World, bad: float) -> Iterator[Call]:
    yield lambda: setattr(world, "gravity", [bad] * world.dimension)
    for name in ("max_displacement", "flip", "target_error", "time_budget_ms"):
        yield lambda name=name: setattr(world, name, bad)  # type: ignore[misc]
    yield lambda: world.step(bad)


def _bad_materials(world: pbmpm.World, bad: float) -> Iterator[Call]:
    for kind in (pbmpm.Liquid, pbmpm.Elastic):
        for name in (item.name for item in fields(kind) if isinstance(item.default, float)):
            yield lambda kind=kind, name=name: world.add_material(kind(**{name: bad}))  # type: ignore[misc]


def _accepted(calls: Iterator[Call]) -> int:
    """How many calls went through; every one of them should raise."""
    count = 0
    for call in calls:
        try:
            call()
        except (pbmpm.PbmpmError, ValueError, OverflowError):
            continue
        count += 1
    return count


def _attack(world: pbmpm.World, material: pbmpm.Material, moving: pbmpm.Collider) -> int:
    """Tries every bad value everywhere and says how many were accepted."""
    return sum(
        _accepted(_bad_particles(world, material, bad))
        + _accepted(_bad_state(world, material, bad))
        + _accepted(_bad_obstacles(world, moving, bad))
        + _accepted(_bad_settings(world, bad))
        + _accepted(_bad_materials(world, bad))
        for bad in NOT_NUMBERS
    )


def not_a_number(setting: Setting) -> list[Check]:
    """H07: NaN and infinities wherever a number goes in. The world must be as if nobody had tried."""
    d, size = setting.dimension, [BOX] * setting.dimension
    hashes: list[int] = []
    with (
        make_world(setting, CELL, gravity=True, size=size) as attacked,
        make_world(setting, CELL, gravity=True, size=size) as left_alone,
    ):
        for world in (attacked, left_alone):
            material = world.add_material(setting.parameters(CELL))
            _block(world, material, setting.seed)
            moving = world.add_collider(pbmpm.Sphere([0.5 * BOX] * d, 2.0 * CELL), kinematic=True)
            watch = Watch(world)
            watch.run(0.2, setting.dt)
            if world is attacked:
                before = world.hash()
                accepted = _attack(world, material, moving)
                changed = float(world.hash() != before)
            watch.run(0.2, setting.dt)
            hashes.append(world.hash())
        return [
            Check("bad values accepted", accepted, 0),
            Check("state changed by a refused call", changed, 0),
            Check("later steps differ from those of an untouched world", float(hashes[0] != hashes[1]), 0),
            *watch.checks(),
        ]


# H17

SEEDINGS: dict[str, Callable[[int, int], np.ndarray]] = {  # from dimension and seed
    "one particle": lambda d, _: np.full((1, d), 0.77),
    "two at one point": lambda d, _: np.full((2, d), 0.77),
    "10000 in one cell": lambda d, seed: 0.71 + CELL * np.random.default_rng(seed).random((10_000, d)),
    "one per 8 cells": lambda d, _: np.stack(np.meshgrid(*[np.arange(0.1, BOX, 2.0 * CELL)] * d), axis=-1).reshape(
        -1, d
    ),
    "on nodes": lambda d, _: np.stack(np.meshgrid(*[np.arange(4, 9) * CELL] * d), axis=-1).reshape(-1, d),
    "on the domain's edge": lambda d, _: np.array(
        [[0.0] * d, [BOX] * d, vector(d, 0.0, BOX, 0.0), vector(d, BOX, 0.5)]
    ),
}
SEEDING_SECONDS = 2.0


def _bad_seedings(world: pbmpm.World, material: pbmpm.Material) -> Iterator[Call]:
    d = world.dimension
    inside = np.full((1, d), 0.5 * BOX)
    for volume in (0.0, -1.0, 1e30, 1e-30):
        yield lambda volume=volume: world.add_particles(material, inside, volumes=volume)  # type: ignore[misc]
        yield lambda volume=volume: world.add_particles(material, inside, volumes=[volume])  # type: ignore[misc]
    for outside in (-0.01, BOX + 0.01, 1e20):
        yield lambda outside=outside: world.add_particles(material, np.full((1, d), outside))  # type: ignore[misc]
    for density in (0.0, -1.0, 1e30):
        yield lambda density=density: world.add_material(type(material.parameters)(density=density))  # type: ignore[misc]


def seed_badly(setting: Setting) -> list[Check]:
    """H17: odd seedings live on; impossible ones are refused."""
    with make_world(setting, CELL, gravity=True, size=[BOX] * setting.dimension) as world:
        material = world.add_material(setting.parameters(CELL))
        refused = _accepted(_bad_seedings(world, material))
        world.add_particles(material, SEEDINGS[setting.variant](setting.dimension, setting.seed))
        watch = Watch(world)
        watch.run(SEEDING_SECONDS, setting.dt)
        return [Check("impossible seedings accepted", refused, 0), *watch.checks()]


CASES = (
    HardCase(
        "H07",
        "NaN and infinity in every argument",
        "NaN that spreads through worlds of released engines; validate and ignore",
        "every call refused, nothing changed, later steps bit for bit as without the attempt",
        not_a_number,
        fixed_variants=("plain",),  # a call is refused whatever the steps are
    ),
    HardCase(
        "H17",
        "Degenerate seedings",
        "engine fuzzing practice",
        "finite, nothing lost, nothing outside; zero, negative and absurd volumes and places refused",
        seed_badly,
        variants=tuple(SEEDINGS),
    ),
)
