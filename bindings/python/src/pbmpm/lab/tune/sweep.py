"""Measures a scene's settings against its converged solution."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

from ..errors import InputError
from ..progress import progress_bar
from ..report.pareto import front_of
from ..scenes.scene import Scene
from ..simulation import RunSettings
from ..workers.attempt import Lost
from ..workers.workers import Workers
from . import candidates as plans
from .distance import ALIKE, Distance, distance
from .observe import Observation, observe
from .visible import Visible, visible

#: Errors above this [cells] show: matter is a cell away from where it belongs.
SHOWS = 1.0
#: Share of the budget that each preset may use.
SHARES = {"low": 0.25, "medium": 0.5, "high": 1.0}
#: A setting whose first frames cost more than this many budgets is given up.
FAR_TOO_DEAR = 4.0


@dataclass(frozen=True)
class Plan:
    """What a sweep is asked for."""

    seconds: float
    frame_rate: float
    budget_ms: float
    threads: int
    percentile: float  #: of the frame times that has to keep the budget
    reference_substeps: int = plans.REFERENCE_SUBSTEPS
    reference_iterations: int = plans.REFERENCE_ITERATIONS


@dataclass
class Reference:
    """The converged solution, and how much it changes when it is solved with half the substeps."""

    observation: Observation
    halved: Distance

    @property
    def by_particles(self) -> bool:
        """Whether particles are compared one by one: only when they do the same in both converged runs."""
        return self.halved.particles is not None and self.halved.particles < ALIKE

    @property
    def floor(self) -> float:
        """Errors below this cannot be told apart [cells]."""
        return self.halved.error(self.by_particles) or 0.0


@dataclass(frozen=True)
class Result:
    """One setting of the sweep. Times are wall milliseconds per frame."""

    settings: RunSettings
    error: float  #: [cells]; infinite where it broke or was given up
    ms_median: float
    ms_p99: float
    cost: float  #: the percentile of the frame times that has to keep the budget
    iterations_used: float
    predicted_error: float  #: mean over the frames, by the library [cells]
    parts: Distance | None
    reasons: tuple[str, ...]  #: why it is not stable
    too_dear: bool
    seen: Visible | None = None
    interruptions: int = 0

    @property
    def usable(self) -> bool:
        """Whether it may become a preset."""
        return math.isfinite(self.error) and not self.reasons

    @property
    def good(self) -> bool:
        """Whether its error does not show."""
        return self.usable and self.error <= SHOWS

    def as_dict(self) -> dict[str, Any]:
        """The row of a report."""
        parts = self.parts
        return {
            **self.settings.as_dict(),
            "error": self.error,
            "error_unit": "cells",
            "particles": parts.particles if parts else None,
            "spread": parts.spread if parts else None,
            "energy": parts.energy if parts else None,
            "crowding": parts.crowding if parts else None,
            "seen": self.seen.text() if self.seen else None,
            "seen_cells": self.seen.cells if self.seen else None,
            "ms_median": self.ms_median,
            "ms_p99": self.ms_p99,
            "interruptions": self.interruptions,
            "iterations_used": self.iterations_used,
            "predicted_error_by_library": self.predicted_error,
            "stable": not self.reasons,
            "reasons": list(self.reasons),
            "given_up": self.too_dear,
        }


@dataclass
class Tuning:
    """A sweep's results."""

    scene: Scene
    plan: Plan
    reference: Reference
    results: list[Result] = field(default_factory=list)
    skipped: int = 0  #: settings that can only be dearer than one that was given up
    alone: dict[RunSettings, float] = field(default_factory=dict)  #: median ms per frame with one thread, of the settings of presets

    def front(self) -> list[Result]:
        """The settings that no other beats in both time and error, cheap ones first."""
        return front_of(result for result in self.results if result.usable)

    def best_within(self, ms: float) -> Result | None:
        """The setting with the lowest error whose frames keep a budget."""
        fitting = [result for result in self.front() if result.cost <= ms]
        return fitting[-1] if fitting else None

    def cheapest(self, good: bool = False) -> Result | None:
        """The cheapest usable setting, or the cheapest whose error does not show."""
        return min((item for item in self.results if (item.good if good else item.usable)), key=lambda item: item.cost, default=None)


