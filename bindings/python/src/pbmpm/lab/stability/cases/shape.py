"""Cases of shape: elastic bodies twisted, stretched, squashed, spun, and squeezed through a slot."""

from __future__ import annotations

import math

import numpy as np

import pbmpm

from .case import DUAL, ELASTIC, PRIMAL, VISCO, Check, HardCase, Kind, Setting, sound_modulus
from .watch import GRAVITY, Watch, make_world, vector

CELL = 0.1  # [m]

# H13

COLUMN_CELLS = (2, 16)  # width, height: faces are sheared by turns times pi times the width over the height, 0.8
TWIST_TURNS = 2.0  # 720 degrees
TWIST_SECONDS = 2.0
RELEASE_SECONDS = 2.0
LENGTH_ERROR = 0.05
DISC_CELLS = {2: 4.0, 3: 2.0}  # radius
#: Times the usual modulus: the rim moves at a tenth of the speed of sound, so that a spinning disc grows by about a hundredth only.
DISC_STIFFNESS = 9.0
TURNS = 10
TURN_SECONDS = 1.0
SPIN_LOSS = 0.01
TWIST, SPIN, SECOND_ORDER = "twist of 720 degrees", "spinning disc", "spinning disc, BDF2"


def _length(world: pbmpm.World) -> float:
    """Along the body's own longest axis, since a column that buckled under its twist turns when it is let go: sqrt(12) standard
    deviations of an even bar."""
    spread = np.cov(world.positions.array().astype(float).T, bias=True)
    return math.sqrt(12.0 * float(np.linalg.eigvalsh(spread)[-1]))


def twist(setting: Setting) -> list[Check]:
    """A column between two plates that hold it; one turns by 360 degrees, the other by as much the other way."""
    width, height = (cells * CELL for cells in COLUMN_CELLS)
    with make_world(setting, CELL) as world:
        half = [0.5 * width, 0.5 * height, 0.5 * width]
        world.fill(pbmpm.Box([0.0] * 3, half), world.add_material(setting.parameters(CELL)), seed=setting.seed)
        plates = [
            world.add_collider(
                pbmpm.Box([0.0, side * (0.5 * height + CELL), 0.0], [2.0 * width, CELL, 2.0 * width]),
                kinematic=True,
                friction=pbmpm.Friction.STICK,
            )
            for side in (-1, 1)
        ]
        watch, length = Watch(world), _length(world)
        steps = round(TWIST_SECONDS / setting.dt)
        for step in range(steps):
            for plate, side in zip(plates, (-1, 1), strict=True):
                angle = side * TWIST_TURNS * math.pi * (step + 1) / steps
                turn = (0.0, math.sin(0.5 * angle), 0.0, math.cos(0.5 * angle))
                plate.move([0.0, side * (0.5 * height + CELL), 0.0], turn)
            watch.step(setting.dt)
        for plate in plates:
            plate.destroy()
        watch.run(RELEASE_SECONDS, setting.dt)
        error = abs(_length(world) / length - 1.0)
        return [Check("change of length", error, LENGTH_ERROR, kind=Kind.GOAL), *watch.checks()]


def angular_momentum(world: pbmpm.World) -> float:
    """About the last axis and the origin [kg m^2/s]. The affine velocities take part: the quadratic splines spread a particle
    over dx^2/4 per axis."""
    masses = world.masses.array().astype(float)
    x, v = (array.astype(float) for array in (world.positions.array(), world.velocities.array()))
    spin = world.affine_velocities.array().astype(float)
    curl = spin[:, 1, 0] - spin[:, 0, 1]
    return float(masses @ (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0] + 0.25 * world.cell_size**2 * curl))


def kept_spin(setting: Setting, rate: float, seconds: float) -> float:
    """Share of the angular momentum that the solver's law leaves.

    Backward Euler moves x' = x + dt v' with sum x' x m (v' - v) = 0, so L changes by dt sum v' x m v per step. In a rigid turn v' is v
    turned by w dt: dw/dt = -w^3 dt for small w dt, and w(t) = w0 / sqrt(1 + 2 w0^2 dt t). The second order formula and the solvers
    that apply symmetric stresses at the start of the step keep all.
    """
    if setting.solver != PRIMAL or setting.variant == SECOND_ORDER:
        return 1.0
    return 1.0 / math.sqrt(1.0 + 2.0 * rate**2 * setting.dt * seconds)


