"""Hard cases of emission: more matter than there is room for."""

from __future__ import annotations

import math

import numpy as np

import pbmpm

from .case import EXPLICIT, LIQUID, Check, HardCase, Kind, KnownFailure, Setting
from .watch import Watch, make_world, vector

CELL = 0.1
JET, EVERYWHERE = "jet", "everywhere"
IN_SMALL_BOX = ", small box"
#: How long the emitter works [s], and the side of the box [cells]: about as many particles in 2D as in 3D.
SECONDS = {"": 30.0, IN_SMALL_BOX: 10.0}
SIDE = {"": {2: 12, 3: 6}, IN_SMALL_BOX: {2: 6, 3: 4}}
SMALL_VARIANTS = (JET + IN_SMALL_BOX, EVERYWHERE + IN_SMALL_BOX)
#: The emitter could fill the box so often in that time.
FILLINGS = 10.0
SPEED = 2.0
#: J below this is overpressure: where the emission of the released code led to.
RATIO_MIN = 0.5
#: Of so many particles in a hundred J may be lower: a jet that hits a wall crushes some for a moment.
CRUSHED_PERCENT = 1.0
#: What the matter claims at its J, over the volume of the box. Soft liquid is compressed by its own weight, and the more of it has room.
CLAIM_MAX = 1.2


def _emitter(setting: Setting, world: pbmpm.World, material: pbmpm.Material, side: float, seconds: float) -> pbmpm.Emitter:
    dimension = setting.dimension
    rate = FILLINGS * side**dimension / seconds
    centre = [0.5 * side] * dimension
    if setting.variant.startswith(EVERYWHERE):
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
    box = IN_SMALL_BOX if setting.variant in SMALL_VARIANTS else ""
    side, seconds = SIDE[box][setting.dimension] * CELL, SECONDS[box]
    with make_world(setting, CELL, gravity=True, size=[side] * setting.dimension) as world:
        emitter = _emitter(setting, world, world.add_material(setting.parameters(CELL)), side, seconds)
        watch = Watch(world)
        ratio, told = math.inf, 0
        for _ in range(round(seconds / setting.dt)):
            stats = watch.step(setting.dt)
            told += sum(event.count for event in world.events if event.kind is pbmpm.EventKind.EMISSION_REFUSED)
            if stats.particle_count:
                ratios = world.volume_ratios.copy()
                ratio = min(ratio, float(np.percentile(ratios, CRUSHED_PERCENT)))
        status = emitter.status
        due = emitter.rate * seconds / (CELL / 2) ** setting.dimension
        return [
            Check("smallest J of 99 particles in 100", ratio, RATIO_MIN, at_least=True, kind=Kind.GOAL),
            Check("volume claimed at the end over that of the box", status.emitted * FILLINGS / due * ratios.mean(), CLAIM_MAX),
            Check("refusals that no event told of", abs(status.refused - told), 0),
            Check("particles that were due and neither emitted nor refused", abs(due - status.emitted - status.refused), 1.0),
            *watch.checks(),
        ]


CASES = (
    HardCase(
        "H18",
        "Emitter into a full box",
        "severe overpressure in the released demo before it learned to stop",
        "for 30 s, ten times what the box holds: J >= 0.5 but for one particle in 100, no more matter than there is room for, every "
        "refusal counted",
        overfill,
        materials=(LIQUID,),
        variants=(JET, EVERYWHERE),
        fixed_variants=(JET, EVERYWHERE),
        map_variants=SMALL_VARIANTS,
        known_failures=(KnownFailure("sound travels two cells per step at 60 Hz", (EXPLICIT,)),),
    ),
)
