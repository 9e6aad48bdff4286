"""Running the same steps of a scene again and again, and clocking them.

What is clocked is the CPU time of the process inside the library's calls, of all its threads: unlike wall time it does not
see other processes that take the CPU away. What other processes do to caches and clock rates it does see; therefore two
scenes are compared in turns, pinned to one CPU where the system can, and the median over the turns is taken.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation
from ..state import State
from .hosting import HostEffect

WARM_UP_STEPS = 3
"""After which the figures of a transplanted state no longer tell that it was transplanted."""
TURN_SECONDS = 0.02
"""CPU time of a turn, at least: far above what reading the clock costs."""
MOST_STEPS = 32
"""Of a turn: the state must stay about what it was."""
_MEDIAN_ERROR = 0.93  # standard error of a median of n normal values: 1.2533 sd / sqrt(n), with sd = 0.7413 (q75 - q25)


class Probe(Simulation):
    """A simulation that always begins with the same state. Use it as a context manager."""

    def __init__(
        self, scene: Scene, settings: RunSettings, state: State, room: int, host: HostEffect | None = None
    ) -> None:
        self.seconds = 0.0
        """CPU time of the steps so far."""
        super().__init__(scene, settings, state, room)
        try:
            self._advance = host.prepare(self.world, state) if host is not None else self.world.step
            time_to_sleep = self.world.sleep_time
            self.world.sleep_time = 0.0  # what is at rest sleeps at once, as it would if it had not been put here
            self.step()
            self.memory_bytes = self.world.stats.memory_bytes + (host.host_bytes(self.world) if host is not None else 0)
            for _ in range(WARM_UP_STEPS - 1):
                self.step()
            self.world.sleep_time = time_to_sleep
            self._start = self.bookmark()
        except BaseException:
            self.world.close()
            raise

    def __enter__(self) -> Probe:
        return self

    def advance(self, dt: float) -> None:
        begin = time.process_time()
        self._advance(dt)
        self.seconds += time.process_time() - begin

    def turn(self, steps: int) -> float:
        """CPU time [s] of some steps from the start, after one step that is not counted: caches are cold."""
        self.go_back(self._start)
        self.step()
        before = self.seconds
        for _ in range(steps):
            self.step()
        return self.seconds - before


@dataclass(frozen=True)
class Comparison:
    """Two scenes in turns."""

    ratio: float
    """Median over the turns of the second one's time over the first one's."""
    error: float
    """Standard error of the ratio."""
    seconds: float
    """Median of the first one's time per step."""
    turns: int


def compare(first: Callable[[int], float], second: Callable[[int], float], steps: int, rounds: int) -> Comparison:
    """Lets two probes take turns of some steps; every other round the second one goes first."""
    times = np.empty((rounds, 2))
    for index in range(rounds):
        if index % 2 == 0:
            times[index, 0] = first(steps)
            times[index, 1] = second(steps)
        else:
            times[index, 1] = second(steps)
            times[index, 0] = first(steps)
    return comparison_of(times, steps)


def comparison_of(times: np.ndarray, steps: int) -> Comparison:
    """The figures of (rounds, 2) times of so many steps each."""
    ratios = times[:, 1] / times[:, 0]
    low, middle, high = np.percentile(ratios, [25, 50, 75])
    error = _MEDIAN_ERROR * (high - low) / math.sqrt(len(ratios))
    return Comparison(float(middle), float(error), float(np.median(times[:, 0])) / steps, len(ratios))


def steps_per_turn(probe: Probe) -> int:
    """So many that a turn takes TURN_SECONDS."""
    each = probe.turn(2) / 2
    return max(2, min(MOST_STEPS, math.ceil(TURN_SECONDS / max(each, 1e-9))))


@contextmanager
def one_cpu() -> Iterator[bool]:
    """Keeps the process on one CPU inside the block; says whether the system can."""
    if not hasattr(os, "sched_setaffinity"):
        yield False
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(allowed)})
    try:
        yield True
    finally:
        os.sched_setaffinity(0, allowed)
