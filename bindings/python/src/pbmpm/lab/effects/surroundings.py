"""Effects around matter: obstacles of all kinds, and the impulses that they take."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..scenes.motion import Pose, collider_pose
from ..names import EffectName
from ..scenes.scene import BodyPart, BoxPart, ColliderPart, KeyframePart, MeshPart, MotionPart, Scene, SpherePart
from ..state import State
from .effect import Effect, NotHere, declared, scene_with, undeclared

SIZE = 2.0
"""Half the size of an obstacle that a scene does not have [cells]."""
_SPEED = 1.0  # [cells/s] of an obstacle that a scene does not have
_LONG = 1e4  # [s] longer than any scene
_LIGHT = 0.5  # density of a body that a scene does not have, over that of its first material


def is_baked(part: ColliderPart) -> bool:
    """Whether the shape is a grid of distances."""
    return part.shape.kind in ("mesh", "heights")


def _is_plain(part: ColliderPart) -> bool:
    return not is_baked(part)


def _moves(part: ColliderPart) -> bool:
    return part.motion is not None


def _is_body(part: ColliderPart) -> bool:
    return part.body is not None


def _obstacle_effect(
    name: EffectName,
    description: str,
    typical: str,
    has: Callable[[ColliderPart], bool],
    at_rest: bool,
    added: Callable[[Scene, list[float], State], ColliderPart],
    idle: Callable[[ColliderPart, Scene], bool],
    why_idle: str,
) -> Effect:
    """Obstacles that `has` tells. Switched off they stand still (`at_rest`), or are not there."""

    def found(scene: Scene) -> str | None:
        return next((f"colliders[{index}]" for index, part in enumerate(scene.colliders) if has(part)), None)

    def why(scene: Scene) -> str | None:
        return why_idle if all(idle(part, scene) for part in scene.colliders if has(part)) else None

    def off(scene: Scene, state: State) -> tuple[Scene, State]:
        if not at_rest:
            return scene_with(scene, colliders=[part for part in scene.colliders if not has(part)]), state
        poses = poses_of(scene, state)
        colliders = [_resting(part, pose) if has(part) else part for part, pose in zip(scene.colliders, poses, strict=True)]
        return scene_with(scene, colliders=colliders), state

    def on(scene: Scene, state: State) -> tuple[Scene, State]:
        part = added(scene, middle_of(state), state)
        return scene_with(scene, colliders=[*scene.colliders, part]), state

    return Effect(name, description, typical, found, why, off, on)


def poses_of(scene: Scene, state: State) -> list[Pose]:
    """Where the obstacles of a scene are at the moment of a state."""
    bodies = iter(state.bodies)
    return [
        next(bodies)["pose"] if part.body is not None else collider_pose(part, state.time) for part in scene.colliders
    ]


def _resting(part: ColliderPart, pose: Pose) -> ColliderPart:
    position, rotation = pose
    changes: dict[str, Any] = {"position": position[: len(part.shape.position)]}
    if hasattr(part.shape, "rotation"):
        changes["rotation"] = rotation
    return part.model_copy(update={"shape": part.shape.model_copy(update=changes), "motion": None, "body": None})


def middle_of(state: State) -> list[float]:
    """The middle of the matter."""
    return np.median(state.positions, axis=0).astype(float).tolist()


def _ball(scene: Scene, centre: list[float]) -> SpherePart:
    return SpherePart(kind="sphere", position=centre, radius=SIZE * scene.cell_size)


def _moving(scene: Scene, centre: list[float], state: State) -> ColliderPart:
    """Begins at the moment of the state, so that it goes on from there."""
    end = [centre[0] + _LONG * _SPEED * scene.cell_size, *centre[1:]]
    frames = [
        KeyframePart(time=state.time, position=centre),
        KeyframePart(time=state.time + _LONG, position=end),
    ]
    return ColliderPart(shape=_ball(scene, centre), motion=MotionPart(keyframes=frames))


def _baked(scene: Scene, centre: list[float], _: State) -> ColliderPart:
    half = SIZE * scene.cell_size
    corners = np.array(np.meshgrid(*[[-half, half]] * scene.dimension)).reshape(scene.dimension, -1).T
    mesh = MeshPart(kind="mesh", position=centre, vertices=corners.tolist(), hull=True, resolution=16)
    return ColliderPart(shape=mesh)


def _light_body(scene: Scene, centre: list[float], _: State) -> ColliderPart:
    half = SIZE * scene.cell_size
    density = next(iter(scene.materials.values())).density
    body = BodyPart(mass=_LIGHT * density * (2 * half) ** scene.dimension)
    return ColliderPart(shape=BoxPart(kind="box", position=centre, half_extents=[half] * scene.dimension), body=body)


def _out_of_reach(part: ColliderPart, scene: Scene) -> bool:
    """Whether a resting ball or box lies beyond the walls of the domain, two cells and more away."""
    if scene.domain is None or part.shape.kind not in ("sphere", "box") or part.motion or part.body:
        return False
    size = part.shape.radius if isinstance(part.shape, SpherePart) else math.hypot(*part.shape.half_extents)
    reach = size + 2 * scene.cell_size
    axes = zip(part.shape.position, scene.domain.min, scene.domain.max, strict=True)
    return any(place + reach < low or place - reach > high for place, low, high in axes)


def _stands_still(part: ColliderPart, _: Scene) -> bool:
    assert part.motion is not None
    first, *others = part.motion.keyframes
    return all((frame.position, frame.rotation) == (first.position, first.rotation) for frame in others)


def _measuring(scene: Scene) -> str | None:
    """Bodies take impulses anyway; this is about all the rest."""
    return "effects" if declared(scene, "impulses") else None


def _impulses_off(scene: Scene, state: State) -> tuple[Scene, State]:
    return undeclared(scene, "impulses"), state


def _impulses_on(scene: Scene, state: State) -> tuple[Scene, State]:
    if not scene.colliders and scene.domain is None:
        raise NotHere("there is nothing that could take them")
    return scene_with(scene, effects=[*(scene.effects or []), "impulses"]), state


def _impulses_idle(scene: Scene) -> str | None:
    return None if scene.colliders or scene.domain else "there is nothing that could take them"


def surrounding_effects() -> list[Effect]:
    """In the order in which they are switched off: what moves becomes still before it goes."""
    return [
        _obstacle_effect(
            "rigid_bodies",
            "obstacles that matter pushes; switched off they stand still",
            "a light box in the middle of the matter, against none",
            _is_body,
            True,
            _light_body,
            lambda part, scene: False,
            "",
        ),
        _obstacle_effect(
            "moving_obstacles",
            "obstacles on a path; switched off they stand still",
            "a ball that goes through the middle of the matter, against none",
            _moves,
            True,
            _moving,
            _stands_still,
            "all its poses are the same",
        ),
        _obstacle_effect(
            "baked_solids",
            "obstacles from meshes and heights",
            "a baked box in the middle of the matter",
            is_baked,
            False,
            _baked,
            lambda part, scene: False,
            "",
        ),
        _obstacle_effect(
            "obstacles",
            "planes, boxes, balls and capsules",
            "a ball in the middle of the matter",
            _is_plain,
            False,
            lambda scene, centre, _: ColliderPart(shape=_ball(scene, centre)),
            _out_of_reach,
            "all of them lie outside of the domain",
        ),
        Effect(
            "impulses",
            "what matter does to all obstacles and walls is measured, not to rigid bodies alone",
            "all obstacles and walls",
            _measuring,
            _impulses_idle,
            _impulses_off,
            _impulses_on,
        ),
    ]
