"""What "stable" means: defined here and nowhere else.

A run is stable when, at every step,
- every figure of the step is finite,
- no particle has been deleted,
- kinetic plus potential energy (zero level: the floor) is at most ENERGY_TOLERANCE of its start value above it, unless
  the case drives the matter,
and when at the end of a case that comes to rest the liquid occupies a volume between SETTLED_LOWEST times what the
compressibility of the paper's solver predicts and SETTLED_HIGHEST times the rest volume. Compression itself is an error, not an instability: it is shown
as volume error and settled volume. The lower bound is there to find liquids that go on losing volume without end.
"""

from __future__ import annotations

import math

import pbmpm

ENERGY_TOLERANCE = 0.02
SETTLED_LOWEST = 0.5
SETTLED_HIGHEST = 1.25

DEFINITION = (
    f"finite, no particle deleted, energy at most {100 * ENERGY_TOLERANCE:g} % above its start, "
    f"settled volume between {SETTLED_LOWEST:g} of what the paper's law gives and {SETTLED_HIGHEST:g} of the rest volume"
)


class StabilityJudge:
    """Watches the runs of one setting; the domain's floor is at height 0."""

    def __init__(self) -> None:
        self.energy_peak = 0.0
        """Highest energy over the start energy, minus 1."""
        self._start_energy: float | None = None
        self._reasons: dict[str, str] = {}

    def begin(self, start_energy: float) -> None:
        """A run begins with this energy [J]; without it the energy is not judged."""
        self._start_energy = start_energy

    def watch(self, stats: pbmpm.Stats) -> None:
        """Looks at one step."""
        figures = (stats.max_speed, stats.volume_error_max, stats.kinetic_energy, stats.potential_energy)
        if not all(math.isfinite(figure) for figure in figures):
            self._note(stats, "finite", "a figure is not finite")
            return
        if stats.deleted_total:
            self._note(stats, "deleted", "particles were deleted")
        if self._start_energy is not None:
            gain = (stats.kinetic_energy + stats.potential_energy) / self._start_energy - 1.0
            self.energy_peak = max(self.energy_peak, gain)
            if gain > ENERGY_TOLERANCE:
                self._note(stats, "energy", f"energy {100 * gain:.1f} % above its start")

    def settle(self, volume_ratio: float, predicted: float) -> None:
        """Looks at the volume that the liquid takes in the end, relative to its rest volume."""
        low = SETTLED_LOWEST * predicted
        if not low <= volume_ratio <= SETTLED_HIGHEST:
            self._reasons["settled"] = f"settled volume {volume_ratio:.3f} outside [{low:.3f}, {SETTLED_HIGHEST:g}]"

    def _note(self, stats: pbmpm.Stats, kind: str, text: str) -> None:
        self._reasons.setdefault(kind, f"{text} at {stats.simulated_seconds:.3f} s")

    @property
    def broken(self) -> bool:
        """Whether going on makes no sense."""
        return "finite" in self._reasons or "deleted" in self._reasons

    @property
    def reasons(self) -> list[str]:
        """Why the run is not stable; empty when it is."""
        return list(self._reasons.values())
