"""The command as a user calls it: runs, reports, files, exit codes."""

from __future__ import annotations

import copy
import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import plyfile
import pytest

from pbmpm.lab.errors import InputError
from pbmpm.lab.scenes.preset import Preset, PresetSettings, load_preset, save_preset
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.simulation import RunSettings, Simulation
from pbmpm.settings import DEFAULTS

SCENE: dict[str, Any] = {
    "format": "pbmpm-scene",
    "version": 1,
    "name": "small",
    "dimension": 2,
    "cell_size": 0.1,
    "gravity": [0, -9.81],
    "domain": {"min": [0, 0], "max": [2, 1.5]},
    "seconds": 0.5,
    "rate_hz": 60,
    "iterations": 3,
    "materials": {"water": {"kind": "liquid"}, "jelly": {"kind": "elastic"}},
    "fills": [
        {"shape": {"kind": "box", "position": [0.5, 0.5], "half_extents": [0.5, 0.5]}, "material": "water"},
        {"shape": {"kind": "sphere", "position": [1.5, 0.8], "radius": 0.2}, "material": "jelly", "velocity": [-1, 0]},
    ],
    "colliders": [
        {
            "shape": {"kind": "box", "position": [1.9, 0.1], "half_extents": [0.05, 0.2]},
            "motion": {"keyframes": [{"time": 0, "position": [1.9, 0.1]}, {"time": 0.5, "position": [1.6, 0.1]}]},
        }
    ],
}


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    path = tmp_path / "small.json"
    path.write_text(json.dumps(SCENE))
    return path


def pbmpm_command(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pbmpm", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=300, check=False)


def report_of(*arguments: object, cwd: Path | None = None) -> dict[str, Any]:
    done = pbmpm_command(*arguments, "--json", "-", cwd=cwd)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_report(scene_file: Path) -> None:
    report = report_of("run", scene_file, "--warmup-steps", 10)
    assert report["steps"] == 30 and report["steps_timed"] == 20
    assert report["simulated_seconds"] == pytest.approx(0.5)
    assert (report["rate_hz"], report["iterations"], report["substeps"]) == (60, 3, 1)
    assert report["particles"] == report["particles_at_start"] > 400
    assert report["mass"] == pytest.approx(report["mass_at_start"])
    assert report["finite"] is True and report["problems"] == [] and report["deleted"] == 0
    assert report["million_particle_iterations_per_cpu_second"] > 0
    assert report["ms_per_simulated_second"] > 0 and report["million_particle_iterations_per_second"] > 0
    assert set(report["ms_per_step_by_phase"]) == {"sort", "scatter", "contacts", "iterate", "integrate"}
    assert report["machine"]["isa"] and report["machine"]["date"]
    assert len(report["hash"]) == 16


def test_options_override_the_scene(scene_file: Path) -> None:
    options = ("--seconds", 0.2, "--rate", 120, "--iterations", 2, "--substeps", 2)
    report = report_of("run", scene_file, *options)
    assert (report["rate_hz"], report["iterations"], report["substeps"], report["steps"]) == (120, 2, 2, 24)


def test_solver_options_and_presets(scene_file: Path, tmp_path: Path) -> None:
    """A preset goes before the scene, an option before the preset."""
    settings = PresetSettings(rate_hz=30.0, solver="explicit", flip=0.5, target_error=0.25)
    save_preset(Preset(name="medium", scene="small", settings=settings, ms_median=1.5), tmp_path / "medium.json")
    assert load_preset(tmp_path / "medium.json").settings == settings
    assert json.loads((tmp_path / "medium.json").read_text())["settings"].keys() == settings.changes().keys()
    options = ("--preset", tmp_path / "medium.json", "--solver", "paper", "--flip", 0, "--seconds", 0.1)
    report = report_of("run", scene_file, *options)
    assert (report["rate_hz"], report["iterations"], report["solver"]) == (30, 3, "paper")
    assert (report["flip"], report["target_error"], report["pressure"]) == (0, 0.25, "particles")
    assert report["iterations_used"] == 3 and report["stops"] == {"iterations": 3}


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ('{"format": "pbmpm-scene"}', "not a preset"),
        ('{"format": "pbmpm-preset", "name": "x", "scene": "s", "settings": {"iterations": 0}}', "settings.iterations"),
        ('{"format": "pbmpm-preset", "name": "x", "scene": "s", "settings": {"gravity": 1}}', "settings.gravity"),
    ],
)
def test_a_bad_preset_is_refused_by_field(tmp_path: Path, content: str, said: str) -> None:
    (tmp_path / "preset.json").write_text(content)
    with pytest.raises(InputError, match=said):
        load_preset(tmp_path / "preset.json")


