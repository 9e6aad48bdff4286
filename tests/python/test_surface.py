"""Surfaces and points through the library, and the files that `pbmpm run --mesh` writes."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import plyfile
import pytest

import pbmpm
from pbmpm.lab.commands.cli import cli
from pbmpm.lab.meshes import write_mesh


def open_edges(mesh: pbmpm.Mesh) -> int:
    """Edges that do not have two triangles, one in each direction."""
    corners = mesh.triangles.astype(np.int64)
    ways = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    there, back = (np.unique(a * len(mesh.positions) + b, return_counts=True) for a, b in (ways.T, ways.T[::-1]))
    return int((there[1] != 1).sum()) + len(np.setxor1d(there[0], back[0]))


@pytest.fixture
def world():
    with pbmpm.World(3, 0.1, capacity=10_000, gravity=(0, -9.81, 0)) as it:
        yield it


def test_a_ball(world: pbmpm.World) -> None:
    water = world.add_material(pbmpm.Liquid(density=1000))
    world.fill(pbmpm.Sphere((0.01, 0.02, 0.03), 0.5), water, velocity=(1, 2, 3))
    mesh = world.surface(velocities=True)
    assert open_edges(mesh) == 0
    assert mesh.volume == pytest.approx(4 / 3 * math.pi * 0.5**3, rel=0.02)
    assert mesh.area == pytest.approx(4 * math.pi * 0.5**2, rel=0.02)
    outward = mesh.positions - np.float32((0.01, 0.02, 0.03))
    assert (np.einsum("ij,ij->i", outward, mesh.normals) > 0.4).all()
    assert mesh.velocities == pytest.approx(np.tile((1, 2, 3), (len(mesh.positions), 1)), abs=1e-5)
    assert mesh.weights is None
    coarse = world.surface(subdivision=1, narrow=True)
    assert coarse.triangles.dtype == np.uint16 and 3 < len(mesh.triangles) / len(coarse.triangles) < 5
    assert world.surface(level=0.2).volume > mesh.volume > world.surface(level=0.8).volume


def test_materials(world: pbmpm.World) -> None:
    water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic())
    world.fill(pbmpm.Box((0, 0, 0), (0.3, 0.3, 0.3)), water)
    world.fill(pbmpm.Box((2, 0, 0), (0.3, 0.3, 0.3)), jelly)
    both = world.surface([jelly, water], weights=True)
    assert both.weights.shape == (len(both.positions), 2)
    assert (both.weights[:, 0] == (both.positions[:, 0] > 1)).all()
    assert world.surface([jelly]).positions[:, 0].min() > 1.5
    with pytest.raises(pbmpm.InvalidArgumentError, match="weights"):
        world.surface(weights=True)
    with pytest.raises(pbmpm.InvalidArgumentError, match="twice"):
        world.surface([jelly, jelly])
    with pytest.raises(TypeError, match="a Material is needed"):
        world.surface([0])  # type: ignore[list-item]


def test_points(world: pbmpm.World) -> None:
    water, jelly = world.add_material(pbmpm.Liquid(density=1000)), world.add_material(pbmpm.Elastic())
    world.fill(pbmpm.Box((0, 0, 0), (0.2, 0.2, 0.2)), water)
    points = world.surface_points()
    assert (points["position"] == world.positions.array()).all() and (points["colour"] == 255).all()
    assert (4 / 3 * math.pi * points["radius"].astype(float) ** 3).sum() == pytest.approx(world.stats.mass / 1000)
    world.fill(pbmpm.Box((2, 0, 0), (0.2, 0.2, 0.2)), jelly)
    coloured = world.surface_points(palette={jelly: (1, 2, 3, 4), water: (5, 6, 7, 8)})
    assert (coloured["colour"] == np.where(coloured["position"][:, :1] > 1, (1, 2, 3, 4), (5, 6, 7, 8))).all()
    assert len(world.surface_points([jelly])) == len(world) - len(points)
    world.fill(pbmpm.Box((5, 0, 0), (0.025, 0.025, 0.025)), water)
    spray = world.surface_points(spray_only=True)
    assert (spray["position"][:, 0] > 4.9).sum() == 1


def test_flat_worlds_have_points_but_no_surface() -> None:
    with pbmpm.World(2, 0.1, capacity=1000) as world:
        world.fill(pbmpm.Box((0, 0), (0.2, 0.2)), world.add_material(pbmpm.Liquid()))
        assert len(world.surface_points()) == len(world)
        with pytest.raises(pbmpm.UnsupportedError, match="in 3D"):
            world.surface()


def test_an_empty_world(world: pbmpm.World) -> None:
    mesh = world.surface(velocities=True)
    assert mesh.positions.shape == mesh.normals.shape == (0, 3) and mesh.triangles.shape == (0, 3) and mesh.volume == 0
    assert len(world.surface_points()) == 0


def test_mesh_files(world: pbmpm.World, tmp_path: Path) -> None:
    water, jelly = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic())
    world.fill(pbmpm.Box((0, 0, 0), (0.3, 0.3, 0.3)), water, velocity=(1, 2, 3))
    world.fill(pbmpm.Box((2, 0, 0), (0.3, 0.3, 0.3)), jelly)
    meshes = [world.surface([material], velocities=True) for material in (water, jelly)]
    write_mesh(meshes, np.float32([[10, 20, 30], [40, 50, 60]]), 0.25, tmp_path / "a.ply")
    data = plyfile.PlyData.read(str(tmp_path / "a.ply"))
    vertices, faces = data["vertex"].data, np.stack(data["face"].data["vertex_indices"])
    assert len(vertices) == sum(len(mesh.positions) for mesh in meshes) and data.comments == ["time 0.25 s"]
    assert faces.max() == len(vertices) - 1 and len(faces) == sum(len(mesh.triangles) for mesh in meshes)
    right = vertices["x"] > 1
    assert (vertices["red"] == np.where(right, 40, 10)).all() and (vertices["material"] == right).all()
    assert (right[faces].min(axis=1) == right[faces].max(axis=1)).all()
    assert vertices["vy"][~right] == pytest.approx(2, abs=1e-5)
    assert np.hypot(np.hypot(vertices["nx"], vertices["ny"]), vertices["nz"]) == pytest.approx(1, abs=1e-5)


@pytest.fixture
def three(world: pbmpm.World) -> list[pbmpm.Mesh]:
    """Surfaces of three materials, the second of which has no matter."""
    materials = [world.add_material(it) for it in (pbmpm.Liquid(), pbmpm.Elastic(), pbmpm.Elastic())]
    for material, x in ((materials[0], 0), (materials[2], 2)):
        world.fill(pbmpm.Box((x, 0, 0), (0.3, 0.3, 0.3)), material)
    return [world.surface([material]) for material in materials]


COLOURS = np.float32([[10, 20, 30], [0, 0, 0], [40, 50, 60]])


def test_mesh_files_for_engines(three: list[pbmpm.Mesh], tmp_path: Path) -> None:
    import trimesh

    write_mesh(three, COLOURS, 0, tmp_path / "a.glb")
    objects = trimesh.load_scene(tmp_path / "a.glb", process=False).geometry
    assert set(objects) == {"material_0", "material_2"}
    for row in (0, 2):
        it, mesh = objects[f"material_{row}"], three[row]
        assert it.is_watertight and (it.faces == mesh.triangles).all() and (it.visual.vertex_colors[:, :3] == COLOURS[row]).all()
        assert np.allclose(it.vertices, mesh.positions, atol=1e-6) and np.allclose(it.vertex_normals, mesh.normals, atol=1e-6)


def test_mesh_files_of_text(three: list[pbmpm.Mesh], tmp_path: Path) -> None:
    write_mesh(three, COLOURS, 0, tmp_path / "a.obj")
    lines = [line.split() for line in (tmp_path / "a.obj").read_text().splitlines() if line]
    vertices, normals = (np.float32([line[1:4] for line in lines if line[0] == key]) for key in ("v", "vn"))
    faces = np.int64([[corner.split("/")[0] for corner in line[1:]] for line in lines if line[0] == "f"])
    shades = np.float32([line[4:7] for line in lines if line[0] == "v"])
    assert np.allclose(255 * shades, np.repeat(COLOURS, [len(it.positions) for it in three], axis=0), atol=0.01)
    assert np.allclose(vertices, np.concatenate([it.positions for it in three]), atol=1e-6)
    assert np.allclose(normals, np.concatenate([it.normals for it in three]), atol=1e-6)
    assert (faces == np.concatenate([three[0].triangles, three[2].triangles + len(three[0].positions)]) + 1).all()


@pytest.mark.parametrize("kind", ["ply", "obj", "glb"])
def test_mesh_files_of_nothing(world: pbmpm.World, tmp_path: Path, kind: str) -> None:
    write_mesh([world.surface([world.add_material(pbmpm.Liquid())], velocities=True)], np.float32([[10, 20, 30]]), 0, tmp_path / f"a.{kind}")
    assert (tmp_path / f"a.{kind}").stat().st_size > 0


def test_the_command_writes_the_format(tmp_path: Path) -> None:
    from click.testing import CliRunner

    scene = Path(__file__).resolve().parents[2] / "samples/scenes/glass_jelly_3d.json"
    result = CliRunner().invoke(cli, ["run", str(scene), "--mesh-format", "glb", "--seconds", "0.03", "--pictures", "", "--output", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    assert len(list((tmp_path / "out").glob("*_mesh.glb"))) == 2 and not list((tmp_path / "out").glob("*.ply"))


def test_flat_scenes_have_no_mesh_files() -> None:
    from click.testing import CliRunner

    scene = Path(__file__).resolve().parents[2] / "samples/scenes/boat_2d.json"
    result = CliRunner().invoke(cli, ["run", str(scene), "--mesh"])
    assert result.exit_code != 0 and "in 3D" in str(result.exception)


def among_boxes(seed: int, cells: tuple[int, int, int], subdivision: int) -> np.ndarray:
    """The vertices of scattered matter among small boxes; all is moved by whole cells, and the vertices are moved back. All places are exact in 32 bits."""
    random, cell, fine = np.random.default_rng(seed), 0.125, 4096
    middles, halves = random.uniform(-0.9, 0.9, (25, 3)).astype(np.float32), random.uniform(0.02, 0.15, (25, 3)).astype(np.float32)
    places, way = np.floor(random.uniform(-0.9, 0.9, (11000, 3)) * fine) / fine, np.array(cells) * cell
    with pbmpm.World(3, cell, capacity=len(places), threads=1) as world:
        for middle, half in zip(middles, halves, strict=True):
            world.add_collider(pbmpm.Box((np.floor(middle * fine) / fine + way).tolist(), half.tolist()))
        world.add_particles(world.add_material(pbmpm.Liquid()), places + way)
        return world.surface(subdivision=subdivision, keeps_thin=False).positions.astype(float) - way


@pytest.mark.parametrize(("seed", "subdivision"), [(36, 2), (50, 2), (179, 2), (148, 1)])
def test_obstacles_are_seen_from_every_block(seed: int, subdivision: int) -> None:
    """The surface does not tell where blocks begin: they see what hides a mirror image, and what is near their corners. With less reach vertices were off by up to 3 mm."""
    expected = among_boxes(seed, (0, 0, 0), subdivision)
    for cells in ((3, 1, 2), (1, 2, 3), (-13, -2, -1)):
        found = among_boxes(seed, cells, subdivision)
        assert len(found) == len(expected)
        assert np.sort(found.sum(axis=1)) == pytest.approx(np.sort(expected.sum(axis=1)), abs=1e-5)
