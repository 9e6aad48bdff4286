#!/usr/bin/env python3
"""How long a step takes with 1, 2, 4, 16 and 64 threads, by itself and beside busy processes, at 60 Hz x 5 with the convergent solver.

    build/venv/bin/python tests/cost/threads.py [SCENE...] [--busy 2] [--rounds 9]

A dam break in 3D, one in 2D, and a small one in 2D; threads take turns of ten steps. Printed per scene: wall time of a step, median of the rounds, and its ratio to that of one
thread. `--busy` is how many processes compute for ever beside it. Nothing passes or fails here: a machine's noise must not."""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pbmpm

THREADS = (1, 2, 4, 16, 64)
WARM_UP, TURN = 30, 10
SCENES = {"dam break, 3D": (3, 1 / 32, 13), "dam break, 2D": (2, 0.02, 50), "small dam break, 2D": (2, 0.02, 15)}
"""Dimension, cell size [m], and cells along each side of the column."""


def dam_break(dimension: int, cell: float, cells: int, threads: int) -> pbmpm.World:
    """A cube of liquid in a tank twice as long."""
    side = cells * cell
    domain = ([0.0] * dimension, [2 * side, 2 * side, side][:dimension])
    gravity = [0.0, -9.81, 0.0][:dimension]
    world = pbmpm.World(dimension, cell, gravity=gravity, iterations=5, threads=threads, capacity=40_000, domain=domain)
    world.fill(pbmpm.Box([side / 2] * dimension, [side / 2] * dimension), world.add_material(pbmpm.Liquid()))
    return world


def turn(world: pbmpm.World, steps: int) -> float:
    """Wall time of a step [ms]."""
    begin = time.perf_counter()
    for _ in range(steps):
        world.step(1 / 60)
    return 1e3 * (time.perf_counter() - begin) / steps


@contextmanager
def busy_processes(count: int) -> Iterator[None]:
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def measure(name: str, rounds: int) -> list[float]:
    """Medians [ms], one per number of threads."""
    worlds = [dam_break(*SCENES[name], threads) for threads in THREADS]
    for world in worlds:
        turn(world, WARM_UP)
    times = [[turn(world, TURN) for world in worlds] for _ in range(rounds)]
    for world in worlds:
        world.close()
    return [statistics.median(own) for own in zip(*times, strict=True)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", default=[*SCENES], help=", ".join(SCENES))
    parser.add_argument("--busy", type=int, default=0)
    parser.add_argument("--rounds", type=int, default=9)
    options = parser.parse_args()
    if unknown := set(options.scenes) - set(SCENES):
        parser.error(f"no scene is called {', '.join(sorted(unknown))}; there are: {', '.join(SCENES)}")
    print(f"{'scene':20}" + "".join(f"{threads:>15} thr." for threads in THREADS))
    with busy_processes(options.busy):
        for name in options.scenes:
            own = measure(name, options.rounds)
            print(f"{name:20}" + "".join(f"{ms:>11.2f} ms {ms / own[0]:5.2f}" for ms in own), flush=True)


if __name__ == "__main__":
    main()
