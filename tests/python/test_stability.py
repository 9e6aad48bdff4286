"""The stability map: what it runs, what it says, and the command. The cases themselves are tested in test_hard_cases.py."""

from __future__ import annotations

import json
import math
import os
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from browser import browser, open_page
from pbmpm.lab.errors import InputError
from pbmpm.lab.files import json_text
from pbmpm.lab.stability.cases import CASES, SOLVERS, Check, HardCase, Kind, Outcome, Setting, find_case
from pbmpm.lab.report.stability_page import save_stability_page
from pbmpm.lab.stability import record as saved
from pbmpm.lab.stability import sweep as sweeping
from pbmpm.lab.stability.plan import ITERATIONS, RATES, Run, Selection, cases_named, plan
from pbmpm.lab.stability.result import counts, lines_of, row_of
from pbmpm.lab.stability.sweep import run_one, sweep
from pbmpm.lab.stability.table import cells_text, goals_text, map_text, summary
from pbmpm.lab.workers.workers import Workers

from progress_lines import without_progress

ROW_KEYS = {"case", "solver", "material", "dims", "rate_hz", "iterations", "passed", "figure", "limit", "seconds"}


def places_of(runs: list[Run], **wanted: object) -> set[tuple[float, int]]:
    """Rates and iterations of the runs whose setting has these values."""
    settings = [run.setting for run in runs]
    return {
        (setting.rate_hz, setting.iterations)
        for setting in settings
        if all(getattr(setting, name) == value for name, value in wanted.items())
    }


GRID = {(rate, count) for rate in RATES for count in ITERATIONS}


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_full_form_takes_every_case_over_all_rates_and_iterations(solver: str) -> None:
    """In 2D all, in 3D the corners and the case's own; the explicit solver has no iterations."""
    grid = {(rate, 1) for rate in RATES} if solver == "explicit" else GRID
    for case in CASES:
        if solver not in case.solvers or case.ladder or case.has_own_steps:
            continue
        runs = plan(Selection(cases=(case,), solvers=(solver,)))
        assert len(runs) == len(set(runs))
        own = (case.rate_hz, 1 if solver == "explicit" else case.iterations)
        corners = {(rate, count) for rate, count in grid if rate in (15.0, 480.0) and count in (1, 20)}
        for variant in case.all_variants:
            fixed = variant in case.fixed_variants + case.long_variants
            for dimension in {setting.dimension for setting in case.settings(solver=solver, variants=(variant,))}:
                expected = {own} if fixed else grid if dimension == 2 else {*corners, own}
                assert places_of(runs, variant=variant, dimension=dimension) == expected, (case.id, variant)


def test_rates_or_iterations_that_are_named_are_run_with_everything() -> None:
    case = find_case("H03")
    named = plan(Selection(cases=(case,), solvers=("dual",), rates=(30.0, 60.0), dimensions=(3,)))
    assert places_of(named) == {(rate, count) for rate in (30.0, 60.0) for count in ITERATIONS}
    assert places_of(plan(Selection(cases=(case,), solvers=("dual",), iterations=(2,), dimensions=(3,)))) == {(r, 2) for r in RATES}


def test_a_case_with_its_own_steps_runs_at_one_rate() -> None:
    runs = plan(Selection(cases=(find_case("H10"),), solvers=("dual",), dimensions=(2,)))
    assert places_of(runs) == {(60.0, count) for count in ITERATIONS}


def test_what_stays_at_its_own_setting_in_the_map_has_a_reason_to() -> None:
    """Nothing else is fixed: a smaller scene takes its place, or neither rate nor iterations matter to it."""
    independent = {"H07": ("plain",), "H16": ("impossible shapes",), "H21": ("denormal velocities",)}
    for case in CASES:
        if not case.map_variants:
            assert case.fixed_variants == independent.get(case.id, ()), case.id
    assert {case.id for case in CASES if case.map_variants} == {"H01", "H18"}
    assert {case.id for case in CASES if case.has_own_steps} == {"H10"}


