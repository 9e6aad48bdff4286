"""This library beside Taichi's examples of the method, in turns on one core.

What is compared are particles times iterations per second of CPU time, whole steps of ours, with particles times substeps of theirs. Each passes matter to the grid and back once. They are not the
same work: an iteration solves for a stiff step, a substep is explicit. So simulated seconds per second stand beside it.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

import pbmpm

from ..errors import InputError
from .measure import in_turns, moved_state, step_amid
from .phases import PHASE_VARIANTS, RATE_HZ
from .subjects import scene_of

PAIRS = (("mpm3d", "liquid", 3), ("jelly", "elastic", 3), ("mpm99", "liquid", 2), ("mpm99", "elastic", 2))
"""Example, and what it is compared with."""
ITERATIONS = (5, 10)
WARMUP_SUBSTEPS = 60
SUBSTEPS = 5
"""In each turn."""

RUNNER = Path(__file__).with_name("peer_taichi.py")


class Peer:
    """A program that speaks as ``peer_taichi.py`` does."""

    def __init__(self, command: Sequence[str]) -> None:
        self._said = tempfile.TemporaryFile("w+")  # a pipe that nobody empties would stop it once it has warned enough
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._said, text=True)
        self.facts = self._answer()
        self.seconds: list[float] = []

    def __enter__(self) -> Peer:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._said.close()

    def take(self, substeps: int) -> float:
        """CPU time [s] of so many substeps."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{substeps}\n")
        self._process.stdin.flush()
        answer = self._answer()
        if not abs(answer["height"]) < float("inf"):
            raise InputError("the peer's particles have left the numbers: their mean height is not finite")
        return float(answer["seconds"])

    def _answer(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            self._process.wait()
            self._said.seek(0)
            said = self._said.read().strip().splitlines() or ["it ended without a word"]
            raise InputError(f"the peer does not run: {said[-1]} (pip install 'pbmpm[peers]', or name a Python that has Taichi by --peer-python)")
        facts: dict[str, Any] = json.loads(line)
        return facts

    def turn(self, keep: bool) -> None:
        """Substeps of one round; kept per substep."""
        seconds = self.take(SUBSTEPS) / SUBSTEPS
        if keep:
            self.seconds.append(seconds)


@dataclass
class Own:
    """What steps of this library took, round by round [s]."""

    variant: str
    iterations: int
    particles: int = 0
    state: bytearray | None = None
    """From where its steps begin: where it brought the matter itself."""
    seconds: list[float] = field(default_factory=list)

    def turn(self, world: pbmpm.World, keep: bool) -> None:
        """A step of one round."""
        self.particles = len(world)
        seconds = step_amid(world, self.state, self.variant, (self.iterations, self.iterations), RATE_HZ)
        if keep:
            self.seconds.append(seconds)


def measure_peer(command: Sequence[str], pair: tuple[str, str, int], rounds: int, warmup_steps: int, tick: Callable[[], None]) -> list[dict[str, Any]]:
    """Rows of one pair; ``command`` runs the peer. ``tick`` is called `peer_pieces()` times."""
    example, material, dimension = pair
    own = [Own(variant, iterations) for variant in PHASE_VARIANTS for iterations in ITERATIONS]
    with Peer(command) as peer:
        peer.take(WARMUP_SUBSTEPS)

        def turn(world: pbmpm.World, start: Any, subject: Own | Peer, keep: bool) -> None:
            if isinstance(subject, Peer):
                subject.turn(keep)
                return
            if subject.state is None:
                subject.state = moved_state(world, start, subject.variant, subject.iterations, RATE_HZ, warmup_steps)
            subject.turn(world, keep)

        in_turns(scene_of(material, dimension), [*own, peer], rounds, 0, tick, turn)
    return [peer_row(example, material, dimension, costs, peer.facts, peer.seconds) for costs in own]


def peer_pieces(rounds: int) -> int:
    """How often `measure_peer()` calls ``tick``."""
    return rounds + 2


def peer_row(example: str, material: str, dimension: int, own: Own, facts: dict[str, Any], theirs: Sequence[float]) -> dict[str, Any]:
    """One row of the report. A ratio above 1: this library does more."""
    work, peer_work = 1e-6 * own.iterations * own.particles, 1e-6 * facts["particles"]
    return {
        "peer": example,
        "peer_version": facts["version"],
        "peer_particles": facts["particles"],
        "material": material,
        "dims": dimension,
        "solver": own.variant,
        "iterations": own.iterations,
        "particles": own.particles,
        "million_particle_iterations_per_second": work / median(own.seconds),
        "peer_million_particle_substeps_per_second": peer_work / median(theirs),
        "ratio": work / peer_work * median(b / a for a, b in zip(own.seconds, theirs)),
        "ratio_of_least": work / peer_work * min(theirs) / min(own.seconds),
        "simulated_seconds_per_second": 1.0 / RATE_HZ / median(own.seconds),
        "peer_simulated_seconds_per_second": facts["dt"] / median(theirs),
    }


def peers_text(rows: Sequence[dict[str, Any]]) -> str:
    """The rows for a person."""
    lines = [
        "Million particle-iterations per second, whole steps, over the peer's particle-substeps: median of a round's ratios, and the ratio of the least times;"
        " CPU time, one thread. In brackets simulated seconds per second of CPU."
    ]
    for key in dict.fromkeys((row["peer"], row["material"], row["dims"]) for row in rows):
        own = [row for row in rows if (row["peer"], row["material"], row["dims"]) == key]
        first = own[0]
        lines.append(
            f"\n{first['peer']} of {first['peer_version']}, {first['peer_particles']} particles: {first['peer_million_particle_substeps_per_second']:.2f}"
            f" ({first['peer_simulated_seconds_per_second']:.4f}); {key[1]} {key[2]}D, {first['particles']} particles:"
        )
        lines += [
            f"  {row['solver']:<12} {row['iterations']:>3} iterations {row['million_particle_iterations_per_second']:>8.2f}"
            f" ({row['simulated_seconds_per_second']:.3f})  ratio {row['ratio']:>6.1f}, {row['ratio_of_least']:.1f}"
            for row in own
        ]
    return "\n".join(lines)
