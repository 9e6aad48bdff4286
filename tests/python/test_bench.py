"""The bench: what it measures, and its arithmetic. No test looks at how long anything took."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import pbmpm
from pbmpm.lab.bench import lake, scenes
from pbmpm.lab.bench.builds import builds_text, measure_builds
from pbmpm.lab.commands.bench import bench
from pbmpm.lab.bench.lake import BOTH, PARTS, LakeCosts, lake_pieces, lake_row, lake_scene, lake_text, measure_lake, over_parts
from pbmpm.lab.bench.measure import Costs, measure, pieces
from pbmpm.lab.bench.pool import (
    AWAKE_STEPS,
    PACES,
    PATIENCE,
    PoolCosts,
    measure_pool,
    pool_pieces,
    pool_row,
    pool_scene,
    pool_text,
)
from pbmpm.lab.bench.report import ratios_of, row_of
from pbmpm.lab.bench.scenes import GAME, SceneCosts, measure_scenes, scene_pieces, scene_row, scenes_text
from pbmpm.lab.bench.subjects import CELL, ITERATIONS, MATERIALS, RATE_HZ, VARIANTS, applies, scene_of
from pbmpm.lab.meter import Meter
from pbmpm.lab.loading import load_scene
from pbmpm.lab.simulation import RunSettings

from progress_lines import without_progress

ROW_KEYS = {
    "material",
    "dims",
    "solver",
    "particles",
    "iterations",
    "ns_per_particle_iteration",
    "ns_per_particle_iteration_min",
    "ns_per_particle_step_fixed",
    "ns_per_particle_step_fixed_min",
    "million_particle_iterations_per_second",
    "million_particle_iterations_per_second_max",
    "million_particle_iterations_per_second_in_iterate",
    "ms_per_step",
    "bytes_per_particle",
}


@pytest.mark.parametrize("material", ["liquid", "elastic"])
def test_scenes_are_those_of_the_samples(material: str, root: Path) -> None:
    """So that 'pbmpm run' and 'pbmpm bench' can be compared. Only the modulus, which the paper's solver ignores, differs."""
    sample = load_scene(root / "samples" / "scenes" / f"bench_{material}_3d.json")
    own = scene_of(material, 3)
    for name in ("dimension", "cell_size", "gravity", "domain", "rate_hz", "iterations"):
        assert getattr(own, name) == getattr(sample, name), name
    assert [fill.model_dump(exclude={"material"}) for fill in own.fills] == [
        fill.model_dump(exclude={"material"}) for fill in sample.fills
    ]
    assert own.iterations == ITERATIONS


def costs(variant: str, few: list[float], many: list[float], used: tuple[int, int] = (10, 20)) -> Costs:
    return Costs(variant, 1000, 200.0, few=few, many=many, few_solve=[0.8 * time for time in few], used=used)


def test_costs_of_iterations_and_of_a_step_are_told_apart() -> None:
    """30 us of a step and 5 us per iteration; a round that was disturbed does not count."""
    own = costs("dual", [80e-6, 80e-6, 90e-6], [130e-6, 130e-6, 990e-6])
    assert own.marginal() == pytest.approx(5e-9)
    assert own.fixed() == pytest.approx(30e-9)
    assert own.marginal(min) == pytest.approx(5e-9)
    row = row_of("liquid", 3, own)
    assert set(row) == ROW_KEYS
    assert row["ns_per_particle_iteration"] == pytest.approx(5.0)
    assert row["ns_per_particle_step_fixed"] == pytest.approx(30.0)
    assert row["million_particle_iterations_per_second"] == pytest.approx(10 * 1000 / 80e-6 / 1e6)


def test_iterations_that_were_not_done_are_not_divided_by() -> None:
    """The explicit solver has none, and a solver may be done early."""
    explicit = costs("explicit", [40e-6], [], used=(1, 1))
    assert explicit.marginal() is None
    assert explicit.fixed() == pytest.approx(40e-9)
    early = costs("primal", [100e-6], [150e-6], used=(10, 15))
    assert early.marginal() == pytest.approx(10e-9)


