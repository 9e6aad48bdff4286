"""Liquids and solids in one world with the dual solver, at 60 Hz x 5 as a game would run it: bodies keep shape and volume, liquids keep theirs.

The limits lie between what is measured and what is without the guess and the rounds that solids take part in (src/solvers/dual/pressure_guess.h, src/solvers/dual/rounds.h)."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.accuracy.elastic.floating import FloatingBlock
from pbmpm.lab.loading import load_scene
from pbmpm.lab.simulation import RunSettings, Simulation


def test_a_stiff_block_floats_as_a_block() -> None:
    """Median strain 0.015, without 0.15; depth 8 % off, of which a converged solution on these cells keeps most, without 23 %."""
    floated = FloatingBlock().float_up(RunSettings(rate_hz=60.0, substeps=1, iterations=5, threads=1, solver="dual"))
    assert not floated.reasons
    assert floated.strain is not None and floated.strain < 0.04
    assert floated.error is not None and floated.error < 0.16
    assert floated.water_height == pytest.approx(floated.water_truth, rel=0.03)


def test_the_workshop_at_a_games_rate(root: Path) -> None:
    """After 2 s the mean J of water, jelly and clay is 0.88, 0.87 and 1.00, and the worst stretches lie in [0.2, 2.0]. Without: 0.68,
    0.28, 0.99 and [0.1, 15]; 0.1 is the bound of the strain. The water by itself has 0.88. Sand has 1.2, for it remembers what came apart where it
    was stirred; without volume correction 0.96, and 0.81 without the guess and the rounds."""
    scene = load_scene(root / "samples" / "scenes" / "workshop_2d.json")
    with Simulation(scene, RunSettings.of(scene, threads=1, solver="dual", rate_hz=60.0, iterations=5)) as simulation:
        for _ in range(120):
            simulation.step()
        world, materials = simulation.world, simulation.frame().materials
        ratio, stretch = np.array(world.volume_ratios), np.linalg.svd(np.array(world.deformations), compute_uv=False)
    mean = {name: ratio[materials == row].mean() for row, name in enumerate(scene.materials)}
    solid = np.isin(materials, [row for row, name in enumerate(scene.materials) if name != "water"])
    assert mean["water"] > 0.8
    assert min(mean["jelly"], mean["sand"], mean["clay"]) > 0.75
    assert max(mean["water"], mean["jelly"], mean["clay"]) < 1.1
    assert mean["sand"] < 1.5  # of at most 3 for each grain
    assert stretch[solid].max() < 5.0
    assert np.percentile(stretch[solid], 1) > 0.4


#: 24 moduli apart by 1e-5 each decide it by their rounding: 7 of them gained 9 % before pressures flowed over links, 11 do since.
BY_CHANCE = pytest.mark.xfail(strict=False, reason="a third to a half of such scenes gains 9 % of its energy")


@pytest.mark.parametrize(("iterations", "modulus", "yields_at"), [(14, 4.0e6, 0.001), pytest.param(18, 2.0e6, 0.003, marks=BY_CHANCE), (20, 4.0e6, 0.0023), (22, 1.0e6, 0.001)])
def test_clay_that_heavy_liquid_runs_into_gains_no_energy(iterations: int, modulus: float, yields_at: float) -> None:
    """A column of liquid beside stiff clay collapses in a closed box, at 30 Hz. Where they meet the sketch of the joint solver is far from done.

    When it pushed the liquid all the same, that was thrown up to the ceiling: 26, 43, 40 and 33 % of the energy that the scene can turn over came out of nothing. A closed scene may
    gain 2 %, as in tests/random_scenes.py, whose seed 396074 this is.
    """
    cell, gravity = 0.016338593, 3.2056
    size = 18 * cell
    with pbmpm.World(2, cell, gravity=[0.0, -gravity], iterations=iterations, threads=1, domain=([0.0, 0.0], [size, size]), domain_friction=0.5) as world:
        clay = pbmpm.Visco(density=2310.325, young_modulus=modulus, poisson_ratio=0.3, yield_strain=yields_at)
        world.fill(pbmpm.Box([0.0534536, 0.1018584], [0.0336192, 0.0587516]), world.add_material(clay), velocity=[0.1246024, 0.0])
        world.fill(pbmpm.Box([0.2251707, 0.1266521], [0.0677441, 0.0538]), world.add_material(pbmpm.Liquid(density=5866.8129)))
        first = world.stats
        turned = first.kinetic_energy + first.mass * gravity * size
        for _ in range(30):
            world.step(1.0 / 30.0)
            gain = world.stats.kinetic_energy + world.stats.potential_energy - first.kinetic_energy - first.potential_energy
            assert gain < 0.02 * turned


#: Young's modulus and density of a jelly, and the yield strain of a clay.
LYING = {"stiff": (1e7, 2500.0, 0.0), "clay": (1e5, 1800.0, 0.05), "jelly": (1e5, 1500.0, 0.0)}


@pytest.mark.parametrize("off", [0.0, 0.5, 0.8])
@pytest.mark.parametrize("body", LYING)
def test_no_water_is_lost_below_a_body_a_cell_above_the_floor(body: str, off: float) -> None:
    """A pool of 20 cells holds a square of 8 cells, which starts with a cell of water below it. From the fifth second to the eighth it has the level that both volumes make.
    The tank lies so many cells off the grid.

    Water below the body flowed through the floor: the parts of the joint solver had laws of walls of their own. On the grid the pool lost a third of a cell, off it up to
    three. It loses up to 0.15 now; a quarter of a cell is little over one percent. A stiff body on the grid moves the pool at 3 to 6 mm/s; a pool
    alone may move at 10. How calm others are the field cases `over_the_floor` judge.
    """
    cell, width, depth, half = 0.025, 0.6, 0.5, 0.1
    start = off * cell
    modulus, density, yields_at = LYING[body]
    with pbmpm.World(2, cell, gravity=[0.0, -9.81], iterations=5, threads=1, domain=([start, start], [start + width, start + 2.5 * depth])) as world:
        kind = pbmpm.Visco(density=density, young_modulus=modulus, yield_strain=yields_at) if yields_at else pbmpm.Elastic(density=density, young_modulus=modulus)
        water, solid = world.add_material(pbmpm.Liquid()), world.add_material(kind)
        places = np.stack(np.meshgrid(*(np.arange(cell / 4, size, cell / 2) for size in (width, depth)), indexing="ij"), -1).reshape(-1, 2)
        inside = (abs(places - (width / 2, half + cell)) < half).all(1)
        world.add_particles(water, start + places[~inside])
        world.add_particles(solid, start + places[inside])
        levels, square = [], []
        for step in range(8 * 60):
            world.step(1.0 / 60.0)
            if step >= 5 * 60:
                levels.append(2 * (world.positions.array()[:, 1].mean() - start))
                square.append((world.velocities.array() ** 2).sum(1).mean())
        assert abs(np.mean(levels) - depth) < 0.25 * cell
        if body == "stiff" and off == 0.0:
            assert np.sqrt(np.mean(square)) < 0.01


def test_ten_iterations_calm_a_pool_around_a_heavy_block() -> None:
    """A block of twice water's density is let go in the middle of a square pool of 24 cells, and sinks. Speeds are of
    the fifth and sixth second.

    Six starts have 0.016 to 0.064 m/s each with AVX-512, AVX2 and SSE4. Where the guess took three steps, not N, all
    the water heaved: 0.15 to 0.26.
    """
    cell, cells, half = 0.04, 24, 4
    speeds = []
    for start in range(3):
        domain = ([0.0, 0.0], [cells * cell, 2 * cells * cell])
        with pbmpm.World(2, cell, gravity=[0.0, -9.81], iterations=10, threads=1, domain=domain) as world:
            water = world.add_material(pbmpm.Liquid())
            block = world.add_material(pbmpm.Elastic(density=2000.0, young_modulus=1e6))
            places = np.stack(np.meshgrid(*[np.arange(0.25, cells, 0.5) * cell] * 2, indexing="ij"), -1).reshape(-1, 2)
            inside = (abs(places - cells * cell / 2) < half * cell).all(1)
            world.add_particles(water, places[~inside])
            world.add_particles(block, places[inside] + [1e-5 * start, 0.0])
            square = []
            for step in range(6 * 60):
                world.step(1.0 / 60.0)
                if step >= 4 * 60:
                    square.append((world.velocities.array() ** 2).sum(1).mean())
            speeds.append(float(np.sqrt(np.mean(square))))
    print(" ".join(f"{speed:.3f}" for speed in speeds), "m/s")
    assert np.mean(speeds) < 0.1


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_floor_lets_go_what_a_hand_lifts(dimension: int) -> None:
    """A jelly beside sand and a drop of water, so the dual holds all three. A hand takes it and rises with the cosine of a second, by 0.78 m/s at most.

    A floor that pulls held it by its lowest cells: the middle of the jelly came to 0.44 m in 2D and to 0.15 m in 3D, not to the hand's 0.6 m.
    """
    cell, depth = 0.05, 0.4
    with pbmpm.World(dimension, cell, gravity=[0.0, -9.81, 0.0][:dimension], iterations=5, threads=1) as world:
        world.add_collider(pbmpm.Plane([0.0] * dimension, [0.0, 1.0, 0.0][:dimension]), friction_coefficient=0.5)
        jelly, sand, water = (world.add_material(m) for m in (pbmpm.Elastic(density=900.0, young_modulus=5e4), pbmpm.Sand(), pbmpm.Liquid()))

        def fill(material: pbmpm.Material, x: float, half: list[float]) -> None:
            world.fill(pbmpm.Box([x, half[1], depth][:dimension], half[:dimension]), material)

        fill(jelly, 0.8, [0.15, 0.15, 0.15])
        fill(sand, 1.15, [0.2, 0.1, 0.15])
        fill(water, 0.6, [0.05, 0.05, 0.15])
        hand = world.add_force("grab", shape=pbmpm.Sphere([0.8, 0.1, depth][:dimension], 0.12), falloff="smooth", range=0.12)
        for step in range(120):
            height = 0.35 + 0.25 * math.cos(math.pi * (step + 1) / 60) if step >= 60 else 0.1
            speed = (height - hand.shape.position[1]) * 60.0 if step >= 60 else 0.0
            hand.shape = pbmpm.Sphere([0.8, height, depth][:dimension], 0.12)
            hand.velocity = [0.0, speed, 0.0][:dimension]
            world.step(1.0 / 60.0)
        heights = world.positions.array()[world.material_indices.array() == 0, 1]
        assert heights.mean() > 0.5
