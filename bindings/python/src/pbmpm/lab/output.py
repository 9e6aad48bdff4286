"""Particle files: PLY and VTK sequences with an index for ParaView, and a JSON sidecar (NAME_run.json) about them.

Each file appears under its name only when it is complete. The sidecar is written when the run starts and again after
every frame, so that it always lists exactly the files that are there and says how the run ended.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

import pbmpm

from .files import replace_when_complete, write_json
from .frame import Frame
from .meshes import write_mesh

UNITS = {
    "position": "m",
    "velocity": "m/s",
    "volume_ratio": "1 (volume over rest volume, J)",
    "material": "row in the list of materials",
    "radius": "m, of a ball (2D: a disc) of the particle's volume",
    "red, green, blue, alpha": "0 to 255, of the material",
    "id, generation": "identity of a particle, the same in all files",
}


class Sequence:
    """Writes the frames of one run into a folder and keeps the index and the sidecar up to date."""

    def __init__(self, folder: Path, name: str, facts: dict[str, Any], ply: bool, vtk: bool, colours: np.ndarray | None = None, mesh: str = "ply") -> None:
        """``mesh`` is the format of surfaces, see `meshes.MESH_FORMATS`. ``facts`` is the part of the sidecar that does not change: scene, settings, versions, machine. ``colours`` has one per material, from 0 to 255."""
        self.folder, self.name = folder, name
        self.ply, self.vtk, self._colours, self._mesh = ply, vtk, colours, mesh
        self._sidecar = {"status": "running", "units": UNITS, **facts, "frames": [], "pictures": []}
        folder.mkdir(parents=True, exist_ok=True)
        self.write_sidecar()

    def add_frame(self, frame: Frame, meshes: list[pbmpm.Mesh] | None = None) -> None:
        """Writes the particle files that were asked for, and a file of the surfaces of all materials, if they are given."""
        stem = f"{self.name}_{len(self._sidecar['frames']):05d}"
        entry: dict[str, Any] = {"time": frame.time, "step": frame.step, "particles": len(frame.positions)}
        if self.ply:
            entry["ply"] = f"{stem}.ply"
            write_ply(frame, self.folder / entry["ply"], self._colours)
        if self.vtk:
            entry["vtk"] = f"{stem}.vtu"
            write_vtu(frame, self.folder / entry["vtk"])
        if meshes is not None:
            entry["mesh"] = f"{stem}_mesh.{self._mesh}"
            write_mesh(meshes, self._colours, frame.time, self.folder / entry["mesh"])
        self._sidecar["frames"].append(entry)
        if self.vtk:
            frames = [(item["time"], item["vtk"]) for item in self._sidecar["frames"]]
            write_pvd(frames, self.folder / f"{self.name}.pvd")
        self.write_sidecar()

    def add_picture(self, time: float, file_name: str) -> None:
        """Notes a picture that has been written into the folder."""
        self._sidecar["pictures"].append({"time": time, "png": file_name})
        self.write_sidecar()

    def finish(self, status: str, report: dict[str, Any]) -> None:
        """Marks the run as ``complete``, ``interrupted`` or ``failed`` and adds its figures."""
        self._sidecar["status"] = status
        self._sidecar["report"] = report
        self.write_sidecar()

    def write_sidecar(self) -> None:
        """Writes the sidecar as it stands."""
        write_json(self._sidecar, self.folder / f"{self.name}_run.json")


def points_3d(values: np.ndarray) -> np.ndarray:
    """(n, d) to (n, 3); 2D gets a third component of 0."""
    result = np.zeros((len(values), 3), dtype=np.float32)
    result[:, : values.shape[1]] = values
    return result


def write_ply(frame: Frame, path: Path, colours: np.ndarray | None = None) -> None:
    """A binary little-endian PLY with one vertex per particle; with the colour of its material, if ``colours`` has them."""
    from plyfile import PlyData, PlyElement

    position, velocity = points_3d(frame.positions), points_3d(frame.velocities)
    columns = {
        "x": position[:, 0],
        "y": position[:, 1],
        "z": position[:, 2],
        "vx": velocity[:, 0],
        "vy": velocity[:, 1],
        "vz": velocity[:, 2],
        "volume_ratio": frame.volume_ratios.astype(np.float32),
        "material": frame.materials.astype(np.uint8),
        "id": frame.ids[:, 0].astype(np.uint32),
        "generation": frame.ids[:, 1].astype(np.uint32),
    }
    if frame.radii is not None:
        columns["radius"] = frame.radii
    if colours is not None:
        shade = np.column_stack([colours[frame.materials], np.full(len(position), 255)]).astype(np.uint8)
        columns |= {name: shade[:, i] for i, name in enumerate(("red", "green", "blue", "alpha"))}
    table = np.empty(len(position), dtype=[(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    data = PlyData([PlyElement.describe(table, "vertex")], byte_order="<", comments=[f"time {frame.time:.9g} s"])
    with replace_when_complete(path) as temporary:
        data.write(str(temporary))


def write_vtu(frame: Frame, path: Path) -> None:
    """A binary VTK unstructured grid with one vertex cell per particle."""
    import meshio

    cells = np.arange(len(frame.positions), dtype=np.int64)[:, None]
    data = {
        "velocity": points_3d(frame.velocities),
        "volume_ratio": frame.volume_ratios.astype(np.float32),
        "material": frame.materials.astype(np.int32),
        "id": frame.ids[:, 0].astype(np.int64),
        "generation": frame.ids[:, 1].astype(np.int64),
    }
    mesh = meshio.Mesh(points_3d(frame.positions), [("vertex", cells)], point_data=data)
    with replace_when_complete(path) as temporary:
        meshio.vtu.write(str(temporary), mesh, compression=None)


def write_pvd(frames: list[tuple[float, str]], path: Path) -> None:
    """ParaView's index of a sequence: time and file of each frame."""
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = ElementTree.SubElement(root, "Collection")
    for time, file_name in frames:
        ElementTree.SubElement(collection, "DataSet", timestep=f"{time:.9g}", part="0", file=file_name)
    with replace_when_complete(path) as temporary:
        ElementTree.ElementTree(root).write(temporary, encoding="utf-8", xml_declaration=True)
