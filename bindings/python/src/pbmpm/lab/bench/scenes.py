"""Whole scenes: how many times faster than real time each runs, as its file says and at the pace of a game.

Each round starts every scene anew, with both settings in turns. Times are CPU times on one thread that stays on one core. What the pace of a game
costs in quality is shown beside it, by the one measure that every scene has: how far volumes are from what they should be.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from ..meter import Meter
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation

GAME: dict[str, Any] = {"rate_hz": 60.0, "substeps": 1, "iterations": 5, "solver": "convergent"}
"""A step per frame, and few iterations of the solver that suits the matter."""
LONGEST = 5.0
"""Simulated at most of each scene [s]."""


@dataclass
class SceneCosts:
    """What one scene took with one kind of settings."""

    scene: str
    dimension: int
    pace: str
    """``file`` or ``game``."""
    settings: RunSettings
    seconds: float
    """Simulated in each round."""
    runs: list[Meter] = field(default_factory=list)
    particles: int = 0
    """At the end."""

    def milliseconds(self) -> list[float]:
        """Per simulated second, round by round."""
        return [1e3 * sum(run.step_seconds) / self.seconds for run in self.runs]

    @property
    def times_real_time(self) -> float:
        """Median of the rounds."""
        return 1e3 / median(self.milliseconds())


def measure_scenes(scenes: Sequence[Scene], rounds: int, tick: Callable[[], None]) -> list[SceneCosts]:
    """Times the scenes; ``tick`` is called `scene_pieces()` times."""
    costs = [_costs(scene, pace, changes) for scene in scenes for pace, changes in (("file", {}), ("game", GAME))]
    for _ in range(rounds):
        for own, scene in zip(costs, [scene for scene in scenes for _ in range(2)]):
            _run(scene, own)
            tick()
    return costs


def scene_pieces(scenes: Sequence[Scene], rounds: int) -> int:
    """How often `measure_scenes()` calls ``tick``."""
    return 2 * len(scenes) * rounds


def _costs(scene: Scene, pace: str, changes: dict[str, Any]) -> SceneCosts:
    return SceneCosts(scene.name, scene.dimension, pace, RunSettings.of(scene, 1, **changes), min(scene.seconds, LONGEST))


def _run(scene: Scene, costs: SceneCosts) -> None:
    meter = Meter()
    steps = max(1, round(costs.seconds * costs.settings.rate_hz))
    with Simulation(scene, costs.settings) as simulation:
        for _ in range(steps):
            begin = time.thread_time()
            simulation.step()
            seconds = time.thread_time() - begin
            meter.add(simulation.stats(), seconds, seconds)
        costs.particles = len(simulation.world)
    costs.seconds = steps * costs.settings.dt
    costs.runs.append(meter)


def scene_row(costs: SceneCosts) -> dict[str, Any]:
    """One row of the report."""
    each, last = costs.milliseconds(), costs.runs[-1]
    return {
        "scene": costs.scene,
        "dims": costs.dimension,
        "pace": costs.pace,
        "rate_hz": costs.settings.rate_hz,
        "substeps": costs.settings.substeps,
        "iterations": costs.settings.iterations,
        "solver": costs.settings.solver_text(),
        "particles": costs.particles,
        "simulated_seconds": costs.seconds,
        "ms_per_simulated_second": median(each),
        "ms_per_simulated_second_min": min(each),
        "times_real_time": costs.times_real_time,
        "ms_per_step_p99": median(run.ms_per_step(99) or 0.0 for run in costs.runs),
        "volume_error_rms": last.volume_error_rms,
    }


def scenes_text(rows: Sequence[dict[str, Any]]) -> str:
    """The rows for a person."""
    lines = [
        f"Times faster than real time, ms per simulated second (median, least) and per step (99 of 100 take less), of up to {LONGEST:g} s of each scene;"
        " CPU times, one thread."
    ]
    for row in rows:
        pace = f"{row['rate_hz']:g} Hz{' x ' + str(row['substeps']) if row['substeps'] > 1 else ''} x {row['iterations']}, {row['solver']}"
        lines.append(
            f"  {row['scene']:<22} {row['dims']}D {row['particles']:>7} particles  {pace:<24} {row['times_real_time']:>6.1f} x"
            f"  {row['ms_per_simulated_second']:>8.1f} {row['ms_per_simulated_second_min']:>8.1f}  {row['ms_per_step_p99']:>7.2f}"
            f"  volume error {100.0 * row['volume_error_rms']:.1f} %"
        )
    return "\n".join(lines)
