"""What a sweep found, as JSON and as text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..scenes.preset import Preset
from ..simulation import RunSettings, versions
from .candidates import left_out
from .sweep_chart import error_title, setting_text, table
from .sweep import SHARES, SHOWS, Tuning

SCATTERED = 2.0
"""Frames scatter where, with half of the settings, one in a hundred takes so many times the median."""


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
        "scatter": scatter(tuning),
        "versions": versions(),
        "machine": reference.observation.machine,
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
        "top: how much too high the material stands that is farthest off [cells]; solids sag where it is below 0",
        "",
        table(tuning),
        "",
        *(f"left out: {line}" for line in _left_out(tuning)),
        "",
        *(_preset_line(tuning, level, preset, paths[level]) for level, preset in made.items()),
        *(_missing_line(tuning, level) for level in SHARES if level not in made),
        *_scatter_lines(tuning),
        closing_line(tuning),
    ]
    return "\n".join(lines)


def _preset_line(tuning: Tuning, level: str, preset: Preset, path: Path) -> str:
    settings = RunSettings(**preset.settings.changes())
    said = f"{level + ':':<10} {setting_text(settings)}: error {preset.predicted_error:.3g} cells"
    result = next((item for item in tuning.results if item.settings.as_dict() == settings.as_dict()), None)
    if result is not None and result.seen is not None:
        said += f" ({result.seen.text()})"
    said += f", {preset.ms_median:.2f} ms median, {preset.ms_p99:.2f} ms p99"
    alone = tuning.alone.get(result.settings) if result is not None else None
    if alone is not None:
        said += f", {alone:.2f} ms with one thread{': use one' if alone <= result.cost else ''}"
    return f"{said} ({path})"


def _missing_line(tuning: Tuning, level: str) -> str:
    share = SHARES[level]
    cheapest = tuning.cheapest()
    why = _dearer(tuning) if cheapest is None else f"the cheapest setting takes {cheapest.cost:.3g} ms"
    return f"{level + ':':<10} not written: nothing fits into {share * tuning.plan.budget_ms:g} ms ({100 * share:g} % of the budget); {why}"


def _dearer(tuning: Tuning) -> str:
    """What is known of good settings where none was measured to its end."""
    given_up = min((item for item in tuning.results if item.too_dear), key=lambda item: item.cost, default=None)
    if given_up is None:
        return "no setting that was tried is good"
    return f"you need more than {given_up.cost:.3g} ms, at which {setting_text(given_up.settings)} was given up"


def scatter(tuning: Tuning) -> dict[str, float]:
    """How far the slowest frame in a hundred lies above the median, and how often other programs took a processor away."""
    ratios = sorted(item.ms_p99 / item.ms_median for item in tuning.results if item.ms_median > 0.0)
    return {
        "p99_over_median": ratios[len(ratios) // 2] if ratios else 1.0,
        "interruptions": float(sum(item.interruptions for item in tuning.results)),
    }


def _scatter_lines(tuning: Tuning) -> list[str]:
    found = scatter(tuning)
    if found["p99_over_median"] < SCATTERED:
        return []
    times = int(found["interruptions"])
    why = f"other programs took a processor away {times} times: repeat on a quiet machine" if times else "nothing disturbed: frames of this scene differ"
    return [f"frame times scatter: one frame in a hundred takes {found['p99_over_median']:.2g} times the median or more; {why}"]


def closing_line(tuning: Tuning) -> str:
    """What the budget buys, in one sentence."""
    budget, best, good = tuning.plan.budget_ms, tuning.best_within(tuning.plan.budget_ms), tuning.cheapest(good=True)
    if best is not None and best.good:
        return f"in {budget:g} ms: {setting_text(best.settings)}, {best.error:.2g} cells off"
    need = _dearer(tuning) if good is None else f"you need {good.cost:.3g} ms ({setting_text(good.settings)})"
    had = "" if best is None else f" (the best is {best.error:.2g} cells off; above {SHOWS:g} it shows)"
    return f"nothing usable fits in {budget:g} ms{had}; {need}"