def test_the_ratio_is_that_of_the_same_rounds() -> None:
    paper, dual = costs("paper", [100e-6, 200e-6], [180e-6, 360e-6]), costs("dual", [90e-6, 180e-6], [130e-6, 260e-6])
    (ratio,) = ratios_of("liquid", 3, [paper, dual])
    assert (ratio["solver"], ratio["iteration"]) == ("dual", pytest.approx(0.5))
    assert ratio["step"] == pytest.approx(0.9)
    assert ratios_of("liquid", 3, [dual]) == []


def passes_of_deep_sand() -> range:
    """The dual solver crosses a column of 6 m in 1/60 s, by 4 cells per iteration; what it does beyond those asked for counts, as it costs as much. The depth is
    known to half a cell at either end."""
    least, most = (max(ITERATIONS, math.ceil((6.0 / CELL + cells) * 60.0 / RATE_HZ / 4.0)) for cells in (-1.0, 1.0))
    return range(least, most + 1)


@pytest.mark.parametrize("material", MATERIALS)
def test_a_measurement_steps_all_solvers(material: str) -> None:
    done: list[int] = []
    found = measure(material, 2, VARIANTS, 1, 1, lambda: done.append(1))
    assert [own.variant for own in found] == [variant for variant in VARIANTS if applies(variant, material)]
    assert len(done) == pieces(1)
    for own in found:
        solver_iterates = own.variant != "explicit"
        assert (len(own.few), len(own.many)) == (1, 1 if solver_iterates else 0)
        few = passes_of_deep_sand() if (own.variant, material) == ("dual", "sand") else [ITERATIONS]
        assert own.used[0] in (few if solver_iterates else [1])
        assert own.used[1] > own.used[0] or not solver_iterates
        assert own.bytes_per_particle > 100  # positions, velocities, affine velocities, identifiers


def test_pressures_in_cells_are_measured_with_liquids_only() -> None:
    assert [material for material in MATERIALS if applies("dual-cells", material)] == ["liquid"]
    assert all(applies(variant, material) for variant in VARIANTS if variant != "dual-cells" for material in MATERIALS)


def run_bench(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "pbmpm", "bench", *arguments], capture_output=True, text=True)


def test_the_command_says_where_the_figures_come_from() -> None:
    small = ("--solvers", "paper,dual", "--materials", "liquid", "--dims", "2", "--rounds", "1", "--warmup-steps", "0")
    done = run_bench(*small, "--json", "-")
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    assert [(row["solver"], set(row)) for row in report["rows"]] == [("paper", ROW_KEYS), ("dual", ROW_KEYS)]
    assert [ratio["solver"] for ratio in report["ratios"]] == ["dual"]
    assert {"cpu", "isa", "date"} <= set(report["machine"])
    assert any(name.startswith("ISPC") for name in report["compilers"])
    assert without_progress(done.stderr) == []


def test_unknown_solvers_are_refused() -> None:
    done = run_bench("--solvers", "newton")
    assert done.returncode == 2
    assert "'newton' is not one of convergent, paper, dual" in done.stderr


@pytest.mark.parametrize("name", [*PARTS, BOTH])
def test_lakes_are_those_of_the_samples(name: str, root: Path) -> None:
    sample = load_scene(root / "samples" / "scenes" / f"bench_{name}_3d.json")
    own = lake_scene(name).model_dump(exclude={"name", "description"})
    assert own == sample.model_dump(exclude={"name", "description"})


def test_lake_and_jelly_are_both_and_nothing_else(monkeypatch: pytest.MonkeyPatch) -> None:
    """2,048 particles of jelly in the hole of the lake; the lake has 200,000."""
    monkeypatch.setattr(lake, "WARMUP_STEPS", 1)
    ticks: list[None] = []
    costs = measure_lake("paper", 1, lambda: ticks.append(None))
    particles = {own.scene: own.particles for own in costs}
    assert particles == {"lake": 205952, "jelly": 2048, BOTH: 208000}
    assert all(len(own.seconds) == 1 and own.seconds[0] > 0 for own in costs)
    assert len(ticks) == lake_pieces(1)