def test_same_hash_for_any_number_of_threads(scene_file: Path) -> None:
    hashes = {report_of("run", scene_file, "--threads", threads)["hash"] for threads in (1, 2, 3)}
    assert len(hashes) == 1


def test_files(scene_file: Path, tmp_path: Path) -> None:
    options = ("--output", tmp_path / "out", "--ply", "--vtk", "--every", 10, "--pictures", "0,0.25,0.5")
    done = pbmpm_command("run", scene_file, *options, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert all(line.startswith(("advice: ", "came true at ")) for line in done.stderr.splitlines())  # no progress bar away from a terminal
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    expected = [f"small_{i:05d}.{kind}" for i in range(4) for kind in ("ply", "vtu")]
    expected += [f"small_t{t}.png" for t in ("000.000", "000.250", "000.500")]
    assert names == sorted([*expected, "small.pvd", "small_run.json"])
    sidecar = json.loads((tmp_path / "out/small_run.json").read_text())
    assert sidecar["status"] == "complete"
    assert [entry["time"] for entry in sidecar["frames"]] == pytest.approx([0, 1 / 6, 1 / 3, 0.5])
    assert sidecar["scene"]["name"] == "small" and sidecar["seeds"] == [1, 1]
    assert sidecar["materials"] == ["water", "jelly"]
    assert sidecar["settings"].items() >= {"rate_hz": 60, "substeps": 1, "iterations": 3, "solver": DEFAULTS.solver.name.lower()}.items()


def test_identities_last_over_a_run(scene_file: Path, tmp_path: Path) -> None:
    pbmpm_command("run", scene_file, "--output", tmp_path / "out", "--ply", "--every", 30)
    tables = [plyfile.PlyData.read(str(tmp_path / f"out/small_{i:05d}.ply"))["vertex"].data for i in (0, 1)]
    material = [{(i, g): m for i, g, m in t[["id", "generation", "material"]].tolist()} for t in tables]
    assert len(material[0]) == len(tables[0])
    assert material[0] == material[1]
    assert set(material[0].values()) == {0, 1}


def test_nothing_is_written_without_being_asked(scene_file: Path, tmp_path: Path) -> None:
    report_of("run", scene_file, "--seconds", 0.1, cwd=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["small.json"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("run", "none.json"), "none.json: there is no such file"),
        (("run", "small.json", "--rate", "0"), "--rate"),
        (("run", "small.json", "--solver", "newton"), "--solver"),
        (("run", "small.json", "--solver", "dula"), "did you mean 'dual'?"),
        (("run", "small.json", "--json", "."), ".: is a folder"),
        (("run", "small.json", "--json", "small.json/a.json"), "small.json: is a file, not a folder"),
        (("run", "small.json", "--output", "small.json"), "small.json: is a file, not a folder"),
        (("run", "small.json", "--preset", "none.json"), "none.json: there is no such file"),
        (("advice", "small.json", "--preset", "none.json"), "none.json: there is no such file"),
        (("run", "small.json", "--rate", "fast"), "'fast' is not a valid number"),
        (("run", "small.json", "--rate", "nan"), "'nan' is not a valid number"),
        (("run", "small.json", "--iterations", "2.5"), "'2.5' is not a valid whole number"),
        (("run", "small.json", "--seconds", "-1"), "--seconds"),
        (("run", "small.json", "--pictures", "0,x"), "not a list of times"),
        (("run", "small.json", "--pictures", "9"), "9 s is after the end"),
        (("run", "small.json", "--warmup-steps", "30"), "leaves no step"),
        (("run", "small.json", "--nonsense"), "--nonsense"),
        (("run", "bad.json"), "bad.json: fills[0].shape.half_extents"),
        (("run", "empty.json"), "no point of its lattice"),
        (("accuracy", "quicksand"), "quicksand"),
        (("accuracy", "colunm"), "did you mean 'column'?"),
        (("stability", "h33"), "there is no hard case"),
        (("accuracy", "column", "--rates", "a"), "not a list of numbers"),
    ],
)
def test_bad_input_is_exit_code_2(scene_file: Path, tmp_path: Path, arguments: tuple[str, ...], said: str) -> None:
    bad = copy.deepcopy(SCENE)
    bad["fills"][0]["shape"]["half_extents"] = [1]
    (tmp_path / "bad.json").write_text(json.dumps(bad))
    bad["fills"][0]["shape"] = {"kind": "sphere", "position": [9, 9], "radius": 0.2}
    (tmp_path / "empty.json").write_text(json.dumps(bad))
    done = pbmpm_command(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_ctrl_c_leaves_complete_files(scene_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    command = [
        sys.executable,
        "-m",
        "pbmpm",
        "run",
        str(scene_file),
        "--seconds",
        "1000",
        "--ply",
        "--pictures",
        "",
        "--output",
        str(out),
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + 60
        while not (out / "small_00003.ply").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    sidecar = json.loads((out / "small_run.json").read_text())
    assert sidecar["status"] == "interrupted" and sidecar["report"]["interrupted"] is True
    assert {path.name for path in out.iterdir()} == {"small_run.json", *(entry["ply"] for entry in sidecar["frames"])}
    for entry in sidecar["frames"]:
        assert len(plyfile.PlyData.read(str(out / entry["ply"]))["vertex"].data) == entry["particles"]


def test_a_particle_lost_without_a_word_is_a_failed_check() -> None:
    with Simulation(parse_scene(SCENE), RunSettings(60.0, 1, 3, 1)) as simulation:
        simulation.step()
        assert simulation.problems() == []
        simulation.world.remove(simulation.frame().ids[:2])
        assert simulation.problems() == ["2 particles are gone, but the library reports 0 deletions"]


def ea_scene(material: str) -> dict[str, Any]:
    shape = {"position": {"x": 200, "y": 250}, "halfSize": {"x": "120", "y": "100"}, "rotation": 0, "shape": "0"}
    return {"version": 2, "resolution": [800, 400], "shapes": [{**shape, "function": "3", "emitMaterial": material}]}


def test_ea_scene_runs_and_reports_its_notes(tmp_path: Path) -> None:
    data = ea_scene("0")
    data["settings"] = [{"name": "renderMode", "value": "0"}]
    (tmp_path / "demo.json").write_text(json.dumps(data))
    report = report_of("run", tmp_path / "demo.json", "--seconds", 0.2)
    assert report["rate_hz"] == 240 and report["problems"] == []
    assert any("renderMode" in note for note in report["notes"])


def test_ea_scene_with_sand_and_an_emitter_runs(tmp_path: Path) -> None:
    data = ea_scene("2")
    data["shapes"].append({**data["shapes"][0], "function": "0", "emitMaterial": "0", "emissionRate": "20"})
    (tmp_path / "demo.json").write_text(json.dumps(data))
    report = report_of("run", tmp_path / "demo.json", "--seconds", 0.2)
    assert report["problems"] == [] and report["effects"] == ["liquid", "sand", "viscosity", "volume_feedback", "emitters"]
    assert report["emitted"] + report["refused"] > 0
