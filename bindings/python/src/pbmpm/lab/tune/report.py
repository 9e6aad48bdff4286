"""What a sweep found, as JSON and as text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pbmpm

from ..machine import machine_facts
from ..scenes.preset import Preset
from ..simulation import RunSettings, versions
from .candidates import left_out
from .sweep_chart import error_title, setting_text, table
from .sweep import Tuning


def report_of(tuning: Tuning) -> dict[str, Any]:
    """The report: the plan, the reference, all rows, what was left out, and the machine."""
    plan, reference = tuning.plan, tuning.reference
    return {
        "scene": tuning.scene.name,
        "seconds": plan.seconds,
        "frame_rate": plan.frame_rate,
        "budget_ms": plan.budget_ms,
        "fit_percentile": plan.percentile,
        "error_means": error_title(tuning),
        "compared": "particles" if reference.by_particles else "statistics",
        "reference": {
            **reference.observation.settings.as_dict(),
            "ms_median": reference.observation.ms(50),
            "error": reference.floor,
            "particles_at_half_the_substeps": reference.halved.particles,
            "statistics_at_half_the_substeps": reference.halved.statistics,
        },
        "rows": [result.as_dict() for result in tuning.results],
        "left_out": _left_out(tuning),
        "versions": versions(),
        "machine": machine_facts(pbmpm.isa(), reference.observation.threads),
    }


def _left_out(tuning: Tuning) -> list[str]:
    said = left_out(tuning.scene)
    if tuning.skipped:
        said.append(f"{tuning.skipped} settings with more iterations than one that was given up as far too dear")
    return said


def text_of(tuning: Tuning, made: dict[str, Preset], paths: dict[str, Path]) -> str:
    """The sweep for a person: table, what the error means, presets."""
    plan, reference = tuning.plan, tuning.reference
    halved = reference.halved
    alike = "-" if halved.particles is None else f"{halved.particles:.3g}"
    how = "calm: compared particle by particle" if reference.by_particles else "chaotic: compared by statistics"
    lines = [
        f"{tuning.scene.name}: {plan.seconds:g} s at {plan.frame_rate:g} frames/s, budget {plan.budget_ms:g} ms per frame",
        f"reference: {setting_text(reference.observation.settings)}; with half the substeps its particles are {alike} cells"
        f" away, its statistics {halved.statistics:.3g} ({how})",
        f"error: {error_title(tuning)}; the reference itself is good to {reference.floor:.2g}",
        "",
        table(tuning),
        "",
        *(f"left out: {line}" for line in _left_out(tuning)),
        "",
        *(_preset_line(level, preset, paths[level]) for level, preset in made.items()),
    ]
    return "\n".join(lines)


def _preset_line(level: str, preset: Preset, path: Path) -> str:
    settings = RunSettings(**preset.settings.changes())
    return (
        f"{level + ':':<10} {setting_text(settings)}: error {preset.predicted_error:.3g} cells, {preset.ms_median:.2f} ms"
        f" median, {preset.ms_p99:.2f} ms p99 ({path})"
    )
