"""Case of the whole ladder of rates and iterations: every kind of matter, from the softest setting to the stiffest."""

from __future__ import annotations

import pbmpm

from .case import ALL_KINDS, Check, HardCase, Setting
from .watch import Watch, highest_energy, make_world, vector

# H02

RATES = (15.0, 30.0, 60.0, 120.0, 240.0, 480.0, 1200.0)
ITERATIONS = (1, 2, 5, 10, 20)
CELL = 0.1  # [m]
TANK_CELLS = {2: (12, 10, 0), 3: (10, 8, 6)}
BLOCK_CELLS = {2: 5, 3: 4}
DROP_CELLS = 1
POST_CELLS = 1.5  # radius
SECONDS = 0.5


def climb(setting: Setting) -> list[Check]:
    """H02: a block falls beside a post in a tank, and lands on its edge."""
    d = setting.dimension
    size = [cells * CELL for cells in TANK_CELLS[d]]
    with make_world(setting, CELL, gravity=True, size=size) as world:
        half, centre = 0.5 * BLOCK_CELLS[d] * CELL, 0.5 * size[0]
        world.add_collider(pbmpm.Sphere(vector(d, centre - half, 0.0, 0.5 * size[2]), POST_CELLS * CELL))
        place = vector(d, centre, half + DROP_CELLS * CELL, 0.5 * size[2])
        world.fill(pbmpm.Box(place, [half] * d), world.add_material(setting.parameters(CELL)), seed=setting.seed)
        watch = Watch(world)
        return [highest_energy(watch, SECONDS, setting.dt), *watch.checks()]


CASES = (
    HardCase(
        "H02",
        "Ladder of rates and iterations",
        "menu of the released demo",
        "from 15 Hz x 1 to 1200 Hz x 20 nothing fails: energy never above the start's",
        climb,
        materials=ALL_KINDS,
        ladder=tuple((rate, count) for rate in RATES for count in ITERATIONS),
    ),
)
