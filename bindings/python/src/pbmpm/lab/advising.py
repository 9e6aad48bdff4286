"""What a scene's world advises, in words that name the scene's own materials and obstacles."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pbmpm

from .scenes.scene import Scene
from .simulation import RunSettings, Simulation


def advice_lines(simulation: Simulation, came_true: bool | None = None) -> list[str]:
    """What the present state calls for, one line each; only what came true, or only what is foreseen."""
    return [_line(simulation, item) for item in _chosen(simulation.advice(), came_true)]


def advice_rows(simulation: Simulation) -> list[dict[str, Any]]:
    """The same for reports."""
    return [
        {
            "code": item.code.name.lower(),
            "of": _owner(simulation, item),
            "text": item.text,
            "figure": item.figure,
            "bound": item.bound,
            "change": item.change.name.lower(),
            "value": item.value,
            "price_percent_of_step": item.price,
            "came_true": item.came_true,
        }
        for item in simulation.advice()
    ]


def scene_advice(scene: Scene, settings: RunSettings) -> list[str]:
    """What is foreseen of a scene before its first step."""
    with Simulation(scene, settings) as simulation:
        return advice_lines(simulation)


def _chosen(advice: Iterable[pbmpm.Advice], came_true: bool | None) -> list[pbmpm.Advice]:
    return [item for item in advice if came_true is None or item.came_true == came_true]


def _owner(simulation: Simulation, item: pbmpm.Advice) -> str:
    """Name of the material, or the obstacle's field in the scene; empty for what is of the whole world."""
    if item.material is not None:
        return next((name for name, material in simulation.materials.items() if material.index == item.material), "")
    if item.collider is not None:
        return next((f"colliders[{i}]" for i, found in enumerate(simulation.colliders) if found.identity == item.collider), "")
    return ""


def _line(simulation: Simulation, item: pbmpm.Advice) -> str:
    owner = _owner(simulation, item)
    return f"{owner}: {item.sentence}" if owner else item.sentence
