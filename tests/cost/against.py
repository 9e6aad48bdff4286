#!/usr/bin/env python3
"""What a step of ordinary scenes costs against another build of the library, at 60 Hz x 5 with the convergent solver.

    build/venv/bin/python tests/cost/against.py LIBRARY PACKAGE [SCENE...] [--rounds 7]

LIBRARY and PACKAGE are the other build's shared library and the folder that holds its `pbmpm` package, for the binding belongs to the library. This
build is the one that the running interpreter imports, or that PBMPM_LIBRARY names. Compare builds of the same type, as users get them: Release. Each round runs every scene in both, one after the other, each in a process of its own on one
thread: 60 steps of motion, then 60 that are measured. Printed per scene: the median CPU time of a step with each, and the median and the least of the ratios
of a round; at the end the median over the scenes. Nothing passes or fails here: a machine's noise must not."""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

WARM_UP, MEASURED = 60, 60
SCENES: dict[str, Callable[[Any], Any]] = {}


def scene(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    SCENES[function.__name__] = function
    return function


def world(pbmpm: Any, dimension: int, cell: float, **more: Any) -> Any:
    gravity = [0.0, -9.81] + [0.0] * (dimension - 2)
    return pbmpm.World(dimension, cell, **{"gravity": gravity, "solver": pbmpm.Solver.CONVERGENT, "iterations": 5, "threads": 1, "capacity": 60_000, **more})


@scene
def pool(pbmpm: Any) -> Any:
    """Water at rest between planes: 1.6 x 0.6 m, 12 cells deep."""
    w = world(pbmpm, 2, 0.05)
    for at, normal in (((0, 0), (1, 0)), ((1.6, 0), (-1, 0)), ((0, 0), (0, 1))):
        w.add_collider(pbmpm.Plane(at, normal), friction=pbmpm.Friction.SLIP)
    w.fill(pbmpm.Box((0.8, 0.3), (0.8, 0.3)), w.add_material(pbmpm.Liquid()))
    return w


@scene
def glass(pbmpm: Any) -> Any:
    """A glass of 12^3 cells, of planes."""
    w, half = world(pbmpm, 3, 0.025), 0.15
    for side in (-1, 1):
        w.add_collider(pbmpm.Plane((side * half, 0, 0), (-side, 0, 0)), friction=pbmpm.Friction.SLIP)
        w.add_collider(pbmpm.Plane((0, 0, side * half), (0, 0, -side)), friction=pbmpm.Friction.SLIP)
    w.add_collider(pbmpm.Plane((0, 0, 0), (0, 1, 0)), friction=pbmpm.Friction.SLIP)
    w.fill(pbmpm.Box((0, half, 0), (half, half, half)), w.add_material(pbmpm.Liquid()))
    return w


@scene
def slope(pbmpm: Any) -> Any:
    """An elastic block on a frictionless slope of 30 degrees."""
    w = world(pbmpm, 2, 0.025, gravity=(4.905, -8.496))
    w.fill(pbmpm.Box((0, 0.1), (0.2, 0.1)), w.add_material(pbmpm.Elastic(young_modulus=1e5)))
    w.add_collider(pbmpm.Plane((0, 0), (0, 1)), friction=pbmpm.Friction.SLIP)
    return w


@scene
def dam_break_2d(pbmpm: Any) -> Any:
    """A column of 40 x 40 cells in a tank four times as wide."""
    w = world(pbmpm, 2, 0.025, domain=((0, 0), (4, 2)))
    w.fill(pbmpm.Box((0.5, 0.5), (0.5, 0.5)), w.add_material(pbmpm.Liquid()))
    return w


@scene
def dam_break_3d(pbmpm: Any) -> Any:
    """A column of 12 x 16 x 12 cells in a tank three times as long."""
    w = world(pbmpm, 3, 0.025, domain=((0, 0, 0), (0.9, 0.6, 0.3)))
    w.fill(pbmpm.Box((0.15, 0.2, 0.15), (0.15, 0.2, 0.15)), w.add_material(pbmpm.Liquid()))
    return w


def measure(name: str) -> None:
    """In a process of its own: prints the CPU time of a step [s]."""
    import pbmpm

    made = SCENES[name](pbmpm)
    for _ in range(WARM_UP):
        made.step(1 / 60)
    begin = time.process_time()
    for _ in range(MEASURED):
        made.step(1 / 60)
    print((time.process_time() - begin) / MEASURED)


def step_of(name: str, environment: dict[str, str]) -> float:
    command = [sys.executable, __file__, "--measure", name]
    return float(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", type=Path)
    parser.add_argument("package", type=Path)
    parser.add_argument("scenes", nargs="*", choices=[*SCENES, []])
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    here = dict(os.environ)
    there = {**here, "PBMPM_LIBRARY": str(arguments.library.resolve()), "PYTHONPATH": str(arguments.package.resolve())}
    ratios = []
    print(f"{'scene':14} {'this [ms]':>10} {'other [ms]':>10} {'median':>7} {'least':>7}")
    for name in arguments.scenes or SCENES:
        pairs = [(step_of(name, here), step_of(name, there)) for _ in range(arguments.rounds)]
        of = [a / b for a, b in pairs]
        ratios.append(statistics.median(of))
        this, other = (1e3 * statistics.median(side) for side in zip(*pairs))
        print(f"{name:14} {this:10.3f} {other:10.3f} {ratios[-1]:7.2f} {min(of):7.2f}", flush=True)
    print(f"median of the scenes: {statistics.median(ratios):.2f}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--measure"]:
        measure(sys.argv[2])
    else:
        main()