def spin(setting: Setting) -> list[Check]:
    """A disc (3D: a ball) that turns freely."""
    d, rate = setting.dimension, 2.0 * math.pi / TURN_SECONDS
    material = setting.parameters(CELL, young_modulus=DISC_STIFFNESS * sound_modulus(CELL))
    with make_world(setting, CELL) as world:
        world.fill(pbmpm.Sphere([0.0] * d, DISC_CELLS[d] * CELL), world.add_material(material), seed=setting.seed)
        turning = np.zeros((d, d))
        turning[1, 0], turning[0, 1] = rate, -rate
        world.velocities = world.positions.copy() @ turning.T
        world.affine_velocities = np.tile(turning, (len(world), 1, 1))
        if setting.variant == SECOND_ORDER:
            world.integrator = pbmpm.Integrator.BDF2
        watch, start, lost, gained = Watch(world), angular_momentum(world), 0.0, 0.0
        for step in range(round(TURNS * TURN_SECONDS / setting.dt)):
            watch.step(setting.dt)
            law = kept_spin(setting, rate, (step + 1) * setting.dt)
            share = angular_momentum(world) / start
            lost, gained = max(lost, 1.0 - share / law), max(gained, share - 1.0)
        return [
            Check("angular momentum lost beyond the law", lost, SPIN_LOSS, kind=Kind.GOAL),
            Check("angular momentum gained", gained, SPIN_LOSS),
            *watch.checks(),
        ]


def turn(setting: Setting) -> list[Check]:
    """H13."""
    return twist(setting) if setting.variant == TWIST else spin(setting)


# H14

BAR_CELLS = 4
BAR_SPACING = 0.05  # cells along the first axis: stretched ten times still two particles per cell
FACTORS = {"stretched to 10": 10.0, "squashed to 0.05": 0.05}
STRAIN_MIN = 0.01  # of the material: the library's default of 0.1 would forget how flat it was
RECOVERY_SECONDS = 5.0
EXTENT_ERROR = 0.02
TORN_CELLS = 2.0  # neighbours further apart than this are torn


def deform(setting: Setting) -> list[Check]:
    """H14: a bar let go from ten times its length, or a twentieth."""
    d, factor = setting.dimension, FACTORS[setting.variant]
    with make_world(setting, CELL) as world:
        along = np.arange(-0.5 * BAR_CELLS, 0.5 * BAR_CELLS, BAR_SPACING) + 0.5 * BAR_SPACING
        across = np.arange(-0.5 * BAR_CELLS if d == 2 else -1.0, 0.5 * BAR_CELLS if d == 2 else 1.0, 0.5) + 0.25
        lattice = np.stack(np.meshgrid(along, *[across] * (d - 1), indexing="ij"), axis=-1) * CELL
        rest = lattice.reshape(-1, d)
        volume = BAR_SPACING * 0.5 ** (d - 1) * CELL**d
        material = world.add_material(setting.parameters(CELL, strain_min=STRAIN_MIN))
        ids = world.add_particles(material, rest * [factor, 1.0, 1.0][:d], volumes=volume)
        world.set(pbmpm.Field.DEFORMATION, np.tile(np.diag([factor, 1.0, 1.0][:d]), (len(rest), 1, 1)))
        watch = Watch(world)
        watch.run(RECOVERY_SECONDS, setting.dt)
        places = world.positions.copy()[world.find(ids)].reshape(lattice.shape)
        extent = math.sqrt(((places - places.mean(axis=tuple(range(d)))) ** 2).sum(axis=-1).mean())
        nominal = math.sqrt(((lattice - lattice.mean(axis=tuple(range(d)))) ** 2).sum(axis=-1).mean())
        gaps = np.linalg.norm(np.diff(places, axis=0), axis=-1)
        torn = int((gaps > TORN_CELLS * CELL).sum())
        return [
            Check(f"change of size ({torn} of {gaps.size} neighbours torn)", abs(extent / nominal - 1.0), EXTENT_ERROR, kind=Kind.GOAL),
            *watch.checks(),
        ]


