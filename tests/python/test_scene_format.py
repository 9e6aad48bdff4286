"""Scene files: what is accepted, and that each error names its field."""

from __future__ import annotations

import copy
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pbmpm
from pbmpm.lab.errors import InputError
from pbmpm.lab.scenes.motion import pose_at, quaternion, rotation_matrix
from pbmpm.lab.loading import load_scene
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.scenes.scene import MotionPart, Part
from pbmpm.lab.simulation import RunSettings, Simulation

VALID: dict[str, Any] = {
    "format": "pbmpm-scene",
    "version": 1,
    "name": "test",
    "dimension": 2,
    "cell_size": 0.1,
    "gravity": [0, -9.81],
    "seconds": 1,
    "domain": {"min": [0, 0], "max": [1, 1]},
    "materials": {"water": {"kind": "liquid"}},
    "fills": [{"shape": {"kind": "box", "position": [0.5, 0.5], "half_extents": [0.2, 0.2]}, "material": "water"}],
}


PLANE: dict[str, Any] = {"kind": "plane", "position": [0, 0], "normal": [0, 1]}
BALL: dict[str, Any] = {"kind": "sphere", "position": [0.5, 0.5], "radius": 0.1}
EMITTER: dict[str, Any] = {
    "shape": {"kind": "sphere", "position": [0.5, 0.8], "radius": 0.1},
    "material": "water",
    "rate": 0.05,
}


def changed(path: str, value: Any) -> dict[str, Any]:
    """The valid scene with one field set; the path is written with dots."""
    data = copy.deepcopy(VALID)
    *way, last = path.split(".")
    place: Any = data
    for step in way:
        place = place[int(step)] if isinstance(place, list) else place[step]
    place[last] = value
    return data


def test_defaults() -> None:
    scene = parse_scene(VALID)
    assert (scene.rate_hz, scene.substeps, scene.iterations) == (60.0, 1, 5)
    assert scene.materials["water"].volume_feedback == 0.1
    assert scene.fills[0].particles_per_axis == 2.0
    assert (scene.solver.flip, scene.materials["water"].bulk_modulus) == (0.0, 0.0)  # for the solver see test_defaults.py
    assert scene.picture_times(4.0) == [0.0, 1.0, 2.0, 3.0, 4.0]


