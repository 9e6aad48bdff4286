"""Cases in which liquid loses its volume: a collapsing column at the lowest rate, a press, and matter on one point."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

import pbmpm

from ...accuracy import laws
from .case import DUAL, LIQUID, PAPER, Check, HardCase, Kind, Setting
from .watch import ENERGY_SLACK, GRAVITY, Watch, make_world, occupied_share, potential_energy, total_energy, vector

#: Share of the volume that has to come back, of what the solver's own compressibility leaves of it.
RECOVERED_VOLUME = 0.9


def volume_at_rest(setting: Setting, cell_size: float, height: float) -> float:
    """Volume of a settled column over its rest volume: by the compressibility of the paper's solver, that of the dual one's single
    iteration, or the liquid's own."""
    liquid = setting.parameters(cell_size)
    assert isinstance(liquid, pbmpm.Liquid)
    if setting.solver == PAPER:
        modulus = laws.bulk_modulus_over_density(
            setting.dimension, cell_size, setting.dt, setting.iterations, liquid.relaxation
        )
        return 1.0 - laws.mean_compression(height, GRAVITY, modulus)
    if setting.solver == DUAL and setting.iterations == 1 and liquid.bulk_modulus == 0.0:
        modulus = laws.single_iteration_modulus_over_density(
            setting.dimension, cell_size, setting.dt, liquid.relaxation
        )
        return 1.0 - laws.mean_compression(height, GRAVITY, modulus)
    if liquid.bulk_modulus == 0.0:
        return 1.0
    # A layer at rest height X carries rho g (h - X) = K (1 - J); the mean over the height h is half of the bottom's.
    return 1.0 - 0.5 * liquid.density * GRAVITY * height / liquid.bulk_modulus


# H01

PLAIN, SMALL = "plain", "small column"
COLUMN_CELLS = {PLAIN: {2: 64, 3: 16}, SMALL: {2: 16, 3: 8}}
#: As the default; and none: when uneven particles settle they lift their column by a fiftieth of a cell, a thousandth of a small one.
COLUMN_JITTER = {PLAIN: None, SMALL: 0.0}
TANK_WIDTHS = 4
COLUMN_CELL = 1.0  # [m]: 64 m of water; smaller cells would make the law's own compression larger
COLUMN_SECONDS = 20.0  # of the plain one
COLUMN_AVERAGE_SHARE = 0.25  # of that time, in the end


def dam_break(setting: Setting) -> list[Check]:
    """H01: a column falls over in a tank. The final volume is judged by what the solver's compressibility allows, for at
    30 Hz and one iteration that law alone takes away more than a tenth. In a smaller scene times are shorter by the square
    root of lengths, as gravity wants."""
    cells = COLUMN_CELLS[setting.variant][setting.dimension]
    side, depth = cells * COLUMN_CELL, 0.5 * cells * COLUMN_CELL
    seconds = COLUMN_SECONDS * math.sqrt(cells / COLUMN_CELLS[PLAIN][setting.dimension])
    world = make_world(setting, COLUMN_CELL, gravity=True, size=[TANK_WIDTHS * side, 2.0 * side, depth])
    with world:
        body = vector(setting.dimension, 0.5 * side, 0.5 * side, 0.5 * depth)
        material = world.add_material(setting.parameters(COLUMN_CELL))
        world.fill(pbmpm.Box(body, body), material, seed=setting.seed, jitter=COLUMN_JITTER[setting.variant])
        watch, start = Watch(world), potential_energy(world)
        peak, ratios = -math.inf, []
        steps = round(seconds * setting.rate_hz)
        for step in range(steps):
            peak = max(peak, total_energy(watch.step(setting.dt)) / start)
            if steps - step <= COLUMN_AVERAGE_SHARE * steps:
                ratios.append(float(world.volume_ratios.array().mean()))
        share = float(np.mean(ratios)) / volume_at_rest(setting, COLUMN_CELL, side / TANK_WIDTHS)
        return [
            Check("highest energy over the start's", peak, 1.0 + ENERGY_SLACK),
            Check("mean volume ratio over the law's", share, RECOVERED_VOLUME, at_least=True, kind=Kind.GOAL),
            *watch.checks(),
        ]


