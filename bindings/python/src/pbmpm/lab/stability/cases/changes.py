"""Cases of changing settings: iterations that jump, and the whole range of the relaxation."""

from __future__ import annotations

import pbmpm

from .case import DUAL, ELASTIC, PAPER, SOLID_AND_LIQUID, Check, HardCase, Setting
from .watch import Watch, highest_energy, make_world, potential_energy, total_energy, vector

CELL = 0.2  # [m]
BLOCK_CELLS = {2: 8, 3: 4}
TANK_WIDTHS = 3.0


def _falling(setting: Setting, world: pbmpm.World, side: float, changes: dict[str, float]) -> Watch:
    """A column at a wall, half a cell above the floor."""
    d = setting.dimension
    place = vector(d, 0.5 * side, 0.5 * side + 0.5 * CELL, 0.5 * side)
    material = world.add_material(setting.parameters(CELL, **changes))
    world.fill(pbmpm.Box(place, [0.5 * side] * d), material, seed=setting.seed)
    return Watch(world)


def _tank(setting: Setting, side: float) -> pbmpm.World:
    return make_world(setting, CELL, gravity=True, size=[TANK_WIDTHS * side, 2.0 * side, side])


# H11

MANY_ITERATIONS = 50
PART_SECONDS = 3.0
RISING_SUBSTEPS = 250  # that raised iterations take to have all their effect, at most: 100 with the paper's solver
RISING_SUBSTEPS_FROM_ONE = 1900  # the same, on bodies with the dual solver (see dual_stiffened() in src/solvers/dual/dual.c) from one iteration on
GAIN_MAX = 0.01


def _rising_substeps(setting: Setting) -> int:
    from_one = setting.iterations == 1 and setting.solver == DUAL and setting.material == ELASTIC
    return RISING_SUBSTEPS_FROM_ONE if from_one else RISING_SUBSTEPS


def jump(setting: Setting) -> list[Check]:
    """H11: from the setting's iterations to 50 until they have all their effect, and back. Soft matter that becomes stiff rises again, but not above where
    it came from."""
    side = BLOCK_CELLS[setting.dimension] * CELL
    with _tank(setting, side) as world:
        watch = _falling(setting, world, side, {})
        start, peak = potential_energy(world), 0.0
        part = round(PART_SECONDS / setting.dt)
        few, many = (setting.iterations, part), (MANY_ITERATIONS, max(part, _rising_substeps(setting)))
        for count, steps in (few, many, few):
            world.iterations = count
            for _ in range(steps):
                peak = max(peak, total_energy(watch.step(setting.dt)) / start)
        return [Check("highest energy over the start's", peak, 1.0 + GAIN_MAX), *watch.checks()]


# H12

RELAXATIONS = {f"relaxation {value:g}": value for value in (0.1, 0.5, 1.0, 1.5, 1.9, 1.999)}
REFUSED_RELAXATIONS = (0.0, 2.0, 2.5, 5.0, 10.0)
SWEEP_SECONDS = 2.0


def relax(setting: Setting) -> list[Check]:
    """H12: what is below 2 is stable, the rest refused. The iteration multiplies a body's error by 1 - w: from 2 on it grows."""
    side, accepted = BLOCK_CELLS[setting.dimension] * CELL, 0
    with _tank(setting, side) as world:
        for value in REFUSED_RELAXATIONS:
            try:
                world.add_material(setting.parameters(CELL, relaxation=value))
            except pbmpm.InvalidArgumentError:
                continue
            accepted += 1
        watch = _falling(setting, world, side, {"relaxation": RELAXATIONS[setting.variant]})
        energy = highest_energy(watch, SWEEP_SECONDS, setting.dt)
        return [energy, Check("relaxations of 0 or from 2 on accepted", accepted, 0), *watch.checks()]


CASES = (
    HardCase(
        "H11",
        "Iterations jump from 1 to 50 and back",
        "settings that users change while a scene runs",
        "energy never more than 1 % above the start's",
        jump,
        materials=SOLID_AND_LIQUID,
        iterations=1,
    ),
    HardCase(
        "H12",
        "Relaxation over its whole range, and beyond",
        "the released demo allows 10",
        "energy never above the start's for what is accepted; refused from 2 on, where the iteration makes errors grow",
        relax,
        materials=SOLID_AND_LIQUID,
        variants=tuple(RELAXATIONS),
        solvers=(PAPER,),  # the others have no relaxation that a user sets
    ),
)
