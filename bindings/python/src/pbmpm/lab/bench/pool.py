"""A pool at rest, asleep against awake, and what one drop wakes in it.

The scene is that of ``samples/scenes/bench_pool_3d.json``. It runs until all of it sleeps. From that state steps are timed with
everything awake and with everything asleep; then a drop falls into its middle, and every particle is compared with what it was, bit for bit.
Times are CPU times on one thread that stays on one core.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np
import numpy.typing as npt

import pbmpm

from ..errors import InputError
from ..parsing import parse_scene
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation
from .subjects import CELL

SIZE = (2.5, 0.5, 2.5)
"""Of the pool [m]: 200,000 particles."""
PACES = {"paper": (120, 10), "dual": (60, 10)}
"""Steps per second and iterations with which each solver lets the pool come to rest. The paper's at 60 Hz x 10 does not: it stirs by 0.06 m/s."""
PATIENCE = 10.0
"""[s] until the pool sleeps, and until it sleeps again."""
AWAKE_STEPS = 3
DROP_SPEED = 3.0


def pool_scene(solver: str, size: Sequence[float] = SIZE) -> Scene:
    """The pool as a solver lets it rest."""
    rate_hz, iterations = PACES[solver]
    half = [0.5 * extent for extent in size]
    return parse_scene(
        {
            "format": "pbmpm-scene",
            "version": 1,
            "name": "pool",
            "dimension": 3,
            "cell_size": CELL,
            "gravity": [0, -9.81, 0],
            "domain": {"min": [0, 0, 0], "max": [size[0], 3 * size[1], size[2]]},
            "seconds": 4,
            "rate_hz": rate_hz,
            "iterations": iterations,
            "solver": {"solver": solver},
            "sleeping": {},
            "materials": {"water": {"kind": "liquid"}},
            "fills": [{"shape": {"kind": "box", "position": half, "half_extents": half}, "material": "water"}],
            "pictures": {"times": [0, 4]},
        }
    )


@dataclass
class PoolCosts:
    """What was measured of one solver. Times [s] are of steps."""

    solver: str
    particles: int
    until_asleep: float
    """Simulated [s]."""
    awake: list[float]
    asleep: list[float]
    woken: int
    """Most particles awake at once after the drop."""
    woken_for: float
    """Simulated [s] until all of them sleep again."""
    changed: int
    """Particles that are not what they were, to the last bit."""
    farthest: float
    """Of those from the drop, along the surface [cells]."""

    @property
    def ratio(self) -> float:
        """Of a step awake to one asleep."""
        return median(self.awake) / median(self.asleep)


def measure_pool(solver: str, rounds: int, tick: Callable[[], None], size: Sequence[float] = SIZE) -> PoolCosts:
    """Times the pool with a solver and lets a drop fall into it. ``tick`` is called `pool_pieces()` times.

    Raises:
        InputError: the pool does not come to rest.
    """
    scene = pool_scene(solver, size)
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        world = simulation.world
        until_asleep = _rest(simulation)
        tick()
        state = simulation.bookmark()
        world.step(simulation.settings.dt)  # the last blocks leave the grid
        asleep = [_time_step(simulation) for _ in range(20 * rounds)]
        world.sleeping = False
        world.step(simulation.settings.dt)  # wakes all
        awake = [_time_step(simulation) for _ in range(AWAKE_STEPS * rounds)]
        tick()
        simulation.go_back(state)
        before = _particles(world)
        spot = [0.5 * size[0], size[1] + 2 * CELL, 0.5 * size[2]]
        (material,) = simulation.materials.values()
        world.add_particles(material, [spot], [[0, -DROP_SPEED, 0]])
        woken: list[int] = []
        woken_for = _rest(simulation, woken)
        changed = _changed(before, _particles(world))
        tick()
    away = np.hypot(changed[:, 0] - spot[0], changed[:, 2] - spot[2])
    return PoolCosts(
        solver, len(before), until_asleep, awake, asleep, max(woken), woken_for, len(changed), float(away.max(initial=0.0)) / CELL
    )


def pool_pieces() -> int:
    """How often `measure_pool()` calls ``tick``."""
    return 3


def _time_step(simulation: Simulation) -> float:
    begin = time.thread_time()
    simulation.world.step(simulation.settings.dt)
    return time.thread_time() - begin


def _rest(simulation: Simulation, woken: list[int] | None = None) -> float:
    """Steps until all particles sleep; returns the simulated seconds. ``woken`` gets the particles awake in each step."""
    steps = 0
    while steps < PATIENCE * simulation.settings.rate_hz:
        simulation.step()
        steps += 1
        stats = simulation.world.stats
        if woken is not None:
            woken.append(stats.particle_count - stats.particles_asleep)
        if stats.particles_asleep == stats.particle_count:
            return steps * simulation.settings.dt
    raise InputError(f"the pool does not fall asleep within {PATIENCE:g} s ({simulation.settings.text()})")


def _particles(world: pbmpm.World) -> dict[tuple[int, int], npt.NDArray[np.float32]]:
    """Position, velocity and volume ratio of each particle."""
    rows = np.hstack([world.positions.copy(), world.velocities.copy(), world.volume_ratios.copy()[:, None]])
    return {(int(index), int(generation)): row for (index, generation), row in zip(world.ids.copy(), rows, strict=True)}


def _changed(
    before: dict[tuple[int, int], npt.NDArray[np.float32]], after: dict[tuple[int, int], npt.NDArray[np.float32]]
) -> npt.NDArray[np.float32]:
    """The rows of before that are not the same bits after."""
    rows = [row for key, row in before.items() if key not in after or row.tobytes() != after[key].tobytes()]
    return np.array(rows, dtype=np.float32).reshape(len(rows), 7)


def pool_row(costs: PoolCosts) -> dict[str, Any]:
    """One row of the report."""
    rate_hz, iterations = PACES[costs.solver]
    return {
        "solver": costs.solver,
        "rate_hz": rate_hz,
        "iterations": iterations,
        "particles": costs.particles,
        "seconds_until_asleep": costs.until_asleep,
        "ms_per_step_awake": 1e3 * median(costs.awake),
        "ms_per_step_asleep": 1e3 * median(costs.asleep),
        "ratio": costs.ratio,
        "drop": {
            "most_particles_awake": costs.woken,
            "seconds_until_asleep": costs.woken_for,
            "particles_changed": costs.changed,
            "farthest_cells": costs.farthest,
        },
    }


def pool_text(rows: Sequence[dict[str, Any]]) -> str:
    """The rows for a person."""
    return "\n".join(
        f"{row['solver']}, {row['rate_hz']} Hz x {row['iterations']}: {row['particles']} particles, all asleep after"
        f" {row['seconds_until_asleep']:.2f} s; a step takes {row['ms_per_step_awake']:.2f} ms awake and {row['ms_per_step_asleep']:.4f} ms"
        f" asleep, {row['ratio']:.0f} times less (medians of CPU times, one thread)\n"
        f"  one drop wakes at most {row['drop']['most_particles_awake']} particles at a time, for {row['drop']['seconds_until_asleep']:.2f} s;"
        f" {row['drop']['particles_changed']} are not where or what they were, the farthest {row['drop']['farthest_cells']:.1f} cells"
        " from it; all others keep every bit"
        for row in rows
    )
