"""Adds up what steps cost and what they left."""

from __future__ import annotations

from typing import Any

PHASES = ("sort", "scatter", "contacts", "iterate", "integrate")
"""The phases of a step that the library times, in their order."""


class Meter:
    """Totals over the steps of a run. The first ``warmup_steps`` steps do not count for the timing."""

    def __init__(self, warmup_steps: int = 0) -> None:
        self._to_skip = warmup_steps
        self.steps_timed = 0
        self.seconds = 0.0
        self.cpu_seconds = 0.0
        self.work = 0.0
        """Particle-iterations."""
        self.phase_ms = dict.fromkeys(PHASES, 0.0)
        self.volume_error_squares = 0.0
        self.volume_error_max = 0.0
        self.max_speed = 0.0
        self.steps = 0

    def add(self, stats: Any, seconds: float, cpu_seconds: float = 0.0) -> None:
        """Counts one step with its wall time and the CPU time of all threads [s]."""
        self.steps += 1
        self.volume_error_squares += stats.volume_error_rms**2
        self.volume_error_max = max(self.volume_error_max, stats.volume_error_max)
        self.max_speed = max(self.max_speed, stats.max_speed)
        if self.steps <= self._to_skip:
            return
        self.steps_timed += 1
        self.seconds += seconds
        self.cpu_seconds += cpu_seconds
        self.work += stats.particle_count * stats.substeps * stats.iterations
        for phase in PHASES:
            self.phase_ms[phase] += getattr(stats, f"ms_{phase}")

    @property
    def volume_error_rms(self) -> float:
        """Root mean square over all steps of |J - 1|."""
        return (self.volume_error_squares / self.steps) ** 0.5 if self.steps else 0.0

    def ms_per_simulated_second(self, dt: float) -> float | None:
        """Wall milliseconds of the timed steps per simulated second."""
        return 1e3 * self.seconds / (self.steps_timed * dt) if self.steps_timed else None

    def figures(self, dt: float) -> dict[str, Any]:
        """The part of a report that speaks of cost and of extremes over the run."""
        timed = self.steps_timed > 0 and self.seconds > 0
        iterate = self.phase_ms["iterate"]
        return {
            "steps": self.steps,
            "steps_timed": self.steps_timed,
            "wall_seconds_timed": self.seconds,
            "cpu_seconds_timed": self.cpu_seconds,
            "ms_per_simulated_second": self.ms_per_simulated_second(dt),
            "million_particle_iterations_per_second": self.work / self.seconds / 1e6 if timed else None,
            "million_particle_iterations_per_cpu_second": self.work / self.cpu_seconds / 1e6
            if self.cpu_seconds
            else None,
            "million_particle_iterations_per_second_in_iterate": self.work / iterate / 1e3 if iterate > 0 else None,
            "ms_per_step": 1e3 * self.seconds / self.steps_timed if timed else None,
            "ms_per_step_by_phase": {name: total / self.steps_timed for name, total in self.phase_ms.items()}
            if timed
            else {},
            "volume_error_rms_over_run": self.volume_error_rms,
            "volume_error_max_over_run": self.volume_error_max,
            "max_speed_over_run": self.max_speed,
        }
