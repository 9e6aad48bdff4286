"""Rigid bodies of a scene: obstacles that move as matter pushes them.

They are free, or turn about a hinge. They know gravity, matter and the walls of the domain, and not each other: for more there are
physics engines, see ``samples/bullet``. What is stable for light bodies stands at ``pbmpm_impulse`` in ``include/pbmpm/collider.h``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

import pbmpm

from .motion import Pose, pad3, quaternion, rotation_matrix
from .scene import ColliderPart, Scene
from .solids import baked_solid


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
        self._momentum = np.zeros(3)  # angular, about the centre of mass or the hinge [kg m^2/s]
        form = form_of(part.shape, scene.dimension)
        self._mass = part.body.mass if part.body.mass is not None else (part.body.density or 0.0) * form.volume
        self._centre = form.centre  # of mass, from the position, in the frame of the shape
        # About a hinge at the position: Steiner's share of the centre.
        away = np.zeros((3, 3)) if part.body.moves else form.centre @ form.centre * np.eye(3) - np.outer(form.centre, form.centre)
        self._inertia = self._mass * (form.inertia + away)
        self._axis = None if part.body.axis is None else np.array(part.body.axis) / math.hypot(*part.body.axis)

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
        centre = self._position + self._arm()
        if self._body.turns:
            self._rotation = _turned(self._rotation, dt * self._spin())
        if self._body.moves:
            self._position = centre + dt * self._velocity - self._arm()
            self._stop_at_walls()
        self._collider.move(self._position[: self._scene.dimension], self._rotation)

    def after_step(self, dt: float) -> None:
        """Takes what matter gave to the obstacle, and gravity."""
        impulse = self._collider.impulse
        given = np.array(pad3(list(impulse.linear)))
        angular = np.array(impulse.angular if len(impulse.angular) == 3 else (0.0, 0.0, impulse.angular[0]))
        arm, weight = self._arm(), self._mass * dt * self._gravity
        if not self._body.moves:
            self._momentum = self._momentum + angular + np.cross(arm, weight)
            return
        virtual = self._body.virtual_mass
        self._last = (weight + given + virtual * self._last) / (self._mass + virtual)
        self._velocity = self._velocity + self._last
        self._momentum = self._momentum + angular - np.cross(arm, given)

    def figures(self) -> dict[str, Any]:
        """For the report."""
        d = self._scene.dimension
        return {"position": self._position[:d].tolist(), "rotation": self._rotation.tolist(), "velocity": self._velocity[:d].tolist()}

    def _arm(self) -> np.ndarray:
        """From the position to the centre of mass, in the world."""
        return rotation_matrix(self._rotation.tolist()) @ self._centre

    def _spin(self) -> np.ndarray:
        turn = rotation_matrix(self._rotation.tolist())
        inertia = turn @ self._inertia @ turn.T
        if self._axis is not None:
            return self._axis * (self._axis @ self._momentum) / (self._axis @ inertia @ self._axis)
        if self._scene.dimension == 2:
            return np.array([0.0, 0.0, self._momentum[2] / inertia[2, 2]])
        return np.linalg.solve(inertia, self._momentum)

    def _stop_at_walls(self) -> None:
        domain = self._scene.domain
        if domain is None:
            return
        below, above = _reach(self._shape, rotation_matrix(self._rotation.tolist()), self._scene.dimension)
        for axis in range(self._scene.dimension):
            low, high = domain.min[axis] - below[axis], domain.max[axis] - above[axis]
            place = min(max(self._position[axis], low), high)
            if place != self._position[axis]:
                self._velocity[axis] = self._last[axis] = 0.0
            self._position[axis] = place


@dataclass(frozen=True)
class Form:
    """What the form of a body says of its motion. Three components in 2D too; there only what lies in the plane matters."""

    volume: float
    """[m^d]"""
    centre: np.ndarray
    """Of the volume [m], from the position of the shape, in its frame."""
    inertia: np.ndarray
    """(3, 3) about the centre and per mass [m^2], in the frame of the shape."""


def form_of(shape: Any, dimension: int) -> Form:
    """Of a box or sphere by its formula, of a mesh from its baked distances."""
    if shape.kind == "sphere":
        volume = math.pi * shape.radius**2 * (4 / 3 * shape.radius if dimension == 3 else 1)
        return Form(volume, np.zeros(3), (0.4 if dimension == 3 else 0.5) * shape.radius**2 * np.eye(3))
    if shape.kind == "box":
        x, y, z = [extent**2 for extent in pad3(shape.half_extents)]
        return Form(math.prod(2 * e for e in shape.half_extents), np.zeros(3), np.diag([y + z, z + x, x + y]) / 3)
    return _baked_form(baked_solid(shape, dimension))


def _baked_form(solid: pbmpm.BakedSolid) -> Form:
    """Sums over the nodes of the grid; a cell that the surface crosses counts by its share, which its distance tells."""
    info = solid.info
    share = np.clip(0.5 - solid.distances / info.spacing, 0.0, 1.0).astype(np.float64)
    axes = [low + info.spacing * np.arange(count) for low, count in zip(info.minimum, info.counts)]
    places = np.zeros((share.size, 3))
    places[:, : info.dimension] = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, info.dimension)
    weights = share.ravel()
    total = weights.sum()
    centre = weights @ places / total
    away = places - centre
    second = (away * weights[:, None]).T @ away / total
    return Form(total * info.spacing**info.dimension, centre, np.trace(second) * np.eye(3) - second)


def _reach(shape: Any, turn: np.ndarray, dimension: int) -> tuple[np.ndarray, np.ndarray]:
    """How far the turned shape reaches from its position, down and up each axis."""
    if shape.kind == "sphere":
        return np.full(3, -shape.radius), np.full(3, shape.radius)
    if shape.kind == "box":
        half = np.abs(turn) @ np.array(pad3(shape.half_extents))
        return -half, half
    info = baked_solid(shape, dimension).info  # its surface lies two cells inside of the grid
    low = np.array(pad3([v + 2 * info.spacing for v in info.minimum]))
    high = np.array(pad3([v - 2 * info.spacing for v in info.maximum]))
    middle, half = turn @ (low + high) / 2, np.abs(turn) @ (high - low) / 2
    return middle - half, middle + half


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
