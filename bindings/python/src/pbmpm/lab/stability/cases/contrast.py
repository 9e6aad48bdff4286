"""Cases of contrast: heavy matter on light matter, and soft beside stiff in one cell."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

import pbmpm
from pbmpm.materials import Parameters

from ...accuracy import laws
from .case import ELASTIC, EXPLICIT, LIQUID, MIXED, PAPER, PRIMAL, Check, HardCase, Kind, Setting, sound_modulus
from .watch import ENERGY_SLACK, GRAVITY, Watch, highest_energy, make_world, potential_energy, total_energy, vector

# H09

CELL = 1.0  # [m]: the paper's stiffness grows with the square of the cell, so a light block carries ten times its weight
BLOCK_CELLS = {2: 6, 3: 4}
GAP_CELLS = 1.0
LIGHT_DENSITY = 100.0  # [kg/m^3]
BLOCK_SECONDS = 3.0
OVERTURN_SECONDS = 10.0
UNDAMPED_SECONDS = 3.4  # what it takes where nothing damps: at 480 Hz with one iteration, in 2D and 3D
LATTICE_PARTICLES = 2  # per axis and cell
WAVE_CELLS = 0.5  # amplitude of the wave between the liquids; half a wave is as long as the tank
RATIOS = (10, 100, 1000, 10000)
RATIOS_3D = (10, 1000)  # for the sake of time
VARIANTS = {f"1:{ratio}": ratio for ratio in RATIOS}
CARRIED_RATIO = 10  # up to here the light block has to keep its volume
VOLUME_MIN = 0.3
CRUSHED_MAX = 0.5  # light liquid that is compressed by more is not asked to rise; of a solid see _is_flattened()
EJECTION = 2.0  # times the height at the start


def _light_and_heavy(setting: Setting, world: pbmpm.World) -> tuple[pbmpm.Material, pbmpm.Material]:
    densities = (LIGHT_DENSITY, LIGHT_DENSITY * VARIANTS[setting.variant])
    light, heavy = (world.add_material(setting.parameters(CELL, density=density)) for density in densities)
    return light, heavy


def _is_flattened(setting: Setting) -> bool:
    """Whether the law of the paper's solver lets the heavy block press the light one flat: a weight that comes at once compresses twice as far as
    at rest (W x = E x^2 / 2), by all from W / E = 1/2 on."""
    weight = VARIANTS[setting.variant] * GRAVITY * BLOCK_CELLS[setting.dimension] * CELL
    return setting.solver == PAPER and weight > CRUSHED_MAX * _elastic_modulus(setting)


def _elastic_modulus(setting: Setting) -> float:
    """E / rho of the paper's solver [m^2/s^2]."""
    relaxation = setting.parameters(CELL).relaxation
    return laws.young_modulus_over_density(CELL, setting.dt, setting.iterations, relaxation)


def _release_speed(setting: Setting, height: float) -> float:
    """What matter that was pressed flat, and falls from some height, may reach by the law of the paper's solver [m/s]. How high it flies is
    no sign of a fault, but it is no faster than this."""
    return math.hypot(setting.stored_speed(CELL), math.sqrt(2.0 * GRAVITY * height))


def _heavy_block(setting: Setting) -> list[Check]:
    """A heavy block falls on a light one."""
    d = setting.dimension
    side, gap = BLOCK_CELLS[d] * CELL, GAP_CELLS * CELL
    start = 2.0 * side + gap
    with make_world(setting, CELL, gravity=True, size=[4.0 * side, 6.0 * side, side]) as world:
        light, heavy = _light_and_heavy(setting, world)
        for material, base in ((light, 0.0), (heavy, side + gap)):
            place = vector(d, 2.0 * side, base + 0.5 * side, 0.5 * side)
            world.fill(pbmpm.Box(place, [0.5 * side] * d), material, seed=setting.seed)
        watch, top, least = Watch(world), 0.0, np.inf
        energy, peak = potential_energy(world), 0.0
        for _ in range(round(BLOCK_SECONDS / setting.dt)):
            peak = max(peak, total_energy(watch.step(setting.dt)) / energy)
            rows = world.material_indices.array() == light.index
            top = max(top, float(world.positions.array()[:, 1].max()))
            least = min(least, float(np.linalg.det(world.deformations.array()[rows].astype(float)).min()))
        carried = VARIANTS[setting.variant] <= CARRIED_RATIO
        flattened = _is_flattened(setting)
        return [
            *([Check("smallest J of the light block", least, VOLUME_MIN, at_least=True, kind=Kind.GOAL)] if carried else []),
            *([] if flattened else [Check("highest place over the start's height", top / start, EJECTION)]),
            *([Check("highest speed over what the law stores", watch.fastest / _release_speed(setting, start), 1.0)] if flattened else []),
            Check("highest energy over the start's", peak, 1.0 + ENERGY_SLACK),
            *watch.checks(),
        ]


