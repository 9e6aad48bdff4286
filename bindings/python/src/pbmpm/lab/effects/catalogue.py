"""All effects that a scene can have, and what a scene says about them."""

from __future__ import annotations

from dataclasses import dataclass

from ..scenes.scene import Scene
from .effect import Effect
from .flowing import flowing_effects
from .matter import matter_effects
from .surroundings import surrounding_effects

EFFECTS: tuple[Effect, ...] = (*matter_effects(), *flowing_effects(), *surrounding_effects())
"""In the order of reports, and in the order in which they are switched off one after the other."""


@dataclass(frozen=True)
class Presence:
    """What a scene has to do with an effect."""

    effect: Effect
    where: str | None
    """The field that switches it on; None: it is off."""
    idle: str | None
    """Why it does nothing though it is on."""
    declared: bool

    @property
    def on(self) -> bool:
        return self.where is not None

    @property
    def called_for(self) -> bool:
        """Whether the scene would be another one without it."""
        return self.on and self.idle is None


def presences(scene: Scene) -> list[Presence]:
    """Every effect, in the order of the catalogue."""
    declared = scene.effects or []
    found = []
    for effect in EFFECTS:
        where = effect.found(scene)
        idle = effect.idle(scene) if where is not None else None
        found.append(Presence(effect, where, idle, effect.name in declared))
    return found


def effects_on(scene: Scene) -> list[str]:
    """Names of the effects that are on."""
    return [item.effect.name for item in presences(scene) if item.on]


def remarks(scene: Scene) -> list[str]:
    """Effects that cost and do nothing, and ones that are declared and not there."""
    said = []
    for item in presences(scene):
        if item.idle is not None:
            said.append(f"effect '{item.effect.name}' is on ({item.where}) and does nothing: {item.idle}")
        elif item.declared and not item.on:
            said.append(f"effect '{item.effect.name}' is declared, but nothing in the scene uses it; it stays off")
    return said


def missing(scene: Scene) -> list[str]:
    """What a declared list lacks; nothing for a scene that leaves its effects to be derived."""
    if scene.effects is None:
        return []
    return [
        f"effects: '{item.effect.name}' is missing, but {item.where} needs it"
        for item in presences(scene)
        if item.on and not item.declared
    ]
