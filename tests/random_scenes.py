"""Closed scenes that are drawn at random: nothing may be lost, and energy may only fall.

    build/venv/bin/python tests/random_scenes.py [--count 5000] [--seed 1] [--only SEED] [--solver NAME] [--viscous]

A box of 2D or 3D with one or two bodies in it, at rest or thrown: matter, shape, place, modulus, density, gravity, walls and their friction, obstacle, solver,
rate and iterations are drawn from the seed. Energy is that of motion and height, and what springs hold cannot be more than what they took from these: at no
time may it exceed that of the start by 2 % of the energy that the scene can turn over, its motion and the fall through its box, at least that of a tenth of
a cell per second.
Prints the seeds that fail, the worst gain, and how many scenes each solver had.
"""

from __future__ import annotations

import argparse
import collections
import functools
import multiprocessing
import random
from typing import Any

import numpy as np

from pbmpm import Box, Elastic, Friction, Liquid, Sand, Solver, Sphere, Visco, World

ALLOWED = 0.02


def material_of(draw: random.Random) -> Any:
    """Matter of any kind, from feathers to steel-heavy, from jelly to hard rubber."""
    kind, density = draw.choice(("liquid", "elastic", "sand", "visco")), 10 ** draw.uniform(2, 4)
    modulus = density * 10 ** draw.uniform(0.5, 4)
    if kind == "liquid":
        return Liquid(density=density)
    if kind == "elastic":
        return Elastic(density=density, young_modulus=modulus, poisson_ratio=draw.uniform(0, 0.45))
    if kind == "sand":
        return Sand(density=density, young_modulus=modulus, friction_angle=draw.uniform(0.26, 0.8))
    return Visco(density=density, young_modulus=modulus, yield_strain=10 ** draw.uniform(-4, -1))


def energy_of(world: World) -> float:
    """Of motion and height [J]."""
    stats = world.stats
    return float(stats.kinetic_energy + stats.potential_energy)


def run(seed: int, forced: str | None = None, viscous: bool = False) -> dict[str, Any]:
    """One scene: its gain of energy over what it can turn over, and whether anything is lost. A solver that is named takes the place of the one drawn. `viscous`: all
    matter is liquid, with a viscosity from that which no step sees to that of tar."""
    draw = random.Random(seed)
    dimension, cell = draw.choice((2, 2, 2, 3)), 10 ** draw.uniform(-2, 0)
    size = draw.randint(8, 24 if dimension == 2 else 12) * cell
    solver = draw.choice((Solver.PAPER, Solver.DUAL, Solver.PRIMAL, Solver.CONVERGENT, Solver.CONVERGENT))
    solver = Solver[forced.upper()] if forced else solver
    rate, iterations = draw.choice((30, 60, 60, 120, 240)), draw.choice((1, 2, 5, 5, 10, 20))
    pull = draw.choice((0.0, 9.81, 9.81, 1.62)) * cell / 0.05
    gravity = [0.0, -pull] + [0.0] * (dimension - 2)
    box = ([0.0] * dimension, [size] * dimension)
    with World(dimension, cell, gravity=gravity, solver=solver, iterations=iterations, threads=1, capacity=20_000, domain=box, domain_friction=draw.choice((0.0, 0.5))) as world:
        bodies, taken = draw.choice((1, 1, 2)), []
        for k in range(bodies):
            width = size / bodies
            half = [draw.uniform(1.5 * cell, 0.48 * width), *(draw.uniform(1.5 * cell, 0.3 * size) for _ in range(dimension - 1))]
            centre = [k * width + draw.uniform(half[0], width - half[0]), *(draw.uniform(h, size - h) for h in half[1:])]
            shape = Box(centre, half) if draw.random() < 0.7 else Sphere(centre, min(half))
            thrown = [draw.uniform(-1, 1) * draw.choice((0.0, 1.0)) * cell * 10 for _ in range(dimension)]
            matter = material_of(draw)
            if viscous:
                matter = Liquid(density=matter.density, kinematic_viscosity=rate * cell**2 * 10 ** random.Random(seed + k).uniform(-3, 2))
            world.fill(shape, world.add_material(matter), velocity=thrown)
            taken.append((np.array(centre), np.array(half)))
        for _ in range(draw.choice((0, 10))):
            centre, half = np.array([draw.uniform(0, size) for _ in range(dimension)]), np.array([draw.uniform(cell, 0.15 * size) for _ in range(dimension)])
            if all((np.abs(centre - c) > half + h + cell).any() for c, h in taken):
                world.add_collider(Box(centre.tolist(), half.tolist()), friction=draw.choice((Friction.SLIP, Friction.COULOMB)))
                break
        count, first = len(world), energy_of(world)
        stats = world.stats
        unseen = 0.5 * stats.mass * (0.1 * cell) ** 2
        turned = max(float(stats.kinetic_energy + stats.mass * pull * size), unseen)
        most = 0.0
        for _ in range(rate):
            world.step(1 / rate)
            most = max(most, (energy_of(world) - first) / turned)
        whole = len(world) == count and bool(np.isfinite(world.positions.array()).all())
    setting = f"{dimension}D {solver.name.lower()} {rate}x{iterations}"
    return {"seed": seed, "gain": most, "whole": whole, "solver": solver.name.lower(), "setting": setting, "particles": count}


def main() -> None:
    """Runs the scenes on all processors but one and prints what failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--solver", choices=[solver.name.lower() for solver in Solver], help="for all scenes, instead of the one drawn")
    parser.add_argument("--viscous", action="store_true", help="all matter is viscous liquid")
    parser.add_argument("--jobs", type=int, default=max(1, multiprocessing.cpu_count() - 1))
    arguments = parser.parse_args()
    seeds = [arguments.only] if arguments.only is not None else range(arguments.seed, arguments.seed + arguments.count)
    failed, solvers, worst = [], collections.Counter(), {"gain": 0.0}
    with multiprocessing.Pool(arguments.jobs, maxtasksperchild=50) as pool:
        for result in pool.imap_unordered(functools.partial(run, forced=arguments.solver, viscous=arguments.viscous), seeds, chunksize=4):
            solvers[result["solver"]] += 1
            worst = max(worst, result, key=lambda r: r["gain"])
            if result["gain"] > ALLOWED or not result["whole"]:
                failed.append(result)
                print(f"seed {result['seed']}: {result['setting']}, {result['particles']} particles: gain {result['gain']:.3f}{'' if result['whole'] else ', LOST'}", flush=True)
    print(f"{sum(solvers.values())} scenes ({', '.join(f'{n} {s}' for s, n in sorted(solvers.items()))}): {len(failed)} failed; largest gain {worst}")


if __name__ == "__main__":
    main()
