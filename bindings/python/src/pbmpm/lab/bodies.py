"""Rigid bodies of a scene: `pbmpm.RigidBody` made from what the scene says.

They know gravity, matter and the walls of the domain, and not each other: for more there are physics engines, see ``samples/bullet``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import pbmpm

from .scenes.motion import Pose, pad3, quaternion, rotation_matrix
from .scenes.scene import BodyPart, ColliderPart, Scene


class Body:
    """One body."""

    def __init__(self, collider: pbmpm.Collider, part: ColliderPart, scene: Scene) -> None:
        assert part.body is not None
        self._rigid = pbmpm.RigidBody(collider, mass=part.body.mass, density=part.body.density, **_holds(part, part.body, scene.dimension))
        if part.body.velocity is not None:
            self._rigid.velocity = part.body.velocity

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return pad3(list(self._rigid.position)), list(self._rigid.rotation)

    @property
    def state(self) -> dict[str, Any]:
        """A copy of all that changes, and the pose that is a part of it."""
        return {"pose": self.pose, "motion": self._rigid.state}

    @state.setter
    def state(self, value: dict[str, Any]) -> None:
        self._rigid.state = value["motion"]

    def before_step(self, dt: float) -> None:
        """Gives it what matter gave to its obstacle, and sends that where the body will be."""
        self._rigid.advance(dt)

    def figures(self) -> dict[str, Any]:
        """For the report."""
        body = self._rigid
        return {"position": list(body.position), "rotation": list(body.rotation), "velocity": list(body.velocity)}


def _holds(part: ColliderPart, body: BodyPart, dimension: int) -> dict[str, Any]:
    """What holds the body, as `pbmpm.RigidBody` takes it."""
    freedom, holds = pbmpm.Freedom, {}
    if not body.moves:
        holds["moves"] = freedom.NONE
    elif body.slides is not None:
        holds.update(moves=freedom.AXIS, move_axis=body.slides)
    if not body.turns:
        holds["turns"] = freedom.NONE
    elif body.axis is not None:
        holds.update(turns=freedom.AXIS, turn_axis=body.axis)
    if body.pivot is not None:
        turn = rotation_matrix(quaternion(getattr(part.shape, "rotation", 0.0)))
        away = np.array(pad3(body.pivot)) - np.array(pad3(part.shape.position))
        holds["pivot"] = (turn.T @ away)[:dimension]
    return holds