def test_what_a_jelly_costs_over_its_share() -> None:
    """100 + 2 by themselves, 107.1 together: 5 % more; disturbed rounds do not count."""
    costs = [
        LakeCosts("lake", 1000, [0.100, 0.250]),
        LakeCosts("jelly", 10, [0.009, 0.002]),
        LakeCosts(BOTH, 1010, [0.1071, 0.2]),
    ]
    assert over_parts(costs) == pytest.approx(5.0)
    row = lake_row("dual", costs)
    assert row["jelly"] == {"particles": 10, "ms_per_step_min": pytest.approx(2.0)}
    assert lake_text([row]).startswith("dual: lake of 1000 particles 100.00 ms, jelly of 10 particles 2.00 ms,")
    assert "together +5.0 % over the sum" in lake_text([row])


def test_the_pool_is_that_of_the_sample(root: Path) -> None:
    sample = load_scene(root / "samples" / "scenes" / "bench_pool_3d.json")
    assert pool_scene("dual").model_dump(exclude={"name", "description"}) == sample.model_dump(exclude={"name", "description"})


@pytest.mark.parametrize("solver", list(PACES))
def test_a_small_pool_sleeps_and_a_drop_wakes_a_part_of_it(solver: str) -> None:
    """48 x 6 x 8 cells; what the drop does not reach keeps every bit."""
    ticks: list[None] = []
    costs = measure_pool(solver, 1, lambda: ticks.append(None), (2.4, 0.3, 0.4))
    assert len(ticks) == pool_pieces()
    assert costs.particles == 8 * 48 * 6 * 8
    assert 0.0 < costs.until_asleep < PATIENCE and 0.0 < costs.woken_for < PATIENCE
    assert 0 < costs.changed < costs.particles / 2
    assert 0 < costs.woken < costs.particles / 2
    assert costs.farthest < 14.0  # two blocks and a few cells more
    assert len(costs.awake) == AWAKE_STEPS and min(costs.awake) > 0.0


def test_the_figures_of_a_pool() -> None:
    costs = PoolCosts("paper", 1000, 2.0, [0.050, 0.040, 0.300], [0.002, 0.001, 0.009], 80, 0.5, 60, 7.25)
    assert costs.ratio == pytest.approx(25.0)
    row = pool_row(costs)
    assert (row["rate_hz"], row["iterations"]) == PACES["paper"]
    assert row["ms_per_step_awake"] == pytest.approx(50.0) and row["ms_per_step_asleep"] == pytest.approx(2.0)
    text = pool_text([row])
    assert "50.00 ms awake and 2.0000 ms asleep, 25 times less" in text
    assert "wakes at most 80 particles" in text and "60 are not where or what they were, the farthest 7.2 cells" in text


@pytest.mark.parametrize("options", [["--pool", "--lake"], ["--pool", "--solvers", "explicit"]])
def test_a_pool_that_is_not_measured_is_refused(options: list[str]) -> None:
    assert CliRunner().invoke(bench, options).exit_code == 2


def test_scenes_run_as_their_files_say_and_at_the_pace_of_a_game(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scenes, "LONGEST", 0.1)
    wanted = [load_scene(root / "samples" / "scenes" / f"{name}.json") for name in ("column_2d", "fountain_2d")]
    ticks: list[None] = []
    costs = measure_scenes(wanted, 2, lambda: ticks.append(None))
    assert len(ticks) == scene_pieces(wanted, 2) == 8
    rows = [scene_row(own) for own in costs]
    assert [(row["scene"], row["pace"]) for row in rows] == [
        (scene.name, pace) for scene in wanted for pace in ("file", "game")
    ]
    for row, scene in zip(rows[0::2], wanted):
        assert (row["rate_hz"], row["substeps"], row["iterations"]) == (scene.rate_hz, scene.substeps, scene.iterations)
    for row in rows[1::2]:
        assert {name: row[name] for name in GAME} == GAME
    for own, row in zip(costs, rows):
        assert [len(run.step_seconds) for run in own.runs] == [round(0.1 * row["rate_hz"])] * 2  # every round from the start
        assert row["times_real_time"] == pytest.approx(1e3 / row["ms_per_simulated_second"])
    assert rows[2]["particles"] > 0  # the fountain begins empty


