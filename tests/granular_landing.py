"""What sand keeps of its volume where it lands, by how many cells it goes in a substep.

A block of 16 cells falls into a bin, and an emitter of 8 cells pours a stream into another. The bounds of advice come from here.
--rate shows that a higher rate prevents this: speeds stay the same, so that matter goes fewer cells in a substep.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent / "field"))

from harness import Frame, G, pool, tank
from pbmpm import Friction, Region, Sand, Solver, Sphere, World

REFERENCE, ITERATIONS = 60.0, 5  # speeds are given in cells per substep at this rate [Hz]
GRAINS = Sand(density=1600, friction_angle=math.radians(30), young_modulus=1e6)


def _world(cell: float) -> World:
    return World(2, cell, gravity=(0, -G), solver=Solver.CONVERGENT, iterations=ITERATIONS, threads=1, capacity=60_000)


def block(cells: float, rate: float = REFERENCE, seconds: tuple[float, ...] = (0.25, 1.0, 2.0)) -> list[float]:
    """Volume over that of the start, so long after a block landed at so many cells per substep of the reference."""
    cell, width, height = 0.0125, 0.5, 0.2
    fall = (cells * cell * REFERENCE) ** 2 / (2 * G)
    with _world(cell) as world:
        tank(world, Frame(), width, fall + 1, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=0.2)
        pool(world, Frame(), (0, fall), (width, fall + height), GRAINS)
        kept, steps = [], 0
        for after in seconds:
            end = round((math.sqrt(2 * fall / G) + after) * rate)
            for _ in range(steps, end):
                world.step(1 / rate)
            steps = end
            kept.append(2 * world.positions.array()[:, 1].mean() / height)
        return kept


def stream(cells: float, rate: float = REFERENCE, after: float = 0.3) -> float:
    """Volume of a heap over that of its grains, so long after the last of a stream of so many cells per substep of the reference landed."""
    cell, half, high, radius = 0.02, 0.4, 0.7, 0.08
    speed = cells * cell * REFERENCE
    frame = Frame(2, 0, (-half, 0.0))
    with _world(cell) as world:
        tank(world, frame, 2 * half, 2.0, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=0.4)
        flow = speed * 2 * radius
        emitter = world.add_emitter(Sphere((0, high), radius), world.add_material(GRAINS), flow, region=Region.DISC, speed=speed)
        poured = round(0.12 / flow * rate)
        for step in range(poured + round((high / speed + after) * rate)):
            emitter.enabled = step < poured
            world.step(1 / rate)
        x = np.linspace(0.01, 2 * half - 0.01, 120)
        area = np.trapezoid(np.clip(frame.levels(world, [[at, 0] for at in x]), 0, 9), x) * 2 * half / (x[-1] - x[0])
        return float(area / (emitter.status.emitted_mass / GRAINS.density))


def main() -> None:
    """Prints both."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rate", type=float, default=REFERENCE, help="steps per second (default: %(default)g)")
    rate = parser.parse_args().rate
    print(f"{rate:g} Hz x {ITERATIONS}: volume kept")
    for cells in (3.2, 4.0, 4.8, 6.0, 8.0, 10.0):
        kept = ", ".join(f"{share:.2f}" for share in block(cells, rate))
        print(f"block, {cells * REFERENCE / rate:4.1f} cells per substep, 0.25, 1 and 2 s after it landed: {kept}", flush=True)
    for cells in (2.0, 3.0, 4.0, 5.0, 6.0):
        print(f"stream, {cells * REFERENCE / rate:4.1f} cells per substep, 0.3 s after the last of it landed: {stream(cells, rate):.2f}", flush=True)


if __name__ == "__main__":
    main()
