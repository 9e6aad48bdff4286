"""Where the time of a step goes, at the pace of a game: phase by phase.

The library's statistics tell the wall time of each phase; each gets that share of the step's CPU time. They do not tell what starts a solver
(guesses, matrices) from its iterations. A step with more iterations from the same state does: the difference in CPU time is iterations alone.
Each solver steps from where it brought the matter itself. Another program that takes the core away meanwhile lengthens one phase: of `TRIES` steps that one counts whose
wall time is the least over its CPU time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

import pbmpm

from .measure import in_turns, moved_state, step_amid
from .subjects import scene_of

RATE_HZ = 60.0
ITERATIONS = 5
MANY_ITERATIONS = 4 * ITERATIONS
TRIES = 5
DISTURBED = 1.05
"""Wall time over CPU time above which the text says that others had the core, too: phases are then off by as much."""
PHASE_VARIANTS = ("convergent", "paper")
"""Solvers that are measured when none is named."""

LAPS = {"sort": "ms_sort", "scatter": "ms_scatter", "contacts": "ms_contacts", "solve": "ms_iterate", "integrate": "ms_integrate"}
"""Phases that the library has a clock for, and the statistic of each."""

PHASES = ("sort", "scatter", "contacts", "start", "iterations", "solve", "integrate", "other")
"""In the order of a step, which is their sum. ``start``: what the solver does before its iterations; where more iterations could not be had, both are one,
``solve``. ``other``: between the phases, and emitters."""

TIMED = ("iterations", "iteration", "rest", "step")
"""What CPU times of steps tell by themselves. The others have a share of one, which is too low where others had the core in another phase: their least says nothing."""

Pick = Callable[[Sequence[float]], float]


@dataclass
class PhaseCosts:
    """What the phases of one variant's steps took, round by round [s]."""

    variant: str
    particles: int = 0
    state: bytearray | None = None
    """From where its steps begin."""
    memory_bytes: int = 0
    """Of the world, which knows all variants."""
    few: list[dict[str, float]] = field(default_factory=list)
    """Steps with `ITERATIONS` iterations: seconds by the names of `LAPS`, ``other`` and ``step``."""
    many: list[dict[str, float]] = field(default_factory=list)
    """Steps with `MANY_ITERATIONS`."""
    wall_over_cpu: list[float] = field(default_factory=list)
    """Of all these steps."""
    used: tuple[int, int] = (0, 0)
    """Iterations that both kinds of steps did."""

    def seconds(self, pick: Pick = median) -> dict[str, float]:
        """Of each phase, of one ``iteration``, of the ``rest`` of a step and of the whole ``step``."""
        laps = {name: pick([taken[name] for taken in self.few]) for name in (*LAPS, "other", "step")}
        if pick is min:
            more = min(taken["step"] for taken in self.many) - laps["step"]
        else:
            more = pick([many["step"] - few["step"] for few, many in zip(self.few, self.many)])
        return split_solve(laps, more, self.used)


def split_solve(laps: Mapping[str, float], more: float, used: tuple[int, int]) -> dict[str, float]:
    """Phases, an iteration and the rest of a step from what is known of its laps, and what ``used[1] - used[0]`` iterations add to it."""
    parts = dict(laps)
    if used[1] > used[0]:
        parts["iteration"] = more / (used[1] - used[0])
        parts["iterations"] = used[0] * parts["iteration"]
        parts["start"] = parts.pop("solve") - parts["iterations"]
        parts["rest"] = parts["step"] - parts["iterations"]
    return parts


def measure_phases(
    material: str, dimension: int, variants: Sequence[str], rounds: int, warmup_steps: int, tick: Callable[[], None]
) -> list[PhaseCosts]:
    """Times the phases of all variants in turns. ``tick`` is called `phase_pieces()` times."""
    costs = [PhaseCosts(variant) for variant in variants]

    def turn(world: pbmpm.World, start: Any, own: PhaseCosts, keep: bool) -> None:
        if own.state is None:
            own.state = moved_state(world, start, own.variant, ITERATIONS, RATE_HZ, warmup_steps)
        _time_phases(world, own, keep)

    in_turns(scene_of(material, dimension), costs, rounds, 0, tick, turn)
    return costs


