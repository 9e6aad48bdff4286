"""Where obstacles are at a given time."""

from __future__ import annotations

import math
from bisect import bisect_right

import numpy as np

from ..frame import Frame
from .scene import ColliderPart, MotionPart

Pose = tuple[list[float], list[float]]
"""Position (3 components) and rotation (quaternion x, y, z, w)."""


def pad3(vector: list[float]) -> list[float]:
    """A vector of 2 or 3 components as 3 components."""
    return [*vector, 0.0][:3]


def quaternion(rotation: float | list[float]) -> list[float]:
    """A rotation of a scene file, angle or quaternion, as a unit quaternion (x, y, z, w)."""
    if isinstance(rotation, list):
        length = math.hypot(*rotation)
        return [component / length for component in rotation]
    return [0.0, 0.0, math.sin(rotation / 2), math.cos(rotation / 2)]


def rotation_matrix(unit: list[float]) -> np.ndarray:
    """(3, 3) matrix of a unit quaternion; its columns are the turned axes."""
    x, y, z, w = unit
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def collider_pose(collider: ColliderPart, time: float) -> Pose:
    """The pose of an obstacle at ``time``; a static one stays where its shape says."""
    if collider.motion is None:
        return pad3(collider.shape.position), quaternion(getattr(collider.shape, "rotation", 0.0))
    return pose_at(collider.motion, time)


def obstacle_poses(colliders: list[ColliderPart], frame: Frame) -> list[Pose]:
    """The poses of all obstacles at the moment of a frame: of bodies as it holds them, of others as the scene says."""
    return [
        frame.body_poses.get(index) or collider_pose(collider, frame.time) for index, collider in enumerate(colliders)
    ]


def pose_at(motion: MotionPart, time: float) -> Pose:
    """Linear between keyframes (rotations: shortest arc); held outside, or repeated from the first to the last."""
    frames = motion.keyframes
    first, last = frames[0].time, frames[-1].time
    if motion.repeat and time > last:
        time = first + (time - first) % (last - first)
    time = min(max(time, first), last)
    after = min(bisect_right([frame.time for frame in frames], time), len(frames) - 1)
    a, b = frames[after - 1], frames[after]
    share = (time - a.time) / (b.time - a.time)
    position = [p + share * (q - p) for p, q in zip(pad3(a.position), pad3(b.position))]
    return position, _blend(a.rotation, b.rotation, share)


def _blend(a: float | list[float], b: float | list[float], share: float) -> list[float]:
    if not isinstance(a, list) and not isinstance(b, list):
        return quaternion(a + share * (b - a))  # angles: a full turn is a full turn
    start, end = np.array(quaternion(a)), np.array(quaternion(b))
    cosine = float(start @ end)
    if cosine < 0:
        end, cosine = -end, -cosine
    angle = math.acos(min(1.0, cosine))
    if angle < 1e-6:
        return quaternion(list(start + share * (end - start)))
    return quaternion(list((math.sin((1 - share) * angle) * start + math.sin(share * angle) * end) / math.sin(angle)))