def _lattice(size: list[float]) -> npt.NDArray[np.float64]:
    """Places that fill a box from the origin to there evenly [m]."""
    spacing = CELL / LATTICE_PARTICLES
    axes = [spacing * (np.arange(round(length / spacing)) + 0.5) for length in size]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(size))


def crushed_share(setting: Setting, height: float) -> float:
    """By how much heavy liquid of this height compresses the light one, by the solver's own compressibility."""
    light = setting.parameters(CELL, density=LIGHT_DENSITY)
    assert isinstance(light, pbmpm.Liquid)
    modulus = light.bulk_modulus / light.density
    if setting.solver == PAPER:
        modulus = laws.bulk_modulus_over_density(
            setting.dimension, CELL, setting.dt, setting.iterations, light.relaxation
        )
    return VARIANTS[setting.variant] * GRAVITY * height / modulus if modulus > 0.0 else 0.0


def _growth_share(setting: Setting) -> float:
    """By how much the damping of the paper's transfers slows a wave between the liquids down.

    It grows at the rate n of n^2 + c n = n0^2 = A g k tanh(k h): h deep to either side, half a wave as long as the tank (S. Chandrasekhar, "Hydrodynamic
    and Hydromagnetic Stability", 1961, chapter X; c is what damps the flow, a vortex as wide as the tank and as high as both liquids, which is as much). At
    480 Hz x 20 c is three (in 3D thirteen) times n0, and the liquids creep.
    """
    ratio, side = VARIANTS[setting.variant], BLOCK_CELLS[setting.dimension] * CELL
    wave_number = math.pi / (2.0 * side)
    undamped = math.sqrt((ratio - 1.0) / (ratio + 1.0) * GRAVITY * wave_number * math.tanh(wave_number * side))
    damping = laws.transfer_damping(wave_number, CELL, setting.dt, setting.iterations) if setting.solver == PAPER else 0.0
    return (math.hypot(0.5 * damping, undamped) - 0.5 * damping) / undamped


def overturn_seconds(setting: Setting) -> float:
    """The time in which liquids have to change places: 10 s, three times what they take undamped; or as much longer than that as damped waves grow
    more slowly. (2D, 480 Hz: with 1, 10 and 20 iterations they take 3.4, 5.9 and 9 s, and the shares are 0.92, 0.49 and 0.29. In 3D, where the tank is
    8 cells long, they take 22 s with 20 iterations, and 44 s are allowed: the law of the damping is that of long waves. Liquids that lock stay as they
    are there, and take 21 s in 2D, where 11.6 s are allowed.)"""
    return max(OVERTURN_SECONDS, UNDAMPED_SECONDS / _growth_share(setting))


