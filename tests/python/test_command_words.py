"""What a person who mistypes is told: by the command, and by the binding."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import pbmpm
from pbmpm.lab.commands.cli import cli
from pbmpm.lab.errors import InputError
from pbmpm.lab.scenes.preset import Preset, PresetSettings, save_preset
from pbmpm.lab.stability.cases import find_case


def said(*words: object) -> str:
    """What `pbmpm` says to a command line that it cannot use."""
    result = CliRunner().invoke(cli, [str(word) for word in words])
    assert result.exit_code != 0
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        assert isinstance(result.exception, InputError), result.exception
        return str(result.exception)
    return result.output


@pytest.fixture
def scene(root: Path, tmp_path: Path) -> Callable[[Callable[[Any], None]], Path]:
    """A scene file that somebody has changed."""

    def changed(change: Callable[[Any], None]) -> Path:
        data = json.loads((root / "samples" / "scenes" / "column_2d.json").read_text(encoding="utf-8"))
        change(data)
        path = tmp_path / "mine.json"
        path.write_text(json.dumps(data), encoding="utf-8")
        return path

    return changed


WRONG_WORDS: dict[str, tuple[Callable[[Any], None], str]] = {
    "solver": (lambda data: data.update(solver="duel"), "solver: 'duel' is not one of 'paper', 'dual', 'primal', 'explicit' or 'convergent'; did you mean 'dual'?"),
    "field": (lambda data: data.update(gravtiy=[0, -9]), "gravtiy: unknown field; did you mean 'gravity'?"),
    "beginning": (lambda data: data.update(kill={"min": [0, 0]}), "kill: unknown field; did you mean 'kill_bounds'?"),
    "kind": (lambda data: data["materials"]["water"].update(kind="liqid"), "did you mean 'liquid'?"),
    "parameter": (lambda data: data["materials"]["water"].update(denisty=3), "materials.water.denisty: unknown field; did you mean 'density'?"),
    "order of parts": (lambda data: data["materials"]["water"].update(viscosity_kinematic=3), "viscosity_kinematic: unknown field; did you mean 'kinematic_viscosity'?"),
    "material": (lambda data: data["fills"][0].update(material="watr"), "no material is called 'watr' (there are: water); did you mean 'water'?"),
    "effect": (lambda data: data.update(effects=["emiters"]), "did you mean 'emitters'?"),
    "extents": (lambda data: data["fills"][0]["shape"].update(half_extents=0.2), "fills[0].shape.half_extents: needs 2 numbers in brackets, one per axis"),
    "extent": (lambda data: data["fills"][0]["shape"].update(half_extents=[0.1]), "fills[0].shape.half_extents: needs 2 numbers in brackets, one per axis"),
    "dimension": (lambda data: data.update(dimension=4), "dimension: 4 is not one of 2 or 3"),
    "word for a number": (lambda data: data.update(cell_size="wide"), 'cell_size: must be a valid number, not "wide"'),
    "number out of range": (lambda data: data.update(cell_size=-1), "cell_size: must be greater than or equal to 0.000001, not -1"),
    "broken number": (lambda data: data.update(iterations=2.5), "iterations: must be a valid integer, not 2.5"),
}


@pytest.mark.parametrize("name", WRONG_WORDS)
def test_a_misspelt_word_of_a_scene_gets_a_suggestion(scene: Callable[..., Path], name: str) -> None:
    change, text = WRONG_WORDS[name]
    heard = said("run", scene(change))
    assert text in heard and "Input should be" not in heard


def test_a_mesh_that_is_not_there_is_said_in_plain_words(scene: Callable[..., Path], tmp_path: Path) -> None:
    mesh = {"kind": "mesh", "position": [0, 0], "file": "boat.obj"}
    heard = said("run", scene(lambda data: data.update(colliders=[{"shape": mesh}])))
    assert f"column_2d: colliders[0].shape: {tmp_path / 'boat.obj'}: there is no such file" in heard


def test_a_fill_that_has_no_room_says_how_much_it_needs(scene: Callable[..., Path]) -> None:
    heard = said("run", scene(lambda data: data.update(capacity=100)))
    assert "column_2d: fills[0]: no room for" in heard
    assert "0 of 100 in use; make the world with a capacity of at least" in heard


def test_a_file_that_is_not_there_gets_a_suggestion(scene: Callable[..., Path], root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    beside = scene(lambda data: None)
    wrong = beside.with_name(f"{beside.stem[:-1]}{beside.suffix}")
    assert f"{wrong}: there is no such file; did you mean '{beside}'?" in said("run", wrong)
    monkeypatch.chdir(root)
    assert "did you mean 'samples/scenes/glass_jelly_3d.json'?" in said("run", "glass_jelly")
    assert "there is no such file" in said("run", "qqqq") and "did you mean" not in said("run", "qqqq")


def test_an_effect_that_is_not_there_gets_a_suggestion(root: Path) -> None:
    assert "did you mean 'emitters'?" in said("effects", root / "samples" / "scenes" / "column_2d.json", "--only", "emiters")


@pytest.mark.parametrize("word", ["H3", "h03", "H03"])
def test_a_hard_case_needs_no_zero(word: str) -> None:
    assert find_case(word).id == "H03"


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (("run", "--json"), "mine/figures.json"),
        (("run", "--video"), "mine/run.gif"),
        (("run", "--output"), "mine/files"),
        (("effects", "--chart"), "mine/chart.png"),
        (("effects", "--json"), "mine/figures.json"),
        (("tune", "--budget-ms", "4", "--output"), "mine/tuned"),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else "",
)
def test_output_paths_are_tried_before_any_work(root: Path, tmp_path: Path, words: tuple[str, ...], what: str) -> None:
    """Where a file is in the way of a folder, its name is said and no step is made."""
    (tmp_path / "mine").write_text("a file")
    command, *options = words
    heard = said(command, root / "samples" / "scenes" / "column_2d.json", *options, tmp_path / what)
    assert f"{tmp_path / 'mine'}: is a file, not a folder" in heard
    assert ".part" not in heard


def test_a_command_that_fails_leaves_no_empty_folder(tmp_path: Path) -> None:
    assert "did you mean" not in said("run", tmp_path / "qqqq.json", "--output", tmp_path / "qqqr.json" / "inner")
    assert list(tmp_path.iterdir()) == []


def test_a_video_is_named_as_what_it_is(root: Path, tmp_path: Path) -> None:
    assert "run.mp4: its name has to end in .gif" in said("run", root / "samples" / "scenes" / "column_2d.json", "--video", tmp_path / "run.mp4")


def test_the_default_folder_of_presets_is_tried_before_any_work(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("column_2d-tune").write_text("a file")
    assert "column_2d-tune: is a file, not a folder" in said("tune", root / "samples" / "scenes" / "column_2d.json", "--budget-ms", "4")


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: pbmpm.Elastic(youngs_modulus=1e5), "Elastic has no parameter 'youngs_modulus'; did you mean 'young_modulus'?"),
        (lambda: pbmpm.Liquid(denisty=1e3), "Liquid has no parameter 'denisty'; did you mean 'density'?"),
        (lambda: pbmpm.Sand(friction=0.5), "Sand has no parameter 'friction'; did you mean 'friction_angle'?"),
        (lambda: pbmpm.Box((0, 0), half_extent=(1, 1)), "Box has no parameter 'half_extent'; did you mean 'half_extents'?"),
        (lambda: pbmpm.Box((0, 0), h=(1, 1)), "Box has no parameter 'h'; it has position, half_extents, rotation"),
        (lambda: pbmpm.World(2, 0.1, gravtiy=(0, -9.81)), "World has no parameter 'gravtiy'; did you mean 'gravity'?"),
    ],
    ids=["Elastic", "Liquid", "Sand", "Box", "short", "World"],
)
def test_a_misspelt_parameter_gets_a_suggestion(make: Callable[[], object], text: str) -> None:
    with pytest.raises(TypeError) as caught:
        make()
    assert str(caught.value) == text


def test_what_is_spelt_right_is_as_before() -> None:
    assert pbmpm.Elastic(young_modulus=2e5).young_modulus == 2e5
    assert pbmpm.Box((0, 0), (1, 1)) == pbmpm.Box(position=(0, 0), half_extents=(1, 1))
    with pytest.raises(TypeError, match="positional"):
        pbmpm.Box()  # type: ignore[call-arg]


def test_advice_tells_without_a_step_what_a_run_tells_before_it(scene: Callable[..., Path]) -> None:
    path = str(scene(lambda data: None))
    asked = CliRunner().invoke(cli, ["advice", path, "--rate", "60"]).output.splitlines()
    ran = CliRunner().invoke(cli, ["run", path, "--rate", "60", "--seconds", "0.05"])
    assert asked and [f"advice: {line}" for line in asked] == ran.stderr.splitlines()[: len(asked)]
    report = json.loads(CliRunner().invoke(cli, ["advice", path, "--rate", "60", "--json", "-"]).stdout)
    assert [row["text"] in line for row, line in zip(report["advice"], asked, strict=True)] == [True] * len(asked)


def test_advice_takes_a_preset(scene: Callable[..., Path], tmp_path: Path) -> None:
    path, preset = str(scene(lambda data: None)), tmp_path / "p.json"
    save_preset(Preset(name="p", scene="s", settings=PresetSettings(rate_hz=60.0), ms_median=1.0), preset)
    asked, with_it = (CliRunner().invoke(cli, ["advice", path, *options]).output for options in (("--rate", "60"), ("--preset", str(preset))))
    assert with_it == asked
    assert CliRunner().invoke(cli, ["advice", path, "--preset", str(preset), "--solver", "convergent", "--rate", "240"]).output.startswith("nothing is foreseen")


def test_advice_says_where_nothing_is_foreseen(scene: Callable[..., Path]) -> None:
    told = CliRunner().invoke(cli, ["advice", str(scene(lambda data: None)), "--solver", "convergent", "--rate", "240"])
    assert told.exit_code == 0 and told.output.startswith("nothing is foreseen")
