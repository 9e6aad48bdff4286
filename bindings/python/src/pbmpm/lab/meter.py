"""Adds up what steps cost and what they left."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np

import pbmpm

PHASES = ("sort", "scatter", "contacts", "iterate", "integrate")
"""The phases of a step that the library times, in their order."""


def stepping_clock(threads: int) -> Callable[[], float]:
    """The clock [s] that tells what steps cost: the processor time of the calling thread where it does all the work, so
    that other programs matter little; wall time where several threads share it."""
    return time.thread_time if threads == 1 else time.perf_counter


class Meter:
    """Totals over the steps of a run. The first ``warmup_steps`` steps do not count for the timing."""

    def __init__(self, warmup_steps: int = 0) -> None:
        self._to_skip = warmup_steps
        self.step_seconds: list[float] = []
        """Wall time of each timed step."""
        self.cpu_seconds = 0.0
        self.work = 0.0
        """Particle-iterations."""
        self.phase_ms = dict.fromkeys(PHASES, 0.0)
        self.volume_error_squares = 0.0
        self.volume_error_max = 0.0
        self.max_speed = 0.0
        self.steps = 0
        self.iterations_used = 0
        """Sum over the steps of the iterations of their last substeps."""
        self.predicted_error_sum = 0.0
        self.stops: Counter[str] = Counter()
        self.energy_checks_failed = 0
        self.awake_steps = 0
        """Particle-steps of particles that were not asleep, among the timed steps."""
        self.particle_steps = 0
        self.blocks_woken = 0
        self.asleep_now = 0

    def add(self, stats: pbmpm.Stats, seconds: float, cpu_seconds: float = 0.0) -> None:
        """Counts one step with its wall time and the CPU time of all threads [s]."""
        self.steps += 1
        self.volume_error_squares += stats.volume_error_rms**2
        self.volume_error_max = max(self.volume_error_max, stats.volume_error_max)
        self.max_speed = max(self.max_speed, stats.max_speed)
        self.iterations_used += stats.iterations_used
        self.predicted_error_sum += stats.predicted_error
        self.stops[stats.stop.name.lower()] += 1
        self.energy_checks_failed += stats.energy_checks_failed
        self.blocks_woken += stats.blocks_woken
        self.asleep_now = stats.particles_asleep
        if self.steps <= self._to_skip:
            return
        self.particle_steps += stats.particle_count
        self.awake_steps += stats.particle_count - stats.particles_asleep
        self.step_seconds.append(seconds)
        self.cpu_seconds += cpu_seconds
        self.work += (stats.particle_count - stats.particles_asleep) * stats.substeps * stats.iterations_used
        for phase in PHASES:
            self.phase_ms[phase] += getattr(stats, f"ms_{phase}")

    @property
    def steps_timed(self) -> int:
        return len(self.step_seconds)

    @property
    def seconds(self) -> float:
        """Wall time of the timed steps."""
        return sum(self.step_seconds)

    @property
    def volume_error_rms(self) -> float:
        """Root mean square over all steps of |J - 1|."""
        return (self.volume_error_squares / self.steps) ** 0.5 if self.steps else 0.0

    @property
    def mean_iterations_used(self) -> float | None:
        """Per substep, judged by the last substep of each step."""
        return self.iterations_used / self.steps if self.steps else None

    @property
    def mean_predicted_error(self) -> float | None:
        """Mean over the steps [cells]; 0 for solvers that predict none."""
        return self.predicted_error_sum / self.steps if self.steps else None

    def ms_per_simulated_second(self, dt: float) -> float | None:
        """Wall milliseconds of the timed steps per simulated second."""
        return 1e3 * self.seconds / (self.steps_timed * dt) if self.steps_timed else None

    def ms_per_step(self, percentile: float) -> float | None:
        """A percentile of the wall time of a step; 50 is the median."""
        return 1e3 * float(np.percentile(self.step_seconds, percentile)) if self.step_seconds else None

    def figures(self, dt: float) -> dict[str, Any]:
        """The part of a report that speaks of cost and of extremes over the run."""
        return {
            "steps": self.steps,
            **self._cost(dt),
            "iterations_used": self.mean_iterations_used,
            "predicted_error": self.mean_predicted_error,
            "stops": dict(self.stops),
            "energy_checks_failed": self.energy_checks_failed,
            "particles_asleep": self.asleep_now,
            "awake_share": self.awake_steps / self.particle_steps if self.particle_steps else None,
            "blocks_woken": self.blocks_woken,
            "volume_error_rms_over_run": self.volume_error_rms,
            "volume_error_max_over_run": self.volume_error_max,
            "max_speed_over_run": self.max_speed,
        }

    def _cost(self, dt: float) -> dict[str, Any]:
        timed = self.steps_timed > 0 and self.seconds > 0
        iterate, cpu = self.phase_ms["iterate"], self.cpu_seconds
        return {
            "steps_timed": self.steps_timed,
            "wall_seconds_timed": self.seconds,
            "cpu_seconds_timed": cpu,
            "ms_per_simulated_second": self.ms_per_simulated_second(dt),
            "million_particle_iterations_per_second": self.work / self.seconds / 1e6 if timed else None,
            "million_particle_iterations_per_cpu_second": self.work / cpu / 1e6 if cpu else None,
            "million_particle_iterations_per_second_in_iterate": self.work / iterate / 1e3 if iterate > 0 else None,
            "ms_per_step": 1e3 * self.seconds / self.steps_timed if timed else None,
            "ms_per_step_median": self.ms_per_step(50),
            "ms_per_step_p99": self.ms_per_step(99),
            "ms_per_step_by_phase": {name: total / self.steps_timed for name, total in self.phase_ms.items()}
            if timed
            else {},
        }
