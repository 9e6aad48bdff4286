"""What the liquid cases share: scenes, energies, and the moduli that solvers act with."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...parsing import parse_scene
from ...scenes.scene import FORMAT_NAME, FORMAT_VERSION, LiquidPart, Scene
from ...simulation import RunSettings, Simulation
from .. import laws
from ..case import COURANT_SHARES, Setting

GRAVITY = 9.81
DENSITY = 1000.0
PARTICLES_PER_AXIS = 2.0
WATER = "water"
DEFAULT_FEEDBACK: float = LiquidPart.model_fields["volume_feedback"].default

SOUND_TO_FLOW = 10.0
"""Speed of sound over the fastest flow, where a solver cannot do an incompressible liquid: densities then vary by 1 %.
A setting may say otherwise."""

WATER_SOUND = 1480.0
"""Speed of sound in real water [m/s]."""


def box_fill(lower: tuple[float, ...], upper: tuple[float, ...], **more: Any) -> dict[str, Any]:
    """A box of water between two corners [m]."""
    centre = [0.5 * (low + high) for low, high in zip(lower, upper)]
    half = [0.5 * (high - low) for low, high in zip(lower, upper)]
    shape = {"kind": "box", "position": centre, "half_extents": half}
    return {"shape": shape, "material": WATER, "particles_per_axis": PARTICLES_PER_AXIS, **more}


def water_scene(
    name: str,
    cell_size: float,
    fills: list[dict[str, Any]],
    *,
    domain: tuple[tuple[float, ...], tuple[float, ...]] | None,
    gravity: float = GRAVITY,
    water: dict[str, float] | None = None,
    colliders: list[dict[str, Any]] | None = None,
    dimension: int = 2,
    friction: float = 0.0,
) -> Scene:
    """Water in a closed box or in free space. Rate, iterations and solver come with the setting."""
    down = [0.0, -gravity, 0.0][:dimension]
    walls = None if domain is None else {"min": list(domain[0]), "max": list(domain[1]), "friction": friction}
    return parse_scene(
        {
            "format": FORMAT_NAME,
            "version": FORMAT_VERSION,
            "name": name,
            "dimension": dimension,
            "cell_size": cell_size,
            "gravity": down,
            "domain": walls,
            "seconds": 1.0,
            "materials": {WATER: {"kind": "liquid", "density": DENSITY, **(water or {})}},
            "fills": fills,
            "colliders": colliders or [],
        }
    )


def stiff_enough(setting: Setting, fastest: float) -> dict[str, float]:
    """The bulk modulus [Pa] for solvers that need one; ``fastest``: the largest speed of the flow [m/s].

    The speed of sound is sqrt(K / rho).
    """
    if setting.solver in ("explicit", "primal"):
        return {"bulk_modulus": DENSITY * ((setting.sound or SOUND_TO_FLOW) * fastest) ** 2}
    return {}


def explicit_settings(
    fastest: float, cell_size: float, cells: int, sounds: tuple[float, ...] = (5.0, 10.0, 20.0)
) -> list[Setting]:
    """The explicit solver with weakly compressible water of several speeds of sound, each a little above and below the
    rate at which sound travels a cell per step; ``fastest`` as for ``stiff_enough``."""
    return [
        Setting("explicit", float(math.ceil(share * sound * fastest / cell_size)), 1, cells, sound=sound)
        for sound in sounds
        for share in COURANT_SHARES
    ]


def paper_modulus_over_density(scene: Scene, settings: RunSettings) -> float:
    """K / rho [m^2/s^2] that the paper's solver acts with at these settings."""
    relaxation = scene.materials[WATER].relaxation
    substep = settings.dt / settings.substeps
    return laws.bulk_modulus_over_density(scene.dimension, scene.cell_size, substep, settings.iterations, relaxation)


def centre_height(simulation: Simulation) -> float:
    """Height of the centre of mass above the floor [m]."""
    world = simulation.world
    masses = world.masses.array().astype(np.float64)
    return float(np.sum(masses * world.positions.array()[:, 1]) / masses.sum())


def rest_energy(simulation: Simulation) -> float:
    """Energy of water at rest, zero level at the floor [J]."""
    return GRAVITY * simulation.start_mass * centre_height(simulation)


def kinetic_energy(simulation: Simulation, affine: bool = False) -> float:
    """Of the particles' translation [J]; ``affine`` adds that of their velocity gradients, m dx^2/8 |C|^2, since MLS-MPM's
    quadratic splines spread a particle's mass with a variance of dx^2/4 per axis."""
    world = simulation.world
    masses = world.masses.array().astype(np.float64)
    total = float(np.sum(masses[:, None] * world.velocities.array().astype(np.float64) ** 2))
    if affine:
        spread = world.cell_size**2 / 4.0
        total += spread * float(np.sum(masses[:, None, None] * world.affine_velocities.array().astype(np.float64) ** 2))
    return 0.5 * total
