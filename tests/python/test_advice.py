"""Advice through the binding and the command: what is foreseen of a scene, and what came true."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_scene_run import pbmpm_command

import pbmpm
from pbmpm import AdviceCode, Change
from pbmpm.lab.advising import AdviceWatch
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.runner import OutputOptions, run_scene
from pbmpm.lab.simulation import RunSettings, Simulation


def codes(world: pbmpm.World) -> set[AdviceCode]:
    return {item.code for item in world.advice(1 / 60)}


def test_a_tank_of_water_needs_none(dimension: int) -> None:
    with pbmpm.World(dimension, 0.05, gravity=[0, -9.81, 0][:dimension], domain=([0.0] * dimension, [0.6] * dimension)) as world:
        world.fill(pbmpm.Box([0.3] * dimension, [0.3, 0.15, 0.3][:dimension]), world.add_material(pbmpm.Liquid()))
        assert world.advice(1 / 60) == []
        for _ in range(60):
            world.step(1 / 60)
        assert world.advice(1 / 60) == []


def test_a_record_has_numbers_and_words() -> None:
    with pbmpm.World(2, 0.05) as world:
        soft = world.add_material(pbmpm.Elastic(elasticity_ratio=0.5))
        world.fill(pbmpm.Box((0, 0.5), (0.5, 0.2)), soft)
        nothing_pulls, ignored = world.advice(1 / 60)
        assert (nothing_pulls.code, nothing_pulls.change, nothing_pulls.price) == (AdviceCode.NO_GRAVITY, Change.GRAVITY, 0)
        assert nothing_pulls.material is nothing_pulls.collider is None and not nothing_pulls.came_true
        assert (ignored.code, ignored.material, ignored.figure, ignored.bound) == (AdviceCode.IGNORED, soft.index, 0.5, 1.0)
        assert "elasticity_ratio" in str(ignored) and "0.5" in str(ignored)
        assert "gravity 9.81 m/s^2" in str(nothing_pulls)
        assert str(ignored) == f"elastic {soft.index}: {ignored.sentence}" and str(nothing_pulls) == nothing_pulls.sentence


def test_a_remedy_is_what_its_figure_asks_for() -> None:
    """A pool that is too deep for the rate is not, once the advice was taken."""
    with pbmpm.World(2, 0.01, gravity=(0, -9.81), domain=((0, 0), (0.2, 1.0)), threads=1) as world:
        world.fill(pbmpm.Box((0.1, 0.3), (0.1, 0.3)), world.add_material(pbmpm.Liquid()))
        (item,) = [item for item in world.advice(1 / 60) if item.code is AdviceCode.POOL_TOO_DEEP]
        assert item.change is Change.SUBSTEPS and item.figure > item.bound
        assert item.price == pytest.approx(100 * (item.value - 1))
        world.substeps = int(item.value)
        assert AdviceCode.POOL_TOO_DEEP not in codes(world)


def test_sand_that_few_iterations_do_not_hold() -> None:
    with pbmpm.World(2, 0.02, gravity=(0, -9.81), domain=((-0.2, 0), (0.2, 1)), domain_friction=0.5, threads=1) as world:
        world.fill(pbmpm.Box((0, 0.2), (0.2, 0.2)), world.add_material(pbmpm.Sand(density=1600, young_modulus=1e6)))
        assert AdviceCode.SAND_NOT_HELD not in codes(world)
        world.solver = pbmpm.Solver.PAPER
        assert AdviceCode.SAND_NOT_HELD in codes(world)


def test_a_bounce_that_the_time_step_damps() -> None:
    with pbmpm.World(3, 0.05, gravity=(0, -9.81, 0), domain=((-1, 0, -1), (1, 2, 1)), threads=1) as world:
        world.fill(pbmpm.Sphere((0, 0.5, 0), 0.2), world.add_material(pbmpm.Elastic(young_modulus=1e6)))
        assert not any("dual solver" in item.text for item in world.advice(1 / 60))
        world.solver = pbmpm.Solver.DUAL
        assert any(item.code is AdviceCode.BOUNCE_DAMPED and "dual solver" in item.text for item in world.advice(1 / 60))
        world.substeps = 16
        assert AdviceCode.BOUNCE_DAMPED not in codes(world)


@pytest.mark.parametrize(("young", "shape", "high", "damped"), [(1e5, "ball", 1.0, False), (3e5, "ball", 1.0, True), (1e7, "ball", 1.0, True), (3e5, "box", 1.0, False), (3e5, "ball", 0.05, False)])
def test_a_ball_whose_contact_is_short(dimension: int, young: float, shape: str, high: float, damped: bool) -> None:
    """A ball of twelve cells rests on the floor for 10, 7 and 1.6 steps. Taken, the advice is not given again."""
    low, top = [-1.0, 0.0, -1.0][:dimension], [1.0, 3.0, 1.0][:dimension]
    with pbmpm.World(dimension, 0.05, gravity=[0, -9.81, 0][:dimension], domain=(low, top), threads=1) as world:
        at = [0.0, 0.3 + high, 0.0][:dimension]
        world.fill(pbmpm.Sphere(at, 0.3) if shape == "ball" else pbmpm.Box(at, [0.3] * dimension), world.add_material(pbmpm.Elastic(young_modulus=young)))
        said = [item for item in world.advice(1 / 60) if item.code is AdviceCode.BOUNCE_DAMPED]
        assert bool(said) is damped
        if damped:
            assert said[0].change is Change.SUBSTEPS and "a ball's contact" in said[0].text
            world.substeps = int(said[0].value)
            assert AdviceCode.BOUNCE_DAMPED not in codes(world)


def test_a_round_body_that_rests_on_less_than_a_cell() -> None:
    for half, young, braked in ((None, 1e6, True), (None, 1e5, False), (0.2, 1e6, False)):
        with pbmpm.World(2, 0.025, gravity=(0, -9.81), threads=1) as world:
            world.add_collider(pbmpm.Plane((0, 0), (0, 1)), friction_coefficient=0.6)
            shape = pbmpm.Sphere((0, 0.2), 0.2) if half is None else pbmpm.Box((0, 0.2), (half, half))
            world.fill(shape, world.add_material(pbmpm.Elastic(young_modulus=young)))
            assert (AdviceCode.ROLLING_BRAKED in codes(world)) == braked


@pytest.mark.parametrize(("speed", "said"), [(5, "would help: iterations"), (40, "no setting that pays holds it")])
def test_a_remedy_costs_at_most_what_halving_the_cells_does(speed: float, said: str) -> None:
    """A step that is far from solved asked for a thousand iterations, at 160 times the price."""
    with pbmpm.World(2, 0.05, gravity=(0, -9.81), domain=((0, 0), (2, 2)), threads=1) as world:
        world.fill(pbmpm.Box((1, 0.6), (0.3, 0.3)), world.add_material(pbmpm.Elastic(young_modulus=1e7)), velocity=(0, -speed))
        found: list[pbmpm.Advice] = []
        for _ in range(30):
            world.step(1 / 60)
            found += [item for item in world.advice(1 / 60) if item.code is AdviceCode.NOT_SOLVED]
    worst = max(found, key=lambda item: item.figure)
    assert said in str(worst)
    assert all(item.change is Change.NONE or item.price is not None and item.price <= 700 for item in found)


SCENE = {
    "format": "pbmpm-scene",
    "version": 1,
    "name": "advised",
    "dimension": 2,
    "cell_size": 0.05,
    "gravity": [0, -9.81],
    "domain": {"min": [0, 0], "max": [1, 1]},
    "seconds": 0.2,
    "materials": {"jam": {"kind": "liquid", "viscosity": 0.5}},
    "fills": [{"shape": {"kind": "box", "position": [0.5, 0.2], "half_extents": [0.5, 0.2]}, "material": "jam"}],
    "colliders": [
        {"shape": {"kind": "box", "position": [0.5, 0.2], "half_extents": [0.1, 0.01]}},
        {
            "shape": {"kind": "sphere", "position": [0.2, 0.9], "radius": 0.05},
            "motion": {"keyframes": [{"time": 0, "position": [0.2, 0.9]}, {"time": 0.1, "position": [0.8, 0.9]}]},
        },
    ],
}


def test_the_command_says_it_with_the_names_of_the_scene(tmp_path: Path) -> None:
    path = tmp_path / "advised.json"
    path.write_text(json.dumps(SCENE), encoding="utf-8")
    done = pbmpm_command("run", path, "--json", "-")
    assert done.returncode == 0, done.stderr
    said = [line for line in done.stderr.splitlines() if line.startswith("advice: ")]
    assert any(line.startswith("advice: jam: viscosity does nothing") for line in said)
    assert any(line.startswith("advice: colliders[0]: an obstacle is too thin") for line in said)
    assert any(line.startswith("advice: colliders[1]: an obstacle moves") for line in said)
    report = json.loads(done.stdout)
    assert {(row["code"], row["of"]) for row in report["advice"]} == {
        ("ignored", "jam"),
        ("collider_too_thin", "colliders[0]"),
        ("collider_too_fast", "colliders[1]"),
    }
    assert not {(row["code"], row["text"]) for row in report["advice_after"]} & {(row["code"], row["text"]) for row in report["advice"]}


def test_obstacles_are_named_by_shape_and_index() -> None:
    with pbmpm.World(2, 0.05, gravity=(0, -9.81)) as world:
        world.fill(pbmpm.Box((0, 0.5), (0.2, 0.2)), world.add_material(pbmpm.Liquid()))
        world.add_collider(pbmpm.Plane((0, 0), (0, 1)))
        thin = world.add_collider(pbmpm.Box((0, 0.5), (1, 0.01), rotation=0.3))
        (item,) = [item for item in world.advice(1 / 60) if item.code is AdviceCode.COLLIDER_TOO_THIN]
        assert (item.owner, item.collider) == (f"box collider {thin.identity[0]}", thin.identity)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize(
    ("wide", "foot", "water_at", "told"),
    [
        pytest.param(2.5, 0.0, 0.5, True, id="flush on the floor"),
        pytest.param(1.4, 0.0, 0.5, False, id="fine enough"),
        pytest.param(2.5, 0.2, 0.5, False, id="its foot is deep in the floor"),
        pytest.param(2.5, 0.0, 2.5, False, id="nothing flows near it"),
        pytest.param(2.5, 0.2, 1.0, True, id="water over its upper edge"),
    ],
)
def test_a_wall_that_is_baked_too_coarsely(dimension: int, wide: float, foot: float, water_at: float, told: bool) -> None:
    """A baked wall of 0.4 x 1.5 m beside water of 1 x 0.8 m on a box; the wall reaches `foot` into it."""
    cell = 0.05
    low, high = [-0.2, -foot, -2.0][:dimension], [0.2, 1.5 - foot, 2.0][:dimension]
    corners = np.array([[(low, high)[i >> a & 1][a] for a in range(dimension)] for i in range(2**dimension)])
    longest = max(b - a for a, b in zip(low, high, strict=True))
    solid = pbmpm.bake_hull(corners, resolution=round(longest / (wide * cell)))
    with pbmpm.World(dimension, cell, gravity=(0, -9.81, 0)[:dimension]) as world:
        world.add_collider(pbmpm.Box((0, -0.5, 0)[:dimension], (5, 0.5, 1.5)[:dimension]))
        wall = world.add_collider(pbmpm.Baked((0,) * dimension, world.load_solid(solid)))
        world.fill(pbmpm.Box((-water_at - 0.2, 0.4, 0)[:dimension], (0.5, 0.4, 0.2)[:dimension]), world.add_material(pbmpm.Liquid()))
        if water_at == 1.0:
            world.fill(pbmpm.Box((-0.2, 1.1, 0)[:dimension], (0.3, 0.3, 0.2)[:dimension]), world.add_material(pbmpm.Liquid()))
        found = [item for item in world.advice(1 / 60) if item.code is AdviceCode.COLLIDER_TOO_COARSE]
        assert bool(found) == told
        for item in found:
            assert item.collider == wall.identity and item.figure == pytest.approx(solid.info.spacing / cell)
            assert "spacing 0.075 m" in item.remedy and item.bound == 1.5


def test_a_run_asks_once_before_its_first_step(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    asked: list[int] = []
    ask = Simulation.advice

    def count(simulation: Simulation) -> list[pbmpm.Advice]:
        asked.append(simulation.steps)
        return ask(simulation)

    monkeypatch.setattr(Simulation, "advice", count)
    said: list[str] = []
    done = run_scene(parse_scene(SCENE), RunSettings(60.0, 1, 3, 1), 0.05, OutputOptions(), tell=said.append)
    assert asked.count(0) == 1 and len(asked) > 1
    assert done.report["advice"] and any(line.startswith("advice: ") for line in said)


def test_the_command_tells_of_what_has_passed(tmp_path: Path) -> None:
    """Sand that falls far is crushed where it lands, and has most of its volume back in the end."""
    sand = {"shape": {"kind": "box", "position": [0.3, 0.7], "half_extents": [0.2, 0.1]}, "material": "sand"}
    scene = {**SCENE, "cell_size": 0.008, "domain": {"min": [0, 0], "max": [0.6, 1], "friction": 0.5}, "materials": {"sand": {"kind": "sand"}}}
    path = tmp_path / "falls.json"
    path.write_text(json.dumps({**scene, "colliders": [], "fills": [sand], "seconds": 3}), encoding="utf-8")
    done = pbmpm_command("run", path, "--json", "-")
    assert done.returncode == 0, done.stderr
    assert not any("sand: matter takes less room" in line for line in done.stderr.splitlines() if line.startswith("advice: "))
    [said] = [line for line in done.stderr.splitlines() if "sand: matter takes less room" in line]
    assert said.startswith("came true at 0.")
    [row] = [row for row in json.loads(done.stdout)["advice_after"] if row["code"] == "volume_lost"]
    assert row["of"] == "sand" and 0.3 < row["time_s"] < 2.0 and row["figure"] > 0.1


def test_what_came_true_is_told_in_the_order_of_time() -> None:
    """Each at the time when it was worst, whatever the order of the codes."""
    worst = {AdviceCode.VOLUME_LOST: 3.0, AdviceCode.NOT_SOLVED: 1.0, AdviceCode.STRAIN_CLAMPED: 2.0}

    class Stage:
        time = 0.0
        materials: dict[str, pbmpm.Material] = {}
        colliders: list[pbmpm.Collider] = []

        def advice(self) -> list[pbmpm.Advice]:
            figures = {code: 1.0 - abs(self.time - at) / 10 for code, at in worst.items()}
            return [pbmpm.Advice(code, code.name, None, None, figure, 0.1, pbmpm.Change.NONE, 0, None, True) for code, figure in figures.items()]

    stage: Any = Stage()
    watch = AdviceWatch(stage, [])
    for stage.time in range(5):
        watch.look()
    assert [row["time_s"] for row in watch.rows()] == [1.0, 2.0, 3.0]


def hangs(world: pbmpm.World) -> bool:
    return any("hangs in a liquid" in item.text for item in world.advice(1 / 60))


@pytest.mark.parametrize(("low", "high", "wanted"), [(3, 3, True), (4, 4, True), (5, 5, False), (1, 8, False), (9, 9, False)])
@pytest.mark.parametrize("colliders", [False, True], ids=["domain", "colliders"])
def test_a_body_between_walls_that_are_near_on_both_sides_hangs(dimension: int, colliders: bool, low: int, high: int, wanted: bool) -> None:
    """A box of eight cells with so many cells to its sides, in water and dry. Walls of colliders stand where those of the domain did."""
    cell, width = 0.05, 8 + low + high
    size = [width * cell, 1.2, width * cell][:dimension]
    with pbmpm.World(dimension, cell, gravity=[0, -9.81, 0][:dimension], domain=None if colliders else ([0.0] * dimension, size)) as world:
        if colliders:
            for axis in (0, 2)[: dimension - 1]:
                for end, side in ((0.0, -1.0), (size[axis], 1.0)):
                    centre, half = [width * cell / 2] * dimension, [2.0] * dimension
                    centre[axis], half[axis] = end + 0.1 * side, 0.1
                    world.add_collider(pbmpm.Box(centre, half))
        middle = [cell * (low + 4), 0.8, cell * (low + 4)][:dimension]
        body = world.add_material(pbmpm.Elastic(density=500))
        world.fill(pbmpm.Box(middle, [4 * cell] * dimension), body)
        assert not hangs(world)
        world.fill(pbmpm.Box([0.5 * size[0], 0.2, 0.5 * size[0]][:dimension], [0.5 * size[0], 0.1, 0.5 * size[0]][:dimension]), world.add_material(pbmpm.Liquid()))
        assert hangs(world) is wanted


def test_a_longer_run_looks_at_the_same_times(monkeypatch: pytest.MonkeyPatch) -> None:
    """What came true worst in a short run is at least as bad in a longer one."""
    looks: list[list[float]] = []

    def note(watch: AdviceWatch) -> None:
        looks[-1].append(watch._simulation.time)

    monkeypatch.setattr(AdviceWatch, "look", note)
    for seconds in (0.5, 1.0):
        looks.append([])
        run_scene(parse_scene(SCENE), RunSettings(60.0, 1, 3, 1), seconds, OutputOptions())
    short, long = looks
    assert len(short) >= 4 and set(short[:-1]) <= set(long) and long[-1] == pytest.approx(1.0)


def given(world: pbmpm.World, code: AdviceCode) -> list[pbmpm.Advice]:
    return [item for item in world.advice(1 / 60) if item.code is code]


def test_a_jelly_that_a_plate_presses_has_lost_nothing(dimension: int) -> None:
    """By three tenths, in a box that it fills: its strain says so. A jelly that was filled twice is crushed: no strain
    says so."""
    d = dimension
    size = [1.0, 1.0, 0.4][:d]
    gravity, domain = [0, -9.81, 0][:d], ([0.0] * d, size)
    with pbmpm.World(d, 0.05, gravity=gravity, domain=domain, domain_friction=0, threads=1) as world:
        jelly = world.add_material(pbmpm.Elastic(young_modulus=5e4))
        world.fill(pbmpm.Box([0.5, 0.25, 0.2][:d], [0.5, 0.25, 0.2][:d]), jelly)
        plate = world.add_collider(pbmpm.Box([0.5, 0.7, 0.2][:d], [0.5, 0.2, 0.3][:d]), kinematic=True)
        for step in range(75):
            plate.move([0.5, 0.7 - 0.15 * min(1, (step + 1) / 60), 0.2][:d])
            world.step(1 / 60)
        assert not given(world, AdviceCode.VOLUME_LOST)
        plate.destroy()
        world.remove(world.ids.copy())
        for _ in range(2):
            world.fill(pbmpm.Box([0.5, 0.25, 0.2][:d], [0.5, 0.25, 0.2][:d]), jelly)
        world.step(1e-4)
        assert given(world, AdviceCode.VOLUME_LOST)[0].figure > 0.3  # half, less the eighth that its weight may take


@pytest.mark.parametrize(
    ("below", "bounded", "change"),
    [(False, False, Change.KILL_BOUNDS), (True, False, Change.SUBSTEPS), (False, True, Change.SUBSTEPS)],
)
def test_a_drop_that_falls_for_ever_wants_kill_bounds(below: bool, bounded: bool, change: Change) -> None:
    """It missed its floor, and is as fast as max_displacement lets it be. With a floor far below, or kill bounds, it
    wants substeps. Before the first step advice tells that kill bounds will take it."""
    with pbmpm.World(2, 0.05, gravity=(0, -9.81), threads=1) as world:
        world.add_collider(pbmpm.Box((0, -0.1), (0.5, 0.1)))
        if below:
            world.add_collider(pbmpm.Box((0, -50), (5, 0.1)))
        if bounded:
            world.kill_bounds = ((-9, -99), (9, 9))
        water = world.add_material(pbmpm.Liquid())
        world.fill(pbmpm.Box((0, 0.1), (0.4, 0.1)), water)
        world.fill(pbmpm.Sphere((0.8, 0.1), 0.04), water, velocity=(0, -200))
        (item,) = given(world, AdviceCode.STEP_TOO_LONG)
        assert item.change is change
        assert ("falls for ever" in item.text) is (change is Change.KILL_BOUNDS)
        assert bool(given(world, AdviceCode.FALLS_FOREVER)) is bounded


@pytest.mark.parametrize(("heights", "told"), [([0.0], False), ([1.0], True), ([12.0], True), ([0.0, 1.0], True)])
def test_a_body_that_lies_on_the_floor_does_not_stop_above_it(dimension: int, heights: list[float], told: bool) -> None:
    """Heavy bodies in water, so many cells above the floor: of several, one that does not lie is enough."""
    d, cell = dimension, 0.05
    with pbmpm.World(d, cell, gravity=[0, -9.81, 0][:d], domain=([0.0] * d, [1.6, 2.0, 0.8][:d]), threads=1) as world:
        water, heavy = world.add_material(pbmpm.Liquid()), world.add_material(pbmpm.Elastic(density=1500))
        places = [[0.4 + 0.8 * i, 0.2 + height * cell, 0.4][:d] for i, height in enumerate(heights)]
        bodies = [pbmpm.Box(place, [0.2] * d) for place in places]
        holes = [world.add_collider(body) for body in bodies]
        world.fill(pbmpm.Box([0.8, 0.25, 0.4][:d], [0.8, 0.25, 0.4][:d]), water)
        for hole, body in zip(holes, bodies, strict=True):
            hole.destroy()
            world.fill(body, heavy)
        assert any("stops a cell above the floor" in item.text for item in world.advice(1 / 60)) is told


@pytest.mark.parametrize("rocks", [False, True])
def test_a_pool_that_stirs_around_a_body_at_rest(rocks: bool) -> None:
    """The water circles at 0.03 m/s in a level pool. A heavy block that lies still drives none of that; one that moves
    may."""
    cell, width, depth = 0.05, 1.6, 0.6
    with pbmpm.World(2, cell, gravity=(0, -9.81), domain=((0, 0), (width, 2 * depth)), threads=1) as world:
        water = world.add_material(pbmpm.Liquid())
        heavy = world.add_material(pbmpm.Elastic(density=2000, young_modulus=1e6))
        axes = [np.arange(cell / 4, size, cell / 2) for size in (width, depth)]
        places = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)
        inside = (abs(places - (width / 2, 0.2)) < 0.2).all(1)
        world.add_particles(heavy, places[inside])
        world.add_particles(water, places[~inside])
        for _ in range(300):
            world.step(1 / 60)
        wet = world.material_indices.array().ravel() == water.index
        x, y = np.pi * world.positions.array().T / [[width], [depth]]
        stream = 0.04 * np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y)], -1)
        world.velocities = np.where(wet[:, None], stream, 0.02 if rocks else 0.0)
        told = [item for item in given(world, AdviceCode.POOL_STIRS) if item.came_true]
        assert [item.change for item in told] == ([] if rocks else [Change.NONE])
