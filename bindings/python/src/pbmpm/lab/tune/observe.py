"""Runs a scene at a setting and keeps what errors are computed from, and what each frame cost."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

import pbmpm

try:
    import resource
except ImportError:  # Windows
    resource = None

from ..machine import machine_facts
from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation

SAMPLES = 8  # at most, over a run
WARM_UP_FRAMES = 2  # in which memory grows
PROBE_FRAMES = 10  # after which a setting that is far too dear is given up
CROWDED_PERCENTILE = 99.0


@dataclass(frozen=True)
class Sample:
    """The state at one time; particles in the order of their identifiers."""

    time: float
    ids: npt.NDArray[np.uint32]
    positions: npt.NDArray[np.float32]
    materials: npt.NDArray[np.uint8]
    kinetic_energy: float
    mass: float
    crowding: float  #: high percentile over the particles of how many share their cell, over what the lattice has


@dataclass
class Observation:
    """A run, or the part of it that was done."""

    settings: RunSettings
    samples: list[Sample] = field(default_factory=list)
    frame_ms: list[float] = field(default_factory=list)
    iterations_used: float = 0.0  #: mean per substep
    predicted_error: float = 0.0  #: mean over the frames, by the library [cells]
    reasons: list[str] = field(default_factory=list)  #: why it is not stable
    too_dear: bool = False  #: given up after a few frames
    machine: dict[str, Any] = field(default_factory=dict)  #: where it ran
    interruptions: int = 0  #: times that the system gave a processor of this process to another one; 0 where it does not say

    @property
    def stable(self) -> bool:
        return not self.reasons

    def ms(self, percentile: float) -> float:
        """A percentile of the wall time of the frames that were done; 50 is the median."""
        return float(np.percentile(self.frame_ms[WARM_UP_FRAMES:] or self.frame_ms, percentile))


def sample_frames(frames: int) -> list[int]:
    """After which frames the state is kept: evenly spread, the last one among them."""
    count = min(SAMPLES, frames)
    return sorted({math.ceil(frames * (index + 1) / count) for index in range(count)})


def observe(scene: Scene, settings: RunSettings, seconds: float, most_ms: float = math.inf) -> Observation:
    """Runs ``seconds`` of a scene; each step is a frame. Gives up when its first frames take more than ``most_ms``."""
    frames = max(1, math.ceil(seconds * settings.rate_hz - 1e-9))
    wanted, out = set(sample_frames(frames)), Observation(settings)
    used = predicted = 0.0
    before = _interruptions()
    with Simulation(scene, settings) as simulation:
        for frame in range(1, frames + 1):
            start = time.perf_counter()
            simulation.step()
            out.frame_ms.append(1e3 * (time.perf_counter() - start))
            stats = simulation.stats()
            used += stats.iterations_used
            predicted += stats.predicted_error
            out.reasons = _reasons(simulation, stats)
            if out.reasons:
                break
            if frame == PROBE_FRAMES and out.ms(50) > most_ms:
                out.too_dear = True
                break
            if frame in wanted:
                out.samples.append(_sample(simulation))
        out.machine = machine_facts(simulation.isa, simulation.thread_count)
        out.interruptions = _interruptions() - before
        out.iterations_used, out.predicted_error = used / len(out.frame_ms), predicted / len(out.frame_ms)
    return out


def _interruptions() -> int:
    """Of this process so far."""
    return 0 if resource is None else resource.getrusage(resource.RUSAGE_SELF).ru_nivcsw


def _reasons(simulation: Simulation, stats: pbmpm.Stats) -> list[str]:
    at, found = f"at {simulation.time:.3f} s", []
    if not all(math.isfinite(figure) for figure in (stats.max_speed, stats.kinetic_energy)):
        found.append(f"a figure is not finite {at}")
    if stats.deleted_total:
        found.append(f"{stats.deleted_total} particles were deleted {at}")
    if stats.clamped_total:
        found.append(f"a particle was faster than the clamp {at}")
    return found


def _sample(simulation: Simulation) -> Sample:
    frame, stats = simulation.frame(), simulation.world.stats
    order = np.argsort(frame.ids[:, 0], kind="stable")
    cells = np.floor(frame.positions / simulation.scene.cell_size).astype(np.int64)
    _, inverse, counts = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    lattice = max(fill.particles_per_axis for fill in simulation.scene.sources) ** simulation.scene.dimension
    return Sample(
        simulation.time,
        frame.ids[order],
        frame.positions[order],
        frame.materials[order],
        stats.kinetic_energy,
        stats.mass,
        float(np.percentile(counts[inverse.ravel()], CROWDED_PERCENTILE)) / lattice,
    )
