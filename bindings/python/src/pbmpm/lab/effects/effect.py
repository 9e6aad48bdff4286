"""What an effect of a scene is: how to see whether it is there, and how to switch it on and off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..names import EffectName
from ..scenes.scene import Scene
from ..state import State

Switch = Callable[[Scene, State], tuple[Scene, State]]
"""Changes a scene, and where necessary the state that it has reached."""


class NotHere(Exception):
    """An effect that cannot be in a scene like this one; the message says why."""


@dataclass(frozen=True)
class Effect:
    """An effect that scenes can have.

    `found` tells where in a scene the effect is on (the name of a field), or None; `idle` why an effect that is on does
    nothing, or None. `off` switches it off; `on` adds it in the form that `typical` describes, or raises NotHere.
    """

    name: EffectName
    description: str
    typical: str
    found: Callable[[Scene], str | None]
    idle: Callable[[Scene], str | None]
    off: Switch
    on: Switch


def scene_with(scene: Scene, **changes: object) -> Scene:
    """A copy of a scene with other fields."""
    return scene.model_copy(update=changes)


def declared(scene: Scene, name: EffectName) -> bool:
    """Whether the scene's list of effects has it."""
    return name in (scene.effects or ())


def undeclared(scene: Scene, name: EffectName) -> Scene:
    """The scene without an effect in its list."""
    return scene if scene.effects is None else scene_with(scene, effects=[word for word in scene.effects if word != name])


def never_idle(_: Scene) -> None:
    """For effects that always do something where they are."""
    return None
