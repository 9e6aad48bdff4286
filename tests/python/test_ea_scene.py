"""Import of scenes in the format of the EA demo."""

from __future__ import annotations

import copy
import json
import math
from pathlib import Path
from typing import Any

import pytest

import pbmpm
from pbmpm.lab.effects.catalogue import effects_on
from pbmpm.lab.ea_scene import STANDARD_GRAVITY, import_ea_scene, looks_like_ea_scene
from pbmpm.lab.errors import InputError
from pbmpm.lab.loading import load_scene

SMALL: dict[str, Any] = {
    "version": 2,
    "resolution": [800, 400],
    "settings": [],
    "shapes": [
        {
            "id": "a",
            "position": {"x": 400, "y": 100},
            "halfSize": {"x": "80", "y": "40"},
            "rotation": 30,
            "shape": "0",
            "function": "3",
            "emitMaterial": "0",
        }
    ],
}


def small(**shape: Any) -> dict[str, Any]:
    """The small scene with fields of its shape replaced."""
    data = copy.deepcopy(SMALL)
    data["shapes"][0].update(shape)
    return data


def test_told_apart_by_contents(root: Path) -> None:
    assert looks_like_ea_scene(SMALL)
    assert not looks_like_ea_scene(json.loads((root / "samples/scenes/column_2d.json").read_text()))
    assert not looks_like_ea_scene([1])


def test_pixels_become_cells_and_cells_metres(tmp_path: Path) -> None:
    data = small(position={"x": 240.5, "y": 250.25}, halfSize={"x": "200", "y": "140"}, rotation=0)
    data["resolution"] = [1203, 645]  # 150 x 80 cells and a rest
    data["settings"] = [{"name": "iterationCount", "value": 7, "type": "range"}]
    data["shapes"].append({**SMALL["shapes"][0], "emitMaterial": "1"})
    path = tmp_path / "some scene.json"
    path.write_text(json.dumps(data))
    scene = load_scene(path)
    cell = scene.cell_size
    assert scene.name == "some_scene"
    assert (scene.dimension, scene.rate_hz, scene.iterations, scene.seconds) == (2, 240.0, 7, 10.0)
    assert [fill.material for fill in scene.fills] == ["liquid", "elastic"]
    assert [size / cell for size in scene.fills[0].shape.half_extents] == pytest.approx([25, 17.5])
    assert scene.fills[0].shape.position[0] / cell == pytest.approx(240.5 / 8)
    assert scene.fills[0].shape.position[1] / cell == pytest.approx(80 - 250.25 / 8)
    assert scene.gravity[1] / cell == pytest.approx(-2.5 * 80)
    assert scene.domain.min == pytest.approx([3 * cell, 3 * cell])
    assert scene.domain.max == pytest.approx([147 * cell, 77 * cell])
    assert scene.domain.friction == 0.5
    assert scene.materials["liquid"].viscosity == 0.01
    assert scene.materials["liquid"].volume_feedback == 0.1


def test_default_gravity_is_that_of_the_earth() -> None:
    scene = import_ea_scene(SMALL, "small.json")
    assert scene.gravity == pytest.approx([0, -STANDARD_GRAVITY])


def test_y_and_rotation_are_mirrored() -> None:
    shape = import_ea_scene(SMALL, "small.json").fills[0].shape
    scene_height = 50 * import_ea_scene(SMALL, "small.json").cell_size
    assert shape.position[1] == pytest.approx(scene_height * 0.75)
    assert shape.rotation == pytest.approx(-math.pi / 6)


def test_settings_override_and_may_be_strings() -> None:
    data = small()
    data["settings"] = [
        {"name": "simResDivisor", "value": "16"},
        {"name": "gravityStrength", "value": "0"},
        {"name": "useGridVolumeForLiquid", "value": False},
        {"name": "liquidRelaxation", "value": 5},
        {"name": "renderMode", "value": "0"},
        {"name": "particlesPerCellAxis", "value": "3"},
    ]
    scene = import_ea_scene(data, "small.json")
    assert scene.domain.max[0] / scene.cell_size == pytest.approx(50 - 3)
    assert scene.gravity == pytest.approx([0, 0])
    assert scene.materials["liquid"].volume_feedback == 0.0
    assert scene.materials["liquid"].relaxation < 2
    assert scene.fills[0].particles_per_axis == 3.0
    assert any("renderMode" in note for note in scene.notes)
    assert any("liquidRelaxation" in note for note in scene.notes)


