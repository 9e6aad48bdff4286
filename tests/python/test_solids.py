"""Baked solids and impulses in Python, in scene files and in pictures."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.effects.catalogue import effects_on
from pbmpm.lab.errors import InputError
from pbmpm.lab.pictures.flat import draw_2d
from pbmpm.lab.pictures.look import look_of
from pbmpm.lab.loading import load_scene
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.scenes.solids import baked_solid, distance_function
from pbmpm.lab.simulation import RunSettings, Simulation

SQUARE = np.array([(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)], float)
AROUND = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
CUBE = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], float)


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


# Baking


def test_a_square_and_its_distances() -> None:
    solid = pbmpm.bake_mesh(SQUARE, AROUND, resolution=40)
    assert solid.info.dimension == 2 and solid.info.counts == (45, 25)
    assert solid.info.spacing == pytest.approx(0.05)
    points = np.array([(0, 0), (0.9, 0), (1.08, 0), (1.06, 0.58)])
    expected = [-0.5, -0.1, 0.08, 0.1]
    assert distance_function(solid)(points) == pytest.approx(expected, abs=0.026)  # half a cell, and rounding
    assert 1.8 < distance_function(solid)(np.array([(3.0, 0.0)]))[0] <= 2.0  # beyond the grid
    assert solid.distances.shape == (45, 25) and solid.distances.min() == pytest.approx(-0.5, abs=0.026)


def test_a_hull_of_a_cube() -> None:
    solid = pbmpm.bake_hull(np.concatenate([CUBE, 0.5 * CUBE]), resolution=16)
    points = np.array([(0.0, 0, 0), (0.75, 0, 0), (0, 1.2, 0)])
    assert distance_function(solid)(points) == pytest.approx([-1.0, -0.25, 0.2], abs=0.0625)


def test_heights_in_both_dimensions() -> None:
    flat = pbmpm.bake_heights(np.zeros(9), 0.25, thickness=0.5)
    assert distance_function(flat)(np.array([(1.0, 0.1), (1.0, -0.1)])) == pytest.approx([0.1, -0.1], abs=0.01)
    slope = 0.5 * np.arange(9)[:, None] * 0.25 * np.ones((9, 6))  # rises along the first axis
    hill = pbmpm.bake_heights(slope, 0.25, up=2)
    assert hill.info.counts[0] > hill.info.counts[1]
    near = distance_function(hill)(np.array([(1.0, 0.6, 0.6), (1.0, 0.6, 0.4)]))
    assert near == pytest.approx([0.1 / math.sqrt(1.25), -0.1 / math.sqrt(1.25)], abs=0.02)


@pytest.mark.parametrize(
    ("elements", "message"),
    [
        (AROUND[:3], "open at"),
        (np.array([(0, 1), (1, 2), (2, 3), (0, 3)]), "wound in two ways"),
        (np.array([(0, 1), (1, 0)]), "no volume"),
        (np.array([(0, 1), (1, 9)]), "a vertex that does not exist"),
        (AROUND.astype(float), "whole numbers"),
        (AROUND - 1, "negative"),
    ],
)
def test_bad_meshes_are_refused(elements: np.ndarray, message: str) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError, match=message):
        pbmpm.bake_mesh(SQUARE, elements)


def test_saved_and_loaded(tmp_path: Path) -> None:
    solid = pbmpm.bake_mesh(SQUARE, AROUND, resolution=8)
    solid.save(tmp_path / "a.sdf")
    assert pbmpm.BakedSolid.load(tmp_path / "a.sdf").data == solid.data
    assert [path.name for path in tmp_path.glob("a*")] == ["a.sdf"]
    for spoiled in (solid.data[:-1], solid.data[:100] + b"x" + solid.data[101:], b"", b"nonsense" * 20):
        with pytest.raises(pbmpm.DamagedError):
            pbmpm.BakedSolid(spoiled)


def test_the_cache_is_used_and_repaired(tmp_path: Path) -> None:
    folder = tmp_path / "made" / "here"
    solid = pbmpm.bake_mesh(SQUARE, AROUND, resolution=8, cache=folder)
    (stored,) = folder.iterdir()
    assert stored.read_bytes() == solid.data
    other = pbmpm.bake_hull(SQUARE, resolution=8)
    other.save(stored)  # what lies there is believed
    assert pbmpm.bake_mesh(SQUARE, AROUND, resolution=8, cache=folder).data == other.data
    stored.write_bytes(b"broken")
    assert pbmpm.bake_mesh(SQUARE, AROUND, resolution=8, cache=folder).data == solid.data
    pbmpm.bake_mesh(SQUARE, AROUND, resolution=9, cache=folder)
    assert len(list(folder.iterdir())) == 2


# Worlds


def test_obstacles_share_a_solid() -> None:
    with pbmpm.World(2, 0.1, gravity=(0, -9.81), capacity=5000) as world:
        solid = world.load_solid(pbmpm.bake_mesh(SQUARE, AROUND, resolution=20))
        assert solid.info.counts == (25, 15)
        ground = world.add_collider(pbmpm.Baked((0, -1), solid))
        other = world.add_collider(pbmpm.Baked((3, -1), solid, rotation=0.5), kinematic=True)
        shape = ground.shape
        assert isinstance(shape, pbmpm.Baked) and shape.solid == solid and shape.position == (0, -1)
        water = world.add_material(pbmpm.Liquid())
        world.fill(pbmpm.Box((0, 0), (0.4, 0.3)), water)
        for step in range(60):
            other.move((3, -1 + 0.01 * step), 0.5)
            world.step(1 / 60)
        assert len(ground.query()) < 10
        with pytest.raises(pbmpm.InUseError):
            solid.destroy()
        ground.destroy()
        other.destroy()
        solid.destroy()
        with pytest.raises(pbmpm.InvalidArgumentError, match="no baked solid"):
            world.add_collider(pbmpm.Baked((0, 0), solid))


def test_impulses_bear_the_weight_of_water() -> None:
    with pbmpm.World(
        2, 0.1, gravity=(0, -10), domain=((0, 0), (1, 2)), domain_measures_impulse=True, iterations=10, capacity=5000
    ) as world:
        world.fill(pbmpm.Box((0.5, 0.3), (0.5, 0.3)), world.add_material(pbmpm.Liquid()))
        given = np.zeros(2)
        before = np.array(world.stats.momentum[:2])
        for _ in range(120):
            world.step(1 / 120)
            for axis in range(2):
                given += world.wall_impulse(axis).linear
                given += world.wall_impulse(axis, upper=True).linear
        stats = world.stats
        weight = np.array([0, -10 * stats.mass])
        gained = np.array(stats.momentum[:2]) - before
        assert gained == pytest.approx(weight - given, abs=1e-5 * 10 * stats.mass)


def test_impulses_have_to_be_asked_for() -> None:
    with pbmpm.World(3, 0.1, capacity=10) as world:
        silent = world.add_collider(pbmpm.Sphere((0, 0, 0), 1))
        asked = world.add_collider(pbmpm.Sphere((5, 0, 0), 1), measures_impulse=True)
        assert not silent.measures_impulse and asked.measures_impulse
        assert asked.impulse == pbmpm.Impulse((0, 0, 0), (0, 0, 0))
        with pytest.raises(pbmpm.InvalidArgumentError, match="measures no impulse"):
            _ = silent.impulse
        with pytest.raises(pbmpm.InvalidArgumentError, match="there are no walls"):
            world.wall_impulse(0)


# Scenes


def _scene(shape: dict[str, Any], **collider: Any) -> dict[str, Any]:
    return {
        "format": "pbmpm-scene",
        "version": 1,
        "name": "solid",
        "dimension": 2,
        "cell_size": 0.1,
        "gravity": [0, -9.81],
        "domain": {"min": [-2, -2], "max": [2, 2]},
        "seconds": 1,
        "materials": {"water": {"kind": "liquid"}},
        "fills": [{"shape": {"kind": "box", "position": [0, 0], "half_extents": [0.5, 0.3]}, "material": "water"}],
        "colliders": [{"shape": shape, **collider}],
    }


POLYGON = {
    "kind": "mesh",
    "position": [0, -1],
    "vertices": SQUARE.tolist(),
    "elements": AROUND.tolist(),
    "resolution": 24,
}


def test_a_scene_with_a_polygon_runs_and_is_drawn() -> None:
    scene = parse_scene(_scene(POLYGON))
    assert effects_on(scene) == ["liquid", "volume_feedback", "baked_solids"]
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(30):
            simulation.step()
        frame = simulation.frame()
        low = frame.positions[np.abs(frame.positions[:, 0]) < 0.9, 1].min()
        assert low > -0.52  # rests on top of the square
        picture = np.array(draw_2d(frame, look_of(scene, "")))
    height, width = picture.shape[:2]
    inside, beside = picture[int(0.75 * height), width // 2], picture[int(0.75 * height), int(0.9 * width)]
    assert inside.tolist() == [128, 133, 142] and beside.max() < 60


def test_a_scene_with_heights_and_a_file(tmp_path: Path) -> None:
    heights = {"kind": "heights", "position": [-2.7, -1], "heights": [0.2, 0.0, 0.0, 0.2], "spacing": 1.8, "resolution": 40}
    scene = parse_scene(_scene(heights))
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(60):
            simulation.step()
        assert simulation.frame().positions[:, 1].min() > -1.05
    (tmp_path / "cube.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE)
        + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
    )
    data = _scene({"kind": "mesh", "position": [0, -3, 0], "file": "cube.obj", "resolution": 8})
    data.update(dimension=3, gravity=[0, -9.81, 0], domain=None)
    data["fills"][0]["shape"] = {"kind": "sphere", "position": [0, 0, 0], "radius": 0.3}
    (tmp_path / "scene.json").write_text(json.dumps(data))
    scene = load_scene(tmp_path / "scene.json")
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        simulation.step()


def test_scenes_bake_as_finely_as_their_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    """And as their own features need, but for what would take too much memory, and what says its resolution."""
    heights = {"kind": "heights", "position": [0, 0], "heights": [0.0, 0.3] * 4 + [0.0], "spacing": 1.5, "thickness": 4}
    wide = {"kind": "mesh", "position": [0, 0], "vertices": (10 * SQUARE).tolist(), "elements": AROUND.tolist()}
    small = {**wide, "vertices": (0.1 * SQUARE).tolist()}
    cube = {"kind": "mesh", "position": [0, 0, 0], "vertices": (1000 * CUBE).tolist(), "hull": True}
    side = float(np.ptp(SQUARE))

    def spacing(part: dict[str, Any], **scene: Any) -> float:
        shape = parse_scene({**_scene(part), **scene}).colliders[0].shape
        return baked_solid(shape, len(part["position"])).info.spacing

    assert spacing(heights) == pytest.approx(0.1) and spacing(heights, cell_size=2, domain=None) == pytest.approx(1.5)
    assert spacing({**heights, "resolution": 10}) == pytest.approx(1.2)
    assert spacing(wide) == pytest.approx(0.1) and spacing(small) == pytest.approx(0.1 * side / 64)
    fills = [{"shape": {"kind": "box", "position": [0, 0, 0], "half_extents": [1, 1, 1]}, "material": "water"}]
    monkeypatch.setattr("pbmpm.lab.scenes.solids._MOST_VALUES", 10**3)
    assert spacing(cube, dimension=3, gravity=[0, -9.81, 0], domain=None, fills=fills) == pytest.approx(200)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"file": "a.obj"}, "either a file or vertices"),
        ({"hull": True}, "vertices need elements, or hull"),
        ({"elements": None}, "vertices need elements, or hull"),
        ({"resolution": 2}, "resolution"),
    ],
)
def test_bad_meshes_in_scenes(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_scene(_scene({**POLYGON, **change}))


def test_an_open_polygon_in_a_scene() -> None:
    scene = parse_scene(_scene({**POLYGON, "elements": AROUND[:3].tolist()}))
    with pytest.raises(InputError, match="open"):
        Simulation(scene, RunSettings.of(scene))


# Bodies


def _rest_height(mass: float, seconds: float = 7.0) -> float:
    """Mean height of a box of 0.5 m x 0.6 m after 3 s of a run in a basin of water with its surface at 0. It bobs with a period of
    some 1.3 s."""
    box = {"kind": "box", "position": [0, 0.4], "half_extents": [0.25, 0.3]}
    data = _scene(box, friction_coefficient=0, body={"mass": mass, "turns": False})
    data.update(cell_size=0.05, rate_hz=120, substeps=2, iterations=20, solver={"solver": "dual"})
    data["domain"] = {"min": [-1, -1], "max": [1, 1.5]}
    data["fills"][0]["shape"] = {"kind": "box", "position": [0, -0.5], "half_extents": [1, 0.5]}
    scene = parse_scene(data)
    heights = []
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(int(seconds * 120)):
            simulation.step()
            heights.append(simulation.frame().body_poses[0][0][1])
    return float(np.mean(heights[3 * 120 :]))


@pytest.mark.long
def test_a_light_body_floats_and_a_heavy_one_sinks() -> None:
    level = 0.5 * 0.3 / 2  # it displaces 0.15 m^2 in a basin of 2 m
    draught = level - (_rest_height(150.0) - 0.3)
    assert draught == pytest.approx(0.3, rel=0.05)  # Archimedes: half of 0.6 m
    assert _rest_height(600.0, 4.0) == pytest.approx(-0.7, abs=0.01)  # on the ground


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_cube_of_five_cells_floats(dimension: int) -> None:
    """With the dual solver at 120 Hz and ten iterations, half as heavy as water. The depth is by the weight of the water beside the cube, since liquids give way a
    little. The bound is a fifth of a cell; a cube whose edges are held by one face alone lies 0.6 to 2.9 cells too deep."""
    cell, side, basin, depth, rate = 0.1, 0.5, 1.2, 0.9, 120
    cube = {"kind": "box", "position": [0] * dimension, "half_extents": [side / 2] * dimension}
    low, high = ([value, *[x] * (dimension - 1)] for value, x in ((-basin / 2, -basin / 2), (basin / 2, basin / 2)))
    low[1], high[1] = -depth, 0.8
    water = {"kind": "box", "position": [0, -depth / 2, 0][:dimension], "half_extents": [basin / 2, depth / 2, basin / 2][:dimension]}
    data = _scene(cube, friction_coefficient=0, body={"mass": 500.0 * side**dimension, "turns": False})
    data.update(dimension=dimension, cell_size=cell, rate_hz=rate, substeps=1, iterations=10, solver={"solver": "dual"})
    data.update(gravity=[0, -9.81, 0][:dimension], domain={"min": low, "max": high})
    data["fills"][0]["shape"] = water
    scene = parse_scene(data)
    draughts = []
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for step in range(4 * rate):
            simulation.step()
            if step < 2.5 * rate:
                continue
            bottom = simulation.frame().body_poses[0][0][1] - side / 2
            places = simulation.world.positions.array()
            beside = np.abs(places[:, 0]) > side / 2 + 2 * cell
            area = (basin - side - 4 * cell) * basin ** (dimension - 2)
            draughts.append((beside & (places[:, 1] > bottom)).sum() * (cell / 2) ** dimension / area)
    assert np.mean(draughts) == pytest.approx(side / 2, abs=0.2 * cell)


def test_a_body_turns_upright_again() -> None:
    """A wide flat box that falls in at a slant ends up flat."""
    box = {"kind": "box", "position": [0, 0.3], "half_extents": [0.6, 0.1], "rotation": 0.3}
    data = _scene(box, friction_coefficient=0, body={"mass": 120.0})
    data.update(rate_hz=120, substeps=2, iterations=10, solver={"solver": "dual"})
    data["fills"][0]["shape"] = {"kind": "box", "position": [0, -1], "half_extents": [2, 1]}
    scene = parse_scene(data)
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        angles = []
        for _ in range(480):
            simulation.step()
            x, y, z, w = simulation.frame().body_poses[0][1]
            angles.append(2 * math.atan2(z, w))
    assert x == y == 0
    assert abs(np.mean(angles[240:])) < 0.1 and np.max(np.abs(angles[240:])) < 0.3


BAR = {"kind": "mesh", "position": [0, 3], "vertices": [[0, -0.1], [1, -0.1], [1, 0.1], [0, 0.1]], "elements": [[0, 1], [1, 2], [2, 3], [3, 0]]}


def test_a_mesh_is_as_heavy_and_as_hard_to_turn_as_its_formula_says() -> None:
    scene = parse_scene(_scene(BAR, body={"density": 1.0}))
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        form = simulation.colliders[0].mass(1.0)
    assert form.mass == form.volume == pytest.approx(0.2, rel=0.01)
    assert form.centre == pytest.approx([0.5, 0, 0], abs=0.005)
    assert form.inertia[2] / form.mass == pytest.approx((1 + 0.2**2) / 12, rel=0.02)


def _body_angles(body: dict[str, Any], seconds: float) -> tuple[list[float], list[list[float]]]:
    """Angle and position over time of the bar above, far from all water."""
    data = _scene(BAR, body=body)
    data.update(rate_hz=240)
    del data["domain"]
    scene = parse_scene(data)
    angles, places = [], []
    with Simulation(scene, RunSettings.of(scene)) as simulation:
        for _ in range(round(seconds * 240)):
            simulation.step()
            position, (_, _, z, w) = simulation.frame().body_poses[0]
            angles.append(2 * math.atan2(z, w))
            places.append(position)
    return angles, places


def test_a_bar_on_a_hinge_swings_as_a_pendulum_does() -> None:
    """Let go level it is down after 1.854 sqrt(I / (m g l)): a quarter of the period of a swing of 90 degrees."""
    angles, places = _body_angles({"density": 500.0, "moves": False}, 1.2)
    assert all(place == pytest.approx([0, 3, 0]) for place in places)
    down = next(k for k, angle in enumerate(angles) if angle < -math.pi / 2)
    swing = 1.8541 * math.sqrt(((1 + 0.2**2) / 12 + 0.25) / (9.81 * 0.5))
    assert (down + 0.5) / 240 == pytest.approx(swing, rel=0.02)
    assert min(angles) == pytest.approx(-math.pi, abs=0.05)


def test_a_free_mesh_falls_and_moves_about_its_centre_of_mass() -> None:
    angles, places = _body_angles({"density": 500.0, "velocity": [1.0, 0.0]}, 0.25)
    assert angles == pytest.approx([0.0] * len(angles), abs=1e-6)
    assert places[-1][:2] == pytest.approx([0.25, 3 - 9.81 * 0.25**2 / 2], abs=0.01)


def test_bodies_that_make_no_sense() -> None:
    with pytest.raises(InputError, match="a plane cannot be one"):
        parse_scene(_scene({"kind": "plane", "position": [0, 0], "normal": [0, 1]}, body={"mass": 1.0}))
    box = {"kind": "box", "position": [0, 0], "half_extents": [1, 1]}
    for body in ({}, {"mass": 1.0, "density": 1.0}):
        with pytest.raises(InputError, match="either a mass or a density"):
            parse_scene(_scene(box, body=body))
    for body in ({"mass": 1.0, "moves": False, "turns": False}, {"mass": 1.0, "moves": False, "velocity": [1, 0]}):
        with pytest.raises(InputError, match="does not move has to turn"):
            parse_scene(_scene(box, body=body))
    for body, problem in (({"slides": [0, 0]}, "slides: must not be zero"), ({"pivot": [0, 0]}, "set moves to false")):
        with pytest.raises(InputError, match=problem):
            parse_scene(_scene(box, body={"mass": 1.0, **body}))
    with pytest.raises(InputError, match="does not slide"):
        parse_scene(_scene(box, body={"mass": 1.0, "moves": False, "slides": [0, 1]}))
    with pytest.raises(InputError, match="body.axis: in 2D"):
        parse_scene(_scene(box, body={"mass": 1.0, "axis": [0, 0, 1]}))
    with pytest.raises(InputError, match="axis: must not be zero"):
        parse_scene(_scene(box, body={"mass": 1.0, "axis": [0, 0, 0]}))
    frames = [{"time": 0, "position": [0, 0]}, {"time": 1, "position": [1, 0]}]
    with pytest.raises(InputError, match="not both"):
        parse_scene(_scene(box, body={"mass": 1.0}, motion={"keyframes": frames}))
    with pytest.raises(InputError, match="body.mass"):
        parse_scene(_scene(box, body={"mass": 0.0}))


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("floor", ["box", "baked"])
@pytest.mark.parametrize("wall", ["box", "domain"])
@pytest.mark.parametrize("speed", [0.0, 1.0, 2.5])
def test_what_is_in_the_joint_of_flush_obstacles_comes_out(dimension: int, floor: str, wall: str, speed: float) -> None:
    """A floor ends where a wall stands. A particle that was pressed in exactly between them is in neither. It moves down by so many cells per step."""
    cell, half = 0.1, np.ones(dimension)
    domain = ([0, -2, -1][:dimension], [3, 3, 1][:dimension]) if wall == "domain" else None
    with pbmpm.World(dimension, cell, gravity=(0, -9.81, 0)[:dimension], domain=domain) as world:
        middle = [1, -1, 0][:dimension]
        if floor == "baked":
            corners = np.array([[(-1, 1)[i >> a & 1] for a in range(dimension)] for i in range(2**dimension)])
            world.add_collider(pbmpm.Baked(middle, world.load_solid(pbmpm.bake_hull(corners, resolution=20))))
        else:
            world.add_collider(pbmpm.Box(middle, half))
        if wall == "box":
            world.add_collider(pbmpm.Box([-1, 0, 0][:dimension], [1, 2, 1][:dimension]))
        world.add_particles(world.add_material(pbmpm.Liquid()), np.array([[0, -0.3 * cell, 0][:dimension]]), velocities=np.array([[0, -speed * cell * 60, 0][:dimension]]))
        for _ in range(4):
            world.step(1 / 60)
        assert world.positions.array()[0] == pytest.approx([0] * dimension, abs=1e-4 * cell)


RAMP = np.array([(0, 0), (2, 2 * math.tan(math.radians(20))), (0, 2 * math.tan(math.radians(20)))])
BEAM = 0.1 * np.array([(x, y) for x in (-5, 5) for y in (0, 2)])


@pytest.mark.parametrize(
    ("corners", "cells", "lift", "height"),
    [
        pytest.param(BEAM, 10, 0.05, lambda x: 0.025, id="slit"),
        pytest.param(BEAM, 10, 0.4, lambda x: 0.2, id="wide slit"),
        pytest.param(RAMP, 20, 0.0, lambda x: 0.7 * x * math.tan(math.radians(20)), id="wedge"),
    ],
)
def test_what_is_between_obstacles_that_nearly_meet_stays(corners: np.ndarray, cells: int, lift: float, height: Callable[[float], float]) -> None:
    """Lone particles below a baked solid that stands `lift` cells above a floor, or hangs over it. No gravity: nothing moves them."""
    cell = 0.1
    solid = pbmpm.bake_hull(corners, resolution=cells)
    for x in np.linspace(0.3, 4.3, 9):
        with pbmpm.World(2, cell, gravity=(0, 0)) as world:
            world.add_collider(pbmpm.Box((0, -1), (5, 1)))
            world.add_collider(pbmpm.Baked((0, lift * cell), world.load_solid(solid)))
            start = cell * np.array([[x, height(x)]])
            world.add_particles(world.add_material(pbmpm.Liquid()), start)
            world.step(1 / 60)
            assert np.abs(world.positions.array() - start).max() < 0.02 * cell, x


@pytest.mark.parametrize("material", [pbmpm.Sand, pbmpm.Liquid])
def test_a_piston_that_closes_on_a_floor_lets_nothing_through(material: type[pbmpm.Sand | pbmpm.Liquid]) -> None:
    """A beam of 10 x 2 cells sinks onto matter at half a metre per second, until it stands flush on the floor."""
    cell = 0.1
    with pbmpm.World(2, cell, gravity=(0, -9.81), domain=([-3, -2], [3, 6])) as world:
        world.add_collider(pbmpm.Box((0, -1), (3, 1)))
        beam = world.add_collider(pbmpm.Box((0, 1.3), (0.5, 0.1)), kinematic=True)
        world.fill(pbmpm.Box((0, 0.2), (1.5, 0.2)), world.add_material(material()))
        for i in range(170):
            beam.move((0, max(0.1, 1.3 - 0.5 * i / 60)))
            world.step(1 / 60)
        at = world.positions.array()
        assert ((np.abs(at[:, 0]) < 0.5 - cell) & (at[:, 1] > 0.1)).sum() == 0
