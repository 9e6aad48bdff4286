"""Pictures of 3D scenes: particles as spheres in a depth buffer, smoothed and lit, on a tiled floor with shadows.

Everything is NumPy on whole images. Particles are splatted offset by offset, sorted from far to near, so that of
several particles on one pixel the nearest is written last. The depth of the particles is then smoothed where
neighbouring pixels lie on the same surface, normals are taken from it, and the colours are lit: a body of liquid looks
like one, while drops stay round.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PIL import Image

from .camera import Camera, scene_camera, scene_up
from ..frame import Frame
from ..scenes.motion import obstacle_poses
from .obstacles import trace_obstacles
from .look import BACKGROUND, INK, Look, particle_colours

OVERSAMPLING = 2
_SPHERE_GROWTH = 1.5  # sphere diameter over lattice spacing: neighbours overlap and hide the gaps between them
_SMOOTH_ROUNDS = 3
_SAME_SURFACE = 2.5  # [particle diameters] larger steps in depth are edges
_SHINES_THROUGH = 0.35  # share of its colour that matter behind an obstacle has
_LIGHT = (-0.35, 0.85, 0.55)  # towards the light: share of right, up and towards the viewer
_FLOOR_COLOURS = np.array([[226, 228, 232], [214, 217, 222]], dtype=np.float32)
_MAX_REACH = 24  # [pixels] largest splat radius


@dataclass
class _Canvas:
    """Depth [m] and colour (0..255) of each pixel; infinite depth is background."""

    depth: np.ndarray
    colour: np.ndarray


def draw_3d(frame: Frame, look: Look) -> Image.Image:
    """A picture of one moment, without caption."""
    low, high = _bounds(frame, look)
    camera = scene_camera(look.scene, low, high, look.scene.pictures.width * OVERSAMPLING)
    light = _light_direction(camera, look)
    rays = camera.rays()
    canvas = _background(camera)
    _draw_floor(canvas, camera, rays, frame, look, low, high)
    floor = canvas.depth.copy()
    for depth, colour in trace_obstacles(
        look.scene.colliders,
        obstacle_poses(look.scene.colliders, frame),
        camera,
        rays,
        light,
        float(np.linalg.norm(high - low)),
    ):
        _merge(canvas, depth, colour)
    _draw_particles(canvas, floor, camera, rays, frame, look, light)
    if look.scene.domain is not None:
        _draw_box(canvas, camera, np.array(look.scene.domain.min), np.array(look.scene.domain.max))
    image = Image.fromarray(np.clip(canvas.colour, 0, 255).astype(np.uint8))
    return image.resize((camera.width // OVERSAMPLING, camera.height // OVERSAMPLING), Image.Resampling.BOX)


def _bounds(frame: Frame, look: Look) -> tuple[np.ndarray, np.ndarray]:
    domain = look.scene.domain
    if domain is not None:
        return np.array(domain.min), np.array(domain.max)
    if len(frame.positions) == 0:
        return np.zeros(3), np.ones(3)
    low, high = np.percentile(frame.positions, [0.5, 99.5], axis=0)
    return low - 2 * look.scene.cell_size, high + 2 * look.scene.cell_size


def _light_direction(camera: Camera, look: Look) -> np.ndarray:
    light = _LIGHT[0] * camera.right + _LIGHT[1] * scene_up(look.scene) - _LIGHT[2] * camera.forward
    return (light / np.linalg.norm(light)).astype(np.float32)


def _background(camera: Camera) -> _Canvas:
    shape = (camera.height, camera.width)
    colour = np.empty((*shape, 3), dtype=np.float32)
    colour[:] = (
        np.array(BACKGROUND, dtype=np.float32) * np.linspace(0.93, 1.0, camera.height, dtype=np.float32)[:, None, None]
    )
    return _Canvas(np.full(shape, np.inf, dtype=np.float32), colour)


def _merge(canvas: _Canvas, depth: np.ndarray, colour: np.ndarray) -> None:
    nearer = depth < canvas.depth
    canvas.depth[nearer] = depth[nearer]
    canvas.colour[nearer] = colour[nearer]


def _draw_floor(
    canvas: _Canvas, camera: Camera, rays: np.ndarray, frame: Frame, look: Look, low: np.ndarray, high: np.ndarray
) -> None:
    """A tiled rectangle under the scene, darkened where particles stand above it."""
    vertical = int(np.argmax(np.abs(scene_up(look.scene))))
    level = low[vertical] if scene_up(look.scene)[vertical] > 0 else high[vertical]
    flat = [axis for axis in range(3) if axis != vertical]
    slope = rays[..., vertical]
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = np.where(slope != 0, (level - camera.eye[vertical]) / slope, np.inf)
        hit = [camera.eye[axis] + depth * rays[..., axis] for axis in flat]
        inside = depth > 0
        for axis, place in zip(flat, hit):
            inside &= (place >= low[axis]) & (place <= high[axis])
    rows, columns = np.nonzero(inside)
    places = np.stack([place[rows, columns] for place in hit], axis=1)
    tile = 4 * look.scene.cell_size
    parity = np.floor((places - low[flat]) / tile).astype(int).sum(axis=1) % 2
    shade = _shadow(places, frame, low[flat], high[flat], flat, look.scene.cell_size)
    canvas.depth[rows, columns] = depth[rows, columns]
    canvas.colour[rows, columns] = _FLOOR_COLOURS[parity] * shade[:, None]


def _shadow(
    places: np.ndarray, frame: Frame, low: np.ndarray, high: np.ndarray, flat: list[int], cell: float
) -> np.ndarray:
    """How bright the floor is at ``places``: particles above a cell darken it, softly."""
    counts = np.maximum(1, np.ceil((high - low) / cell)).astype(int)
    map_, _ = np.histogramdd(frame.positions[:, flat], bins=counts, range=list(zip(low, high)))
    cover = np.minimum(1.0, map_ / 4.0)
    for axis in (0, 1):
        padded = np.pad(cover, [(1, 1) if a == axis else (0, 0) for a in (0, 1)], mode="edge")
        cover = (
            0.25 * np.take(padded, range(0, counts[axis]), axis)
            + 0.5 * cover
            + 0.25 * np.take(padded, range(2, counts[axis] + 2), axis)
        )
    index = np.clip(((places - low) / (high - low) * counts).astype(int), 0, counts - 1)
    return 1.0 - 0.35 * cover[index[:, 0], index[:, 1]]


def _draw_particles(
    canvas: _Canvas, floor: np.ndarray, camera: Camera, rays: np.ndarray, frame: Frame, look: Look, light: np.ndarray
) -> None:
    """Matter behind an obstacle shines through it, as through frosted glass: a glass made of boxes would hide its water."""
    diameter = look.particle_diameter * _SPHERE_GROWTH
    depth, owner = _splat(camera, frame.positions, 0.5 * diameter)
    seen = owner >= 0
    if not seen.any():
        return
    smooth = _smooth_depth(depth, seen, diameter, camera)
    colour = particle_colours(frame, look)[np.maximum(owner, 0)]
    lit = _light(colour, smooth, seen, camera, rays, light, diameter)
    behind = seen & (smooth >= canvas.depth) & (smooth < floor)
    canvas.colour[behind] += _SHINES_THROUGH * (lit[behind] - canvas.colour[behind])
    _merge(canvas, np.where(seen, smooth, np.inf), lit)


def _splat(camera: Camera, positions: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Depth of the nearest sphere at each pixel, and the row of its particle (-1: none)."""
    column, row, depth = camera.project(positions)
    depth_map = np.full(camera.height * camera.width, np.inf, dtype=np.float32)
    owner = np.full(camera.height * camera.width, -1, dtype=np.int32)
    order = np.argsort(-depth)
    order = order[depth[order] > 2 * radius]
    column, row, depth = column[order], row[order], depth[order].astype(np.float32)
    pixel_radius = np.clip(camera.focal * radius / depth, 1.0, _MAX_REACH)
    reach = int(np.ceil(pixel_radius.max())) if len(order) else 0
    x0, y0 = np.floor(column).astype(np.int64), np.floor(row).astype(np.int64)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            height2 = 1.0 - (dx * dx + dy * dy) / (pixel_radius * pixel_radius)
            x, y = x0 + dx, y0 + dy
            use = np.nonzero((height2 > 0) & (x >= 0) & (x < camera.width) & (y >= 0) & (y < camera.height))[0]
            near = depth[use] - radius * np.sqrt(height2[use]).astype(np.float32)
            pixel = y[use] * camera.width + x[use]
            _write_nearest(depth_map, owner, pixel, near, order[use])
    shape = (camera.height, camera.width)
    return depth_map.reshape(shape), owner.reshape(shape)


