"""Presets from a sweep: low, medium and high within the budget, and the converged reference."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..scenes.preset import Preset, PresetSettings, save_preset
from ..simulation import RunSettings
from .sweep import SHARES, Tuning

REFERENCE = "reference"


def presets(tuning: Tuning, machine: dict[str, Any]) -> dict[str, Preset]:
    """By level; a level that nothing fits into is missing."""
    made = {}
    for level, share in SHARES.items():
        best = tuning.best_within(share * tuning.plan.budget_ms)
        if best is not None:
            made[level] = _preset(tuning, level, best.settings, best.error, best.ms_median, best.ms_p99, machine)
    reference, floor = tuning.reference.observation, tuning.reference.floor
    made[REFERENCE] = _preset(tuning, REFERENCE, reference.settings, floor, reference.ms(50), reference.ms(99), machine)
    return made


def _preset(
    tuning: Tuning, level: str, settings: RunSettings, error: float, median: float, p99: float, machine: dict[str, Any]
) -> Preset:
    return Preset(
        name=f"{tuning.scene.name}-{level}"[-80:],
        scene=tuning.scene.name,
        settings=PresetSettings(**settings.as_dict()),
        predicted_error=error,
        ms_median=median,
        ms_p99=p99,
        machine=machine,
    )


def save_presets(made: dict[str, Preset], folder: Path) -> dict[str, Path]:
    """Writes one file per level; a file of an earlier sweep whose level is missing now is removed."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {level: folder / f"{level}.json" for level in (*SHARES, REFERENCE)}
    for level, path in paths.items():
        if level in made:
            save_preset(made[level], path)
        else:
            path.unlink(missing_ok=True)
    return {level: paths[level] for level in made}
