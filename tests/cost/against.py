#!/usr/bin/env python3
"""What a step costs against another build of the library, at 60 Hz with the convergent solver.

    build/venv/bin/python tests/cost/against.py LIBRARY PACKAGE [SCENE...] [--iterations 5] [--rounds 60] [--other-isa ISA]

LIBRARY and PACKAGE are the other build's shared library and the folder that holds its `pbmpm` package, for the binding belongs to the library. This
build is the one that the running interpreter imports, or that PBMPM_LIBRARY names. Compare builds of the same type, as users get them: Release.
PBMPM_ISA chooses the kernels of both, `--other-isa` those of the other one.

Each build has a process with one thread, and both share one core. After 60 steps of motion they step in turns, one step each, so that what else the machine does
meets both. Printed per scene: the median CPU time of a step with each, its time per particle, the ratio of the medians, and the median of the
ratios of neighbouring steps; at the end the median over the scenes. Nothing passes or fails here: a machine's noise must not."""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

WARM_UP = 60
ITERATIONS = int(os.environ.get("AGAINST_ITERATIONS", "5"))
SCENES: dict[str, Callable[[Any], Any]] = {}


def scene(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    SCENES[function.__name__] = function
    return function


def world(pbmpm: Any, dimension: int, cell: float, **more: Any) -> Any:
    gravity = [0.0, -9.81] + [0.0] * (dimension - 2)
    return pbmpm.World(dimension, cell, **{"gravity": gravity, "solver": pbmpm.Solver.CONVERGENT, "iterations": ITERATIONS, "threads": 1, "capacity": 250_000, **more})


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


@scene
def elastic_3d(pbmpm: Any) -> Any:
    """Nine blocks of 28^3 cells that fall, bounce and collide: 197,568 particles."""
    w = world(pbmpm, 3, 0.05, domain=((0, 0, 0), (3.4, 2, 3.4)))
    heights, matter = (0.5, 0.65, 0.8, 0.65, 0.8, 0.5, 0.8, 0.5, 0.65), w.add_material(pbmpm.Elastic())
    for i, height in enumerate(heights):
        row, column = divmod(i, 3)
        drift = (0.5 - 0.5 * row, -0.05 * i, 0.5 - 0.5 * column)
        w.fill(pbmpm.Box((0.7 + row, height, 0.7 + column), (0.35, 0.35, 0.35)), matter, velocity=drift)
    return w


def shape(pbmpm: Any, part: dict[str, Any]) -> Any:
    """A box or a ball of a scene file."""
    if part["kind"] == "sphere":
        return pbmpm.Sphere(part["position"], part["radius"])
    return pbmpm.Box(part["position"], part["half_extents"], rotation=part.get("rotation", (0, 0, 0, 1)))


@scene
def workshop_3d(pbmpm: Any) -> Any:
    """Water, jelly, sand and clay among boxes, from samples/scenes/workshop_3d.json without its wheel, jets and drain."""
    file = json.loads((Path(__file__).parents[2] / "samples/scenes/workshop_3d.json").read_text(encoding="utf-8"))
    kinds = {"liquid": pbmpm.Liquid, "elastic": pbmpm.Elastic, "sand": pbmpm.Sand, "visco": pbmpm.Visco}
    w = world(pbmpm, 3, file["cell_size"], domain=(file["domain"]["min"], file["domain"]["max"]))
    materials = {name: w.add_material(kinds[part.pop("kind")](**part)) for name, part in file["materials"].items()}
    for part in file["colliders"]:
        w.add_collider(shape(pbmpm, part["shape"]))
    for part in file["fills"]:
        w.fill(shape(pbmpm, part["shape"]), materials[part["material"]])
    return w


def columns(dimension: int, cells: int, in_cell: int = 0) -> Callable[[Any], Any]:
    """A column that is as long as it is high and wide breaks in a tank 2.5 times as long; `in_cell`: so many particles per cell, not as many as usual."""

    def make(pbmpm: Any) -> Any:
        half = 0.025 * cells / 2
        w = world(pbmpm, dimension, 0.025, domain=((0,) * dimension, (5 * half, 3 * half, 2 * half)[:dimension]))
        more = {"particles_per_axis": in_cell ** (1 / dimension)} if in_cell else {}
        w.fill(pbmpm.Box((half,) * dimension, (half,) * dimension), w.add_material(pbmpm.Liquid()), **more)
        return w

    return make


SCENES |= {"liquid_3d_200k": columns(3, 29), "liquid_3d_20k": columns(3, 14), "liquid_2d_10k": columns(2, 50)}
SCENES |= {f"liquid_3d_{count}_a_cell": columns(3, 29, count) for count in (1, 2, 4)}


def turns(name: str) -> None:
    """In a process of its own: a step per line of input, whose CPU time [s] and number of particles it prints."""
    import pbmpm

    made = SCENES[name](pbmpm)
    for _ in range(WARM_UP):
        made.step(1 / 60)
    for _ in sys.stdin:
        begin = time.process_time()
        made.step(1 / 60)
        print(time.process_time() - begin, len(made), flush=True)


class Build:
    """One build that steps a scene."""

    def __init__(self, scene: str, environment: dict[str, str]) -> None:
        self.name = environment.get("PBMPM_LIBRARY", "of this interpreter's package")
        self.process = subprocess.Popen([sys.executable, __file__, "--turns", scene], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.seconds: list[float] = []
        self.particles = 0

    def step(self) -> None:
        assert self.process.stdin and self.process.stdout
        try:
            self.process.stdin.write("\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # it has ended: then there is no line to read either
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"the build {self.name} ended with status {self.process.wait()}; its own message stands above")
        seconds, particles = line.split()
        self.seconds.append(float(seconds))
        self.particles = int(particles)

    def end(self) -> None:
        self.process.communicate()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", type=Path)
    parser.add_argument("package", type=Path)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"of {', '.join(SCENES)}; all, if none is named")
    parser.add_argument("--iterations", type=int, default=5)
    parser.add_argument("--rounds", type=int, default=60, help="steps that are measured")
    parser.add_argument("--other-isa", choices=["sse4", "avx2", "avx512"], help="kernels of the other build")
    arguments = parser.parse_args()
    if not arguments.library.is_file():
        parser.error(f"{arguments.library} is no file: name the other build's shared library")
    if not (arguments.package / "pbmpm" / "__init__.py").is_file():
        parser.error(f"{arguments.package} has no package pbmpm: name the folder that holds it, such as a site-packages")
    if unknown := [name for name in arguments.scenes if name not in SCENES]:
        parser.error(f"there is no scene {unknown[0]}: choose of {', '.join(SCENES)}")
    if arguments.rounds < 1 or arguments.iterations < 1:
        parser.error("--rounds and --iterations are at least 1")
    here = {**os.environ, "AGAINST_ITERATIONS": str(arguments.iterations), "OPENBLAS_NUM_THREADS": "1"}
    there = {**here, "PBMPM_LIBRARY": str(arguments.library.resolve()), "PYTHONPATH": str(arguments.package.resolve())}
    if arguments.other_isa:
        there["PBMPM_ISA"] = arguments.other_isa
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    ratios = []
    print(f"{'scene':20} {'particles':>9} {'this [ms]':>10} {'other [ms]':>10} {'this [ns]':>10} {'other [ns]':>10} {'ratio':>7} {'median':>7}")
    for name in arguments.scenes or SCENES:
        builds = [Build(name, environment) for environment in (here, there)]
        for _ in range(arguments.rounds):
            for build in builds:
                build.step()
        for build in builds:
            build.end()
        this, other = (statistics.median(build.seconds) for build in builds)
        ratios.append(statistics.median(a / b for a, b in zip(builds[0].seconds, builds[1].seconds)))
        each = [1e9 * seconds / build.particles for seconds, build in zip((this, other), builds)]
        print(f"{name:20} {builds[0].particles:9} {1e3 * this:10.3f} {1e3 * other:10.3f} {each[0]:10.1f} {each[1]:10.1f} {this / other:7.3f} {ratios[-1]:7.3f}", flush=True)
    print(f"median of the scenes: {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--turns"]:
        turns(sys.argv[2])
    else:
        main()
