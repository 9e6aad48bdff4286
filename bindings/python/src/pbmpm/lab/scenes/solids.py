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


def cache_folder() -> Path:
    """Where baked solids are kept: `pbmpm/solids` in XDG_CACHE_HOME, or in ~/.cache."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "pbmpm" / "solids"


def baked_solid(part: MeshPart | HeightsPart, dimension: int) -> pbmpm.BakedSolid:
    """Bakes what a part describes, or finds it baked. InputError says what is wrong with it."""
    return _bake(part.model_dump_json(), isinstance(part, MeshPart), dimension)


@lru_cache(maxsize=64)
def _bake(text: str, is_mesh: bool, dimension: int) -> pbmpm.BakedSolid:
    part = MeshPart.model_validate_json(text) if is_mesh else HeightsPart.model_validate_json(text)
    what = (part.file if isinstance(part, MeshPart) else None) or part.kind
    try:
        solid = _bake_mesh(part, dimension) if isinstance(part, MeshPart) else _bake_heights(part)
    except pbmpm.PbmpmError as problem:
        raise InputError(f"{what}: {problem}") from None
    if solid.info.dimension != dimension:
        raise InputError(f"{what}: is for {solid.info.dimension} dimensions, the scene has {dimension}")
    return solid


def _bake_mesh(part: MeshPart, dimension: int) -> pbmpm.BakedSolid:
    if part.file is not None and part.file.endswith(".sdf"):
        return pbmpm.BakedSolid.load(part.file)
    vertices, elements = _read_mesh(part.file, dimension) if part.file else (part.vertices, part.elements)
    if part.hull:
        return pbmpm.bake_hull(np.array(vertices), resolution=part.resolution, cache=cache_folder())
    return pbmpm.bake_mesh(np.array(vertices), np.array(elements), resolution=part.resolution, cache=cache_folder())


def _bake_heights(part: HeightsPart) -> pbmpm.BakedSolid:
    return pbmpm.bake_heights(
        np.array(part.heights),
        part.spacing,
        up=part.up,
        thickness=part.thickness,
        resolution=part.resolution,
        cache=cache_folder(),
    )


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