def test_a_ladder_is_climbed_in_the_quick_form_and_brings_its_rates_into_the_full_one() -> None:
    case = find_case("H02")
    quick = plan(Selection(cases=(case,), quick=True, dimensions=(2,), materials=("liquid",)))
    for solver, counts_of in (("dual", ITERATIONS), ("explicit", (1,))):
        places = [(run.setting.rate_hz, run.setting.iterations) for run in quick if run.setting.solver == solver]
        assert len(places) == len(set(places))
        assert set(places) == {(rate, count) for rate in (*RATES, 1200.0) for count in counts_of}
    full = plan(Selection(cases=(case,), solvers=("dual",), materials=("liquid",), dimensions=(3,)))
    assert places_of(full) == {(rate, count) for rate in (*RATES, 1200.0) for count in ITERATIONS}


def test_long_variants_run_in_the_full_form_or_when_they_are_named() -> None:
    case = find_case("H19")
    (name,) = case.long_variants
    full = [run.setting for run in plan(Selection(cases=(case,))) if run.setting.variant == name]
    assert {(setting.rate_hz, setting.iterations) for setting in full} == {(case.rate_hz, case.iterations)}
    assert {(setting.solver, setting.material) for setting in full} == {
        (solver, material) for solver in ("paper", "dual", "primal") for material in case.materials
    }
    some = Selection(cases=(case,), rates=(60.0,), iterations=(5,))
    assert all(run.setting.variant != name for run in plan(some))
    assert all(run.setting.variant == name for run in plan(replace(some, variant=name, rates=None, iterations=None, quick=True)))


def test_the_quick_form_runs_each_case_at_its_own_setting() -> None:
    """The same settings as the tests of the catalogue."""
    runs = plan(Selection(quick=True, solvers=("paper", "dual")))
    expected = {
        (case.id, setting) for case in CASES for solver in ("paper", "dual") for setting in case.settings(solver=solver)
    }
    assert {(run.case, run.setting) for run in runs} == expected


def test_a_selection_narrows() -> None:
    case = find_case("H04")
    selection = Selection(
        cases=(case,), rates=(30.0,), iterations=(2,), solvers=("dual",), dimensions=(2,), variant="line", seed=7
    )
    assert [run.setting for run in plan(selection)] == [Setting("liquid", 2, "line", 30.0, 2, solver="dual", seed=7)]


@pytest.mark.parametrize(
    ("selection", "message"),
    [
        (Selection(cases=(find_case("H03"),), materials=("elastic",)), "none of these cases"),
        (
            Selection(cases=(find_case("H04"),), variant="nonsense"),
            "no variant 'nonsense'; there are: line, one cell, point",
        ),
    ],
)
def test_an_empty_selection_says_why(selection: Selection, message: str) -> None:
    with pytest.raises(InputError, match=message):
        plan(selection)


def test_cases_are_named_in_any_order_and_spelling() -> None:
    assert [case.id for case in cases_named(["h08", "H03", "H08"])] == ["H03", "H08"]
    assert cases_named([]) == CASES
    with pytest.raises(InputError, match="H99"):
        cases_named(["H99"])


CASE_OF_GOALS = HardCase(
    "H04", "title", "origin", "criterion", lambda _: [], materials=("liquid",), variants=("point",), rate_hz=60.0, iterations=5
)


def judged(rate: float, iterations: int, *checks: Check, solver: str = "dual", case: HardCase = CASE_OF_GOALS) -> Outcome:
    """The outcome of some checks at a setting of a case whose own is 60 Hz x 5."""
    return case.outcome(Setting("liquid", 2, "point", rate, iterations, solver=solver), checks, 0.5)