@pytest.mark.parametrize(
    ("path", "value", "named", "said"),
    [
        ("foo", 1, "foo", "unknown field"),
        ("materials.water.densty", 3, "materials.water.densty", "unknown field"),
        ("materials.water.density", -3, "materials.water.density", "greater than"),
        ("materials.water.relaxation", 2.0, "materials.water.relaxation", "less than 2"),
        ("materials.water.kind", "snow", "materials.water", "'snow'"),
        ("materials.water.bulk_modulus", 1e-6, "materials.water.bulk_modulus", "0.001"),
        ("materials.water.young_modulus", 1e6, "materials.water.young_modulus", "unknown field"),
        ("solver", {"solver": "newton"}, "solver.solver", "'paper'"),
        ("solver", {"flip": 1.5}, "solver.flip", "less than or equal to 1"),
        ("gravity", [0, 0, 1], "gravity", "needs 2 numbers"),
        ("gravity", [0, math.nan], "gravity[1]", "finite"),
        ("rate_hz", "60", "rate_hz", "valid number"),
        ("iterations", True, "iterations", "valid integer"),
        ("seconds", 0, "seconds", "greater than 0"),
        ("fills.0.material", "oil", "fills[0].material", "'oil'"),
        ("fills.0.shape.radius", 1, "fills[0].shape.radius", "unknown field"),
        ("fills.0.shape.half_extents", [0, 1], "fills[0].shape.half_extents[0]", "greater than 0"),
        ("fills.0.shape.rotation", [0, 0, 0, 1], "fills[0].shape.rotation", "angle"),
        ("domain.max", [0.2, 1], "domain.max[0]", "4 cells"),
        (
            "colliders",
            [{"shape": {"kind": "plane", "position": [0, 0], "normal": [0, 0]}}],
            "colliders[0].shape.normal",
            "zero",
        ),
        ("colliders", [{"shape": BALL, "body": {"mass": 1, "slides": [1, 0, 0]}}], "colliders[0].body.slides", "needs 2 numbers"),
        ("colliders", [{"shape": BALL, "body": {"mass": 1, "moves": False, "pivot": [0, 0, 0]}}], "colliders[0].body.pivot", "needs 2 numbers"),
        ("fills", [], "fills", "a fill or an emitter"),
        ("emitters", [EMITTER | {"rate": -1}], "emitters[0].rate", "greater than or equal to 0"),
        ("emitters", [EMITTER | {"material": "oil"}], "emitters[0].material", "'oil'"),
        ("emitters", [EMITTER | {"direction": [0, 0]}], "emitters[0].direction", "zero"),
        ("emitters", [EMITTER | {"direction": [0, 0, 1]}], "emitters[0].direction", "needs 2 numbers"),
        ("emitters", [EMITTER | {"start": 2, "stop": 1}], "emitters[0]", "stop must be after start"),
        ("emitters", [EMITTER | {"shape": PLANE}], "emitters[0].shape", "'plane'"),
        ("emitters", [EMITTER | {"budget": 1.5}], "emitters[0].budget", "valid integer"),
        ("drains", [{"shape": PLANE, "material": "oil"}], "drains[0].material", "'oil'"),
        ("drains", [{"shape": PLANE, "rate": 1}], "drains[0].rate", "unknown field"),
        ("kill_bounds", {"min": [0, 0], "max": [1, 0]}, "kill_bounds.max", "above"),
        ("kill_bounds", {"min": [0, 0, 0], "max": [1, 1]}, "kill_bounds.min", "needs 2 numbers"),
        ("forces", [{"kind": "push"}], "forces[0].kind", "'radial'"),
        ("forces", [{"kind": "drag", "strength": -1}], "forces[0]", "must not be negative"),
        ("forces", [{"kind": "radial", "falloff": "inverse_square"}], "forces[0]", "range"),
        ("forces", [{"kind": "uniform", "direction": [0, 0]}], "forces[0].direction", "zero"),
        ("capacity", 0, "capacity", "greater than or equal to 1"),
        ("pictures", {"times": [-1]}, "pictures.times[0]", "greater than or equal to 0"),
        ("name", "../evil", "name", "pattern"),
    ],
)
def test_error_names_the_field(path: str, value: Any, named: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_scene(changed(path, value), "file.json")
    message = str(caught.value)
    assert f"file.json: {named}: " in message
    assert said in message


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"[" * 100_000, "nested too deeply"),
        (b'{"a":' * 100_000, "nested too deeply"),
        (b'{"seconds": ' + b"9" * 5000 + b"}", "cannot be read"),
        (b'{"name": "\xff"}', "not a text file"),
        (b"{", "scene.json:1:2: not JSON"),
        (b"", "the file is empty"),
        (b" \n", "the file is empty"),
    ],
)
def test_files_that_are_no_json(tmp_path: Path, text: bytes, said: str) -> None:
    path = tmp_path / "scene.json"
    path.write_bytes(text)
    with pytest.raises(InputError, match=said):
        load_scene(path)


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("fils", [], "fils: unknown field; did you mean 'fills'?"),
        ("solver", {"integratr": "bdf2"}, "solver.integratr: unknown field; did you mean 'integrator'?"),
        ("colour", "speed", "colour: unknown field here; it belongs to the scene's pictures"),
        ("materials.water", {"density": 1}, "materials.water: the field 'kind' is missing"),
        ("pictures", {"times": [0.5, 1.5]}, "pictures.times: 1.5 s is after the end of the scene at 1 s"),
        ("solver", "primel", "did you mean 'primal'?"),
        ("solver", {"solver": "Dual"}, "did you mean 'dual'?"),
        ("materials.water.kind", "fluid", "'fluid' is not one of"),
        ("materials.water.kind", "liqid", "did you mean 'liquid'?"),
        ("zzz", 1, "zzz: unknown field$"),
    ],
)
def test_misspelt_words_get_a_suggestion(path: str, value: object, said: str) -> None:
    with pytest.raises(InputError, match=said.replace("?", r"\?")):
        parse_scene(changed(path, value))


def test_a_solver_may_stand_by_its_name() -> None:
    assert parse_scene(changed("solver", "primal")).solver == parse_scene(changed("solver", {"solver": "primal"})).solver


def test_the_world_gets_what_the_scene_says() -> None:
    data = changed("materials", {"gel": {"kind": "elastic", "elastic_model": "neo_hookean", "poisson_ratio": 0.4}})
    data["fills"][0]["material"] = "gel"
    data["solver"] = {"solver": "primal", "integrator": "bdf2", "target_error": 0.01}
    scene = parse_scene(data)
    with Simulation(scene, RunSettings.of(scene, 1, iterations=7)) as simulation:
        world = simulation.world
        assert (world.solver, world.integrator) == (pbmpm.Solver.PRIMAL, pbmpm.Integrator.BDF2)
        assert (world.target_error, world.iterations, world.threads) == (0.01, 7, 1)


