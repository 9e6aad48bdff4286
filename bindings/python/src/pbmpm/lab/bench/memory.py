"""What a world takes in memory: per particle when it has many, and what a small one takes besides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..scenes.scene import Scene
from ..simulation import RunSettings, Simulation
from .measure import choose_variant
from .phases import ITERATIONS, RATE_HZ
from .subjects import scene_of, small_scene


def memory_pieces(variants: Sequence[str]) -> int:
    """How often `measure_memory()` calls ``tick``."""
    return 2 * len(variants)


def measure_memory(material: str, dimension: int, variants: Sequence[str], steps: int, tick: Callable[[], None]) -> list[dict[str, Any]]:
    """One row per variant, each of worlds that know no other."""
    rows = []
    for variant in variants:
        large, small = (_bytes_of(make(material, dimension), variant, steps, tick) for make in (scene_of, small_scene))
        rows.append(memory_row(material, dimension, variant, large, small))
    return rows


def memory_row(material: str, dimension: int, variant: str, large: tuple[int, int], small: tuple[int, int]) -> dict[str, Any]:
    """Of the particles and bytes of both worlds. ``small_world_bytes_besides``: beyond what its particles take at the large one's bytes each."""
    each = large[1] / large[0]
    return {
        "material": material,
        "dims": dimension,
        "solver": variant,
        "particles": large[0],
        "bytes_per_particle": each,
        "small_world_particles": small[0],
        "small_world_bytes": small[1],
        "small_world_bytes_besides": small[1] - each * small[0],
    }


def _bytes_of(scene: Scene, variant: str, steps: int, tick: Callable[[], None]) -> tuple[int, int]:
    """Particles and bytes after steps of motion at the pace of a game."""
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        choose_variant(simulation.world, variant, ITERATIONS)
        for _ in range(steps):
            simulation.world.step(1.0 / RATE_HZ)
        tick()
        return len(simulation.world), simulation.world.step_stats.memory_bytes


def memory_text(rows: Sequence[dict[str, Any]], steps: int) -> str:
    """The rows for a person."""
    lines = [f"Bytes that a world takes, by the library's statistics, after {steps} steps of {RATE_HZ:g} Hz x {ITERATIONS}:"]
    for row in rows:
        lines.append(
            f"  {row['material']} {row['dims']}D  {row['solver']:<12} {row['bytes_per_particle']:.0f} per particle of {row['particles']};"
            f" a world of {row['small_world_particles']} takes {row['small_world_bytes_besides'] / 1024:.0f} KB besides"
        )
    return "\n".join(lines)