def test_circles_and_colliders() -> None:
    data = small(shape="1", radius=40)
    data["shapes"].append({**SMALL["shapes"][0], "function": "1"})
    scene = import_ea_scene(data, "small.json")
    assert scene.fills[0].shape.kind == "sphere"
    assert scene.fills[0].shape.radius == pytest.approx(5 * scene.cell_size)
    assert scene.colliders[0].shape.kind == "box"


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"emissionRate": "often"}, r"shapes\[0\].emissionRate: 'often' is not a number"),
        ({"position": 3}, r"shapes\[0\].position: an object with x and y"),
        ({"halfSize": {"x": "wide", "y": 1}}, r"shapes\[0\].halfSize.x: 'wide' is not a number"),
        ({"function": "1"}, "nothing fills this scene"),
    ],
)
def test_refused_by_name(fields: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        import_ea_scene(small(**fields), "small.json")


def test_emitters_and_drains() -> None:
    """A site of the demo's lattice emits emissionRate particles per second, so the shape its own area as often."""
    data = small(function="0", emissionRate="2.5", rotation=0)
    data["shapes"].append({**SMALL["shapes"][0], "function": "2"})
    data["shapes"].append({**SMALL["shapes"][0], "function": 0, "shape": 1, "radius": 20, "emitMaterial": 1})
    scene = import_ea_scene(data, "small.json")
    cell = scene.cell_size
    assert scene.fills == []
    assert [emitter.material for emitter in scene.emitters] == ["liquid", "elastic"]
    assert scene.emitters[0].rate / cell**2 == pytest.approx(2.5 * 20 * 10)
    assert scene.emitters[1].rate == 0.0  # it names none
    assert [emitter.fill_limit for emitter in scene.emitters] == [1.5, 1.5]
    assert any("emitters of solids" in note for note in scene.notes)
    assert scene.drains[0].shape.half_extents == scene.emitters[0].shape.half_extents
    assert effects_on(scene) == ["liquid", "elastic", "viscosity", "volume_feedback", "emitters", "drains"]


def test_sand_and_visco() -> None:
    data = small(emitMaterial="3")
    data["shapes"].append({**SMALL["shapes"][0], "emitMaterial": "2"})
    settings = {"frictionAngle": "40", "plasticity": 0.88, "elasticityRatio": "0.5", "elasticRelaxation": 1.25}
    data["settings"] = [{"name": name, "value": value} for name, value in settings.items()]
    scene = import_ea_scene(data, "small.json")
    assert [fill.material for fill in scene.fills] == ["visco", "sand"]
    visco, sand = scene.materials["visco"], scene.materials["sand"]
    assert (visco.kind, sand.kind) == ("visco", "sand")
    assert visco.elasticity_ratio == sand.elasticity_ratio == 0.5 and visco.relaxation == sand.relaxation == 1.25
    assert sand.friction_angle == pytest.approx(math.radians(40))
    assert visco.yield_strain == pytest.approx(math.sqrt(2) * 0.12)
    assert visco.flow_rate / scene.rate_hz > 100  # nothing is left of exp(-100) in single precision


@pytest.mark.parametrize("ratio", [1.0, 0.25, 0.07])
def test_solids_have_the_moduli_that_the_demos_iterations_act_like(ratio: float) -> None:
    data = small(emitMaterial="3")
    settings = {"elasticityRatio": ratio, "simRate": 480, "iterationCount": 7, "elasticRelaxation": 1.25}
    data["settings"] = [{"name": name, "value": value} for name, value in settings.items()]
    scene = import_ea_scene(data, "small.json")
    visco = scene.materials["visco"]
    assert visco.kind == "visco"
    assert scene.solver.solver == "paper"
    with pbmpm.World(2, scene.cell_size, capacity=1, iterations=scene.iterations, solver=pbmpm.Solver.PAPER) as world:
        matter = pbmpm.Visco(density=visco.density, relaxation=visco.relaxation)
        papers = world.add_material(matter).effective(1.0 / scene.rate_hz)
    shear = 0.5 * visco.young_modulus / (1 + visco.poisson_ratio)
    bulk = shear / (1 - 2 * visco.poisson_ratio)  # lambda + mu
    assert bulk == pytest.approx(papers.bulk_modulus, rel=1e-5)
    assert 2 * shear == pytest.approx(ratio * papers.young_modulus, rel=1e-5)


def test_extreme_sand_and_visco_stay_within_what_there_is() -> None:
    data = small(emitMaterial="3")
    data["shapes"].append({**SMALL["shapes"][0], "emitMaterial": "2"})
    settings = {"frictionAngle": 90, "plasticity": 1.5, "elasticityRatio": 0}
    data["settings"] = [{"name": name, "value": value} for name, value in settings.items()]
    materials = import_ea_scene(data, "small.json").materials
    assert materials["visco"].yield_strain == 0 and 1.3 < materials["sand"].friction_angle < math.pi / 2
    assert 0 < materials["sand"].elasticity_ratio == materials["visco"].elasticity_ratio <= 0.1
    assert materials["visco"].poisson_ratio < 0.5 and materials["visco"].young_modulus > 1.0


def test_what_nobody_knows_becomes_a_note() -> None:
    data = small(emissionSpeed="3")
    data["settings"] = [{"name": "moonPhase", "value": "full"}]
    for field, value in (("function", "7"), ("shape", "2"), ("emitMaterial", "9")):
        data["shapes"].append({**SMALL["shapes"][0], field: value})
    scene = import_ea_scene(data, "small.json")
    assert len(scene.fills) == 1
    for said in ("moonPhase", "emissionSpeed", "shapes[1] was left out: function 7", "shape 2", "emitMaterial 9"):
        assert any(said in note for note in scene.notes), said
