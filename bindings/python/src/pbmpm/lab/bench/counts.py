"""How many floating-point operations each phase of a step does, and how many bytes it moves: counted, not timed.

Valgrind's tool Callgrind runs steps on a simulated CPU and says how often it executed each instruction; objdump says which of these are sums, products, quotients or
roots, and of how many lanes. A fused product and sum is two, lanes that are masked count, comparisons and conversions do not. A simulated cache, as large as one
core's own, says how many lines of 64 bytes came from beyond it and went back there. Phases begin where the library calls the functions in `STARTS`.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pbmpm

from ..errors import InputError
from ..simulation import RunSettings, Simulation
from .measure import choose_variant
from .phases import ITERATIONS, LAPS, RATE_HZ, split_solve
from .subjects import scene_of

STEP_BEGINS, STEP_ENDS = "pool_set_serial", "colliders_end_step"
STARTS = {
    STEP_BEGINS: "sort",
    "granular_prepare": "scatter",
    "reach_find_groups": "contacts",
    "solver_solve": "solve",
    "solver_before_going": "integrate",
    STEP_ENDS: None,
}
"""Functions of the library that are called where a phase begins."""

LINE_BYTES = 64
LINES_MOVED = ("DLmr", "DLmw", "DLdmr", "DLdmw")
"""Callgrind's events: lines fetched for reading and for writing, and changed lines that went back for each."""

TOOLS = ("valgrind", "objdump")
STEPS = (ITERATIONS, ITERATIONS, 2 * ITERATIONS)
"""Iterations of the steps that run. The first is not counted: it is for memory, and for what obstacles give to nodes, which steps keep."""


@dataclass
class Counts:
    """Of something, while it was counted."""

    flops: float = 0.0
    bytes: float = 0.0

    def add(self, other: Counts) -> None:
        self.flops += other.flops
        self.bytes += other.bytes


def missing_tools() -> list[str]:
    """What is not installed of `TOOLS`."""
    return [tool for tool in TOOLS if shutil.which(tool) is None]


def count_phases(material: str, dimension: int, states: Mapping[str, bytes | bytearray]) -> dict[str, dict[str, Counts]]:
    """Per variant and phase, per particle; also of one ``iteration``, of the ``rest`` of a step and the ``step``. ``states`` are by variant, from where its steps begin.
    Takes a minute or more."""
    library = pbmpm.library_path()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for variant, state in states.items():
            (folder / variant).write_bytes(state)
        ran = _run_counted(folder, [material, str(dimension), *(str(folder / variant) for variant in states)])
        written = sorted(folder.glob("counts.*"), key=lambda path: int(path.suffix[1:]))
        steps = steps_of(read_parts(written, library, flops_of(_disassembly(library))))
    if len(steps) != len(STEPS) * len(states) or not all(steps):
        raise InputError(f"{library}: has no names of functions, so that phases cannot be told apart; build it without stripping them")
    found = {}
    for i, variant in enumerate(states):
        _, few, many = steps[len(STEPS) * i : len(STEPS) * (i + 1)]
        found[variant] = per_particle(few, many, ran["used"][variant], ran["particles"])
    return found


def per_particle(few: Mapping[str, Counts], many: Mapping[str, Counts], used: tuple[int, int], particles: int) -> dict[str, Counts]:
    """Phases of a step from its laps with few and with many iterations."""
    flops, moved = (
        split_solve(laps | {"step": sum(laps.values())}, _part(many, "solve", member, particles) - laps["solve"], used)
        for member in ("flops", "bytes")
        for laps in [{name: _part(few, name, member, particles) for name in LAPS}]
    )
    return {name: Counts(flops[name], moved[name]) for name in flops}


def _part(laps: Mapping[str, Counts], name: str, member: str, particles: int) -> float:
    return float(getattr(laps[name], member)) / particles if name in laps else 0.0