@pytest.mark.parametrize("field", ["dimension", "cell_size", "gravity", "seconds", "materials", "name"])
def test_required_fields(field: str) -> None:
    data = {key: value for key, value in VALID.items() if key != field}
    with pytest.raises(InputError, match=rf"{field}: this field is required"):
        parse_scene(data)


def test_all_errors_are_told_at_once() -> None:
    data = changed("foo", 1)
    data["seconds"] = -1
    with pytest.raises(InputError) as caught:
        parse_scene(data)
    assert "foo: unknown" in str(caught.value) and "seconds: " in str(caught.value)


def test_degrees_are_recognised() -> None:
    """More than a whole turn of a shape; keyframes may turn on and on."""
    data = changed("colliders", [{"shape": {"kind": "box", "position": [0.5, 0.2], "half_extents": [0.2, 0.1], "rotation": -20}}])
    with pytest.raises(InputError, match=r"rotation: an angle in radians, at most a whole turn; -20 degrees are -0.3491"):
        parse_scene(data)
    data["colliders"][0]["shape"]["rotation"] = -0.35
    data["colliders"][0]["motion"] = {"keyframes": [{"time": 0, "position": [0.5, 0.2]}, {"time": 9, "position": [0.5, 0.2], "rotation": 20}]}
    assert parse_scene(data).colliders[0].motion.keyframes[1].rotation == 20


def test_3d_wants_quaternions() -> None:
    data = changed("dimension", 3)
    data["gravity"], data["domain"] = [0, -9.81, 0], {"min": [0, 0, 0], "max": [1, 1, 1]}
    data["fills"][0]["shape"] = {"kind": "box", "position": [0.5] * 3, "half_extents": [0.2] * 3, "rotation": 0.3}
    with pytest.raises(InputError, match=r"fills\[0\].shape.rotation: in 3D this is a quaternion"):
        parse_scene(data)
    data["fills"][0]["shape"]["rotation"] = [0, 0, 0, 1]
    assert parse_scene(data).fills[0].shape.rotation == [0, 0, 0, 1]


