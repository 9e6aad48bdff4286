#!/usr/bin/env python3
"""What a surface costs beside a step, at 200,000 liquid particles in 3D and 60 Hz x 5; and what that of a sleeping pool costs.

    PBMPM_LIBRARY=build/release/lib/libpbmpm.so build/venv/bin/python tests/cost/surface.py [SCENE...] [--rounds 11]

Steps and surfaces take turns in one process, on one thread. Printed per scene: the triangles, the median CPU time of a step, and that of each kind of
surface as a share of it. Compare release builds. Nothing passes or fails here: a machine's noise must not."""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import pbmpm

CELL, CAPACITY = 0.1, 210_000
SCENES: dict[str, tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...] | None, int]] = {
    "falling cube": ((0, 0, 0), (1.45, 1.45, 1.45), None, 5),
    "dam break": ((1.0, 1.55, 2.0), (1.0, 1.55, 2.0), (6, 4, 4), 30),
    "shallow pool": ((4, 0.2, 4), (4, 0.2, 4), (8, 4, 8), 20),
}
"""Centre and half size of the water, the domain's far corner, and the steps before the measurement."""
ASLEEP = "sleeping pool"
KINDS: dict[str, Callable[[pbmpm.World], object]] = {
    "subdivision 2": lambda world: world.surface(),
    "without keeps_thin": lambda world: world.surface(keeps_thin=False),
    "subdivision 1": lambda world: world.surface(subdivision=1),
    "with velocities": lambda world: world.surface(velocities=True),
    "all points": lambda world: world.surface_points(),
}


def milliseconds(work: Callable[[], object]) -> float:
    begin = time.process_time()
    work()
    return 1e3 * (time.process_time() - begin)


def measure(name: str, rounds: int) -> None:
    centre, half, far, still = SCENES[name]
    domain = None if far is None else ((0.0, 0.0, 0.0), far)
    with pbmpm.World(3, CELL, gravity=(0, -9.81, 0), capacity=CAPACITY, domain=domain, iterations=5, threads=1) as world:
        world.fill(pbmpm.Box(centre, half), world.add_material(pbmpm.Liquid()))
        for _ in range(still):
            world.step(1 / 60)
        steps: list[float] = []
        costs: dict[str, list[float]] = {kind: [] for kind in KINDS}
        for _ in range(rounds):
            for kind, make in KINDS.items():
                steps.append(milliseconds(lambda: world.step(1 / 60)))
                costs[kind].append(milliseconds(lambda: make(world)))
        step = statistics.median(steps)
        shares = ", ".join(f"{kind} {100 * statistics.median(times) / step:.0f} %" for kind, times in costs.items())
        print(f"{name}: {len(world)} particles, {len(world.surface().triangles)} triangles, step {step:.0f} ms; {shares}", flush=True)


def measure_asleep(rounds: int) -> None:
    """The surface of the shallow pool once all of it sleeps: anew, as after other options, and again."""
    centre, half, far, _ = SCENES["shallow pool"]
    with pbmpm.World(3, CELL, gravity=(0, -9.81, 0), capacity=CAPACITY, domain=((0.0, 0.0, 0.0), far), iterations=5, threads=1, sleeping=True) as world:
        world.fill(pbmpm.Box(centre, half), world.add_material(pbmpm.Liquid()))
        for _ in range(1200):
            world.step(1 / 60)
            if world.stats.particles_asleep == len(world):
                break
        anew: list[float] = []
        again: list[float] = []
        for _ in range(rounds):
            world.surface(subdivision=1)
            anew.append(milliseconds(world.surface))
            world.step(1 / 60)
            again.append(milliseconds(world.surface))
        asleep = world.stats.particles_asleep
        print(f"{ASLEEP}: {asleep} of {len(world)} particles asleep; anew {statistics.median(anew):.1f} ms, again after a step {statistics.median(again):.1f} ms", flush=True)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("scenes", nargs="*", metavar="SCENE", choices=[[], *SCENES, ASLEEP], default=[])
    arguments.add_argument("--rounds", type=int, default=11)
    options = arguments.parse_args()
    for name in options.scenes or [*SCENES, ASLEEP]:
        if name == ASLEEP:
            measure_asleep(options.rounds)
        else:
            measure(name, options.rounds)


if __name__ == "__main__":
    main()