# H03

PRESS_CELLS = {2: 16, 3: 8}
PRESS_CELL = 0.5  # [m]: the law's own compression stays near a tenth at 60 Hz and 5 iterations
PRESS_SPEED = 2.0  # [m/s] of each wall
PRESS_HOLD_SECONDS = 1.0
PRESS_RECOVERY_SECONDS = 1.0
PRESS_FIRST_STEPS = 10
RECOVERED_RATIOS = (0.8, 1.2)
RECOVERED_SHARE = 0.95


@dataclass(frozen=True)
class Press:
    """Two kinematic walls that move towards each other under a fixed lid, with liquid between them."""

    world: pbmpm.World
    left: pbmpm.Collider
    right: pbmpm.Collider
    side: float

    @classmethod
    def build(cls, world: pbmpm.World, side: float) -> Press:
        """Around a body of this side length [m], in the middle of a box three times as wide."""
        d = world.dimension
        wall = [side, 4.0 * side, 4.0 * side][:d]
        lid = pbmpm.Box(vector(d, 1.5 * side, 3.0 * side, 0.5 * side), [4.0 * side, 2.0 * side, 4.0 * side][:d])
        world.add_collider(lid)
        left, right = (
            world.add_collider(pbmpm.Box(place, wall), kinematic=True) for place in cls._places(d, side, 0.0)
        )
        return cls(world, left, right, side)

    @staticmethod
    def _places(dimension: int, side: float, closed: float) -> list[list[float]]:
        way = 0.5 * side * closed
        return [vector(dimension, x, 0.5 * side, 0.5 * side) for x in (way, 3.0 * side - way)]

    def move(self, closed: float) -> None:
        """Where the walls are to be at the end of the next step: 0 at the body's sides, 1 touching each other."""
        left, right = self._places(self.world.dimension, self.side, closed)
        self.left.move(left)
        self.right.move(right)


def release_speed(setting: Setting, cell_size: float, fall: float, pushed: float = PRESS_SPEED) -> float:
    """What crushed matter may reach when it is let go: pushed by walls of this speed and falling from some height; and what it stores,
    for kinetic energies add."""
    return math.hypot(4.0 * pushed + math.sqrt(2.0 * GRAVITY * fall), setting.expansion_speed(cell_size))


def crush(setting: Setting) -> list[Check]:
    """H03: to no volume at all, held, and let go."""
    cells, d = PRESS_CELLS[setting.dimension], setting.dimension
    side = cells * PRESS_CELL
    world = make_world(setting, PRESS_CELL, gravity=True, size=[3.0 * side, 4.0 * side, side])
    with world:
        body = pbmpm.Box(vector(d, 1.5 * side, 0.5 * side, 0.5 * side), [0.5 * side] * d)
        world.fill(body, world.add_material(setting.parameters(PRESS_CELL)), seed=setting.seed)
        press, watch = Press.build(world, side), Watch(world)
        steps = math.ceil(0.5 * side / PRESS_SPEED / setting.dt)
        for step in range(steps):
            press.move((step + 1) / steps)
            watch.step(setting.dt)
        watch.run(PRESS_HOLD_SECONDS, setting.dt)
        watch.forget()
        for step in range(steps + round(PRESS_RECOVERY_SECONDS / setting.dt)):
            press.move(max(0.0, 1.0 - (step + 1) / steps))
            watch.step(setting.dt)
            if step == PRESS_FIRST_STEPS - 1:
                fastest = watch.fastest
        ratios = world.volume_ratios.array()
        recovered = float(((ratios > RECOVERED_RATIOS[0]) & (ratios < RECOVERED_RATIOS[1])).mean())
        volume = occupied_share(world, cells**d) / volume_at_rest(setting, PRESS_CELL, side)
        return [
            Check("speed in the first 10 steps of release [m/s]", fastest, release_speed(setting, PRESS_CELL, side)),
            Check("share of particles with J in [0.8, 1.2]", recovered, RECOVERED_SHARE, at_least=True, kind=Kind.GOAL),
            Check("occupied volume over the law's", volume, RECOVERED_VOLUME, at_least=True, kind=Kind.GOAL),
            *watch.checks(),
        ]


