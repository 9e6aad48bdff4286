"""Rigid bodies of a scene: obstacles that move as matter pushes them.

They know gravity, matter and the walls of the domain, and not each other: for more there are physics engines, see
``samples/bullet``. What is stable for light bodies stands at ``pbmpm_impulse`` in ``include/pbmpm/collider.h``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import pbmpm

from .motion import Pose, pad3, quaternion, rotation_matrix
from .scene import ColliderPart, Scene


class Body:
    """One body. Vectors have three components in 2D too."""

    def __init__(self, collider: pbmpm.Collider, part: ColliderPart, scene: Scene) -> None:
        assert part.body is not None
        self._collider, self._scene = collider, scene
        self._shape, self._body = part.shape, part.body
        self._gravity = np.array(pad3(scene.gravity))
        self._position = np.array(pad3(part.shape.position))
        self._rotation = np.array(quaternion(getattr(part.shape, "rotation", 0.0)))
        self._velocity = np.array(pad3(part.body.velocity or [0.0, 0.0, 0.0]))
        self._last = np.zeros(3)  # what the velocity changed by in the last step
        self._momentum = np.zeros(3)  # angular [kg m^2/s]
        self._inertia = part.body.mass * _inertia_per_mass(part.shape, scene.dimension)

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return self._position.tolist(), self._rotation.tolist()

    @property
    def state(self) -> dict[str, Any]:
        """A copy of all that changes: the pose, and what a body remembers of its motion."""
        motion = {"velocity": self._velocity, "last": self._last, "momentum": self._momentum}
        return {"pose": self.pose, **{name: vector.copy() for name, vector in motion.items()}}

    @state.setter
    def state(self, value: dict[str, Any]) -> None:
        self._position, self._rotation = (np.array(part) for part in value["pose"])
        self._velocity, self._last, self._momentum = (value[name].copy() for name in ("velocity", "last", "momentum"))
        self._collider.teleport(self._position[: self._scene.dimension], self._rotation)

    def before_step(self, dt: float) -> None:
        """Sends the obstacle where the body will be."""
        self._position = self._position + dt * self._velocity
        if self._body.turns:
            self._rotation = _turned(self._rotation, dt * self._spin())
        self._stop_at_walls()
        self._collider.move(self._position[: self._scene.dimension], self._rotation)

    def after_step(self, dt: float) -> None:
        """Takes what matter gave to the obstacle."""
        impulse = self._collider.impulse
        mass, virtual = self._body.mass, self._body.virtual_mass
        given = np.array(pad3(list(impulse.linear)))
        self._last = (mass * dt * self._gravity + given + virtual * self._last) / (mass + virtual)
        self._velocity = self._velocity + self._last
        angular = impulse.angular if len(impulse.angular) == 3 else (0.0, 0.0, impulse.angular[0])
        self._momentum = self._momentum + np.array(angular)

    def figures(self) -> dict[str, Any]:
        """For the report."""
        d = self._scene.dimension
        return {"position": self._position[:d].tolist(), "rotation": self._rotation.tolist(), "velocity": self._velocity[:d].tolist()}

    def _spin(self) -> np.ndarray:
        turn = rotation_matrix(self._rotation.tolist())
        return turn @ ((turn.T @ self._momentum) / self._inertia)

    def _stop_at_walls(self) -> None:
        domain = self._scene.domain
        if domain is None:
            return
        reach = _reach(self._shape, rotation_matrix(self._rotation.tolist()))
        for axis in range(self._scene.dimension):
            low, high = domain.min[axis] + reach[axis], domain.max[axis] - reach[axis]
            place = min(max(self._position[axis], low), high)
            if place != self._position[axis]:
                self._velocity[axis] = self._last[axis] = 0.0
            self._position[axis] = place


def _inertia_per_mass(shape: Any, dimension: int) -> np.ndarray:
    """Principal moments about the local axes [m^2]; in 2D only the third matters."""
    if shape.kind == "sphere":
        return np.full(3, (0.4 if dimension == 3 else 0.5) * shape.radius**2)
    x, y, z = [extent**2 for extent in pad3(shape.half_extents)]
    return np.array([y + z, z + x, x + y]) / 3


def _reach(shape: Any, turn: np.ndarray) -> np.ndarray:
    """Half the size of the box around the turned shape."""
    if shape.kind == "sphere":
        return np.full(3, shape.radius)
    return np.abs(turn) @ np.array(pad3(shape.half_extents))


def _turned(rotation: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """A quaternion turned by a rotation vector."""
    angle = float(np.linalg.norm(angles))
    if angle < 1e-12:
        return rotation
    x, y, z = np.sin(angle / 2) * angles / angle
    w = np.cos(angle / 2)
    ox, oy, oz, ow = rotation
    turned = np.array(
        [
            w * ox + x * ow + y * oz - z * oy,
            w * oy + y * ow + z * ox - x * oz,
            w * oz + z * ow + x * oy - y * ox,
            w * ow - x * ox - y * oy - z * oz,
        ]
    )
    return turned / np.linalg.norm(turned)