MET_BOUND, BROKEN_BOUND = Check("energy", 1.0, 1.001), Check("energy", 1.2, 1.001)
MET_GOAL, MISSED_GOAL = (Check("volume", figure, 0.9, at_least=True, kind=Kind.GOAL) for figure in (0.95, 0.3))
COARSER = [(15.0, 1), (30.0, 20), (480.0, 1), (59.0, 5), (60.0, 4)]
AS_FINE = [(60.0, 5), (60.0, 6), (480.0, 5), (480.0, 20)]


@pytest.mark.parametrize(("rate", "iterations"), COARSER + AS_FINE)
def test_a_broken_bound_fails_at_any_setting(rate: float, iterations: int) -> None:
    result = judged(rate, iterations, MET_GOAL, BROKEN_BOUND)
    assert not result.passed and counts(result)
    assert result.telling == BROKEN_BOUND


@pytest.mark.parametrize(("rate", "iterations"), COARSER)
def test_a_goal_missed_at_a_coarser_setting_is_shown_and_no_failure(rate: float, iterations: int) -> None:
    result = judged(rate, iterations, MISSED_GOAL, MET_BOUND)
    assert result.passed and not counts(result)
    assert result.telling == MET_BOUND  # figure and limit of a row that passed are of what was judged
    row = row_of(result)
    assert (row["passed"], row["goals_judged"], row["goals_reached"]) == (True, False, False)
    assert [(goal["check"], goal["figure"], goal["limit"]) for goal in row["goals_missed"]] == [("volume", 0.3, 0.9)]
    assert f"0.3 (limit >= 0.9)\n      at {rate:g} Hz x {iterations}" in goals_text([result])
    assert re.search(r"^    dual liquid 2D +o *$", map_text([result]), re.M)
    assert "1 of 1 runs passed (1 without a goal" in summary([result])
    assert "not reached here" in result.description and "FAILED" not in result.description


@pytest.mark.parametrize(("rate", "iterations"), AS_FINE)
def test_a_goal_missed_at_its_own_or_a_finer_setting_fails(rate: float, iterations: int) -> None:
    result = judged(rate, iterations, MET_BOUND, MISSED_GOAL)
    assert not result.passed and counts(result)
    assert result.telling == MISSED_GOAL
    assert goals_text([result]) == ""
    assert re.search(r"^    dual liquid 2D +x *$", map_text([result]), re.M)


def test_a_goal_without_a_figure_fails_at_any_setting() -> None:
    assert not judged(15.0, 1, MET_BOUND, replace(MISSED_GOAL, figure=math.nan)).passed


def test_a_ladder_is_judged_in_full() -> None:
    ladder = replace(CASE_OF_GOALS, ladder=((15.0, 1), (60.0, 5)))
    assert not judged(15.0, 1, MET_BOUND, MISSED_GOAL, case=ladder).passed


def test_goals_of_the_explicit_solver_ask_for_the_rate_alone() -> None:
    assert judged(60.0, 1, MET_BOUND, MISSED_GOAL, solver="explicit").passed is False
    assert judged(30.0, 1, MET_BOUND, MISSED_GOAL, solver="explicit").passed is True


def test_every_run_has_a_bound() -> None:
    """Where goals do not count something must decide: the universal checks are bounds."""
    for identifier, variant in (("H03", "plain"), ("H05", "flat F"), ("H14", "squashed to 0.05")):
        case = find_case(identifier)
        result = case.run(next(case.settings(15.0, 1, variants=(variant,))))
        assert any(check.kind is Kind.BOUND for check in result.judged)
        assert {check.kind for check in result.checks} == {Kind.BOUND, Kind.GOAL}


@pytest.mark.parametrize("goal", [MET_GOAL, MISSED_GOAL])
@pytest.mark.parametrize("bound", [MET_BOUND, BROKEN_BOUND])
@pytest.mark.parametrize(("rate", "iterations"), [(15.0, 1), (60.0, 5)])
def test_a_row_gives_back_what_was_judged_and_what_was_missed(goal: Check, bound: Check, rate: float, iterations: int) -> None:
    result = replace(judged(rate, iterations, goal, bound), case="H04")
    again = saved.outcome_of(json.loads(json_text(row_of(result))))
    assert (again.passed, again.telling, again.goals_missed) == (result.passed, result.telling, result.goals_missed)
    assert row_of(again) == row_of(result)


