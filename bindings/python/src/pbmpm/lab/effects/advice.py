"""What to do about the effects of a scene: which it calls for, which are on for nothing, and what is saved by the rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

SURE = 2.0
"""A cost is told from none when it is more than so many standard errors."""


NOTICED = {"predicted_error": 0.01, "volume_error": 0.01}
"""An effect hurts where an error grows by more than this [cells; share of the volume], and by more than a tenth."""
_UNITS = {"predicted_error": ("predicted error", 1.0, " cells"), "volume_error": ("volume error", 100.0, " %")}


def is_sure(row: dict[str, Any]) -> bool:
    """Whether the cost of a row can be told from none."""
    return abs(row["percent_of_step"]) > SURE * row["percent_error"]


def advice_of(called_for: Sequence[str], rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The recommendation from the effects that a scene calls for and the rows of effects, without that of the bare scene.

    Savings count what is sure and above 0 alone: a saving that may be none is not promised. The saving of an effect that is
    off is what it would cost; the sum takes effects for independent, which they are not quite.
    """
    idle = [row for row in rows if row["on"] and not row["called_for"]]
    off = [row for row in rows if not row["on"]]
    return {
        "calls_for": list(called_for),
        "leave_out": [{"effect": row["effect"], "why": row["idle"], **_saving(row)} for row in idle],
        "leave_out_saves_percent": sum(_saving(row)["saves_percent"] for row in idle),
        "hurts_accuracy": [hurt for row in rows if row["on"] for hurt in _hurts(row)],
        "on": [row["effect"] for row in rows if row["on"]],
        "off": [row["effect"] for row in off],
        "off_saves_percent": sum(_saving(row)["saves_percent"] for row in off),
        "off_saves_bytes_per_particle": sum(_saving(row)["saves_bytes_per_particle"] for row in off),
    }


def _saving(row: dict[str, Any]) -> dict[str, float]:
    percent = row["percent_of_step"] if is_sure(row) else 0.0
    return {"saves_percent": max(percent, 0.0), "saves_bytes_per_particle": max(row["bytes_per_particle"], 0.0)}


def _hurts(row: dict[str, Any]) -> list[dict[str, Any]]:
    """Which errors an effect that is on raises."""
    found = []
    for error, least in NOTICED.items():
        having, lacking = row.get(f"{error}_with"), row.get(f"{error}_without")
        if having is not None and lacking is not None and having - lacking > max(least, 0.1 * lacking):
            found.append({"effect": row["effect"], "error": error, "with": having, "without": lacking})
    return found


def _hurt_text(hurt: dict[str, Any]) -> str:
    name, scale, unit = _UNITS[hurt["error"]]
    return f"{hurt['effect']} costs accuracy: {name} {scale * hurt['with']:.2g}{unit}, without it {scale * hurt['without']:.2g}{unit}"


def advice_text(advice: dict[str, Any]) -> str:
    """The recommendation for a person."""
    called = ", ".join(advice["calls_for"]) or "no effect"
    lines = [f"the scene calls for: {called}"]
    for item in advice["leave_out"]:
        lines.append(
            f"leave out {item['effect']}: {item['why']}; saves {item['saves_percent']:.1f} % of the step and"
            f" {item['saves_bytes_per_particle']:.0f} bytes per particle"
        )
    lines += [_hurt_text(hurt) for hurt in advice["hurts_accuracy"]] or [_harmless_text(len(advice["on"]))]
    if advice["off"]:
        count = len(advice["off"])
        said = "the effect that is off costs nothing; it" if count == 1 else f"the {count} effects that are off cost nothing; together they"
        lines.append(
            f"{said} would cost {advice['off_saves_percent']:.0f} % of a step"
            f" and {advice['off_saves_bytes_per_particle']:.0f} bytes per particle more"
        )
    return "\n".join(lines)


def _harmless_text(count: int) -> str:
    """With --only few are measured: of the others nothing is known."""
    if count == 0:
        return "accuracy: no effect that is on was measured"
    return "the effect that was measured costs no accuracy" if count == 1 else f"none of the {count} effects that are on and were measured costs accuracy"
