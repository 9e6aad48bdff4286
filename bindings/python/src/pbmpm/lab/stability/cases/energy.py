"""Case of energy: elastic bodies in impossible states may keep or lose energy, but never gain any."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import pbmpm

from .case import ELASTIC, PHYSICAL_SOLVERS, Check, HardCase, Setting, sound_modulus
from .strain import BLOCK_CELLS, CELL, SCRAMBLE_RANDOM, scrambled
from .watch import ENERGY_ROUNDING, Watch, make_world

# H22

ENERGY_SECONDS = 3.0
ENERGY_STEPS = 360  # at most: what grows, grows by the step; sound crosses the body ten times in so many at 480 Hz
SQUASHED = "squashed to a tenth"
SQUASHED_HEIGHT = 0.1
REFLECTED = "reflected F"
STIFF = 1e4  # times the modulus of the other variants: sound travels 100 times as far
NEO_HOOKEAN_KNEE = 0.1  # J below which ln J is continued by its second-order expansion
VARIANTS: dict[str, tuple[str, float, pbmpm.ElasticModel]] = {
    f"{state}{', stiff' if factor > 1 else ''}{', neo-Hookean' if model is pbmpm.ElasticModel.NEO_HOOKEAN else ''}": (
        state,
        factor,
        model,
    )
    for model in pbmpm.ElasticModel
    for factor in (1.0, STIFF)
    for state in (SCRAMBLE_RANDOM, REFLECTED, SQUASHED)
}


def energy_density(material: pbmpm.Elastic, deformations: npt.NDArray[np.floating]) -> npt.NDArray[np.float64]:
    """Elastic energy per rest volume [J/m^d] of each F, in double precision, as material.h defines it."""
    matrices = np.asarray(deformations, dtype=np.float64)
    modulus, ratio = material.young_modulus, material.poisson_ratio
    mu = modulus / (2.0 * (1.0 + ratio))
    lam = modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio))
    volumes = np.linalg.det(matrices)
    if material.elastic_model is pbmpm.ElasticModel.FIXED_COROTATED:
        singular = np.linalg.svd(matrices, compute_uv=False)
        # The nearest rotation, not reflection: where det F < 0 the smallest singular value counts as negative.
        singular[:, -1] *= np.where(volumes < 0.0, -1.0, 1.0)
        return mu * ((singular - 1.0) ** 2).sum(axis=1) + 0.5 * lam * (volumes - 1.0) ** 2
    beyond = np.minimum(volumes / NEO_HOOKEAN_KNEE - 1.0, 0.0)
    logarithms = np.log(np.maximum(volumes, NEO_HOOKEAN_KNEE)) + beyond - 0.5 * beyond**2
    squares = (matrices**2).sum(axis=(1, 2))
    return 0.5 * mu * (squares - matrices.shape[-1]) - mu * logarithms + 0.5 * lam * logarithms**2


def mechanical_energy(world: pbmpm.World, material: pbmpm.Elastic) -> float:
    """Elastic and kinetic energy [J] of a world of one elastic material.

    The affine velocities C take part: the quadratic splines spread a particle over dx^2/4 per axis, so they hold
    m dx^2/8 |C|^2.
    """
    masses = world.masses.array().astype(np.float64)
    speeds = (world.velocities.array().astype(np.float64) ** 2).sum(axis=1)
    spins = (world.affine_velocities.array().astype(np.float64) ** 2).sum(axis=(1, 2))
    kinetic = 0.5 * masses @ (speeds + 0.25 * world.cell_size**2 * spins)
    elastic = (masses / material.density) @ energy_density(material, world.deformations.array())
    return float(kinetic + elastic)


def gain_energy(setting: Setting) -> list[Check]:
    """H22: a free block in an impossible state, alone in space without gravity."""
    d = setting.dimension
    state, factor, model = VARIANTS[setting.variant]
    material = setting.parameters(CELL, young_modulus=factor * sound_modulus(CELL), elastic_model=model)
    assert isinstance(material, pbmpm.Elastic)  # the case has no other material
    with make_world(setting, CELL) as world:
        half = [0.5 * BLOCK_CELLS[d] * CELL] * d
        world.fill(pbmpm.Box([0.3 * CELL] * d, half), world.add_material(material), seed=setting.seed)
        if state == SQUASHED:
            world.positions = world.positions.copy() * [1.0, SQUASHED_HEIGHT, 1.0][:d]
            squash = np.diag([1.0, SQUASHED_HEIGHT, 1.0][:d])
            world.set(pbmpm.Field.DEFORMATION, np.tile(squash, (len(world), 1, 1)))
        else:
            world.set(pbmpm.Field.DEFORMATION, scrambled(state, len(world), d, setting.seed))
        watch, start, peak = Watch(world), mechanical_energy(world, material), 0.0
        for _ in range(min(round(ENERGY_SECONDS / setting.dt), ENERGY_STEPS)):
            watch.step(setting.dt)
            peak = max(peak, mechanical_energy(world, material) / start)
        return [
            Check("highest energy over the start's", peak, 1.0 + ENERGY_ROUNDING),
            Check("particles deleted", world.stats.deleted_total, 0),
            *watch.checks(),
        ]


CASES = (
    HardCase(
        "H22",
        "Elastic bodies in impossible states never gain energy",
        "truncated solves of stiff bodies that explode",
        "elastic and kinetic energy never above the start's",
        gain_energy,
        materials=(ELASTIC,),
        variants=tuple(VARIANTS),
        solvers=PHYSICAL_SOLVERS,  # with the paper's there is no elastic energy
    ),
)