def test_the_figures_of_a_scene(root: Path) -> None:
    """Rounds of 40, 50 and 90 ms for half a second: 100 ms per second in the middle, 10 times faster than real time."""
    scene = load_scene(root / "samples" / "scenes" / "column_2d.json")
    costs = SceneCosts("column", 2, "game", RunSettings.of(scene, 1, **GAME), 0.5, particles=100)
    for total in (0.040, 0.090, 0.050):
        meter = Meter()
        meter.steps, meter.volume_error_squares = 2, 2 * 0.03**2
        meter.step_seconds = [0.25 * total, 0.75 * total]
        costs.runs.append(meter)
    row = scene_row(costs)
    assert row["ms_per_simulated_second"] == pytest.approx(100.0) and row["ms_per_simulated_second_min"] == pytest.approx(80.0)
    assert row["ms_per_step_p99"] == pytest.approx(50 * 0.75, rel=0.02)
    text = scenes_text([row])
    assert "100 particles  60 Hz x 5, convergent" in text and "10.0 x" in text and "volume error 3.0 %" in text


@pytest.mark.parametrize("option", [["--lake"], ["--warmup-steps", "0"], ["--dims", "2"]])
def test_scenes_run_without_the_options_of_the_others(root: Path, option: list[str]) -> None:
    done = CliRunner().invoke(bench, [str(root / "samples" / "scenes" / "column_2d.json"), *option])
    assert done.exit_code == 2 and option[0] in done.output


def test_builds_are_measured_in_turns() -> None:
    own, other, ticks = Path("own.so"), Path("other.so"), []
    times, turns = {own: [3.0, 8.0, 6.0], other: [2.0, 4.0, 5.0]}, []

    def turn(library: Path, options: list[str]) -> dict[str, Any]:
        turns.append(library)
        assert options == ["--dims", "2"]
        ms = times[library][turns.count(library) - 1]
        row = {"material": "liquid", "dims": 2, "solver": "dual", "ms_per_step": ms}
        row |= {"iterations": 10, "particles": 1000, "million_particle_iterations_per_second_max": 10 / (ms - 1)}
        return {"strict": library == own, "rows": [row]}

    report = measure_builds(own, other, ["--dims", "2"], 3, lambda: ticks.append(0), turn)
    assert turns == [own, other] * 3 and len(ticks) == 6
    assert report["strict"] and not report["strict_other"]
    (row,) = report["rows"]
    assert row["times_as_long"] == 1.5 and row["times_as_long_least"] == pytest.approx(2.0) and row["ms_per_step"] == 6.0
    text = builds_text(report | {"rounds": 3, "machine": {"cpu": "C", "isa": "I", "date": "2026-01-02T"}})
    assert "(strict) over one of the other (ordinary)" in text and "1.50 times as long" in text


@pytest.mark.parametrize("options", [["--lake"], ["--pool"]])
def test_builds_are_not_compared_by_the_lake_or_the_pool(options: list[str]) -> None:
    assert CliRunner().invoke(bench, ["--against", __file__, *options]).exit_code == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["no_library.so", "."], "no_library.so is no file"),
        ([__file__, "."], "has no package pbmpm"),
        ([__file__, Path(pbmpm.__file__).parents[1], "no_scene"], "there is no scene no_scene"),
        ([__file__, Path(pbmpm.__file__).parents[1], "--rounds", "0"], "--rounds and --iterations are at least 1"),
        ([__file__, Path(pbmpm.__file__).parents[1], "pool", "--rounds", "1"], f"the build {__file__} ended with status 1"),
    ],
)
def test_a_build_that_cannot_be_measured_is_named(arguments: list[str | Path], said: str, root: Path) -> None:
    """This file is no library."""
    done = subprocess.run([sys.executable, root / "tests/cost/against.py", *arguments], capture_output=True, text=True)
    assert done.returncode != 0 and said in done.stderr and "BrokenPipe" not in done.stderr
