"""Meshes and heights of a scene: read, baked once, and kept in the user's cache."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import numpy as np

import pbmpm

from ..errors import InputError
from ..hints import file_like
from .scene import HeightsPart, MeshPart

_MESH_CELLS = 64  # along the longest side of a mesh, at least: its features
_MOST_VALUES = 2**24  # of one grid; they take 64 MB


def cache_folder() -> Path:
    """Where baked solids are kept: `pbmpm/solids` in XDG_CACHE_HOME, or in ~/.cache."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "pbmpm" / "solids"


def baked_solid(part: MeshPart | HeightsPart, dimension: int) -> pbmpm.BakedSolid:
    """Bakes what a part describes, or finds it baked. InputError says what is wrong with it."""
    return _bake(part.model_dump_json(), part.cell_size, isinstance(part, MeshPart), dimension)


@lru_cache(maxsize=64)
def _bake(text: str, cell_size: float | None, is_mesh: bool, dimension: int) -> pbmpm.BakedSolid:
    part = MeshPart.model_validate_json(text) if is_mesh else HeightsPart.model_validate_json(text)
    what = (part.file if isinstance(part, MeshPart) else None) or part.kind
    try:
        solid = _bake_mesh(part, cell_size, dimension) if isinstance(part, MeshPart) else _bake_heights(part, cell_size)
    except pbmpm.PbmpmError as problem:
        raise InputError(f"{what}: {problem}") from None
    if solid.info.dimension != dimension:
        raise InputError(f"{what}: is for {solid.info.dimension} dimensions, the scene has {dimension}")
    return solid


def _bake_mesh(part: MeshPart, cell_size: float | None, dimension: int) -> pbmpm.BakedSolid:
    if part.file is not None and part.file.endswith(".sdf"):
        return pbmpm.BakedSolid.load(part.file)
    vertices, elements = _read_mesh(part.file, dimension) if part.file else (part.vertices, part.elements)
    place = np.array(vertices, dtype=np.float64)
    resolution = part.resolution or _resolution(np.ptp(place, axis=0), cell_size, np.ptp(place, axis=0).max() / _MESH_CELLS)
    if part.hull:
        return pbmpm.bake_hull(place, resolution=resolution, cache=cache_folder())
    return pbmpm.bake_mesh(place, np.array(elements), resolution=resolution, cache=cache_folder())


def _bake_heights(part: HeightsPart, cell_size: float | None) -> pbmpm.BakedSolid:
    heights = np.array(part.heights)
    sides = [*((count - 1) * part.spacing for count in heights.shape), np.ptp(heights) + part.thickness]
    return pbmpm.bake_heights(
        heights,
        part.spacing,
        up=part.up,
        thickness=part.thickness,
        resolution=part.resolution or _resolution(np.array(sides), cell_size, part.spacing),
        cache=cache_folder(),
    )


def _resolution(sides: np.ndarray, cell_size: float | None, spacing: float) -> int:
    """Grid cells along the longest side, no wider than `spacing` and the scene's own cells, as far as the grid does not grow too large. In
    coarser grids water beside an edge does not rest."""
    if not sides.max() > 0:
        return 4  # the baker says what is wrong
    smallest = (np.prod(np.maximum(sides, spacing)) / _MOST_VALUES) ** (1 / len(sides))
    width = max(min(spacing, cell_size or spacing), smallest)
    return int(np.clip(np.ceil(sides.max() / width - 1e-6), 4, 1024))


def _read_mesh(path: str, dimension: int) -> tuple[np.ndarray, np.ndarray]:
    """The triangles (2D: edges) of a file in a format that meshio knows (OBJ, STL, PLY, ...)."""
    import meshio

    if not Path(path).exists():  # of which meshio's words leave out the folder
        raise InputError(f"{path}: there is no such file{file_like(Path(path))}")
    try:
        mesh = meshio.read(path)
    except (OSError, meshio.ReadError, ValueError, SystemExit) as problem:
        raise InputError(f"{path}: cannot be read as a mesh: {problem}") from None
    kind = "triangle" if dimension == 3 else "line"
    elements = mesh.cells_dict.get(kind, np.empty((0, dimension), np.int64))
    if "quad" in mesh.cells_dict and dimension == 3:
        quads = mesh.cells_dict["quad"]
        elements = np.concatenate([elements, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    if len(elements) == 0:
        raise InputError(f"{path}: holds no {kind}s")
    return mesh.points[:, :dimension], elements


def distance_function(solid: pbmpm.BakedSolid) -> Callable[[np.ndarray], np.ndarray]:
    """The interpolated distance at points (n, d) [m]; beyond the grid no more than the true one."""
    info = solid.info
    low, spacing = np.array(info.minimum, dtype=np.float64), float(info.spacing)
    last = np.array(info.counts) - 1
    values = solid.distances

    def distance(points: np.ndarray) -> np.ndarray:
        cells = (points - low) / spacing
        inside = np.clip(cells, 0, last)
        first = np.minimum(inside.astype(np.int64), last - 1)
        share = inside - first
        outside = np.linalg.norm(cells - inside, axis=1)
        result = np.zeros(len(points))
        for corner in np.ndindex(*(2,) * len(last)):
            weight = np.prod(np.where(np.array(corner) == 1, share, 1 - share), axis=1)
            result += weight * values[tuple((first + corner).T)]
        return np.where(outside > 0, np.hypot(result, spacing * outside), result)

    return distance
