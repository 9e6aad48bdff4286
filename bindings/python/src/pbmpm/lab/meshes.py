"""Surfaces as PLY files that Blender and Houdini read: positions, normals, velocities, a colour per material, triangles."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import pbmpm

from .files import replace_when_complete

#: Of a PLY file: position, normal, velocity [m/s], colour, and the row in the list of materials.
_VERTEX = [(name, "<f4") for name in ("x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz")]
_VERTEX += [(name, "u1") for name in ("red", "green", "blue", "alpha", "material")]


def write_mesh(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray, time: float, path: Path) -> None:
    """A binary little-endian PLY of one surface per material of the scene, in their order; ``colours`` has one for each, from 0 to 255."""
    from plyfile import PlyData, PlyElement

    vertices = np.concatenate([_vertices(mesh, row, colours[row]) for row, mesh in enumerate(meshes)])
    first = np.cumsum([0, *(len(mesh.positions) for mesh in meshes)])
    faces = np.empty(sum(len(mesh.triangles) for mesh in meshes), dtype=[("vertex_indices", "<i4", (3,))])
    faces["vertex_indices"] = np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, first)])
    data = PlyData([PlyElement.describe(vertices, "vertex"), PlyElement.describe(faces, "face")], byte_order="<", comments=[f"time {time:.9g} s"])
    with replace_when_complete(path) as temporary:
        data.write(str(temporary))


def _vertices(mesh: pbmpm.Mesh, row: int, colour: np.ndarray) -> np.ndarray:
    table = np.empty(len(mesh.positions), dtype=_VERTEX)
    for names, values in (("xyz", mesh.positions), (("nx", "ny", "nz"), mesh.normals), (("vx", "vy", "vz"), mesh.velocities)):
        for axis, name in enumerate(names):
            table[name] = values[:, axis]
    for name, value in zip(("red", "green", "blue", "alpha"), (*colour, 255)):
        table[name] = value
    table["material"] = row
    return table
