"""Case of long rest: a pool and a block that must not drift, warm up or creep."""

from __future__ import annotations

import numpy as np

import pbmpm

from .case import DUAL, EXPLICIT, LIQUID, PAPER, PRIMAL, SOLID_AND_LIQUID, Check, HardCase, Kind, KnownFailure, Setting
from .watch import GRAVITY, Watch, make_world

# H19

CELL = 0.2  # [m]
SHORT = "short"
MILLION = "a million steps"
POOL_CELLS = {SHORT: {2: (8, 6, 0), 3: (4, 4, 4)}, MILLION: {2: (4, 3, 0)}}
SETTLE_SECONDS = 10.0
STEPS = {SHORT: 1200, MILLION: 1_000_000}
LOOKS = 400  # how often it is looked at: many times in each swing of a block or a pool
HEIGHT_DRIFT = 0.005
ENERGY_SHARE = 1e-6  # of m g H


def _height(world: pbmpm.World) -> float:
    """Twice the mean height: that of a column of even density."""
    return 2.0 * float(world.positions.array()[:, 1].astype(float).mean())


def rest(setting: Setting) -> list[Check]:
    """H19: settled for 10 s, and then for a long time."""
    size = [cells * CELL for cells in POOL_CELLS[setting.variant][setting.dimension]]
    with make_world(setting, CELL, gravity=True, size=[size[0], 2.0 * size[1], size[2]]) as world:
        half = [0.5 * length for length in size][: setting.dimension]
        world.fill(pbmpm.Box(half, half), world.add_material(setting.parameters(CELL)), seed=setting.seed)
        watch = Watch(world)
        stats = watch.run(SETTLE_SECONDS, setting.dt)
        unit = stats.mass * GRAVITY * size[1]
        start, drift, energies = _height(world), 0.0, []
        for _ in range(LOOKS):
            for _ in range(STEPS[setting.variant] // LOOKS - 1):
                world.step(setting.dt)
            energies.append(watch.step(setting.dt).kinetic_energy / unit)
            drift = max(drift, abs(_height(world) / start - 1.0))
        return [
            Check("drift of the height", drift, HEIGHT_DRIFT, kind=Kind.GOAL),
            Check("kinetic energy over m g H in the end", float(np.median(energies[LOOKS // 2 :])), ENERGY_SHARE, kind=Kind.GOAL),
            Check("kinetic energy of the second half over that of the first", _ratio(energies), 1.0),
            *watch.checks(),
        ]


def _ratio(energies: list[float]) -> float:
    """0 when both are below what counts as rest."""
    first, second = (float(np.mean(half)) for half in np.split(np.array(energies), 2))
    return second / first if second > ENERGY_SHARE else 0.0


CASES = (
    HardCase(
        "H19",
        "Long rest of a pool and a block",
        "drift and warming of long runs",
        "height within 0.5 % after 10 s; kinetic energy falls below 1e-6 of m g H and does not rise",
        rest,
        materials=SOLID_AND_LIQUID,
        variants=(SHORT,),
        long_variants=(MILLION,),
        known_failures=(
            KnownFailure(
                "a pool of 48 particles that were strewn at random goes on rearranging after its 10 s: it sinks by 3 % in the next hour (paper) or by 1.7 % in"
                " the next minute (primal), or rises by 3 % in hours (dual)",
                (PAPER, DUAL, PRIMAL),
                (MILLION,),
                (LIQUID,),
            ),
        ),
        # The explicit solver is there to be compared with. One dimension less: what sums up rounding is the same.
        makes_sense=lambda setting: setting.variant == SHORT or (setting.dimension == 2 and setting.solver != EXPLICIT),
    ),
)
