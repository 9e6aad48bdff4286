"""Obstacles in 3D pictures: boxes cut the viewing rays exactly, other shapes are found by marching through their distance functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from .camera import Camera
from ..scenes.motion import Pose, rotation_matrix
from .look import OBSTACLE
from ..scenes.scene import ColliderPart
from ..scenes.solids import baked_solid, distance_function

_STEPS = 64
_TOUCH = 2e-4  # [scene sizes] a ray that comes this near has hit


def trace_obstacles(
    colliders: list[ColliderPart], poses: list[Pose], camera: Camera, rays: np.ndarray, light: np.ndarray, size: float
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yields depth and colour images of each obstacle. Planes are left out: the floor stands for them."""
    for collider, (position, rotation) in zip(colliders, poses):
        if collider.shape.kind == "plane":
            continue
        turn = rotation_matrix(rotation)
        eye = (camera.eye - np.array(position)) @ turn
        rows, columns = _rows_and_columns(camera, np.array(position), _outer_radius(collider.shape))
        local = (rays[rows, columns].reshape(-1, 3).astype(np.float64)) @ turn
        yield _trace(collider.shape, eye, local, (rows, columns), camera, turn, light, size)


def _trace(shape, eye, rays, window, camera: Camera, turn, light, size: float) -> tuple[np.ndarray, np.ndarray]:
    if shape.kind == "box":
        half = np.array(shape.half_extents)
        depth, hit, normal = _cut_box(-half, half, eye, rays)
    else:
        depth, hit, normal = _march(shape, eye, rays, size)
    bright = 0.5 + 0.5 * np.clip(normal @ turn.T @ light, 0.0, 1.0)
    depth_map = np.full((camera.height, camera.width), np.inf, dtype=np.float32)
    colour = np.zeros((camera.height, camera.width, 3), dtype=np.float32)
    rows, columns = window
    box = (rows.stop - rows.start, columns.stop - columns.start)
    depth_map[rows, columns] = np.where(hit, depth, np.inf).reshape(box)
    colour[rows, columns] = (bright[:, None] * np.array(OBSTACLE)).reshape(*box, 3)
    return depth_map, colour


def _cut_box(low, high, eye, rays) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Depth, hit and normal in the box's frame: a ray is inside between its last entry into and its first exit from a pair of faces."""
    slow = np.where(np.abs(rays) < 1e-12, 1e-12, rays)
    first, second = (low - eye) / slow, (high - eye) / slow
    entry = np.minimum(first, second)
    axis = entry.argmax(axis=1)
    depth, leaves = entry.max(axis=1), np.maximum(first, second).min(axis=1)
    return np.maximum(depth, 0.0), (depth <= leaves) & (leaves > 0.0), -np.sign(slow) * np.eye(3)[axis]


def _march(shape, eye, rays, size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same for any distance function; only rays go on that have neither hit nor left the scene."""
    distance = _distance_function(shape)
    length = np.linalg.norm(rays, axis=1)
    depth = np.zeros(len(rays))
    going = np.arange(len(rays))
    if shape.kind in ("mesh", "heights"):  # all of it is inside its grid
        info = baked_solid(shape, 3).info
        depth, meets, _ = _cut_box(np.array(info.minimum), np.array(info.maximum), eye, rays)
        depth, going = np.where(meets, depth, 100 * size), np.flatnonzero(meets)
    for _ in range(_STEPS):
        gap = distance(eye + depth[going, None] * rays[going])
        depth[going] = np.minimum(depth[going] + np.maximum(gap, 0.0) / length[going], 100 * size)
        going = going[(gap > 0.1 * _TOUCH * size) & (depth[going] < 100 * size)]
        if len(going) == 0:
            break
    near = np.flatnonzero(depth < 100 * size)
    points = eye + depth[near, None] * rays[near]
    touches = distance(points) < _TOUCH * size
    hit, normal = np.zeros(len(rays), bool), np.zeros_like(rays)
    hit[near] = touches
    normal[near[touches]] = _gradient(distance, points[touches], 1e-3 * size)
    return depth, hit, normal


def _distance_function(shape) -> Callable[[np.ndarray], np.ndarray]:
    """Signed distance to the surface in the shape's own frame."""
    match shape.kind:
        case "sphere":
            return lambda p: np.linalg.norm(p, axis=1) - shape.radius
        case "capsule":
            return lambda p: (
                np.linalg.norm(p - np.stack([_along(p, shape), 0 * p[:, 0], 0 * p[:, 0]], axis=1), axis=1) - shape.radius
            )
        case "mesh" | "heights":
            return distance_function(baked_solid(shape, 3))
        case _:
            raise ValueError(f"there is no distance function of a {shape.kind}")


def _along(points: np.ndarray, shape) -> np.ndarray:
    return np.clip(points[:, 0], -shape.half_length, shape.half_length)


def _gradient(distance, points: np.ndarray, step: float) -> np.ndarray:
    columns = [distance(points + step * axis) - distance(points - step * axis) for axis in np.eye(3)]
    gradient = np.stack(columns, axis=1)
    return gradient / np.maximum(np.linalg.norm(gradient, axis=1, keepdims=True), 1e-20)


def _outer_radius(shape) -> float:
    match shape.kind:
        case "box":
            return float(np.linalg.norm(shape.half_extents))
        case "sphere":
            return shape.radius
        case "capsule":
            return shape.radius + shape.half_length
        case "mesh" | "heights":
            info = baked_solid(shape, 3).info
            return float(np.linalg.norm(np.maximum(np.abs(info.minimum), np.abs(info.maximum))))
        case _:
            raise ValueError(f"a {shape.kind} has no radius")


def _rows_and_columns(camera: Camera, centre: np.ndarray, radius: float) -> tuple[slice, slice]:
    """The part of the picture that can show a ball; all of it when the ball is near the eye."""
    column, row, depth = (float(value[0]) for value in camera.project(centre[None]))
    if depth < 2 * radius:
        return slice(0, camera.height), slice(0, camera.width)
    reach = 1.3 * camera.focal * radius / (depth - radius)
    rows = np.clip([row - reach, row + reach + 1], 0, camera.height).astype(int)
    columns = np.clip([column - reach, column + reach + 1], 0, camera.width).astype(int)
    return slice(*rows), slice(*columns)
