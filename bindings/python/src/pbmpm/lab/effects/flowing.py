"""Effects that add, take and push matter: emitters, drains, kill bounds, forces."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..names import EffectName
from ..scenes.scene import DrainPart, EmitterPart, ForcePart, KillBoundsPart, Scene, SpherePart
from ..state import State
from .effect import Effect, scene_with

SIZE = 2.0
"""Radius of an emitter or a drain that a scene does not have [cells]."""
_SPEED = 1.0  # [m/s] of what such an emitter emits
_STRENGTH = 0.01  # [m/s^2, of a drag 1/s] of a force that a scene does not have: the state stays what it is
_FAR = 10.0  # [sizes of the matter] to such kill bounds


def _list_effect(
    name: EffectName,
    description: str,
    typical: str,
    field: str,
    belongs: Callable[[Any], bool],
    works: Callable[[Any, Scene], bool],
    why_idle: str,
    added: Callable[[Scene, State], Any],
) -> Effect:
    """The parts of a list of the scene that belong to an effect."""

    def own(scene: Scene) -> list[tuple[int, Any]]:
        return [(index, part) for index, part in enumerate(getattr(scene, field)) if belongs(part)]

    def found(scene: Scene) -> str | None:
        return next((f"{field}[{index}]" for index, _ in own(scene)), None)

    def idle(scene: Scene) -> str | None:
        return None if any(works(part, scene) for _, part in own(scene)) else why_idle

    def off(scene: Scene, state: State) -> tuple[Scene, State]:
        return scene_with(scene, **{field: [part for part in getattr(scene, field) if not belongs(part)]}), state

    def on(scene: Scene, state: State) -> tuple[Scene, State]:
        return scene_with(scene, **{field: [*getattr(scene, field), added(scene, state)]}), state

    return Effect(name, description, typical, found, idle, off, on)


def _in_time(part: Any, scene: Scene) -> bool:
    return part.start < scene.seconds


def _emits(part: EmitterPart, scene: Scene) -> bool:
    return part.rate > 0 and _in_time(part, scene)


def _pushes(part: ForcePart, scene: Scene) -> bool:
    return (part.strength != 0 or part.kind == "grab") and _in_time(part, scene)


def _ball(scene: Scene, place: np.ndarray) -> SpherePart:
    return SpherePart(kind="sphere", position=place.astype(float).tolist(), radius=SIZE * scene.cell_size)


def _up(scene: Scene) -> np.ndarray:
    """Against gravity; without it along the second axis."""
    gravity = np.array(scene.gravity)
    strength = float(np.linalg.norm(gravity))
    return -gravity / strength if strength > 0 else np.eye(scene.dimension)[1]


def _above(scene: Scene, state: State) -> np.ndarray:
    """A place over the middle of the matter, inside the domain."""
    up, middle = _up(scene), np.median(state.positions, axis=0)
    top = float(np.max(state.positions @ up))
    place = middle + (top - middle @ up + 2 * SIZE * scene.cell_size) * up
    if scene.domain is not None:
        room = (SIZE + 1) * scene.cell_size
        place = np.clip(place, np.array(scene.domain.min) + room, np.array(scene.domain.max) - room)
    return place


def typical_emitter(scene: Scene, state: State) -> EmitterPart:
    """One for a scene that has none."""
    radius = SIZE * scene.cell_size
    area = 2 * radius if scene.dimension == 2 else math.pi * radius**2
    return EmitterPart(
        shape=_ball(scene, _above(scene, state)),
        material=scene.sources[0].material,
        rate=area * _SPEED,
        region="disc",
        speed=_SPEED,
        direction=(-_up(scene)).tolist(),
    )


def emitted_per_second(part: EmitterPart, scene: Scene) -> float:
    """Particles that an emitter brings where nothing hinders it."""
    return part.rate / (scene.cell_size / part.particles_per_axis) ** scene.dimension


def _drain(scene: Scene, state: State) -> DrainPart:
    lowest = state.positions[int(np.argmin(state.positions @ _up(scene)))]
    return DrainPart(shape=_ball(scene, lowest))


def _force(kind: str) -> Callable[[Scene, State], ForcePart]:
    def added(scene: Scene, state: State) -> ForcePart:
        low, high = state.positions.min(axis=0), state.positions.max(axis=0)
        radius = 0.5 * float(np.linalg.norm(high - low))
        shape = SpherePart(kind="sphere", position=(0.5 * (low + high)).astype(float).tolist(), radius=radius)
        return ForcePart(kind=kind, strength=_STRENGTH, shape=shape)  # type: ignore[arg-type]

    return added


def _grab(scene: Scene, state: State) -> ForcePart:
    """Small: it holds what it grabs."""
    return ForcePart(kind="grab", shape=_ball(scene, np.median(state.positions, axis=0)))


def _kill_idle(scene: Scene) -> str | None:
    bounds, domain = scene.kill_bounds, scene.domain
    if bounds is None or domain is None:
        return None
    low = all(bound <= wall for bound, wall in zip(bounds.min, domain.min, strict=True))
    high = all(bound >= wall for bound, wall in zip(bounds.max, domain.max, strict=True))
    return "the walls of the domain hold all matter inside" if low and high else None


def _kill_on(scene: Scene, state: State) -> tuple[Scene, State]:
    low, high = state.positions.min(axis=0), state.positions.max(axis=0)
    reach = _FAR * float(np.max(high - low)) + scene.cell_size
    bounds = KillBoundsPart(min=(low - reach).astype(float).tolist(), max=(high + reach).astype(float).tolist())
    return scene_with(scene, kill_bounds=bounds), state


def _force_effect(kind: str, name: EffectName, description: str) -> Effect:
    return _list_effect(
        name,
        description,
        "a ball in the middle of the matter" if kind == "grab" else f"one of {_STRENGTH:g} over all matter",
        "forces",
        lambda part: part.kind == kind,
        _pushes,
        "its strength is 0, or it begins after the end",
        _grab if kind == "grab" else _force(kind),
    )


def flowing_effects() -> list[Effect]:
    """In the order of reports."""
    return [
        _list_effect(
            "emitters",
            "sources of matter",
            f"one disc over the matter, {_SPEED:g} m/s",
            "emitters",
            lambda _: True,
            _emits,
            "its rate is 0, or it begins after the end",
            typical_emitter,
        ),
        _list_effect(
            "drains",
            "shapes that take matter out",
            "one ball where matter is lowest",
            "drains",
            lambda _: True,
            _in_time,
            "it begins after the end",
            _drain,
        ),
        Effect(
            "kill_bounds",
            "matter beyond a box is taken out",
            f"a box {_FAR:g} sizes of the matter away",
            lambda scene: "kill_bounds" if scene.kill_bounds is not None else None,
            _kill_idle,
            lambda scene, state: (scene_with(scene, kill_bounds=None), state),
            _kill_on,
        ),
        _force_effect("uniform", "uniform_force", "a force in one direction"),
        _force_effect("radial", "radial_force", "a force away from a point or towards it"),
        _force_effect("vortex", "vortex_force", "a force around an axis"),
        _force_effect("drag", "drag_force", "wind, or a brake"),
        _force_effect("grab", "grab_force", "matter takes on a given velocity"),
    ]
