"""Surfaces as files that Blender, Houdini and game engines read: positions, normals, a colour per material, triangles; PLY has velocities, too."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import pbmpm

from .files import replace_when_complete

#: Of a PLY file: position, normal, velocity [m/s], colour, and the row in the list of materials.
_VERTEX = [(name, "<f4") for name in ("x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz")]
_VERTEX += [(name, "u1") for name in ("red", "green", "blue", "alpha", "material")]


#: What `write_mesh` writes.
MESH_FORMATS = ("ply", "obj", "glb")


def write_mesh(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray, time: float, path: Path) -> None:
    """One surface per material of the scene, in their order; ``colours`` has one for each, from 0 to 255. The suffix of ``path`` is one of `MESH_FORMATS`."""
    {".ply": _write_ply, ".obj": _write_obj, ".glb": _write_glb}[path.suffix](meshes, colours, time, path)


def _write_glb(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray, _time: float, path: Path) -> None:
    """An object for each material that has a surface, named material_ROW. GLB's axes are those of scenes whose y points up."""
    from trimesh import Scene
    from trimesh.exchange.gltf import export_glb

    scene = Scene()
    for row, mesh in enumerate(meshes):
        if len(mesh.triangles):
            scene.add_geometry(_joined([mesh], colours[row:]), geom_name=f"material_{row}")
    with replace_when_complete(path) as temporary:
        temporary.write_bytes(export_glb(scene, include_normals=True))


def _write_obj(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray, _time: float, path: Path) -> None:
    """All surfaces are one object: of several, trimesh forgets the normals."""
    from trimesh.exchange.obj import export_obj

    some = any(len(mesh.triangles) for mesh in meshes)
    with replace_when_complete(path) as temporary:
        temporary.write_text(export_obj(_joined(meshes, colours), include_normals=True) if some else "# no surface\n")


def _joined(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray) -> Any:
    from trimesh import Trimesh

    shades = [np.tile(np.uint8([*colour, 255]), (len(mesh.positions), 1)) for mesh, colour in zip(meshes, colours)]
    positions, normals = (np.concatenate([getattr(mesh, name) for mesh in meshes]) for name in ("positions", "normals"))
    return Trimesh(positions, _faces(meshes), vertex_normals=normals, vertex_colors=np.concatenate(shades), process=False, validate=False)


def _faces(meshes: Sequence[pbmpm.Mesh]) -> np.ndarray:
    first = np.cumsum([0, *(len(mesh.positions) for mesh in meshes)])
    return np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, first)])


def _write_ply(meshes: Sequence[pbmpm.Mesh], colours: np.ndarray, time: float, path: Path) -> None:
    """Binary, little-endian."""
    from plyfile import PlyData, PlyElement

    vertices = np.concatenate([_vertices(mesh, row, colours[row]) for row, mesh in enumerate(meshes)])
    faces = np.empty(sum(len(mesh.triangles) for mesh in meshes), dtype=[("vertex_indices", "<i4", (3,))])
    faces["vertex_indices"] = _faces(meshes)
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
