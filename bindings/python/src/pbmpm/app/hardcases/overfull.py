"""Hard cases of emission: more matter than there is room for."""

from __future__ import annotations

import math

import pbmpm

from .case import EXPLICIT, LIQUID, Check, HardCase, KnownFailure, Setting
from .watch import Watch, make_world, vector

CELL = 0.1
SECONDS = 30.0
#: Side of the box [cells]: about as many particles in 2D as in 3D.
SIDE = {2: 16, 3: 8}
#: The emitter could fill the box so often in that time.
FILLINGS = 10.0
SPEED = 2.0
#: J below this is overpressure: where the emission of the released code led to.
RATIO_MIN = 0.5


def _emitter(setting: Setting, world: pbmpm.World, material: pbmpm.Material, side: float) -> pbmpm.Emitter:
    dimension = setting.dimension
    rate = FILLINGS * side**dimension / SECONDS
    centre = [0.5 * side] * dimension
    if setting.variant == "everywhere":
        return world.add_emitter(pbmpm.Box(centre, centre), material, rate, seed=setting.seed)
    nozzle = pbmpm.Sphere(vector(dimension, 0.2 * side, 0.5 * side, 0.5 * side), 0.2 * side)
    return world.add_emitter(
        nozzle,
        material,
        rate,
        region=pbmpm.Region.DISC,
        speed=SPEED,
        direction=vector(dimension, 1.0),
        seed=setting.seed,
    )


def overfill(setting: Setting) -> list[Check]:
    """H18: an emitter goes on long after the box is full."""
    side = SIDE[setting.dimension] * CELL
    with make_world(setting, CELL, gravity=True, size=[side] * setting.dimension) as world:
        emitter = _emitter(setting, world, world.add_material(setting.parameters(CELL)), side)
        watch = Watch(world)
        ratio, told = math.inf, 0
        for _ in range(round(SECONDS / setting.dt)):
            stats = watch.step(setting.dt)
            told += sum(event.count for event in world.events if event.kind is pbmpm.EventKind.EMISSION_REFUSED)
            if stats.particle_count:
                ratio = min(ratio, float(world.volume_ratios.array().min()))
        status = emitter.status
        due = emitter.rate * SECONDS / (CELL / 2) ** setting.dimension
        return [
            Check("smallest J", ratio, RATIO_MIN, at_least=True),
            Check("particles for which there was room, over what fills the box", status.emitted * FILLINGS / due, 1.2),
            Check("refusals that no event told of", abs(status.refused - told), 0),
            Check("particles that were due and neither emitted nor refused", abs(due - status.emitted - status.refused), 1.0),
            *watch.checks(),
        ]


CASES = (
    HardCase(
        "H18",
        "Emitter into a full box",
        "severe overpressure in the released demo before it learned to stop",
        "for 30 s, ten times what the box holds: J >= 0.5, no more matter than fills the box, every refusal counted",
        overfill,
        materials=(LIQUID,),
        variants=("jet", "everywhere"),
        known_failures=(KnownFailure("sound travels two cells per step at 60 Hz", (EXPLICIT,)),),
    ),
)