def outcome(
    passed: bool, *, solver: str = "dual", known: str = "", rate: float = 60.0, variant: str = "point"
) -> Outcome:
    setting = Setting("liquid", 2, variant, rate, 5, solver=solver)
    return Outcome("H04", setting, (Check("volume", 1.0 if passed else 0.3, 0.9, at_least=True),), 0.5, known)


def test_which_failures_count() -> None:
    assert counts(outcome(False))
    assert not any(map(counts, [outcome(True), outcome(False, known="why"), outcome(False, solver="explicit")]))


def test_map_shows_failures_and_how_to_replay_them() -> None:
    outcomes = [
        outcome(True),
        outcome(False, variant="line"),
        outcome(True, rate=120.0),
        outcome(False, solver="paper", known="because"),
        outcome(False, solver="explicit"),
    ]
    text = map_text(outcomes)
    assert re.search(r"^    dual liquid 2D +x +\. *$", text, re.M)
    assert re.search(r"^    paper liquid 2D +k *$", text, re.M)
    assert re.search(r"^    explicit liquid 2D +e *$", text, re.M)
    figures = cells_text(outcomes, passed_too=False)
    assert "'line' [1 of 2 variants]\n      volume: 0.3 (FAILED, limit >= 0.9)" in figures
    assert "--solvers dual --materials liquid --dims 2 --rates 60 --iterations 5 --variant 'line' --seed 1" in figures
    assert "known: because" in figures and "120 Hz" not in figures
    assert "120 Hz" in cells_text(outcomes, passed_too=True)
    assert "dual: 2 of 3 runs passed; 1 failed\n" in summary(outcomes)
    assert summary(outcomes).endswith("1 failure that should not be")


def test_a_cell_is_decided_by_the_failure_that_counts() -> None:
    cells = lines_of([outcome(True), outcome(False, known="why"), outcome(False, variant="line")], SOLVERS)
    (cell,) = next(iter(cells.values())).values()
    assert cell.telling.setting.variant == "line" and cell.mark == "x"


def test_row_has_the_promised_keys_and_its_command_gives_the_same_run() -> None:
    row = row_of(outcome(False))
    assert set(row) >= ROW_KEYS
    assert (row["passed"], row["figure"], row["limit"]) == (False, 0.3, 0.9)
    assert row["command"] == Run("H04", outcome(False).setting).command


def test_a_row_is_json_whatever_numbers_a_case_counts_with() -> None:
    counted = Outcome("H04", outcome(True).setting, (Check("particles", np.int64(3), np.float32(2.0)),), 0.5)  # type: ignore[arg-type]
    assert json.loads(json.dumps(row_of(counted)))["figure"] == 3.0


def test_sweep_keeps_the_order_of_the_runs_with_one_process_and_with_two() -> None:
    runs = plan(
        Selection(cases=(find_case("H10"),), rates=(60.0,), iterations=(1,), solvers=("paper",), dimensions=(2,))
    )
    alone, together = sweep(runs, Workers()), sweep(runs, Workers(2))
    assert [item.setting for item in alone] == [item.setting for item in together] == [run.setting for run in runs]
    assert [item.figure for item in alone] == [item.figure for item in together]


def test_an_error_of_the_library_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    import pbmpm

    def refuse(_: Setting) -> list[Check]:
        raise pbmpm.OutOfMemoryError("no room")

    broken = HardCase("H04", "title", "origin", "criterion", refuse, variants=("point",))
    monkeypatch.setattr(sweeping, "find_case", lambda _: broken)
    result = run_one(Run("H04", Setting("liquid", 2, "point", 60.0, 5)))
    assert not result.passed and "OutOfMemoryError: no room" in result.telling.name