def _write_nearest(
    depth_map: np.ndarray, owner: np.ndarray, pixel: np.ndarray, near: np.ndarray, rows: np.ndarray
) -> None:
    """Writes where nearer than what is there. Entries come from far to near, and the last assignment wins."""
    wins = near < depth_map[pixel]
    depth_map[pixel[wins]] = near[wins]
    owner[pixel[wins]] = rows[wins]


def _smooth_depth(depth: np.ndarray, seen: np.ndarray, diameter: float, camera: Camera) -> np.ndarray:
    """Averages depth along rows and columns with neighbours on the same surface."""
    reach = int(np.clip(0.5 * camera.focal * diameter / float(np.median(depth[seen])), 1, 8))
    result = np.where(seen, depth, np.float32(1e9))
    for _ in range(_SMOOTH_ROUNDS):
        for axis in (0, 1):
            result = _smooth_axis(result, axis, reach, np.float32(_SAME_SURFACE * diameter))
    return np.where(seen, result, np.inf)


def _smooth_axis(depth: np.ndarray, axis: int, reach: int, step: np.float32) -> np.ndarray:
    total, count = depth.copy(), np.ones_like(depth)
    for offset in range(1, reach + 1):
        for here, there in _shifted(axis, offset):
            near = np.abs(depth[there] - depth[here]) < step
            total[here] += np.where(near, depth[there], 0)
            count[here] += near
    return total / count


