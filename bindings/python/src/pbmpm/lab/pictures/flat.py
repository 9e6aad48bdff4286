"""Pictures of 2D scenes: discs for particles, outlines for obstacles. The first axis goes right, the second up."""

from __future__ import annotations

import math

import numpy as np
from PIL import Image, ImageDraw

from ..frame import Frame
from ..scenes.motion import Pose, obstacle_poses, rotation_matrix
from .look import BACKGROUND, INK, OBSTACLE, Look, particle_colours
from ..scenes.scene import ColliderPart
from ..scenes.solids import baked_solid, distance_function

OVERSAMPLING = 2
_AIR = (34, 38, 46)  # dark, so that fast (bright) particles stand out
_DISC_GROWTH = 1.5  # neighbours on the lattice overlap, so that a filled body looks filled
_FAR = 20.0  # [view sizes] how far a half space reaches in the picture


class _View:
    """The window of the world that the picture shows."""

    def __init__(self, frame: Frame, look: Look) -> None:
        low, high = _bounds(frame, look)
        margin = 0.02 * float(max(high - low))
        self.low, self.high = low - margin, high + margin
        self.width = look.scene.pictures.width * OVERSAMPLING
        self.scale = self.width / float(self.high[0] - self.low[0])
        self.height = max(OVERSAMPLING, int(round(float(self.high[1] - self.low[1]) * self.scale)))

    def pixels(self, points: np.ndarray) -> np.ndarray:
        """(n, 2) positions [m] to (n, 2) pixels, y down."""
        result = (np.asarray(points, dtype=np.float64) - self.low) * self.scale
        result[:, 1] = self.height - result[:, 1]
        return result


def draw_2d(frame: Frame, look: Look) -> Image.Image:
    """A picture of one moment, without caption."""
    view = _View(frame, look)
    image = Image.new("RGB", (view.width, view.height), BACKGROUND)
    draw = ImageDraw.Draw(image)
    draw.rectangle(_inside(view, look), fill=_AIR)
    poses = obstacle_poses(look.scene.colliders, frame)
    for collider, pose in zip(look.scene.colliders, poses):
        if collider.shape.kind not in ("mesh", "heights"):
            draw.polygon([tuple(p) for p in view.pixels(_outline(collider, pose, view))], fill=OBSTACLE)
    pixels = np.array(image)
    for collider, pose in zip(look.scene.colliders, poses):
        if collider.shape.kind in ("mesh", "heights"):
            pixels[_baked_mask(collider, pose, view)] = OBSTACLE
    _splat(pixels, view, frame, look)
    image = Image.fromarray(pixels)
    _draw_domain(ImageDraw.Draw(image), view, look)
    return image.resize((view.width // OVERSAMPLING, view.height // OVERSAMPLING), Image.Resampling.BOX)


def _splat(pixels: np.ndarray, view: _View, frame: Frame, look: Look) -> None:
    """Paints a disc per particle; later particles cover earlier ones."""
    colours = particle_colours(frame, look).astype(np.uint8)
    centre = np.floor(view.pixels(frame.positions)).astype(np.int64)
    radius = max(1.0, 0.5 * _DISC_GROWTH * look.particle_diameter * view.scale)
    reach = int(radius)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            if dx * dx + dy * dy > radius * radius:
                continue
            x, y = centre[:, 0] + dx, centre[:, 1] + dy
            inside = (x >= 0) & (x < view.width) & (y >= 0) & (y < view.height)
            pixels[y[inside], x[inside]] = colours[inside]


def _bounds(frame: Frame, look: Look) -> tuple[np.ndarray, np.ndarray]:
    domain = look.scene.domain
    if domain is not None:
        return np.array(domain.min), np.array(domain.max)
    corners = [_reach_of(fill.shape) for fill in look.scene.sources]
    corners += [_reach_of(c.shape) for c in look.scene.colliders if c.shape.kind != "plane"]
    if len(frame.positions):
        corners.append((frame.positions.min(axis=0), frame.positions.max(axis=0)))
    low = np.min([low for low, _ in corners], axis=0)
    high = np.max([high for _, high in corners], axis=0)
    return low, high


def _reach_of(shape) -> tuple[np.ndarray, np.ndarray]:
    """A box around a shape, whatever its rotation."""
    if shape.kind in ("mesh", "heights"):
        info = baked_solid(shape, len(shape.position)).info
        size = math.hypot(*np.maximum(np.abs(info.minimum), np.abs(info.maximum)))
        return np.array(shape.position) - size, np.array(shape.position) + size
    size = math.hypot(
        *getattr(shape, "half_extents", [getattr(shape, "half_length", 0.0) + getattr(shape, "radius", 0.0)])
    )
    centre = np.array(shape.position)
    return centre - size, centre + size


def _baked_mask(collider: ColliderPart, pose: Pose, view: _View) -> np.ndarray:
    """(height, width): the pixels inside a baked obstacle."""
    position, rotation = pose
    distance = distance_function(baked_solid(collider.shape, 2))
    columns, rows = np.meshgrid(np.arange(view.width) + 0.5, np.arange(view.height) + 0.5)
    points = np.stack([columns.ravel(), view.height - rows.ravel()], axis=1) / view.scale + view.low
    local = (points - np.array(position[:2])) @ rotation_matrix(rotation)[:2, :2]
    return distance(local).reshape(view.height, view.width) < 0


def _outline(collider: ColliderPart, pose: Pose, view: _View) -> np.ndarray:
    """(n, 2) corners of an obstacle in the world."""
    shape = collider.shape
    position, rotation = pose
    local = _local_outline(shape, float(max(view.high - view.low)) * _FAR)
    return local @ rotation_matrix(rotation)[:2, :2].T + np.array(position[:2])


def _local_outline(shape, far: float) -> np.ndarray:
    turn = np.linspace(0.0, 2 * math.pi, 96, endpoint=False)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    match shape.kind:
        case "box":
            return np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.array(shape.half_extents)
        case "sphere":
            return circle * shape.radius
        case "capsule":
            return circle * shape.radius + np.where(circle[:, :1] >= 0, 1.0, -1.0) * np.array([shape.half_length, 0.0])
        case "plane":
            normal = np.array(shape.normal) / math.hypot(*shape.normal)
            along = np.array([-normal[1], normal[0]])
            return far * np.array([along, along - normal, -along - normal, -along])
        case _:
            raise ValueError(f"a {shape.kind} has no outline")


def _inside(view: _View, look: Look) -> tuple[float, float, float, float]:
    """Left, top, right and bottom pixel of the domain, or of the whole picture."""
    domain = look.scene.domain
    if domain is None:
        return 0, 0, view.width, view.height
    (left, bottom), (right, top) = view.pixels(np.array([domain.min, domain.max]))
    return left, top, right, bottom


def _draw_domain(draw: ImageDraw.ImageDraw, view: _View, look: Look) -> None:
    if look.scene.domain is not None:
        draw.rectangle(_inside(view, look), outline=INK, width=2 * OVERSAMPLING)