@pytest.mark.parametrize("figure", [0.3, math.nan])
def test_a_row_gives_its_outcome_back(figure: float) -> None:
    """Whether the failure is known is what the catalogue says, not what the file says: H04 has none."""
    setting = Setting("liquid", 2, "line", 120.0, 5, solver="primal", seed=7)
    row = json.loads(json_text(row_of(Outcome("H04", setting, (Check("volume", figure, 0.9, at_least=True),), 0.5, "old reason"))))
    again = saved.outcome_of(row)
    assert (again.case, again.setting, again.passed, again.known_failure) == ("H04", setting, False, "")
    assert json.loads(json_text(row_of(again))) == {**row, "known_failure": ""}


def test_what_was_run_before_an_interrupt_is_in_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(saved, "SAVE_SECONDS", 0.0)
    record = saved.Record(tmp_path / "map.json")
    record.add(outcome(True))
    again = saved.Record(tmp_path / "map.json")
    again.go_on()
    assert [item.setting for item in again.outcomes] == [outcome(True).setting]


def command(*options: str, **more: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "pbmpm", "stability", *options],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        **more,
    )


def test_command_passes_where_all_is_well_and_writes_json(tmp_path: Path) -> None:
    options = [
        "H04",
        "--solvers",
        "paper",
        "--dims",
        "2",
        "--rates",
        "60,120",
        "--iterations",
        "5",
        "--json",
        "map.json",
    ]
    done = command(*options, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert without_progress(done.stderr) == []
    rows = json.loads((tmp_path / "map.json").read_text())["rows"]
    assert [(row["rate_hz"], row["variant"]) for row in rows] == [
        (rate, variant) for rate in (60, 120) for variant in ("point", "line", "one cell")
    ]
    assert all(row["passed"] for row in rows)


def test_command_goes_on_with_a_file(tmp_path: Path) -> None:
    """What the file holds is kept and shown, and only what it has not is run."""
    path = tmp_path / "map.json"
    options = ["H04", "--solvers", "paper", "--dims", "2", "--iterations", "5", "--variant", "line", "--json", str(path), "--resume"]
    assert command(*options, "--rates", "60").returncode == 0
    report = json.loads(path.read_text())
    report["rows"][0]["figure"] = 0.125
    path.write_text(json.dumps(report))
    done = command(*options, "--rates", "60,120")
    assert done.returncode == 1 and "paper: 1 of 2 runs passed" in done.stdout
    rows = json.loads(path.read_text())["rows"]
    assert [(row["rate_hz"], row["figure"] == 0.125) for row in rows] == [(60.0, True), (120.0, False)]
    report["versions"]["pbmpm"] = "0"
    path.write_text(json.dumps(report))
    other = command(*options, "--rates", "60")
    assert other.returncode == 2 and "another library" in other.stderr
    assert json.loads(path.read_text()) == report


@pytest.mark.parametrize(
    ("text", "message"), [("[1]", "not what pbmpm stability"), ('{"rows": [{}], "wall_seconds": 1, "versions": {}, "machine": {}}', "not a map")]
)
def test_a_file_that_is_no_map_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "map.json"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        saved.Record(path).go_on()


def test_resume_needs_a_file() -> None:
    done = command("H04", "--resume")
    assert done.returncode == 2 and "--resume needs a file" in done.stderr


def test_a_press_with_too_few_iterations_shows_the_goal_that_it_misses() -> None:
    """At 15 Hz with one iteration it cannot bring the volume back in time; the row and its replay say by how much."""
    done = command("H03", "--solvers", "paper", "--dims", "2", "--rates", "15", "--iterations", "1")
    assert done.returncode == 0
    _, _, goals = done.stdout.partition("where they do not count:\n")
    assert "  H03 paper liquid 2D 'plain' share of particles with J in [0.8, 1.2]: worst" in goals


def test_command_fails_where_something_fails_and_its_replay_gives_the_same_figure(tmp_path: Path) -> None:
    """A limit that nothing can meet, in a catalogue of its own: no real case is to fail."""
    script = tmp_path / "failing.py"
    script.write_text(
        "import dataclasses, sys\n"
        "from pbmpm.lab.commands import cli\n"
        "from pbmpm.lab.stability.cases import Check, catalogue\n"
        "case = catalogue.find_case('H04')\n"
        "def function(setting):\n"
        "    return [Check('half of the volume', 2.0 * case.function(setting)[0].figure, 0.1)]\n"
        "catalogue.CASES = (dataclasses.replace(case, function=function),)\n"
        "if __name__ == '__main__':\n"
        "    cli.main()\n",
        encoding="utf-8",
    )

    def run(*options: str) -> subprocess.CompletedProcess[str]:
        arguments = [sys.executable, str(script), "stability", *options, "--processes", "1"]
        return subprocess.run(arguments, capture_output=True, text=True, timeout=600, check=False)

    done = run("H04", "--solvers", "paper", "--dims", "2", "--rates", "60", "--iterations", "5", "--variant", "line")
    assert done.returncode == 1, done.stderr
    replay = next(line.strip() for line in done.stdout.splitlines() if line.strip().startswith("pbmpm stability"))
    again = run(*shlex.split(replay)[2:])
    figure = re.compile(r"half of the volume[^(]*")
    assert len(figure.findall(done.stdout)) == 1
    assert figure.findall(again.stdout) == figure.findall(done.stdout)


@pytest.mark.skipif(os.name != "posix", reason="needs signals")
def test_an_interrupt_ends_the_command_and_its_processes(tmp_path: Path) -> None:
    """Without waiting for runs that are queued: the whole of H16 takes far longer than the time limit."""
    code = (
        "import os, signal, sys, threading\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from pbmpm.lab.commands import cli\n"
        "sys.argv = ['pbmpm', 'stability', 'H16', '--processes', '2']\n"
        "if __name__ == '__main__':\n"
        "    threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
        "    cli.main()\n"
    )
    script = tmp_path / "interrupted.py"
    script.write_text(code, encoding="utf-8")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 130, done.stderr
    assert "Traceback" not in done.stderr


def test_the_explicit_solver_may_fail() -> None:
    done = command("H04", "--solvers", "explicit", "--dims", "2", "--rates", "15", "--variant", "line")
    assert done.returncode == 0
    assert re.search(r"explicit liquid 2D +e", done.stdout)


@pytest.mark.parametrize(
    "options", [["H99"], ["--solvers", "magic"], ["--rates", "0"], ["H03", "--materials", "elastic"]]
)
def test_bad_usage(options: list[str]) -> None:
    assert command(*options).returncode == 2


@pytest.mark.skipif(browser() is None, reason="no browser")
def test_page_opens_and_shows_the_map(tmp_path: Path) -> None:
    coarse = replace(judged(15.0, 1, MISSED_GOAL, MET_BOUND), case="H04")
    outcomes = [outcome(True), outcome(False, variant="line"), outcome(False, solver="explicit"), coarse]
    machine = {
        "cpu": "c",
        "cores": os.cpu_count(),
        "isa": "AVX2",
        "threads": 1,
        "system": "s",
        "python": "3",
        "date": "d",
    }
    report = {"machine": machine, "versions": {"pbmpm": "1"}}
    save_stability_page(report, outcomes, "pbmpm stability", tmp_path / "map.html")
    document, messages = open_page(tmp_path / "map.html", tmp_path / "map.png")
    assert messages == []
    assert document.count('<td class="failed"') == 1 and document.count('<td class="expected"') == 1
    assert document.count('<td class="bounds"') == 1 and "1 goals missed" in document
    assert "limit &gt;= 0.9" in document or "limit >= 0.9" in document
