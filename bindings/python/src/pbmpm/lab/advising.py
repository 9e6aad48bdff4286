"""What a scene's world advises, in words that name the scene's own materials and obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pbmpm

from .scenes.scene import Scene
from .simulation import RunSettings, Simulation


def advice_lines(simulation: Simulation, found: list[pbmpm.Advice]) -> list[str]:
    """What was found, one line each."""
    return [_line(simulation, item) for item in found]


def advice_rows(simulation: Simulation, found: list[pbmpm.Advice]) -> list[dict[str, Any]]:
    """The same for reports."""
    return [_row(simulation, item) for item in found]


class AdviceHistory:
    """What a run was advised, again and again: matter that was crushed on the way may have its volume back in the end."""

    LOOKS = 8  #: per simulated second, at the same times however long the run is
    FEW = 0.1  #: of the looks: what came true in fewer, and not in the last, passed by

    def __init__(self, first: list[pbmpm.Advice]) -> None:
        """``first``: what was said before the first step."""
        self._first = {_key(item) for item in first}
        self._looks = 0
        self._last: set[tuple[Any, ...]] = set()
        self._seen: dict[tuple[Any, ...], int] = {}
        self._worst: dict[tuple[Any, ...], tuple[pbmpm.Advice, float]] = {}

    def look(self, advice: list[pbmpm.Advice], time: float) -> None:
        """Notes what is advised now."""
        found = {_key(item): item for item in advice}
        self._looks += 1
        self._last = set(found)
        for key, item in found.items():
            self._seen[key] = self._seen.get(key, 0) + 1
            if key not in self._worst or _excess(item) > _excess(self._worst[key][0]):
                self._worst[key] = (item, time)

    def told(self) -> list[tuple[pbmpm.Advice, float]]:
        """What was not said before the first step: the worst of each, and when that was [s], in the order of these times."""
        lasting = {key for key, count in self._seen.items() if count > self.FEW * self._looks} | self._last
        return sorted((found for key, found in self._worst.items() if key in lasting and key not in self._first), key=lambda found: found[1])


class AdviceWatch:
    """Looks at a simulation's advice, and tells it in words."""

    def __init__(self, simulation: Simulation, first: list[pbmpm.Advice]) -> None:
        self._simulation = simulation
        self._history = AdviceHistory(first)

    def look(self) -> None:
        """Notes what is advised now."""
        self._history.look(self._simulation.advice(), self._simulation.time)

    def lines(self) -> list[str]:
        """One line each."""
        return [f"{f'came true at {time:.3g} s' if item.came_true else 'advice'}: {_line(self._simulation, item)}" for item, time in self._history.told()]

    def rows(self) -> list[dict[str, Any]]:
        """The same for reports."""
        return [{**_row(self._simulation, item), "time_s": time} for item, time in self._history.told()]


@dataclass(frozen=True)
class SceneAdvice:
    """Of a scene, in words that name its own parts, one line each; and the same for reports."""

    lines: list[str]
    rows: list[dict[str, Any]]


def scene_advice(scene: Scene, settings: RunSettings) -> SceneAdvice:
    """What is foreseen of a scene before its first step."""
    with Simulation(scene, settings) as simulation:
        found = simulation.advice()
        return SceneAdvice(advice_lines(simulation, found), advice_rows(simulation, found))


def _key(item: pbmpm.Advice) -> tuple[Any, ...]:
    return item.code, item.material, item.collider, item.text


def _excess(item: pbmpm.Advice) -> float:
    """How far it is from its bound; some figures have to be above theirs."""
    return abs(item.figure - item.bound)


def _row(simulation: Simulation, item: pbmpm.Advice) -> dict[str, Any]:
    return {
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