# H04

COLLAPSED_CELLS = 8
COLLAPSED_CELL = 0.05  # [m]
COLLAPSED_OFF_NODE = 0.013  # [m], so that the point is nowhere special on the grid
COLLAPSED_SECONDS = 2.0
COLLAPSED_DISPLACEMENT = 5.0  # cells per step
COLLAPSED_DRIFT = 1e-4  # of mass times a cell per step


def collapse(setting: Setting) -> list[Check]:
    """H04: all particles of a block at one point, on a line, or at random in one cell; free space, no gravity."""
    d, place = setting.dimension, COLLAPSED_OFF_NODE
    with make_world(setting, COLLAPSED_CELL) as world:
        half = [0.5 * COLLAPSED_CELLS * COLLAPSED_CELL] * d
        world.fill(
            pbmpm.Box([place] * d, half), world.add_material(setting.parameters(COLLAPSED_CELL)), seed=setting.seed
        )
        positions = world.positions.copy()
        if setting.variant == "one cell":
            positions[:] = place + COLLAPSED_CELL * np.random.default_rng(setting.seed).random(positions.shape)
        elif setting.variant == "line":
            positions[:, 1:] = place
        else:
            positions[:] = place
        world.positions = positions
        watch, drift, unbalanced = Watch(world), 0.0, 0.0
        for _ in range(round(COLLAPSED_SECONDS / setting.dt)):
            stats = watch.step(setting.dt)
            # Unlike the other solvers' iterates those of the primal do not balance: by as much as its residual says.
            unbalanced += stats.residual if stats.solver is pbmpm.Solver.PRIMAL else 0.0
            unit = stats.mass * COLLAPSED_CELL / setting.dt
            drift = max(drift, float(np.abs(stats.momentum).max()) / unit - unbalanced)
        volume = occupied_share(world, COLLAPSED_CELLS**d)
        return [
            Check("occupied over rest volume", volume, RECOVERED_VOLUME, at_least=True, kind=Kind.GOAL),
            Check("highest displacement [cells/step]", watch.longest, COLLAPSED_DISPLACEMENT),
            Check("momentum over mass times a cell per step", drift, COLLAPSED_DRIFT),
            *watch.checks(),
        ]


CASES = (
    HardCase(
        "H01",
        "Dam break at 30 Hz with one iteration, 20 s",
        "C. Lewin, A Position Based Material Point Method, 2024, section 3",
        "energy never above the start's; mean volume ratio at least 0.9 of what the solver's compressibility allows",
        dam_break,
        materials=(LIQUID,),
        variants=(PLAIN,),
        fixed_variants=(PLAIN,),
        map_variants=(SMALL,),
        rate_hz=30.0,
        iterations=1,
    ),
    HardCase(
        "H03",
        "Liquid crushed to no volume between walls, held, released",
        "C. Lewin, A Position Based Material Point Method, 2024, section 1",
        "no explosion: in the first 10 steps below 4 wall speeds + sqrt(2 g H), and the speed of sound of what is"
        " compressible; 95 % of particles recover within 1 s",
        crush,
        materials=(LIQUID,),
    ),
    HardCase(
        "H04",
        "Total loss of volume: all particles at one point, on a line, in one cell",
        "C. Lewin, A Position Based Material Point Method, 2024, section 2.1; vertex block descent's flattened bodies",
        "0.9 of the rest volume within 2 s, below 5 cells per step, momentum kept",
        collapse,
        materials=(LIQUID,),
        variants=("point", "line", "one cell"),
    ),
)