def _overturn(setting: Setting) -> list[Check]:
    """Heavy liquid above light liquid: they change places. The particles stand on a lattice: random ones push each other apart when
    they settle, and lift the liquids by a twentieth of a cell. So a wave on the interface says where they begin to sink and rise."""
    side = BLOCK_CELLS[setting.dimension] * CELL
    size = [2.0 * side, 3.0 * side, side]
    with make_world(setting, CELL, gravity=True, size=size) as world:
        light, heavy = _light_and_heavy(setting, world)
        places = _lattice([size[0], 2.0 * side, size[2]][: setting.dimension])
        wave = WAVE_CELLS * CELL * np.cos(np.pi * places[:, 0] / size[0])
        is_light = places[:, 1] < side + wave
        for material, rows in ((light, is_light), (heavy, ~is_light)):
            world.add_particles(material, places[rows], volumes=(CELL / LATTICE_PARTICLES) ** setting.dimension)
        watch, is_judged = Watch(world), crushed_share(setting, side) < CRUSHED_MAX
        longest = overturn_seconds(setting) if is_judged else OVERTURN_SECONDS
        energy = highest_energy(
            watch, OVERTURN_SECONDS, setting.dt, longest=longest, is_over=lambda: _order(world, heavy, light) <= 1.0
        )
        order = Check("mean height of the heavy liquid over that of the light one", _order(world, heavy, light), 1.0, kind=Kind.GOAL)
        return [energy, *([order] if is_judged else []), *watch.checks()]


def _order(world: pbmpm.World, heavy: pbmpm.Material, light: pbmpm.Material) -> float:
    heights, indices = world.positions.array()[:, 1], world.material_indices.array()
    means = [float(heights[indices == material.index].mean()) for material in (heavy, light)]
    return means[0] / means[1]


def contrast(setting: Setting) -> list[Check]:
    """H09."""
    return _heavy_block(setting) if setting.material == ELASTIC else _overturn(setting)


# H20

PILE_CELL = 0.1
PILE_CELLS = {2: 6, 3: 4}
PILE_SECONDS = 3.0
STIFFNESSES = (1e-3, 1.0, 1e3)  # times the usual modulus
PILE_PARTICLES = 2  # per axis and cell


def pile(setting: Setting) -> list[Check]:
    """H20: all kinds of matter, soft and stiff, in the same cells; they fall on the floor of a tank."""
    d = setting.dimension
    side = PILE_CELLS[d] * PILE_CELL
    with make_world(setting, PILE_CELL, gravity=True, size=[3.0 * side, 3.0 * side, side]) as world:
        kinds = [world.add_material(matter) for factor in STIFFNESSES for matter in _matter(setting, factor)]
        count = PILE_PARTICLES * PILE_CELLS[d]
        axis = (np.arange(count) + 0.5) / count * side
        corner = np.array(vector(d, side, 0.5 * side, 0.0))
        places = corner + np.stack(np.meshgrid(*[axis] * d), axis=-1).reshape(-1, d)
        places = np.random.default_rng(setting.seed).permutation(places)
        for kind, part in zip(kinds, np.array_split(places, len(kinds)), strict=True):
            world.add_particles(kind, part, volumes=(PILE_CELL / PILE_PARTICLES) ** d)
        watch = Watch(world)
        return [highest_energy(watch, PILE_SECONDS, setting.dt), *watch.checks()]


def _matter(setting: Setting, factor: float) -> list[Parameters]:
    """One of each kind, with a modulus that is so many times the usual one."""
    modulus = factor * sound_modulus(PILE_CELL)
    compressible = setting.solver in (PRIMAL, EXPLICIT)
    return [
        pbmpm.Liquid(bulk_modulus=modulus) if compressible else pbmpm.Liquid(),
        *(kind(young_modulus=modulus) for kind in (pbmpm.Elastic, pbmpm.Sand, pbmpm.Visco)),
    ]


CASES = (
    HardCase(
        "H09",
        "Heavy matter on light matter, 1:10 to 1:10,000",
        "manual of a particle engine: stability degrades past 10:1",
        "the light block keeps J > 0.3 at 1:10, nothing flies above twice the start's height (what the law of the paper's solver lets be pressed"
        " flat: nor faster than that stores); blocks and liquids gain no energy, and liquids change places",
        contrast,
        materials=(LIQUID, ELASTIC),
        variants=tuple(VARIANTS),
        makes_sense=lambda setting: setting.dimension == 2 or VARIANTS[setting.variant] in RATIOS_3D,
    ),
    HardCase(
        "H20",
        "Mixed pile: all kinds of matter in one cell, stiffness from 1e-3 to 1e3",
        "the four materials of the released demo",
        "finite, nothing lost or outside, energy never above the start's",
        pile,
        materials=(MIXED,),
    ),
)
