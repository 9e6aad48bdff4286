"""The phases of a step beside what one core can do: shares of its peak and of its bandwidth, and times in units of the peak.

Nanoseconds times the peak in GFLOP/s are the operations that the core could have done meanwhile. In this unit machines compare.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

import pbmpm

from .counts import Counts, count_phases, missing_tools
from .peak import Peak, measure_peak
from .phases import measure_phases, phase_pieces, phase_rows, phases_text

COUNTED_ISAS = ("SSE4", "AVX2")
"""What Valgrind runs."""

_UNITS = ("peak_units", "ns x peak", "{:.0f}")
_COLUMNS = (
    _UNITS,
    ("flops_per_particle", "flops", "{:.0f}"),
    ("bytes_moved_per_particle", "bytes", "{:.0f}"),
    ("gflops", "GFLOP/s", "{:.1f}"),
    ("share_of_peak", "of peak", "{:.0%}"),
    ("gb_per_second", "GB/s", "{:.1f}"),
    ("share_of_bandwidth", "of bandw.", "{:.0%}"),
)


def measure_roofline(
    material: str, dimension: int, variants: Sequence[str], rounds: int, warmup_steps: int, tick: Callable[[], None]
) -> list[dict[str, Any]]:
    """Rows of one scene. ``tick`` is called `roofline_pieces()` times."""
    costs = measure_phases(material, dimension, variants, rounds, warmup_steps, tick)
    peak = measure_peak(pbmpm.isa(), max(own.memory_bytes for own in costs))
    tick()
    counts = {} if missing_tools() else count_phases(material, dimension, {own.variant: own.state for own in costs if own.state is not None})
    tick()
    rows = [row for own in costs for row in phase_rows(material, dimension, own)]
    for row in rows:
        row |= roofline_of(row, peak, counts.get(row["solver"], {}))
    return rows


def roofline_pieces(rounds: int) -> int:
    """How often `measure_roofline()` calls ``tick``."""
    return phase_pieces(rounds) + 2


def roofline_of(row: Mapping[str, Any], peak: Peak, counts: Mapping[str, Counts]) -> dict[str, Any]:
    """What a row of `phase_rows()` gets besides; ``counts`` are by phase, and empty where nothing was counted."""
    nanoseconds = row["ns_per_particle"]
    more = asdict(peak) | {"peak_units": nanoseconds * peak.peak_gflops}
    if row["phase"] in counts:
        own = counts[row["phase"]]
        more |= {"flops_per_particle": own.flops, "gflops": own.flops / nanoseconds, "share_of_peak": own.flops / nanoseconds / peak.peak_gflops}
        moved = own.bytes / nanoseconds
        more |= {"bytes_moved_per_particle": own.bytes, "gb_per_second": moved, "share_of_bandwidth": moved / peak.peak_gb_per_second}
    return more


def roofline_text(rows: Sequence[Mapping[str, Any]]) -> str:
    """The rows for a person."""
    lines = []
    for key in dict.fromkeys((row["material"], row["dims"]) for row in rows):
        peak = next(row for row in rows if (row["material"], row["dims"]) == key)
        lines.append(
            f"One core, {key[0]} {key[1]}D: {peak['peak_gflops']:.1f} GFLOP/s (product of matrices, {peak['blas']}), {peak['peak_gb_per_second']:.1f} GB/s (sum of"
            f" arrays of {peak['bandwidth_bytes'] / 1e6:.0f} MB in all; lines fetched and written back)"
        )
    counted = any("gflops" in row for row in rows)
    if not counted:
        lines.append(f"Operations and bytes are not counted: {' and '.join(missing_tools())} not installed.")
    return "\n".join([*lines, phases_text(rows, _COLUMNS if counted else [_UNITS])])
