"""Particle files, sidecar and pictures, read back by the libraries that others would use."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import plyfile
import pytest
from PIL import Image

from pbmpm.lab.files import json_text, replace_when_complete, write_json
from pbmpm.lab.frame import Frame
from pbmpm.lab.output import Sequence
from pbmpm.lab.pictures.drawing import draw_picture
from pbmpm.lab.pictures.look import annotate, look_of, particle_colours
from pbmpm.lab.pictures.flat import draw_2d
from pbmpm.lab.pictures.traced import draw_3d
from pbmpm.lab.pictures.video import Video
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.scenes.scene import Scene


def make_frame(
    dimension: int, positions: np.ndarray | None = None, materials: np.ndarray | None = None, time: float = 0.5
) -> Frame:
    random = np.random.default_rng(3)
    if positions is None:
        positions = random.uniform(0.2, 0.8, (50, dimension))
    count = len(positions)
    return Frame(
        time,
        12,
        positions.astype(np.float32),
        random.normal(size=(count, dimension)).astype(np.float32),
        random.uniform(0.9, 1.1, count).astype(np.float32),
        np.zeros(count, np.uint8) if materials is None else materials.astype(np.uint8),
        np.stack([random.permutation(count), np.full(count, 7)], axis=1).astype(np.uint32),
    )


def make_scene(dimension: int, **fields: object) -> Scene:
    gravity = [0.0, -9.81, 0.0][:dimension]
    shape = {"kind": "box", "position": [0.5] * dimension, "half_extents": [0.1] * dimension}
    return parse_scene(
        {
            "format": "pbmpm-scene",
            "version": 1,
            "name": "test",
            "dimension": dimension,
            "cell_size": 0.05,
            "gravity": gravity,
            "seconds": 1,
            "domain": {"min": [0] * dimension, "max": [1] * dimension},
            "materials": {"water": {"kind": "liquid"}, "jelly": {"kind": "elastic"}},
            "fills": [{"shape": shape, "material": "water"}],
            "pictures": {"width": 320},
            **fields,
        }
    )


@pytest.mark.parametrize("dimension", [2, 3])
def test_ply_round_trip(tmp_path: Path, dimension: int) -> None:
    frame = make_frame(dimension)
    Sequence(tmp_path, "run", {}, ply=True, vtk=False).add_frame(frame)
    table = plyfile.PlyData.read(str(tmp_path / "run_00000.ply"))["vertex"].data
    for axis, name in enumerate("xyz"[:dimension]):
        assert np.array_equal(table[name], frame.positions[:, axis])
        assert np.array_equal(table["v" + name], frame.velocities[:, axis])
    if dimension == 2:
        assert not table["z"].any()
    assert np.array_equal(table["id"], frame.ids[:, 0])
    assert np.array_equal(table["generation"], frame.ids[:, 1])
    assert np.array_equal(table["volume_ratio"], frame.volume_ratios)


@pytest.mark.parametrize("dimension", [2, 3])
def test_vtk_round_trip_and_index(tmp_path: Path, dimension: int) -> None:
    frames = [make_frame(dimension, time=0.0), make_frame(dimension, time=0.25)]
    sequence = Sequence(tmp_path, "run", {}, ply=False, vtk=True)
    for frame in frames:
        sequence.add_frame(frame)
    mesh = meshio.read(str(tmp_path / "run_00001.vtu"))
    assert np.array_equal(mesh.points[:, :dimension].astype(np.float32), frames[1].positions)
    assert np.array_equal(mesh.point_data["id"], frames[1].ids[:, 0])
    assert mesh.cells_dict["vertex"].shape == (50, 1)
    entries = ElementTree.parse(tmp_path / "run.pvd").getroot().findall("Collection/DataSet")
    assert [(float(e.get("timestep")), e.get("file")) for e in entries] == [
        (0.0, "run_00000.vtu"),
        (0.25, "run_00001.vtu"),
    ]


def test_sidecar_lists_what_is_there_and_how_it_ended(tmp_path: Path) -> None:
    sequence = Sequence(tmp_path, "run", {"seeds": [5]}, ply=True, vtk=True)
    assert json.loads((tmp_path / "run_run.json").read_text())["status"] == "running"
    sequence.add_frame(make_frame(2))
    sequence.finish("interrupted", {"steps": 3})
    sidecar = json.loads((tmp_path / "run_run.json").read_text())
    assert sidecar["status"] == "interrupted"
    assert sidecar["seeds"] == [5] and sidecar["report"] == {"steps": 3}
    assert sidecar["units"]["position"] == "m"
    for entry in sidecar["frames"]:
        assert (tmp_path / entry["ply"]).is_file() and (tmp_path / entry["vtk"]).is_file()


def test_a_failed_write_leaves_the_old_file_and_no_rest(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    write_json({"a": 1}, path)
    with pytest.raises(RuntimeError), replace_when_complete(path) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert json.loads(path.read_text()) == {"a": 1}
    assert [item.name for item in tmp_path.iterdir()] == ["a.json"]


def test_numbers_that_are_not_finite_become_null() -> None:
    assert json.loads(json_text({"a": [float("nan"), 1.5], "b": float("inf")})) == {"a": [None, 1.5], "b": None}


def is_bluish(pixel: tuple[int, ...]) -> bool:
    return pixel[2] > pixel[0] + 40


def is_orange(pixel: tuple[int, ...]) -> bool:
    return pixel[0] > pixel[2] + 40


def pixel_at(image: Image.Image, x: float, y: float) -> tuple[int, ...]:
    """The pixel of a 2D picture that shows a place in the unit square: 2 % of margin, y up."""
    width, height = image.size
    margin = 0.02 / 1.04
    return image.getpixel((round(width * (margin + x / 1.04)), round(height * (1 - margin - y / 1.04))))


def test_2d_picture_shows_particles_at_their_place_with_y_up() -> None:
    scene = make_scene(2)
    still = make_frame(2, np.array([[0.25, 0.75], [0.75, 0.25]]), np.array([0, 1]))
    still.velocities[:] = 0
    image = draw_2d(still, look_of(scene, ""))
    assert is_bluish(pixel_at(image, 0.25, 0.75))
    assert is_orange(pixel_at(image, 0.75, 0.25))
    empty = pixel_at(image, 0.25, 0.25)
    assert not is_bluish(empty) and not is_orange(empty)


def test_2d_picture_shows_obstacles() -> None:
    kinds = [
        {"kind": "box", "position": [0.2, 0.2], "half_extents": [0.05, 0.05], "rotation": 0.5},
        {"kind": "sphere", "position": [0.5, 0.2], "radius": 0.05},
        {"kind": "capsule", "position": [0.8, 0.2], "half_length": 0.05, "radius": 0.03},
        {"kind": "plane", "position": [0, 0.05], "normal": [0, 1]},
    ]
    scene = make_scene(2, colliders=[{"shape": kind} for kind in kinds])
    image = draw_2d(make_frame(2, np.array([[0.5, 0.9]])), look_of(scene, ""))
    for x, y in [(0.2, 0.2), (0.5, 0.2), (0.8, 0.2), (0.5, 0.02)]:
        pixel = pixel_at(image, x, y)
        assert max(pixel) < 160, (x, y, pixel)


def count(image: Image.Image, test) -> int:
    return sum(bool(test(pixel)) for pixel in np.array(image).reshape(-1, 3).astype(int))


def block(centre: list[float], half: float) -> np.ndarray:
    axis = np.arange(-half, half, 0.025)
    return np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3) + np.array(centre)


def test_3d_picture_nearer_body_hides_the_farther_one() -> None:
    camera = {"eye": [0.5, 0.5, 5], "target": [0.5, 0.5, 0.5], "field_of_view": 0.4}
    scene = make_scene(3, pictures={"width": 320, "camera": camera})
    water, jelly = block([0.5, 0.5, 0.8], 0.1), block([0.5, 0.5, 0.2], 0.1)
    materials = np.repeat([0, 1], [len(water), len(jelly)])
    front = draw_3d(make_frame(3, np.concatenate([water, jelly]), materials), look_of(scene, ""))
    behind = draw_3d(
        make_frame(3, np.concatenate([water - [0, 0, 0.7], jelly + [0, 0, 0.7]]), materials), look_of(scene, "")
    )
    middle = (front.width // 2, front.height // 2)
    assert is_bluish(front.getpixel(middle)) and not is_orange(front.getpixel(middle))
    assert is_orange(behind.getpixel(middle)) and not is_bluish(behind.getpixel(middle))


def test_3d_picture_height_is_up_and_obstacles_show() -> None:
    scene = make_scene(3, colliders=[{"shape": {"kind": "sphere", "position": [0.8, 0.15, 0.5], "radius": 0.15}}])
    image = draw_3d(make_frame(3, block([0.3, 0.85, 0.5], 0.1), np.ones(8**3)), look_of(scene, ""))
    rows = np.nonzero([count(image.crop((0, y, image.width, y + 1)), is_orange) for y in range(image.height)])[0]
    assert rows.mean() < 0.5 * image.height
    empty = draw_3d(make_frame(3, block([0.3, 0.85, 0.5], 0.1), np.ones(8**3)), look_of(make_scene(3), ""))
    changed = np.abs(np.array(image).astype(int) - np.array(empty)).sum(axis=2) > 60
    assert changed.sum() > 200


def test_3d_picture_matter_shines_through_obstacles() -> None:
    """Water behind a pane of stone: dimmer than before it, bluer than the pane."""
    camera = {"eye": [0.5, 0.5, 5], "target": [0.5, 0.5, 0.5], "field_of_view": 0.4}
    pane = [{"shape": {"kind": "box", "position": [0.5, 0.5, 0.9], "half_extents": [0.4, 0.4, 0.02]}}]
    seen = []
    for colliders, place in (([], 0.3), (pane, 0.3), (pane, 9.0)):
        scene = make_scene(3, pictures={"width": 320, "camera": camera}, colliders=colliders)
        image = draw_3d(make_frame(3, block([0.5, 0.5, place], 0.1)), look_of(scene, ""))
        red, _, blue = image.getpixel((image.width // 2, image.height // 2))
        seen.append(int(blue) - int(red))
    assert seen[0] > seen[1] + 5 and seen[1] > seen[2] + 5


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_picture_without_particles(dimension: int) -> None:
    look = look_of(make_scene(dimension), "60 Hz")
    image = draw_picture(make_frame(dimension, np.empty((0, dimension))), look)
    assert image.width == 320


def test_caption_is_above_the_picture() -> None:
    look = look_of(make_scene(2), "60 Hz x 5 iterations")
    plain = Image.new("RGB", (320, 200), (255, 0, 0))
    image = annotate(plain, make_frame(2), look)
    assert image.height > 200
    assert image.getpixel((160, image.height - 100)) == (255, 0, 0)
    strip = np.array(image.crop((0, 0, 320, image.height - 200)))
    assert (strip.min(axis=2) < 100).sum() > 100  # ink


def test_the_scale_of_colours_goes_below_a_caption_that_leaves_no_room() -> None:
    look = look_of(make_scene(2), "60 Hz x 5 iterations")
    heights = [annotate(Image.new("RGB", (width, 200)), make_frame(2), look).height for width in (320, 1000)]
    assert heights[0] > heights[1]


def test_faster_is_brighter() -> None:
    look = look_of(make_scene(2), "")
    frame = make_frame(2, np.array([[0.5, 0.5], [0.5, 0.5]]))
    frame.velocities[:] = [[0, 0], [0, look.top_speed]]
    slow, fast = particle_colours(frame, look).sum(axis=1)
    assert fast > slow + 100


def test_a_video_has_a_picture_each_80_ms(tmp_path: Path) -> None:
    video = Video(tmp_path / "run.gif")
    times = [step / 60 for step in range(61)]
    for time in times:
        if video.due(time):
            picture = Image.new("RGB", (960, 480))
            picture.paste((250, 200, 0), (int(900 * time), 0, int(900 * time) + 60, 480))
            video.add(picture)
    video.save()
    with Image.open(tmp_path / "run.gif") as saved:
        assert (saved.size, saved.n_frames, saved.info["duration"]) == ((480, 240), 13, 80)
        saved.seek(12)
        assert [saved.convert("RGB").getpixel((x, 5))[0] > 200 for x in (10, 440)] == [False, True]
    assert [path.name for path in tmp_path.iterdir()] == ["run.gif"]


def test_a_video_without_a_picture_is_no_file(tmp_path: Path) -> None:
    Video(tmp_path / "run.gif").save()
    assert not list(tmp_path.iterdir())


def test_a_picture_before_any_particle_shows_what_brings_them() -> None:
    """An emitter alone, in a world without a domain."""
    emitter = {"shape": {"kind": "sphere", "position": [0.5, 0.8], "radius": 0.1}, "material": "water", "rate": 0.05}
    scene = make_scene(2, fills=[], emitters=[emitter], domain=None)
    frame = make_frame(2, positions=np.zeros((0, 2)))
    picture = draw_picture(frame, look_of(scene, "60 Hz"))
    assert picture.width == 320 and picture.height > 100
