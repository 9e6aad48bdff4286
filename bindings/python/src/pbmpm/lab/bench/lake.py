"""A jelly in a lake against both by themselves: matter of another kind has to cost its own share only.

The three scenes are those of ``samples/scenes/bench_lake_3d.json`` and its like. They step in turns on one thread
that stays on one core, each again and again from its own state, which a snapshot brings back. Times are CPU times; what counts is the
least of each, which other programs disturb least.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

from ..parsing import parse_scene
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation
from .measure import choose_variant
from .subjects import CELL, ITERATIONS, RATE_HZ

PARTS = ("lake", "jelly")
BOTH = "lake_and_jelly"
WARMUP_STEPS = 20
LAKE_VARIANTS = ("paper", "dual")
"""Solvers that are measured when none is named."""

_LAKE = {  # round a hole of 0.4 m x 0.2 m x 0.4 m in the middle of the surface
    "below": ([1.3, 0.15, 1.25], [1.3, 0.15, 1.25]),
    "left": ([0.55, 0.4, 1.25], [0.55, 0.1, 1.25]),
    "right": ([2.05, 0.4, 1.25], [0.55, 0.1, 1.25]),
    "front": ([1.3, 0.4, 0.525], [0.2, 0.1, 0.525]),
    "behind": ([1.3, 0.4, 1.975], [0.2, 0.1, 0.525]),
}
_JELLY = ([1.3, 0.4, 1.25], [0.2, 0.1, 0.2])


def lake_scene(name: str) -> Scene:
    """One of `PARTS`, or `BOTH`."""
    materials: dict[str, Any] = {}
    fills = []
    if name != "jelly":
        materials["water"] = {"kind": "liquid"}
        fills += [_fill("water", *box) for box in _LAKE.values()]
    if name != "lake":
        materials["jelly"] = {"kind": "elastic", "young_modulus": 2e4}
        fills.append(_fill("jelly", *_JELLY))
    return parse_scene(
        {
            "format": "pbmpm-scene",
            "version": 1,
            "name": name,
            "dimension": 3,
            "cell_size": CELL,
            "gravity": [0, -9.81, 0],
            "domain": {"min": [0, 0, 0], "max": [2.6, 1.5, 2.5]},
            "seconds": 1,
            "rate_hz": RATE_HZ,
            "iterations": ITERATIONS,
            "solver": {"solver": "paper"},
            "materials": materials,
            "fills": fills,
        }
    )


def _fill(material: str, position: list[float], half_extents: list[float]) -> dict[str, Any]:
    return {"shape": {"kind": "box", "position": position, "half_extents": half_extents}, "material": material}


@dataclass
class LakeCosts:
    """What the steps of one of the three scenes took [s]."""

    scene: str
    particles: int
    seconds: list[float] = field(default_factory=list)


def over_parts(costs: Sequence[LakeCosts]) -> float:
    """By how much both together cost more than by themselves, in percent."""
    least = {own.scene: min(own.seconds) for own in costs}
    return 100.0 * (least[BOTH] / sum(least[part] for part in PARTS) - 1.0)


def measure_lake(variant: str, rounds: int, tick: Callable[[], None]) -> list[LakeCosts]:
    """Times the three scenes with a solver. ``tick`` is called `lake_pieces()` times."""
    with ExitStack() as stack:
        scenes = map(lake_scene, (*PARTS, BOTH))
        simulations = [stack.enter_context(Simulation(scene, RunSettings.of(scene, 1))) for scene in scenes]
        costs, states = [], []
        for simulation in simulations:
            choose_variant(simulation.world, variant, ITERATIONS)
            for _ in range(WARMUP_STEPS):
                simulation.step()
            costs.append(LakeCosts(simulation.scene.name, len(simulation.world)))
            states.append(simulation.world.snapshot())
            tick()
        for number in range(-1, rounds):  # the first is for memory and caches
            for simulation, state, own in zip(simulations, states, costs):
                simulation.world.restore(state)
                begin = time.thread_time()
                simulation.world.step(1.0 / RATE_HZ)
                seconds = time.thread_time() - begin
                if number >= 0:
                    own.seconds.append(seconds)
            tick()
    return costs


def lake_pieces(rounds: int) -> int:
    """How often `measure_lake()` calls ``tick``."""
    return rounds + 4


def lake_row(variant: str, costs: Sequence[LakeCosts]) -> dict[str, Any]:
    """One row of the report."""
    row: dict[str, Any] = {"solver": variant, "iterations": ITERATIONS, "over_parts_percent": over_parts(costs)}
    for own in costs:
        row[own.scene] = {"particles": own.particles, "ms_per_step_min": 1e3 * min(own.seconds)}
    return row


def lake_text(rows: Sequence[dict[str, Any]]) -> str:
    """The rows for a person."""
    return "\n".join(
        f"{row['solver']}: "
        + ", ".join(
            f"{name.replace('_', ' ')} of {row[name]['particles']} particles {row[name]['ms_per_step_min']:.2f} ms"
            for name in (*PARTS, BOTH)
        )
        + f"; together {row['over_parts_percent']:+.1f} % over the sum (least of CPU times per step, one thread)"
        for row in rows
    )
