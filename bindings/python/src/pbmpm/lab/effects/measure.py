"""Measures what the effects of a scene cost: those it has against the scene without them, the others against it with them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from typing import Any

import pbmpm

from ..errors import InputError
from ..progress import progress_bar
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation, solved_with
from ..state import State, state_of
from .catalogue import EFFECTS, Presence, presences
from .effect import NotHere
from .flowing import emitted_per_second, typical_emitter
from .hosting import HOST_EFFECTS
from .matter import base_kind
from .probe import MOST_STEPS, WARM_UP_STEPS, Comparison, Probe, compare, one_cpu, steps_per_turn

BARE = "bare_scene"
"""Name of the row of the scene with all its effects switched off."""


class BrokenScene(Exception):
    """The scene has failed its checks before it could be measured."""


@dataclass(frozen=True)
class Cost:
    """What a scene with an effect costs over one without it."""

    effect: str
    on: bool
    nanoseconds: float
    """CPU time per particle and step."""
    percent: float
    """Of the step of the scene as it is."""
    percent_error: float
    """Standard error of it, with what the scene seems to cost over itself."""
    bytes_per_particle: float
    facts: dict[str, Any] = field(default_factory=dict)

    def as_row(self) -> dict[str, Any]:
        """The row of a report."""
        return {
            "effect": self.effect,
            "on": self.on,
            "ns_per_particle_step": self.nanoseconds,
            "percent_of_step": self.percent,
            "bytes_per_particle": self.bytes_per_particle,
            "percent_error": self.percent_error,
            **self.facts,
        }


@dataclass
class Measurement:
    """What was measured, of a scene at one moment."""

    scene: Scene
    settings: RunSettings
    time: float
    particles: int
    steps_per_turn: int
    rounds: int
    pinned: bool
    nanoseconds: float
    """Of the scene as it is, per particle and step."""
    control_percent: float
    """What it seems to cost over itself in another world: luck with the places that memory has."""
    bytes_per_particle: float
    costs: list[Cost] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)
    """Effects that cannot be measured here, and why."""

    @property
    def bare(self) -> Cost:
        return self.costs[0]

    @property
    def interplay(self) -> float:
        """What the parts do not explain: ns of the scene less those of the bare scene and of its effects one by one."""
        parts = sum(cost.nanoseconds for cost in self.costs if cost.on)
        return self.nanoseconds - parts


@dataclass(frozen=True)
class Plan:
    """What is asked for."""

    at: float
    """Simulated seconds after which the scene is measured."""
    rounds: int
    only: Sequence[str] | None = None
    """Names of effects; None: all."""

    def wants(self, name: str) -> bool:
        return self.only is None or name in self.only


def names() -> list[str]:
    """All effects that can be measured."""
    return [*(effect.name for effect in EFFECTS), *(effect.name for effect in HOST_EFFECTS)]


def measure(scene: Scene, settings: RunSettings, plan: Plan) -> Measurement:
    """Runs the scene to its moment, then measures every effect against it in turns."""
    scene = solved_with(scene, settings)
    state = settled(scene, settings, plan.at)
    found = presences(scene)
    with one_cpu() as pinned, Probe(scene, settings, state, _room(scene, state, settings)) as whole:
        bench = _Bench(whole, state, steps_per_turn(whole), plan.rounds)
        with progress_bar(1 + len(names()), "effect", scene.name) as bar:
            result = _begin(bench, found, pinned)
            bar.update()
            for item in found:
                if plan.wants(item.effect.name):
                    _try(result, item.effect.name, lambda item=item: bench.scene_cost(item, result.nanoseconds))
                bar.update()
            for host in HOST_EFFECTS:
                if plan.wants(host.name):
                    _try(result, host.name, lambda host=host: bench.host_cost(host, result.nanoseconds))
                bar.update()
    return result


def _try(result: Measurement, name: str, cost: Any) -> None:
    try:
        result.costs.append(cost())
    except (NotHere, InputError, pbmpm.PbmpmError) as problem:
        result.left_out[name] = str(problem)


def settled(scene: Scene, settings: RunSettings, seconds: float) -> State:
    """The state of a scene after so many seconds."""
    steps = math.ceil(seconds * settings.rate_hz - 1e-9)
    with Simulation(scene, settings) as simulation, progress_bar(steps, "step", f"{scene.name} to {seconds:g} s") as bar:
        for _ in range(steps):
            simulation.step()
            bar.update()
        problems = simulation.problems()
        if problems:
            raise BrokenScene(f"{scene.name}: cannot be measured after {seconds:g} s: {'; '.join(problems)}")
        if len(simulation.world) == 0:
            raise InputError(f"{scene.name}: there is no particle after {seconds:g} s; measure at another time (--at)")
        return state_of(simulation)


def _room(scene: Scene, state: State, settings: RunSettings) -> int:
    """The same for all variants, so that their memory can be compared: for the state, and for what emitters bring in a turn,
    those of the scene and one that is tried."""
    seconds = (WARM_UP_STEPS + 1 + MOST_STEPS) * settings.dt
    brought = [seconds * emitted_per_second(part, scene) for part in (*scene.emitters, typical_emitter(scene, state))]
    return len(state) + sum(math.ceil(count) + 1 for count in brought)


class _Bench:
    """Compares variants of a scene with the scene as it is."""

    def __init__(self, whole: Probe, state: State, steps: int, rounds: int) -> None:
        self.whole, self.state, self.steps, self.rounds = whole, state, steps, rounds
        self._room = whole.world.capacity
        self.control = 0.0
        with self.probe(whole.scene, state) as other:
            self.control = self.against(other)[0].ratio - 1.0

    def probe(self, scene: Scene, state: State, host: Any = None) -> Probe:
        settings = RunSettings.of(
            scene,
            self.whole.settings.threads,
            **{name: getattr(self.whole.settings, name) for name in ("rate_hz", "substeps", "iterations")},
        )
        return Probe(scene, settings, state, self._room, host)

    def against(self, other: Probe) -> tuple[Comparison, float]:
        """The other over the whole, and how many more bytes per particle it has. The error knows the control."""
        comparison = compare(self.whole.turn, other.turn, self.steps, self.rounds)
        comparison = replace(comparison, error=math.hypot(comparison.error, self.control))
        return comparison, (other.memory_bytes - self.whole.memory_bytes) / len(self.state)

    def per_particle(self, seconds: float) -> float:
        return 1e9 * seconds / len(self.state)

    def scene_cost(self, item: Presence, whole_ns: float) -> Cost:
        switch = item.effect.off if item.on else item.effect.on
        with self.probe(*switch(self.whole.scene, self.state)) as other:
            comparison, more = self.against(other)
            errors = errors_of(*((self.whole, other) if item.on else (other, self.whole)))
        facts = {
            "description": item.effect.description,
            "tried_as": None if item.on else item.effect.typical,
            "where": item.where,
            "called_for": item.called_for,
            "idle": item.idle,
            **errors,
        }
        return cost_of(item.effect.name, item.on, comparison, more, whole_ns, facts)

    def host_cost(self, host: Any, whole_ns: float) -> Cost:
        with self.probe(self.whole.scene, self.state, host) as other:
            comparison, more = self.against(other)
        facts = {"description": host.description, "tried_as": host.typical, "where": None, "called_for": False, "idle": None}
        return cost_of(host.name, False, comparison, more, whole_ns, facts)


def errors_of(having: Probe, lacking: Probe) -> dict[str, float]:
    """What the library says about the accuracy of the last step of a turn, with an effect and without."""
    one, other = having.world.stats, lacking.world.stats
    return {
        "predicted_error_with": one.predicted_error,
        "predicted_error_without": other.predicted_error,
        "volume_error_with": one.volume_error_rms,
        "volume_error_without": other.volume_error_rms,
    }


def cost_of(
    name: str, on: bool, comparison: Comparison, more_bytes: float, whole_ns: float, facts: dict[str, Any]
) -> Cost:
    """The cost of an effect from the scene with the effect switched the other way over the scene as it is: with the ratio r
    an effect that is on costs the share 1 - r of the step, one that is off would cost r - 1 of it."""
    sign = -1.0 if on else 1.0
    share = sign * (comparison.ratio - 1.0)
    return Cost(
        name, on, share * whole_ns, 100 * share, 100 * comparison.error, sign * more_bytes, {**facts, "samples": comparison.turns}
    )


def bare(scene: Scene, state: State, found: Sequence[Presence]) -> tuple[Scene, State]:
    """The scene with all its effects switched off, one after the other."""

    def without(pair: tuple[Scene, State], item: Presence) -> tuple[Scene, State]:
        try:
            return item.effect.off(*pair)
        except NotHere:
            return pair

    return reduce(without, [item for item in found if item.on], (scene, state))


def _begin(bench: _Bench, found: Sequence[Presence], pinned: bool) -> Measurement:
    """The scene as it is, and the bare scene."""
    whole = bench.whole
    with bench.probe(*bare(whole.scene, bench.state, found)) as other:
        comparison, more = bench.against(other)
    nanoseconds = bench.per_particle(comparison.seconds)
    whole_bytes = whole.memory_bytes / len(bench.state)
    facts = {"description": f"{base_kind(whole.scene)} alone, with all effects switched off", "samples": comparison.turns}
    cost = Cost(
        BARE,
        True,
        comparison.ratio * nanoseconds,
        100 * comparison.ratio,
        100 * comparison.error,
        whole_bytes + more,
        facts,
    )
    return Measurement(
        whole.scene,
        whole.settings,
        bench.state.time + WARM_UP_STEPS * whole.settings.dt,
        len(bench.state),
        bench.steps,
        bench.rounds,
        pinned,
        nanoseconds,
        100 * bench.control,
        whole_bytes,
        [cost],
    )