@pytest.mark.parametrize(("text", "said"), [("{", "not JSON"), ("[1]", "'format'"), ('{"format": "x"}', "'format'")])
def test_not_a_scene(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "scene.json"
    path.write_text(text)
    with pytest.raises(InputError, match=said) as caught:
        load_scene(path)
    assert "scene.json" in str(caught.value)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none.json: there is no such file"):
        load_scene(tmp_path / "none.json")
    with pytest.raises(InputError, match="is a folder, not a file"):
        load_scene(tmp_path)
    with pytest.raises(InputError, match="scene.yaml: this is YAML; scenes and presets are JSON"):
        load_scene(tmp_path / "scene.yaml")


def test_sample_scenes_are_valid_and_named_like_their_files(root: Path) -> None:
    files = sorted((root / "samples" / "scenes").glob("*.json"))
    assert len(files) >= 7
    for path in files:
        assert load_scene(path).name == path.stem


def test_every_sample_is_in_the_readme(root: Path) -> None:
    text = (root / "samples" / "scenes" / "README.md").read_text()
    for path in (root / "samples" / "scenes").glob("*.json"):
        assert f"`{path.name}`" in text


def test_every_field_is_in_the_readme(root: Path) -> None:
    text = (root / "samples" / "scenes" / "README.md").read_text(encoding="utf-8")
    parts, missing = [Part], set[str]()
    while parts:
        part = parts.pop()
        parts += part.__subclasses__()
        if part.__module__.endswith("scenes.scene"):
            missing |= {f"{part.__name__}.{name}" for name in part.model_fields if f"`{name}`" not in text}
    assert missing == set()


def motion(**fields: Any) -> MotionPart:
    frames = [{"time": 1.0, "position": [0, 0]}, {"time": 2.0, "position": [2, 0], "rotation": 1.0}]
    return MotionPart.model_validate({"keyframes": frames, **fields})


@pytest.mark.parametrize(
    ("time", "repeat", "x"),
    [(0.0, False, 0), (1.25, False, 0.5), (9.0, False, 2), (2.25, True, 0.5), (3.75, True, 1.5)],
)
def test_motion_is_linear_held_or_repeated(time: float, repeat: bool, x: float) -> None:
    position, rotation = pose_at(motion(repeat=repeat), time)
    assert position == pytest.approx([x, 0, 0])
    assert rotation == pytest.approx(quaternion(x / 2))


def test_rotation_between_quaternions_takes_the_short_way() -> None:
    half = math.sqrt(0.5)
    frames = [
        {"time": 0.0, "position": [0, 0, 0], "rotation": [0.0, 0, 0, 1]},
        {"time": 1.0, "position": [0, 0, 0], "rotation": [0, 0, -half, -half]},
    ]
    _, rotation = pose_at(MotionPart.model_validate({"keyframes": frames}), 0.5)
    turned = rotation_matrix(rotation) @ np.array([1.0, 0, 0])
    assert turned == pytest.approx([math.cos(math.pi / 4), math.sin(math.pi / 4), 0])


def test_keyframes_must_rise() -> None:
    collider = {
        "shape": {"kind": "box", "position": [0, 0], "half_extents": [1, 1]},
        "motion": {"keyframes": [{"time": 1, "position": [0, 0]}, {"time": 1, "position": [0, 0]}]},
    }
    with pytest.raises(InputError, match=r"colliders\[0\].motion: the times of the keyframes must rise"):
        parse_scene(changed("colliders", [collider]))


def test_a_scene_survives_its_own_dump() -> None:
    scene = parse_scene(changed("materials", {"water": {"kind": "liquid"}, "jelly": {"kind": "elastic"}}))
    assert parse_scene(json.loads(scene.model_dump_json(exclude_none=True))) == scene


def _start(scene: dict[str, Any]) -> Simulation:
    parsed = parse_scene(scene)
    return Simulation(parsed, RunSettings.of(parsed))


def test_friction_may_be_a_number() -> None:
    scene = parse_scene(changed("colliders", [{"shape": PLANE, "friction": 0.7}, {"shape": PLANE, "friction": "stick"}]))
    assert [(part.friction, part.friction_coefficient) for part in scene.colliders] == [("coulomb", 0.7), ("stick", 0.2)]
    for wrong, said in (({"friction": -1}, "friction_coefficient"), ({"friction": 0.7, "friction_coefficient": 0.2}, "is there as well"), ({"friction": True}, "friction")):
        with pytest.raises(InputError, match=said):
            parse_scene(changed("colliders", [{"shape": PLANE, **wrong}]))


def test_fills_leave_out_what_is_in_an_obstacle() -> None:
    scene = copy.deepcopy(VALID)
    scene["colliders"] = [{"shape": {"kind": "box", "position": [0.5, 0.5], "half_extents": [0.1, 0.1]}}]
    with _start(VALID) as whole, _start(scene) as around:
        assert around.start_count == whole.start_count - 16  # 4 cells of 4
        assert np.all(np.abs(around.world.positions.array() - 0.5).max(axis=1) > 0.0999)


def test_an_obstacle_acts_on_the_materials_that_it_names() -> None:
    scene = copy.deepcopy(VALID)
    scene["materials"]["jelly"] = {"kind": "elastic"}
    scene["fills"] = [
        {"shape": {"kind": "box", "position": [x, 0.7], "half_extents": [0.15, 0.1]}, "material": name}
        for x, name in ((0.25, "water"), (0.75, "jelly"))
    ]
    scene["colliders"] = [{"shape": {"kind": "box", "position": [0.5, 0.4], "half_extents": [0.6, 0.1]}, "meets": ["jelly"]}]
    with _start(scene) as run:
        assert [it.meets for it in run.colliders] == [run.materials["jelly"].parameters.groups]
        for _ in range(90):
            run.step()
        heights = {name: run.world.positions.array()[run.world.material_indices.array() == it.index, 1] for name, it in run.materials.items()}
    assert heights["water"].mean() < 0.3
    assert heights["jelly"].min() > 0.45  # half a cell into the surface at most


def test_materials_that_are_met_have_to_be_there() -> None:
    scene = copy.deepcopy(VALID)
    scene["colliders"] = [{"shape": PLANE, "meets": ["oil"]}]
    with pytest.raises(InputError, match=r"colliders\[0\]\.meets: no material is called 'oil' \(there are: water\)"):
        parse_scene(scene)
    scene["materials"] = {f"m{i}": {"kind": "liquid"} for i in range(33)}
    scene["fills"][0]["material"] = "m0"
    scene["colliders"][0]["meets"] = ["m32"]
    with pytest.raises(InputError, match="32 materials at most"):
        parse_scene(scene)
    scene["colliders"][0]["meets"] = []
    with pytest.raises(InputError, match=r"colliders\[0\]\.meets"):
        parse_scene(scene)
