"""Whole scene files in the format of the EA demo, as its editor could write them: every shape, function and material, turned
boxes, presses, settings that nobody knows. They are imported, and what comes out runs and accounts for every particle."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pbmpm.lab.ea_scene import FUNCTIONS, MATERIALS, SHAPES, import_ea_scene
from pbmpm.lab.effects.catalogue import effects_on
from pbmpm.lab.loading import load_scene
from pbmpm.lab.scenes.scene import Scene
from pbmpm.lab.simulation import RunSettings, Simulation

EMITTER, COLLIDER, DRAIN, FILL = 0, 1, 2, 3
LIQUID, ELASTIC, SAND, VISCO = 0, 1, 2, 3
GRID = (80, 60)
PIXELS = 8


def shape(function: int, x: float, y: float, width: float, height: float, **more: Any) -> dict[str, Any]:
    """A box, in cells, as the editor writes it: numbers for places, strings for sizes and choices."""
    return {
        "id": f"shape{x}-{y}",
        "position": {"x": x * PIXELS, "y": y * PIXELS},
        "halfSize": {"x": str(width * PIXELS), "y": str(height * PIXELS)},
        "rotation": 0,
        "shape": "0",
        "function": str(function),
        "emitMaterial": "0",
        "emissionRate": "10",
        "radius": 20.2,
        **more,
    }


def ball(function: int, x: float, y: float, radius: float, **more: Any) -> dict[str, Any]:
    return shape(function, x, y, radius, radius, shape="1", radius=radius * PIXELS, **more)


def ea_file(*shapes: dict[str, Any], **settings: Any) -> dict[str, Any]:
    entries = [{"name": name, "value": value, "type": "range"} for name, value in settings.items()]
    return {"version": 2, "resolution": [GRID[0] * PIXELS + 3, GRID[1] * PIXELS + 5], "settings": entries, "shapes": list(shapes)}


def everything() -> dict[str, Any]:
    """Each function with each material and each form, turned by another angle each time."""
    shapes = []
    for index, (function, material, form) in enumerate(itertools.product(FUNCTIONS, MATERIALS, SHAPES)):
        column, line = index % 8, index // 8
        place = {"emitMaterial": str(material), "rotation": 11 * index, "shape": form, "radius": str(1.5 * PIXELS)}
        shapes.append(shape(function, 10 + 8.5 * column, 12 + 11 * line, 2.0, 1.0, **place))
    return ea_file(*shapes)


def presses() -> dict[str, Any]:
    """Slabs that lie askew over soft matter."""
    return ea_file(
        shape(FILL, 40, 30, 15, 8, emitMaterial=str(VISCO)),
        shape(COLLIDER, 30, 15, 10, 1.5, rotation=20),
        shape(COLLIDER, 52, 15, 10, 1.5, rotation="-20"),
        shape(COLLIDER, 40, 45, 12, 1.5),
        plasticity="0.5",
        elasticityRatio="0.2",
        simRate="480",
    )


def turned_boxes() -> dict[str, Any]:
    """Boxes of all materials at all angles fall on a turned floor."""
    boxes = [
        shape(FILL, 14 + 17 * index, 20, 5, 3, emitMaterial=material, rotation=angle)
        for index, (material, angle) in enumerate(zip((SAND, ELASTIC, LIQUID, VISCO), (30, 45.5, -60, 350)))
    ]
    return ea_file(*boxes, shape(COLLIDER, 40, 48, 25, 1.5, rotation=8), particlesPerCellAxis="3", frictionAngle=45)


def fountains() -> dict[str, Any]:
    """An emitter per material over a drain."""
    sources = [ball(EMITTER, 12 + 18 * m, 12, 2.5, emitMaterial=m, emissionRate=str(8 + m)) for m in MATERIALS]
    return ea_file(*sources, shape(DRAIN, 40, 55, 40, 2.5), simRate="60", gravityStrength="4")


def strange() -> dict[str, Any]:
    """What later versions of the demo might write."""
    data = ea_file(
        shape(FILL, 40, 40, 20, 8, colour="#ff0000", layer=3),
        shape(7, 20, 20, 2, 2),
        shape(FILL, 20, 20, 2, 2, shape="5"),
        renderMode="2",
        moonPhase="full",
        showGrid=True,
        useGridVolumeForLiquid="false",
    )
    del data["version"]
    data["settings"].append({"name": "windStrength", "value": None})
    return data | {"camera": {"zoom": 2}, "author": "someone"}


FILES = {
    "everything": everything,
    "presses": presses,
    "turned_boxes": turned_boxes,
    "fountains": fountains,
    "strange": strange,
}


def load(name: str, folder: Path) -> Scene:
    path = folder / f"{name}.json"
    path.write_text(json.dumps(FILES[name]()))
    return load_scene(path)


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("solver", ["paper", "dual"])
def test_every_file_runs_and_accounts_for_its_particles(name: str, solver: str, tmp_path: Path) -> None:
    scene = load(name, tmp_path)
    settings = RunSettings.of(scene, 1, rate_hz=60.0, solver=solver)
    cells = [edge * scene.cell_size for edge in GRID]
    with Simulation(scene, settings) as simulation:
        for _ in range(40):
            simulation.step()
        assert simulation.problems() == []
        account, positions = simulation.account(), simulation.frame().positions
        assert account["missing"] == 0 and account["now"] == len(positions) > 0
        assert (positions >= 0).all() and (positions <= cells).all()
        assert (account["emitted"] > 0) is bool(scene.emitters)
        assert account["drained"] > 0 or name != "fountains"
        assert simulation.stats().max_speed < 2 * math.sqrt(2 * -scene.gravity[1] * cells[1])


def test_every_shape_function_and_material_arrives(tmp_path: Path) -> None:
    scene = load("everything", tmp_path)
    assert [len(part) for part in (scene.emitters, scene.colliders, scene.drains, scene.fills)] == [8, 8, 8, 8]
    for parts in (scene.emitters, scene.fills):
        assert [part.material for part in parts] == [MATERIALS[m] for m in MATERIALS for _ in SHAPES]
    order = [scene.emitters, scene.colliders, scene.drains, scene.fills]
    for index, part in enumerate(itertools.chain(*order)):
        expected = "box" if index % 2 == 0 else "sphere"
        assert part.shape.kind == expected
        if expected == "box":
            assert part.shape.rotation == pytest.approx(-math.radians(11 * index))
            assert np.array(part.shape.half_extents) / scene.cell_size == pytest.approx([2.0, 1.0])
        else:
            assert part.shape.radius / scene.cell_size == pytest.approx(1.5)
    assert {name: part.kind for name, part in scene.materials.items()} == {name: name for name in MATERIALS.values()}
    assert {"emitters", "drains", "obstacles"} <= set(effects_on(scene))


def test_only_materials_that_are_used_are_in_the_scene(tmp_path: Path) -> None:
    assert list(load("strange", tmp_path).materials) == ["liquid"]
    assert list(load("presses", tmp_path).materials) == ["visco"]


@pytest.mark.parametrize("degrees", [0, 30, 90, -45, "135.5"])
def test_a_turned_box_stands_where_the_demo_shows_it(degrees: Any) -> None:
    """Seen with y down the demo turns clockwise: a corner (a, b) of the box is at (a cos - b sin, a sin + b cos) pixels from
    its middle, and y pixels down are y cells down."""
    scene = import_ea_scene(ea_file(shape(FILL, 40, 30, 12, 2, rotation=degrees)), "turned.json")
    with Simulation(scene, RunSettings.of(scene, 1)) as simulation:
        positions = simulation.frame().positions / scene.cell_size
    angle = math.radians(float(degrees))
    corners = np.array([[-12, -2], [12, -2], [12, 2], [-12, 2]])
    turned = corners @ np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    seen = turned * [1, -1] + [40, GRID[1] - 30]
    spread = 0.75  # [cells] lattice and jitter leave corners empty
    assert positions.min(axis=0) == pytest.approx(seen.min(axis=0), abs=spread)
    assert positions.max(axis=0) == pytest.approx(seen.max(axis=0), abs=spread)
    along = (positions - [40, GRID[1] - 30]) @ [math.cos(angle), -math.sin(angle)]
    assert len(positions) == pytest.approx(4 * 24 * 4, rel=0.1)  # of 112 lattice spacings of edge, each errs by less than half
    assert np.abs(along).max() == pytest.approx(12, abs=spread)


def test_unknown_settings_are_told_and_do_no_harm(tmp_path: Path) -> None:
    scene = load("strange", tmp_path)
    for said in ("renderMode", "moonPhase", "showGrid", "windStrength", "'colour'", "'layer'", "function 7", "shape 5"):
        assert any(said in note for note in scene.notes), said
    assert scene.materials["liquid"].volume_feedback == 0
    assert len(scene.fills) == 1 and not scene.colliders