# H15

BODY_CELLS = {2: 8, 3: 4}
SLOT_SHARE = 0.25  # of the body's width
PLATE_CELLS = 3.0  # thickness of what has the slot
PUSH_SECONDS = 2.0
REST_SECONDS = 2.0
PUSHED_SHARE = 0.5  # of the body's height that the piston goes down


def squeeze(setting: Setting) -> list[Check]:
    """H15: a piston presses a body against a slot that is a quarter as wide. At the end what has not passed has stopped."""
    d = setting.dimension
    side = BODY_CELLS[d] * CELL
    floor, slot = 2.0 * side, SLOT_SHARE * side  # the plate's upper side; the slot's width
    with make_world(setting, CELL, gravity=True, size=[side, 2.0 * floor, side]) as world:
        half = vector(d, 0.25 * (side - slot), 0.5 * PLATE_CELLS * CELL, side)
        plates = [
            world.add_collider(pbmpm.Box(vector(d, x, floor - half[1], 0.5 * side), half))
            for x in (half[0], side - half[0])
        ]
        body = pbmpm.Box(vector(d, 0.5 * side, floor + 0.5 * side, 0.5 * side), [0.5 * side] * d)
        world.fill(body, world.add_material(setting.parameters(CELL)), seed=setting.seed)
        top = floor + side + CELL
        piston = world.add_collider(pbmpm.Box(vector(d, 0.5 * side, top, 0.5 * side), vector(d, side, CELL, side)), kinematic=True)
        watch, steps = Watch(world), round(PUSH_SECONDS / setting.dt)
        for step in range(steps):
            piston.move(vector(d, 0.5 * side, top - PUSHED_SHARE * side * (step + 1) / steps, 0.5 * side))
            watch.step(setting.dt)
        watch.run(REST_SECONDS, setting.dt)
        inside = sum(len(plate.query()) for plate in (*plates, piston))
        above = world.positions.array()[:, 1] > floor - 2.0 * half[1]
        speeds = np.linalg.norm(world.velocities.array()[above], axis=1)
        return [
            Check("particles inside the plates or the piston", inside, 0),
            # What falls by a cell is as fast; what has stopped is slower.
            Check("root mean square speed of what has not passed [m/s]", float(np.sqrt((speeds**2).mean())) if above.any() else 0.0, math.sqrt(2.0 * GRAVITY * CELL)),
            *watch.checks(),
        ]


CASES = (
    HardCase(
        "H13",
        "Column twisted by 720 degrees and let go; spinning disc",
        "twisting column of smoothed particles; twist tests of Newton and barrier methods",
        "finite; back to 5 % of its length; angular momentum kept to 1 % over 10 turns, of what backward Euler leaves",
        turn,
        materials=(ELASTIC,),
        variants=(TWIST, SPIN, SECOND_ORDER),
        makes_sense=lambda setting: {
            TWIST: setting.dimension == 3,
            SPIN: True,
            SECOND_ORDER: setting.solver == PRIMAL,  # the others have no such formula
        }[setting.variant],
        rate_hz=120.0,
        iterations=10,
    ),
    HardCase(
        "H14",
        "Bar let go from ten times its length, and a twentieth",
        "extreme compression of vertex block descent",
        "back to its size within 2 %; torn neighbours are counted",
        deform,
        materials=(ELASTIC,),
        variants=tuple(FACTORS),
        iterations=20,
    ),
    HardCase(
        "H15",
        "Squeezed through a slot of a quarter of its width",
        "squeeze-out of incremental potential contact",
        "finite; none inside an obstacle; what has not passed has stopped",
        squeeze,
        materials=(ELASTIC, VISCO),
    ),
)
