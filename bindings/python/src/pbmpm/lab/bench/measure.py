"""Interleaved timing of solvers on one state of matter.

All solvers step from the same state, which a snapshot brings back before each step, in turns, on one thread that stays
on one core. Each does a step with `ITERATIONS` iterations and one with twice as many, so that the difference is the
cost of iterations alone. Times are CPU times: what other programs do counts as little as possible.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any, TypeVar

import pbmpm

from ..accuracy.case import parse_variant
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation
from .subjects import ITERATIONS, applies, scene_of


Subject = TypeVar("Subject")


def pin() -> int | None:
    """Keeps this process on one of its cores, the last one; returns which, or None where the system cannot."""
    if not hasattr(os, "sched_setaffinity"):
        return None
    core = max(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {core})
    return core


@dataclass
class Costs:
    """What the steps of one variant took, round by round [s]."""

    variant: str
    particles: int
    bytes_per_particle: float
    few: list[float] = field(default_factory=list)
    """Steps with `ITERATIONS` iterations, or the only kind of step of the explicit solver."""
    many: list[float] = field(default_factory=list)
    """Steps with twice as many."""
    few_solve: list[float] = field(default_factory=list)
    """Of the first kind of steps the iterations alone: their share of the step by the library's own clock, which is wall time, of its CPU time."""
    used: tuple[int, int] = (0, 0)
    """Iterations that both kinds of steps did."""

    def marginal(self, pick: Callable[[Sequence[float]], float] = median) -> float | None:
        """Seconds per particle and iteration, start-up not counted; None without a second kind of step."""
        more = self.used[1] - self.used[0]
        if more <= 0:
            return None
        if pick is min:
            return (min(self.many) - min(self.few)) / (more * self.particles)
        return pick([many - few for few, many in zip(self.few, self.many)]) / (more * self.particles)

    def fixed(self, pick: Callable[[Sequence[float]], float] = median) -> float:
        """Seconds per particle and step that iterations do not explain."""
        return pick(self.few) / self.particles - self.used[0] * (self.marginal(pick) or 0.0)


def measure(
    material: str, dimension: int, variants: Sequence[str], rounds: int, warmup_steps: int, tick: Callable[[], None]
) -> list[Costs]:
    """Times all variants in turns. ``tick`` is called after each piece of work; `pieces()` says how often."""
    scene = scene_of(material, dimension)
    variants = [variant for variant in variants if applies(variant, material)]
    costs = [Costs(variant, *_memory(scene, variant)) for variant in variants]
    tick()
    in_turns(scene, costs, rounds, warmup_steps, tick, lambda world, state, own, keep: _time_variant(world, state, own, scene.rate_hz, keep))
    return costs


def in_turns(
    scene: Scene, subjects: Sequence[Subject], rounds: int, warmup_steps: int, tick: Callable[[], None], turn: Callable[[pbmpm.World, Any, Subject, bool], None]
) -> None:
    """Gives each subject its turn in each round, from one state of matter in motion. The first round is not kept: it is for memory and caches.
    ``tick`` is called once per round and twice more."""
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        for _ in range(warmup_steps):
            simulation.step()
        tick()
        state = simulation.world.snapshot()
        for number in range(-1, rounds):
            for own in subjects:
                turn(simulation.world, state, own, number >= 0)
            tick()


def pieces(rounds: int) -> int:
    """How often `measure()` calls ``tick``."""
    return rounds + 3


def choose_variant(world: pbmpm.World, variant: str, iterations: int) -> None:
    """Sets the solver; what the variant does not name is the library's default."""
    options = parse_variant(variant)
    world.iterations = iterations
    world.solver = options["solver"]
    world.pressure = options.get("pressure", "particles")
    world.integrator = options.get("integrator", "euler")
    world.flip = options.get("flip", 0.0)


def _memory(scene: Scene, variant: str) -> tuple[int, float]:
    """Particles, and bytes of a world per particle that knows no other solver, after its first step."""
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        choose_variant(simulation.world, variant, 1)
        simulation.step()
        return len(simulation.world), simulation.world.stats.memory_bytes / len(simulation.world)


def moved_state(world: pbmpm.World, start: Any, variant: str, iterations: int, rate_hz: float, steps: int) -> bytearray:
    """What so many steps of one variant make of a state."""
    world.restore(start)
    choose_variant(world, variant, iterations)
    for _ in range(steps):
        world.step(1.0 / rate_hz)
    return world.snapshot()


def step_from(world: pbmpm.World, state: Any, variant: str, iterations: int, rate_hz: float) -> float:
    """CPU time [s] of a step from a state."""
    world.restore(state)
    choose_variant(world, variant, iterations)
    begin = time.thread_time()
    world.step(1.0 / rate_hz)
    return time.thread_time() - begin


def step_amid(world: pbmpm.World, state: Any, variant: str, iterations: tuple[int, int], rate_hz: float) -> float:
    """CPU time [s] of the second step from a state, amid the motion: to go back to a state forgets what obstacles gave to nodes, which steps keep. ``iterations`` are of
    the two steps."""
    step_from(world, state, variant, iterations[0], rate_hz)
    world.iterations = iterations[1]
    begin = time.thread_time()
    world.step(1.0 / rate_hz)
    return time.thread_time() - begin


def _time_variant(world: pbmpm.World, state: Any, costs: Costs, rate_hz: float, keep: bool) -> None:
    solver = parse_variant(costs.variant)["solver"]
    used = []
    for iterations, times in ((ITERATIONS, costs.few), (2 * ITERATIONS, costs.many)):
        if solver == "explicit" and times is costs.many:
            break  # it has none
        seconds = step_from(world, state, costs.variant, iterations, rate_hz)
        used.append(world.stats.iterations_used)
        if keep:
            times.append(seconds)
            if times is costs.few:
                costs.few_solve.append(seconds * world.stats.ms_iterate / world.stats.ms_total)
    costs.used = (used[0], used[-1])