def phase_pieces(rounds: int) -> int:
    """How often `measure_phases()` calls ``tick``."""
    return rounds + 2


def _time_phases(world: pbmpm.World, costs: PhaseCosts, keep: bool) -> None:
    costs.particles, costs.memory_bytes = len(world), world.step_stats.memory_bytes
    used = []
    for iterations, times in ((ITERATIONS, costs.few), (MANY_ITERATIONS, costs.many)):
        taken = [_laps(world, costs, iterations) for _ in range(TRIES)]
        used.append(world.step_stats.iterations_used)
        if keep:
            wall_over_cpu, laps = min(taken, key=lambda lap: lap[0])
            times.append(laps)
            costs.wall_over_cpu.append(wall_over_cpu)
    costs.used = (used[0], used[1])


def _laps(world: pbmpm.World, costs: PhaseCosts, iterations: int) -> tuple[float, dict[str, float]]:
    """Of one step: wall time over CPU time, and CPU seconds of each lap."""
    seconds = step_amid(world, costs.state, costs.variant, (ITERATIONS, iterations), RATE_HZ)
    stats = world.step_stats
    shares = {name: getattr(stats, member) / stats.ms_total for name, member in LAPS.items()}
    shares |= {"other": 1.0 - sum(shares.values()), "step": 1.0}
    return 1e-3 * stats.ms_total / seconds, {name: seconds * share for name, share in shares.items()}


def phase_rows(material: str, dimension: int, costs: PhaseCosts) -> list[dict[str, Any]]:
    """Rows of the report: a phase each, then one iteration, the rest of the step, and all of it."""
    middle, least = costs.seconds(), costs.seconds(min)
    return [
        {
            "material": material,
            "dims": dimension,
            "solver": costs.variant,
            "rate_hz": RATE_HZ,
            "iterations": costs.used[0],
            "particles": costs.particles,
            "phase": phase,
            "ns_per_particle": 1e9 * middle[phase] / costs.particles,
            "ns_per_particle_min": 1e9 * least[phase] / costs.particles if phase in TIMED else None,
            "wall_over_cpu": median(costs.wall_over_cpu),
            "share": middle[phase] / middle["step"],
        }
        for phase in (*PHASES, "iteration", "rest", "step")
        if phase in middle
    ]


def phases_text(rows: Sequence[Mapping[str, Any]], columns: Sequence[tuple[str, str, str]] = ()) -> str:
    """The rows for a person; ``columns`` are more of them: a key of rows, its title and its format."""
    shown = (("ns_per_particle", "ns", "{:.1f}"), ("ns_per_particle_min", "least", "{:.1f}"), ("share", "of step", "{:.0%}"), *columns)
    titles = {"iteration": "one iteration", "rest": "step without iterations", "step": "step"}
    lines = [f"Per particle, {RATE_HZ:g} Hz x {ITERATIONS}: CPU time of each phase of a step, median and least, one thread."]
    for key in dict.fromkeys((row["material"], row["dims"], row["solver"]) for row in rows):
        own = [row for row in rows if (row["material"], row["dims"], row["solver"]) == key]
        lines += ["", f"{key[0]} {key[1]}D, {key[2]}, {own[0]['particles']} particles, {own[0]['iterations']} iterations"]
        lines.append(f"  {'':24}" + "".join(f"{title:>12}" for _, title, _ in shown))
        if own[0]["wall_over_cpu"] > DISTURBED:
            lines.append(f"  Others had the core, too: wall time {own[0]['wall_over_cpu']:.2f} times CPU time. Phases are uncertain by as much; the step is not.")
        for row in own:
            lines.append(f"  {titles.get(row['phase'], row['phase']):24}" + "".join(f"{_cell(row.get(name), form):>12}" for name, _, form in shown))
    return "\n".join(lines)


def _cell(value: float | None, form: str) -> str:
    return "-" if value is None else form.format(value)