@dataclass(frozen=True)
class Family:
    """Settings that differ in their iterations alone, cheap ones first. One worker measures them all, since what comes after
    one that is given up is not tried."""

    scene: Scene
    plan: Plan
    reference: Reference
    settings: tuple[RunSettings, ...]


def tune(scene: Scene, plan: Plan, workers: Workers) -> Tuning:
    """Solves the reference, then measures all candidates. One worker measures one after the other, so that they do not disturb
    each other."""
    families = _families(plans.candidates(scene, plan.frame_rate, plan.threads))
    with progress_bar(sum(map(len, families)) + 2, "run", scene.name) as bar:
        tuning = Tuning(scene, plan, _reference(scene, plan, workers, bar))
        found: dict[int, list[Result]] = {}

        def note(index: int, results: Any) -> None:
            lost = isinstance(results, Lost)
            found[index] = [_lost(item, results.reason) for item in families[index]] if lost else results
            bar.update(len(families[index]))

        workers.carry_out(measure_family, [Family(scene, plan, tuning.reference, items) for items in families], note)
        tuning.results = [result for index in range(len(families)) for result in found[index]]
        tuning.skipped = sum(map(len, families)) - len(tuning.results)
        if plan.threads != 1:
            _measure_alone(tuning, bar)
    return tuning


def _families(settings: list[RunSettings]) -> list[tuple[RunSettings, ...]]:
    families: dict[tuple[Any, ...], list[RunSettings]] = {}
    for item in settings:
        families.setdefault((item.solver, item.integrator, item.substeps, item.target_error), []).append(item)
    return [tuple(items) for items in families.values()]


def measure_family(family: Family) -> list[Result]:
    """The results of its settings, up to one that is given up as too dear: what comes after it can only be dearer."""
    results: list[Result] = []
    for settings in family.settings:
        results.append(_measure(family, settings))
        if results[-1].too_dear:
            break
    return results


def _measure_alone(tuning: Tuning, bar: Any) -> None:
    """The settings that presets will hold, with one thread: small scenes need no more."""
    best = [tuning.best_within(share * tuning.plan.budget_ms) for share in SHARES.values()]
    for settings in {item.settings: None for item in best if item is not None}:
        bar.set_postfix_str(f"one thread: {settings.text()}")
        tuning.alone[settings] = observe(tuning.scene, replace(settings, threads=1), tuning.plan.seconds).ms(tuning.plan.percentile)


def _reference(scene: Scene, plan: Plan, workers: Workers, bar: Any) -> Reference:
    """The converged run, and the one with half of its substeps."""
    full = plans.reference(scene, plan.frame_rate, plan.threads, plan.reference_substeps, plan.reference_iterations)
    runs = [(scene, replace(full, substeps=substeps), plan.seconds) for substeps in (full.substeps, max(1, full.substeps // 2))]
    observations: dict[int, Observation] = {}

    def note(index: int, observation: Any) -> None:
        reasons = [observation.reason] if isinstance(observation, Lost) else observation.reasons
        if reasons:
            raise InputError(f"{scene.name}: the converged solution breaks ({runs[index][1].text()}): {'; '.join(reasons)}")
        observations[index] = observation
        bar.update()

    bar.set_postfix_str(f"reference: {full.text()}")
    workers.carry_out(observe_reference, runs, note)
    bar.set_postfix_str("")
    return Reference(observations[0], distance(scene, observations[1], observations[0]))


def observe_reference(run: tuple[Scene, RunSettings, float]) -> Observation:
    """One of the two runs for the reference."""
    return observe(*run)


def _lost(settings: RunSettings, reason: str) -> Result:
    nothing = math.nan
    return Result(settings, math.inf, nothing, nothing, nothing, nothing, nothing, None, (reason,), False)


def _measure(family: Family, settings: RunSettings) -> Result:
    plan, reference = family.plan, family.reference
    observation = observe(family.scene, settings, plan.seconds, FAR_TOO_DEAR * plan.budget_ms)
    done = observation.stable and not observation.too_dear
    parts = distance(family.scene, observation, reference.observation) if done else None
    error = parts.error(reference.by_particles) if parts else None
    return Result(
        settings,
        math.inf if error is None else error,
        observation.ms(50),
        observation.ms(99),
        observation.ms(plan.percentile),
        observation.iterations_used,
        observation.predicted_error,
        parts,
        tuple(observation.reasons),
        observation.too_dear,
        visible(family.scene, observation, reference.observation) if done else None,
        observation.interruptions,
    )
