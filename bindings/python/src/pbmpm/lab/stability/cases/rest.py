"""Case of long rest: a pool and a block that must not drift, warm up or creep."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

import pbmpm

from .case import EXPLICIT, LIQUID, SOLID_AND_LIQUID, Check, HardCase, Kind, Setting
from .watch import GRAVITY, Watch, make_world

# H19

CELL = 0.2  # [m]
SHORT = "short"
MILLION = "a million steps"
#: Of a pool of 4 x 3 cells half of the particles lie at the surface, whose places alone move its height by half a percent and more.
POOL_CELLS = {2: (8, 6, 0), 3: (4, 4, 4)}
SETTLE_SECONDS = 10.0
STEPS = {SHORT: 1200, MILLION: 1_000_000}
LOOKS = 400  # how often it is looked at: many times in each swing of a block or a pool
HEIGHT_DRIFT = 0.005
ENERGY_SHARE = 1e-6  # of m g H
#: The catalogue gives a pool 10^6 steps to come to rest. Where 1200 are too few the short form goes on, for as long again each time, up to this many
#: times as long; and longer where each time was livelier than all before, which what only stirs seldom is so often: in one run of twenty if in bursts.
LONGEST_TO_REST = 4
LONGEST_TO_TELL = 32
BURSTS = 10  # parts of a run; the liveliest tells how far bursts get
#: Of the 45 pairs of such parts, in which the later is the livelier: what stirs evenly has so many in one run of 900 (H. Mann, "Nonparametric tests
#: against trend", Econometrica 13, 1945), and the map has a hundred runs with liquid.
RISING_PAIRS = 39


def _height(world: pbmpm.World) -> float:
    """Twice the mean height: that of a column of even density."""
    return 2.0 * float(world.positions.array()[:, 1].astype(float).mean())


def rest(setting: Setting) -> list[Check]:
    """H19: settled for 10 s, and then for a long time."""
    size = [cells * CELL for cells in POOL_CELLS[setting.dimension]]
    with make_world(setting, CELL, gravity=True, size=[size[0], 2.0 * size[1], size[2]]) as world:
        half = [0.5 * length for length in size][: setting.dimension]
        world.fill(pbmpm.Box(half, half), world.add_material(setting.parameters(CELL)), seed=setting.seed)
        watch = Watch(world)
        stats = watch.run(SETTLE_SECONDS, setting.dt)
        unit = stats.mass * GRAVITY * size[1]
        start, drifts = _height(world), [0.0]

        def look() -> float:
            for _ in range(STEPS[setting.variant] // LOOKS - 1):
                world.step(setting.dt)
            energy = watch.step(setting.dt).kinetic_energy / unit
            drifts.append(abs(_height(world) / start - 1.0))
            return energy

        energies = look_until_it_tells(look) if setting.variant == SHORT else [look() for _ in range(LOOKS)]
        return [
            Check("drift of the height", max(drifts), HEIGHT_DRIFT, kind=Kind.GOAL),
            Check("kinetic energy over m g H in the end", float(np.median(_second_half(energies))), ENERGY_SHARE, kind=Kind.GOAL),
            Check("kinetic energy of the second half over that of the first", warming(energies), 1.0),
            *([bound_of_bursts(energies, fall_energy(setting.dt) / size[1])] if setting.material == LIQUID else []),
            *watch.checks(),
        ]


def fall_energy(dt: float) -> float:
    """Kinetic energy that gravity gives in one step, over m g: a height [m].

    Each step a pool at rest is let fall by g dt, and what holds it is solved for. Where that is not finished, or the pressure pulls where particles lie
    unevenly, a share of g dt is left: a pool of 192 particles stirs, at 15 Hz with a tenth of this energy. More than all of it no single solution leaves:
    it was gathered. A block may have more: it swings with what its weight squeezed into it.
    """
    return 0.5 * GRAVITY * dt * dt


def look_until_it_tells(look: Callable[[], float]) -> list[float]:
    """Energies, of LOOKS looks or of twice, four times as many and so on, see LONGEST_TO_REST."""
    energies = [look() for _ in range(LOOKS)]
    while len(energies) < LONGEST_TO_TELL * LOOKS:
        comes_to_rest = len(energies) < LONGEST_TO_REST * LOOKS and not _is_at_rest(energies)
        if not comes_to_rest and _livelier_halves(energies) <= 1.0:
            break
        energies += [look() for _ in range(len(energies))]
    return energies


def _second_half(energies: list[float]) -> list[float]:
    return energies[len(energies) // 2 :]


def _is_at_rest(energies: list[float]) -> bool:
    half = _second_half(energies)
    return max(float(np.mean(half)), float(np.median(half))) <= ENERGY_SHARE


def warming(energies: list[float]) -> float:
    """By how much the second half is livelier than the first, see _livelier_halves(); 0 when what was last is rest, and when the parts of the run rise no more
    often than what stirs evenly has it by chance.

    Halves alone told of a pool that it warmed (the dual, 30 Hz x 1): by 9 % in 12,800 looks. In four times as many each sixteenth had as much as the first.
    """
    return _livelier_halves(energies) if _rises(energies) else 0.0


def _livelier_halves(energies: list[float]) -> float:
    """The mean of the second half over that of the first, of the run, its first half, the first quarter and so on, wherever it is least; 0 when what was
    last is rest.

    What stirs evenly has a livelier second half in every other run, and because it stirs in bursts that last for a part of a run, the halves' own scatter says
    little of how far apart their means may be (H. Flyvbjerg, H. Petersen, "Error estimates on averages of correlated data", J. Chem. Phys. 91, 1989: blocks
    must be longer than the correlation). But what warms does so in each half against all before, of any length.
    """
    if _is_at_rest(energies):
        return 0.0
    ratios, length = [], len(energies)
    while length >= LOOKS:
        first, second = (float(np.mean(half)) for half in np.split(np.array(energies[:length]), 2))
        ratios.append(second / first)
        length //= 2
    return min(ratios)


def _means_of_parts(energies: list[float]) -> list[float]:
    return [float(np.mean(part)) for part in np.array_split(np.array(energies), BURSTS)]


def _rises(energies: list[float]) -> bool:
    return sum(later > earlier for earlier, later in itertools.combinations(_means_of_parts(energies), 2)) >= RISING_PAIRS


def bound_of_bursts(energies: list[float], fall: float) -> Check:
    """Of the mean energy of the liveliest part of a run."""
    return Check("kinetic energy of a burst over that of a step's fall", max(_means_of_parts(energies)) / fall, 1.0)


CASES = (
    HardCase(
        "H19",
        "Long rest of a pool and a block",
        "drift and warming of long runs",
        "height within 0.5 % after 10 s; kinetic energy falls below 1e-6 of m g H, does not go on rising, and stays below that of a step's fall",
        rest,
        materials=SOLID_AND_LIQUID,
        variants=(SHORT,),
        long_variants=(MILLION,),
        # The explicit solver is there to be compared with. One dimension less: what sums up rounding is the same.
        makes_sense=lambda setting: setting.variant == SHORT or (setting.dimension == 2 and setting.solver != EXPLICIT),
    ),
)