def _run_counted(folder: Path, arguments: Sequence[str]) -> dict[str, Any]:
    """Leaves files ``counts.N`` in the folder; returns what `_run_steps()` prints."""
    command = ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--dump-line=no", "--compress-pos=no", "--compress-strings=no"]
    command += ["--cache-sim=yes", "--simulate-wb=yes", f"--callgrind-out-file={folder / 'counts'}", *(f"--dump-before={name}" for name in STARTS)]
    cache = core_cache()
    command += [f"--LL={','.join(map(str, cache))}"] if cache else []
    result = subprocess.run([*command, sys.executable, "-m", "pbmpm.lab.bench.counts", *arguments], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise InputError(f"valgrind could not run the library: {result.stderr.strip()[-500:]}")
    printed: dict[str, Any] = json.loads(result.stdout)
    return printed


def core_cache(folder: Path = Path("/sys/devices/system/cpu/cpu0/cache")) -> tuple[int, int, int] | None:
    """Size, ways and line [bytes] of a core's own second cache; None where the system does not tell."""
    for cache in sorted(folder.glob("index*")):
        try:
            level, size, ways, line = ((cache / name).read_text().strip() for name in ("level", "size", "ways_of_associativity", "coherency_line_size"))
        except OSError:
            continue
        if level == "2" and size.endswith("K"):
            return 1024 * int(size[:-1]), int(ways), int(line)
    return None


def _disassembly(library: Path) -> Iterable[str]:
    return subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(library)], capture_output=True, text=True, check=True).stdout.splitlines()


_ARITHMETIC = re.compile(r"v?(add|sub|mul|div|sqrt|addsub|hadd|hsub|fn?m(?:add|sub)(?:132|213|231)|fm(?:addsub|subadd)(?:132|213|231))([ps])([sd])$")


def flops_of(disassembly: Iterable[str]) -> dict[int, int]:
    """Operations of each instruction that does some, by its address."""
    found = {}
    for line in disassembly:
        address, _, text = line.partition(":\t")
        name, _, operands = text.partition(" ")
        matched = _ARITHMETIC.match(name)
        if matched:
            operation, packed, kind = matched.groups()
            bits = 512 if "%zmm" in operands else 256 if "%ymm" in operands else 128
            lanes = bits // (32 if kind == "s" else 64) if packed == "p" else 1
            found[int(address, 16)] = lanes * (2 if operation.startswith("f") else 1)
    return found


@dataclass
class Part:
    """What was counted until a function was called."""

    until: str
    counts: Counts


def read_parts(paths: Iterable[Path], library: Path, flops: Mapping[int, int]) -> Iterator[Part]:
    """Of files of Callgrind, in the order in which it wrote them."""
    for path in paths:
        with path.open(encoding="utf-8", errors="replace") as file:
            yield _read_part(file, library, flops)


def _read_part(lines: Iterator[str], library: Path, flops: Mapping[int, int]) -> Part:
    part, events, inside, names = Part("", Counts()), [], False, {str(library), str(library.resolve())}
    for line in lines:
        if line.startswith("0x"):
            if inside:
                address, executed = line.split(" ", 2)[:2]
                part.counts.flops += flops.get(int(address, 16), 0) * int(executed)
        elif line.startswith("ob="):
            inside = line[3:].strip() in names
        elif line.startswith("calls="):
            next(lines, None)  # what was called, counted where it is
        elif line.startswith("events:"):
            events = line.split()[1:]
        elif line.startswith("totals:"):
            totals = dict(zip(events, map(int, line.split()[1:])))
            part.counts.bytes = LINE_BYTES * sum(totals.get(name, 0) for name in LINES_MOVED)
        elif line.startswith("desc: Trigger: --dump-before="):
            part.until = line.split("=", 1)[1].strip()
    return part


def steps_of(parts: Iterable[Part]) -> list[dict[str, Counts]]:
    """Per step the counts of its laps. A part belongs to the phase that the part before it ended at."""
    steps: list[dict[str, Counts]] = []
    phase: str | None = None
    for part in parts:
        if phase is not None:
            steps[-1].setdefault(phase, Counts()).add(part.counts)
        phase = STARTS.get(part.until)
        if part.until == STEP_BEGINS:
            steps.append({})
    return steps


def _run_steps(material: str, dimension: str, *states: str) -> None:
    """What runs within Callgrind, on any core; files of states are named after their variants."""
    os.sched_setaffinity(0, range(os.cpu_count() or 1))
    scene, used = scene_of(material, int(dimension)), {}
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        world = simulation.world
        for state in map(Path, states):
            world.restore(state.read_bytes())
            done = []
            for iterations in STEPS:
                choose_variant(world, state.name, iterations)
                world.step(1.0 / RATE_HZ)
                done.append(world.step_stats.iterations_used)
            used[state.name] = done[1:]
        print(json.dumps({"particles": len(world), "used": used}))


if __name__ == "__main__":
    _run_steps(*sys.argv[1:])
