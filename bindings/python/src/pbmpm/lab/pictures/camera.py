"""A perspective camera for 3D pictures."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ..scenes.scene import Scene

ASPECT = 16 / 9
_DEFAULT_VIEW = (0.42, 0.40, 1.0)  # share of right, up and front in the direction towards the default eye
_DEFAULT_FIELD_OF_VIEW = 0.6
_FILLED = 0.96  # share of the half picture that the corners of the scene may reach


@dataclass(frozen=True)
class Camera:
    """Maps points of the world to pixels; depth is measured along the viewing direction."""

    eye: np.ndarray
    right: np.ndarray
    up: np.ndarray
    forward: np.ndarray
    width: int
    height: int
    focal: float
    """[pixels]"""

    def project(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Pixel columns, pixel rows and depths [m] of (n, 3) points."""
        offset = np.asarray(points, dtype=np.float64) - self.eye
        depth = offset @ self.forward
        safe = np.where(depth > 1e-9, depth, 1e-9)
        column = 0.5 * self.width + self.focal * (offset @ self.right) / safe
        row = 0.5 * self.height - self.focal * (offset @ self.up) / safe
        return column, row, depth

    def rays(self) -> np.ndarray:
        """(height, width, 3) viewing directions scaled to unit depth: eye + depth * ray is the point seen."""
        column = (np.arange(self.width) + 0.5 - 0.5 * self.width) / self.focal
        row = (0.5 * self.height - np.arange(self.height) - 0.5) / self.focal
        rays = self.forward + column[None, :, None] * self.right + row[:, None, None] * self.up
        return rays.astype(np.float32)


def scene_up(scene: Scene) -> np.ndarray:
    """Unit vector against gravity; the second axis where there is none."""
    gravity = np.array(scene.gravity, dtype=float)
    strength = float(np.linalg.norm(gravity))
    return -gravity / strength if strength > 0 else np.array([0.0, 1.0, 0.0])


def scene_camera(scene: Scene, low: np.ndarray, high: np.ndarray, width: int) -> Camera:
    """The scene's own camera, or one that sees the box from ``low`` to ``high`` from the front, right and above."""
    up = scene_up(scene)
    own = scene.pictures.camera
    if own is not None:
        return _look_at(np.array(own.eye), np.array(own.target), up, own.field_of_view, width)
    target, direction = 0.5 * (low + high), _default_direction(up, high - low)
    distance = float(np.linalg.norm(high - low))
    while True:
        camera = _look_at(target + distance * direction, target, up, _DEFAULT_FIELD_OF_VIEW, width)
        if _shows(camera, low, high):
            return camera
        distance *= 1.03


def _default_direction(up: np.ndarray, extent: np.ndarray) -> np.ndarray:
    vertical = int(np.argmax(np.abs(up)))
    across = max((axis for axis in range(3) if axis != vertical), key=lambda axis: extent[axis])
    right = np.eye(3)[across]
    direction = _DEFAULT_VIEW[0] * right + _DEFAULT_VIEW[1] * up + _DEFAULT_VIEW[2] * np.cross(right, up)
    return direction / np.linalg.norm(direction)


def _shows(camera: Camera, low: np.ndarray, high: np.ndarray) -> bool:
    """Whether all corners of a box are well inside the picture."""
    corners = np.array(list(itertools.product(*zip(low, high))))
    column, row, depth = camera.project(corners)
    across = np.abs(column / (0.5 * camera.width) - 1.0)
    down = np.abs(row / (0.5 * camera.height) - 1.0)
    return bool((depth > 0).all() and max(across.max(), down.max()) <= _FILLED)


def _look_at(eye: np.ndarray, target: np.ndarray, up: np.ndarray, field: float, width: int) -> Camera:
    """``field`` is the vertical opening angle [rad]."""
    forward = target - eye
    forward = forward / max(float(np.linalg.norm(forward)), 1e-12)
    right = np.cross(forward, up)
    if np.linalg.norm(right) < 1e-6:  # looking straight up or down
        right = np.cross(forward, np.roll(up, 1))
    right = right / np.linalg.norm(right)
    height = int(round(width / ASPECT))
    return Camera(eye, right, np.cross(right, forward), forward, width, height, 0.5 * height / math.tan(0.5 * field))
