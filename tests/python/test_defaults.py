"""What a stranger gets who sets nothing: the solver that looks right, from one place, and a tank of water that holds its level."""

from __future__ import annotations

import math

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.scenes.scene import SolverPart
from pbmpm.lab.simulation import RunSettings
from pbmpm.settings import DEFAULTS


def test_the_solver_is_the_convergent_one_everywhere() -> None:
    with pbmpm.World(2, 0.1, capacity=10) as world:
        assert world.solver is DEFAULTS.solver is pbmpm.Solver.CONVERGENT
        assert (world.substeps, world.iterations) == (DEFAULTS.substeps, DEFAULTS.iterations)
    assert SolverPart().solver == RunSettings(60.0, 1, 5).solver == "convergent"


def test_the_modulus_of_a_body_acts() -> None:
    """The tip of a beam that is clamped at one end sinks the less, the stiffer it is."""
    tips = []
    for young in (1e5, 1e6):
        with pbmpm.World(2, 0.05, gravity=(0, -9.81), capacity=1000, threads=1) as world:
            beam = world.add_material(pbmpm.Elastic(young_modulus=young))
            world.fill(pbmpm.Box((0.5, 0), (0.5, 0.1)), beam)
            world.add_collider(pbmpm.Box((-0.1, 0), (0.2, 0.3)), friction=pbmpm.Friction.STICK)
            lowest = 0.0
            for _ in range(30):
                world.step(1 / 60)
                lowest = min(lowest, float(world.positions.array()[:, 1].min()))
            tips.append(lowest + 0.1)
    assert tips[1] > 0.5 * tips[0]


@pytest.mark.parametrize("pour", [False, True], ids=["filled", "poured"])
def test_a_tank_of_water_holds_its_level_at_60_hz(dimension: int, pour: bool) -> None:
    cell, width, depth, flat = 0.05, 0.5, 0.3, [0.25] * (dimension - 2)
    domain = ([0.0] * dimension, [width, 1.0] + [width] * (dimension - 2))
    with pbmpm.World(dimension, cell, gravity=[0, -9.81, 0][:dimension], domain=domain) as world:
        water, seconds = world.add_material(pbmpm.Liquid()), 2.0
        if pour:
            area, speed = (0.1 if dimension == 2 else math.pi * 0.05**2), 1.5
            budget = round(depth * width ** (dimension - 1) / (cell / 2) ** dimension)
            spout = pbmpm.Sphere([0.25, 0.7, *flat], 0.05)
            world.add_emitter(spout, water, area * speed, region=pbmpm.Region.DISC, speed=speed, budget=budget)
            seconds += depth * width ** (dimension - 1) / (area * speed)
        else:
            world.fill(pbmpm.Box([0.25, depth / 2, *flat], [width / 2, depth / 2] + [width / 2] * (dimension - 2)), water)
        for _ in range(math.ceil(60 * seconds)):
            world.step(1 / 60)
        true = world.stats.mass / 1000 / width ** (dimension - 1)
        assert true == pytest.approx(depth, rel=0.02)
        across = [[x, 0, z][:dimension] for x in np.linspace(0.1, 0.4, 7) for z in np.linspace(0.1, 0.4, 7 if dimension == 3 else 1)]
        levels = []
        for _ in range(60):  # it still sloshes
            world.step(1 / 60)
            levels.append(world.query_heights(across).mean())
        assert np.mean(levels) == pytest.approx(true, rel=0.03)
