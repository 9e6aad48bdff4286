"""Tuning of small scenes. Nothing here depends on how fast the machine is, but for budgets that anything or nothing fits."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pbmpm.lab.scenes.preset import load_preset
from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.scenes.scene import Scene
from pbmpm.lab.simulation import RunSettings
from pbmpm.lab.tune import candidates
from pbmpm.lab.tune.distance import distance
from pbmpm.lab.tune.observe import Observation, Sample, observe, sample_frames
from pbmpm.lab.tune.presets import presets
from pbmpm.lab.tune.report import closing_line, scatter, text_of
from pbmpm.lab.tune.sweep import Plan, Reference, Result, Tuning
from pbmpm.lab.tune.visible import visible

from progress_lines import without_progress

CELL = 0.05


def scene_data(**changes: Any) -> dict[str, Any]:
    """A small block of water at rest in a box."""
    data: dict[str, Any] = {
        "format": "pbmpm-scene",
        "version": 1,
        "name": "small",
        "dimension": 2,
        "cell_size": CELL,
        "gravity": [0, -10],
        "domain": {"min": [0, 0], "max": [0.8, 0.8]},
        "seconds": 0.3,
        "materials": {"water": {"kind": "liquid"}, "jelly": {"kind": "elastic"}},
        "fills": [{"shape": {"kind": "box", "position": [0.2, 0.2], "half_extents": [0.2, 0.2]}, "material": "water"}],
    }
    return {**data, **changes}


@pytest.fixture
def scene() -> Scene:
    return parse_scene(scene_data())


def state(positions: np.ndarray, kinetic_energy: float = 0.0, materials: Any = 0, crowding: float = 1.0) -> Sample:
    count = len(positions)
    ids = np.stack([np.arange(count), np.ones(count)], axis=1).astype(np.uint32)
    kinds = np.broadcast_to(np.asarray(materials, dtype=np.uint8), count)
    return Sample(0.0, ids, positions.astype(np.float32), kinds, kinetic_energy, 2.0, crowding)


def run(*samples: Sample) -> Observation:
    return Observation(RunSettings(60.0, 1, 5), list(samples), [1.0])


def test_distance_of_a_shifted_body_is_the_shift_in_cells(scene: Scene) -> None:
    cloud = np.random.default_rng(1).random((50, 2))
    parts = distance(scene, run(state(cloud + [2 * CELL, 0.0])), run(state(cloud)))
    assert parts.particles == pytest.approx(2.0, rel=1e-5)
    # All percentiles of one of two axes are off by 2 cells.
    assert parts.spread == pytest.approx(2.0 / np.sqrt(2), rel=1e-5)
    assert (parts.energy, parts.crowding) == (0.0, 0.0)


def test_particles_that_change_places_are_no_error_of_the_statistics(scene: Scene) -> None:
    cloud = np.random.default_rng(1).random((50, 2))
    parts = distance(scene, run(state(cloud[::-1])), run(state(cloud)))
    assert parts.particles is not None and parts.particles > 1.0
    assert parts.statistics == pytest.approx(0.0, abs=1e-12)


def test_energy_counts_as_a_height_of_fall(scene: Scene) -> None:
    """2 kg that fall 3 cells of 0.05 m at 10 m/s^2 have 3 J."""
    cloud = np.zeros((5, 2))
    assert distance(scene, run(state(cloud, 3.0)), run(state(cloud))).energy == pytest.approx(3.0)


def test_a_material_that_moves_is_not_hidden_by_one_that_rests(scene: Scene) -> None:
    cloud, kinds = np.zeros((1000, 2)), np.array([0] * 990 + [1] * 10)
    moved = cloud.copy()
    moved[990:] += CELL
    parts = distance(scene, run(state(moved, materials=kinds)), run(state(cloud, materials=kinds)))
    assert parts.spread == pytest.approx(np.sqrt(0.5), rel=1e-5)


def test_errors_are_root_mean_squares_over_time(scene: Scene) -> None:
    cloud = np.zeros((5, 2))
    parts = distance(scene, run(state(cloud + [CELL, 0]), state(cloud)), run(state(cloud), state(cloud)))
    assert parts.particles == pytest.approx(np.sqrt(0.5), rel=1e-5)


def test_distance_without_the_same_particles_has_no_field_error(scene: Scene) -> None:
    assert distance(scene, run(state(np.zeros((4, 2)))), run(state(np.zeros((5, 2))))).particles is None


def test_what_is_seen_is_the_top_that_is_farthest_off(scene: Scene) -> None:
    """Water stands half a cell too low, jelly a cell; both are 2 m high."""
    cloud, kinds = np.random.default_rng(1).random((4000, 2)) * [1.0, 2.0], np.array([0, 1] * 2000)
    moved = cloud - np.where(kinds == 1, CELL, CELL / 2)[:, None] * [0.0, 1.0]
    found = visible(scene, run(state(moved, materials=kinds)), run(state(cloud, materials=kinds)))
    assert found is not None and (found.material, found.solid) == ("jelly", True)
    assert found.cells == pytest.approx(-1.0, abs=1e-3) and found.share == pytest.approx(-CELL / 1.8, rel=0.03)
    assert found.text() == "jelly sags by 1 cells (2.8 %)"
    water = visible(scene, run(state(moved[::2])), run(state(cloud[::2])))
    assert water is not None and water.text().startswith("water stands 0.5 cells (1.4 %) too low")
    assert visible(parse_scene(scene_data(gravity=[0, 0])), run(state(moved)), run(state(cloud))) is None


def test_samples_are_spread_over_the_run_and_hold_its_end() -> None:
    assert sample_frames(16) == [2, 4, 6, 8, 10, 12, 14, 16]
    assert sample_frames(3) == [1, 2, 3]


def test_observe_keeps_the_order_of_particles(scene: Scene) -> None:
    """The same setting twice gives the same samples, although the library sorts its particles."""
    settings = RunSettings.of(scene, 1, rate_hz=60.0)
    parts = distance(scene, observe(scene, settings, 0.3), observe(scene, settings, 0.3))
    assert parts.particles == 0.0 and parts.statistics == 0.0


def test_observe_gives_up_what_is_too_dear(scene: Scene) -> None:
    assert observe(scene, RunSettings.of(scene, 1, rate_hz=60.0), 0.3, most_ms=0.0).too_dear


def test_observe_says_why_a_run_is_not_stable(scene: Scene) -> None:
    """A drop with 50 m/s is faster than a clamp of a tenth of a cell per step."""
    fast = parse_scene(scene_data(max_displacement=0.1, fills=[{**scene_data()["fills"][0], "velocity": [50, 0]}]))
    observation = observe(fast, RunSettings.of(fast, 1, rate_hz=60.0), 0.3)
    assert not observation.stable
    assert "faster than the clamp at 0.017 s" in observation.reasons[0]


def test_candidates_depend_on_the_matter() -> None:
    water = candidates.candidates(parse_scene(scene_data()), 60.0, 1)
    assert {item.solver for item in water} == {"dual", "paper"}
    soft = {"water": {"kind": "liquid", "bulk_modulus": 1e5}}
    assert {item.solver for item in candidates.candidates(parse_scene(scene_data(materials=soft)), 60.0, 1)} == {
        "dual",
        "paper",
        "explicit",
    }
    both = [scene_data()["fills"][0], {**scene_data()["fills"][0], "material": "jelly"}]
    assert {item.solver for item in candidates.candidates(parse_scene(scene_data(fills=both)), 60.0, 1)} == {"convergent", "dual", "paper"}
    jelly = parse_scene(scene_data(fills=[{**scene_data()["fills"][0], "material": "jelly"}]))
    assert {(item.solver, item.integrator) for item in candidates.candidates(jelly, 60.0, 1)} == {
        ("primal", "euler"),
        ("primal", "bdf2"),
        ("paper", "euler"),
        ("explicit", "euler"),
    }
    assert all(item.rate_hz == 60.0 for item in water)


def tuning(scene: Scene, results: list[tuple[float, float]], budget: float) -> Tuning:
    """Made up results: (ms, error)."""
    plan = Plan(1.0, 60.0, budget, 1, 50.0)
    same = run(state(np.zeros((5, 2))))
    made = Tuning(scene, plan, Reference(same, distance(scene, same, same)))
    for number, (cost, error) in enumerate(results, 1):
        settings = RunSettings(60.0, 1, number, solver="dual")
        made.results.append(Result(settings, error, cost, 2 * cost, cost, 1.0, 0.0, None, (), False))
    return made


def test_presets_keep_their_share_of_the_budget(scene: Scene) -> None:
    made = presets(tuning(scene, [(1, 9.0), (2, 5.0), (3, 6.0), (8, 1.0), (9, 0.5)], budget=8.0), {})
    chosen = {level: preset.settings.iterations for level, preset in made.items() if level != "reference"}
    assert chosen == {"low": 2, "medium": 2, "high": 4}
    assert (made["high"].predicted_error, made["high"].ms_median, made["high"].ms_p99) == (1.0, 8.0, 16.0)
    assert made["reference"].settings.iterations == 5


def test_presets_that_nothing_fits_are_missing(scene: Scene) -> None:
    assert set(presets(tuning(scene, [(3, 9.0)], budget=4.0), {})) == {"high", "reference"}
    broken = tuning(scene, [(1, float("inf"))], budget=4.0)
    assert set(presets(broken, {})) == {"reference"}


def test_the_last_sentence_says_what_the_budget_buys(scene: Scene) -> None:
    assert closing_line(tuning(scene, [(1, 0.9), (3, 0.5), (9, 0.1)], budget=4.0)) == "in 4 ms: dual 1 x 2, 0.5 cells off"
    assert closing_line(tuning(scene, [(1, 9.0), (11, 0.5)], budget=4.0)) == (
        "nothing usable fits in 4 ms (the best is 9 cells off; above 1 it shows); you need 11 ms (dual 1 x 2)"
    )
    assert closing_line(tuning(scene, [(5, 0.5)], budget=4.0)) == "nothing usable fits in 4 ms; you need 5 ms (dual 1 x 1)"
    assert closing_line(tuning(scene, [(5, 2.0)], budget=4.0)) == "nothing usable fits in 4 ms; no setting that was tried is good"


def test_presets_that_are_not_written_say_why(scene: Scene) -> None:
    found = tuning(scene, [(3, 0.5)], budget=4.0)
    made = presets(found, {})
    text = text_of(found, made, {level: Path(level) for level in made})
    assert "low:       not written: nothing fits into 1 ms (25 % of the budget); the cheapest setting takes 3 ms" in text
    assert "medium:    not written" in text and "high:      dual 1 x 1: error 0.5 cells" in text


def test_scattered_frames_are_told(scene: Scene) -> None:
    """The made up results have a p99 of twice the median."""
    found = tuning(scene, [(3, 0.5), (4, 0.4)], budget=4.0)
    assert scatter(found) == {"p99_over_median": 2.0, "interruptions": 0.0}
    made = presets(found, {})
    text = text_of(found, made, {level: Path(level) for level in made})
    assert "frame times scatter: one frame in a hundred takes 2 times the median or more; nothing disturbed: frames of this scene differ" in text


def test_presets_are_measured_with_one_thread_too(scene: Scene) -> None:
    found = tuning(scene, [(3, 0.5)], budget=4.0)
    found.alone[found.results[0].settings] = 2.5
    made = presets(found, {})
    assert "2.50 ms with one thread: use one" in text_of(found, made, {level: Path(level) for level in made})


def tune_command(folder: Path, data: dict[str, Any], *options: str) -> subprocess.CompletedProcess[str]:
    file = folder / "scene.json"
    file.write_text(json.dumps(data), encoding="utf-8")
    command = [
        sys.executable,
        "-m",
        "pbmpm",
        "tune",
        str(file),
        "--reference-substeps",
        "4",
        "--threads",
        "1",
        *options,
    ]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, cwd=folder)


def test_tune_command_writes_chart_and_presets_that_run(tmp_path: Path) -> None:
    done = tune_command(tmp_path, scene_data(), "--budget-ms", "1000", "--json", "report.json")
    assert done.returncode == 0, done.stderr
    assert without_progress(done.stderr) == []
    folder = tmp_path / "small-tune"
    assert Image.open(folder / "chart.png").width > 800
    report = json.loads((tmp_path / "report.json").read_text())
    usable = [row for row in report["rows"] if row["stable"]]
    assert len(usable) > 20
    best = min(row["error"] for row in usable)
    assert load_preset(folder / "high.json").predicted_error == best
    assert {path.stem for path in folder.glob("*.json")} == {"low", "medium", "high", "reference"}
    command = [
        sys.executable,
        "-m",
        "pbmpm",
        "run",
        "scene.json",
        "--preset",
        "small-tune/high.json",
        "--json",
        "-",
    ]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True, cwd=tmp_path)
    wanted = load_preset(folder / "high.json").settings.changes()
    assert {key: json.loads(ran.stdout)[key] for key in wanted} == wanted


def test_more_iterations_come_closer_to_the_converged_solution(tmp_path: Path) -> None:
    """The dual solver converges: 50 iterations are at least twice as close as 5, and closer than the paper's 50."""
    done = tune_command(tmp_path, scene_data(), "--budget-ms", "1000", "--json", "-")
    rows = {
        (row["solver"], row["iterations"]): row["error"]
        for row in json.loads(done.stdout)["rows"]
        if row["substeps"] == 4 and not row["target_error"]
    }
    assert rows["dual", 50] < 0.5 * rows["dual", 5]
    assert rows["dual", 50] < rows["paper", 50]


def test_tune_command_fails_when_nothing_fits(tmp_path: Path) -> None:
    done = tune_command(tmp_path, scene_data(), "--budget-ms", "1e-6", "--seconds", "0.2")
    assert done.returncode == 1
    assert "check failed: nothing usable fits in 1e-06 ms; you need more than " in done.stderr
    assert "high:      not written" in done.stdout
    assert not (tmp_path / "small-tune" / "high.json").exists()


def test_tune_command_needs_a_scene_and_a_budget(tmp_path: Path) -> None:
    assert tune_command(tmp_path, {"format": "other"}, "--budget-ms", "1").returncode == 2
    assert tune_command(tmp_path, scene_data()).returncode == 2