def _shifted(axis: int, offset: int):
    """Pairs of slices: pixels and their neighbours at +offset and -offset along an axis."""
    first, second = slice(None, -offset), slice(offset, None)
    pair = ((first, slice(None)), (second, slice(None))) if axis == 0 else ((slice(None), first), (slice(None), second))
    return pair, pair[::-1]


def _light(colour, depth, seen, camera: Camera, rays, light, diameter: float) -> np.ndarray:
    """Diffuse and specular light, and darker creases."""
    finite = np.where(seen, depth, 0.0).astype(np.float32)
    normal = _normals(rays * finite[..., None], finite, camera)
    diffuse = np.clip(normal @ light, 0.0, 1.0)
    view = -rays / np.linalg.norm(rays, axis=2, keepdims=True)
    half = view + light
    half /= np.linalg.norm(half, axis=2, keepdims=True)
    shine = np.clip(np.einsum("ijk,ijk->ij", normal, half), 0.0, 1.0) ** 40
    brightness = (0.45 + 0.62 * diffuse)[..., None]
    return colour * brightness + 70.0 * shine[..., None]


def _normals(points: np.ndarray, depth: np.ndarray, camera: Camera) -> np.ndarray:
    """Unit normals towards the viewer from the nearer of the two neighbours along each axis."""
    across = _nearer_difference(points, depth, 1)
    down = _nearer_difference(points, depth, 0)
    normal = np.cross(down, across)
    normal /= np.maximum(np.linalg.norm(normal, axis=2, keepdims=True), 1e-20)
    facing = normal @ camera.forward.astype(np.float32)
    return np.where(facing[..., None] > 0, -normal, normal)


def _nearer_difference(points: np.ndarray, depth: np.ndarray, axis: int) -> np.ndarray:
    ahead = np.roll(points, -1, axis) - points
    behind = points - np.roll(points, 1, axis)
    step_ahead = np.abs(np.roll(depth, -1, axis) - depth)
    step_behind = np.abs(depth - np.roll(depth, 1, axis))
    return np.where((step_ahead < step_behind)[..., None], ahead, behind)


def _draw_box(canvas: _Canvas, camera: Camera, low: np.ndarray, high: np.ndarray) -> None:
    """The edges of the domain, hidden behind what stands before them."""
    corners = np.array(
        [[low[0] if i & 1 else high[0], low[1] if i & 2 else high[1], low[2] if i & 4 else high[2]] for i in range(8)]
    )
    share = np.linspace(0.0, 1.0, 2 * camera.width)[:, None]
    for i in range(8):
        for bit in (1, 2, 4):
            if i & bit:
                continue
            points = corners[i] + share * (corners[i | bit] - corners[i])
            column, row, depth = camera.project(points)
            for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
                x, y = np.floor(column).astype(int) + dx, np.floor(row).astype(int) + dy
                use = (depth > 0) & (x >= 0) & (x < camera.width) & (y >= 0) & (y < camera.height)
                x, y, near = x[use], y[use], depth[use]
                front = near <= canvas.depth[y, x] * 1.001
                canvas.colour[y[front], x[front]] = INK
