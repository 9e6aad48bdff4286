"""What the reference cases of water share: the scene, the timed step and the law."""

from __future__ import annotations

import time

import numpy as np

import pbmpm

from ..meter import Meter
from ..scene import FORMAT_NAME, FORMAT_VERSION, LiquidPart, Scene, parse_scene
from ..simulation import RunSettings, Simulation
from . import laws
from .stability import StabilityJudge

GRAVITY = 9.81
PARTICLES_PER_AXIS = 2.0
WATER = "water"
DEFAULT_FEEDBACK: float = LiquidPart.model_fields["volume_feedback"].default


def water_scene(
    name: str,
    description: str,
    cell_size: float,
    box: tuple[float, float],
    body: tuple[float, float],
    seconds: float,
    iterations: int,
    volume_feedback: float = DEFAULT_FEEDBACK,
) -> Scene:
    """Water at rest in the lower left corner of a closed 2D box without friction; sizes are width and height [m]."""
    half = [0.5 * body[0], 0.5 * body[1]]
    return parse_scene(
        {
            "format": FORMAT_NAME,
            "version": FORMAT_VERSION,
            "name": name,
            "description": description,
            "dimension": 2,
            "cell_size": cell_size,
            "gravity": [0.0, -GRAVITY],
            "domain": {"min": [0.0, 0.0], "max": list(box)},
            "seconds": seconds,
            "rate_hz": 240.0,
            "iterations": iterations,
            "materials": {WATER: {"kind": "liquid", "volume_feedback": volume_feedback}},
            "fills": [
                {
                    "shape": {"kind": "box", "position": half, "half_extents": half},
                    "material": WATER,
                    "particles_per_axis": PARTICLES_PER_AXIS,
                }
            ],
        }
    )


def timed_step(simulation: Simulation, meter: Meter, judge: StabilityJudge) -> pbmpm.Stats:
    """One step, with its cost and its figures noted."""
    start = time.perf_counter()
    simulation.step()
    seconds = time.perf_counter() - start
    stats = simulation.world.stats
    meter.add(stats, seconds)
    judge.watch(stats)
    return stats


def modulus_over_density(scene: Scene, settings: RunSettings) -> float:
    """The law's K / rho of a scene's water at these settings [m^2/s^2]."""
    substep = settings.dt / settings.substeps
    relaxation = scene.materials[WATER].relaxation
    return laws.bulk_modulus_over_density(scene.dimension, scene.cell_size, substep, settings.iterations, relaxation)


def centre_height(simulation: Simulation) -> float:
    """Height of the centre of mass above the floor [m]."""
    world = simulation.world
    masses = world.masses.array().astype(np.float64)
    return float(np.sum(masses * world.positions.array()[:, 1]) / masses.sum())


def start_energy(simulation: Simulation) -> float:
    """Energy of water at rest, zero level at the floor [J per metre of depth]."""
    return GRAVITY * simulation.start_mass * centre_height(simulation)
