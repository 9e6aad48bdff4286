"""The accuracy command and its framework: settings, sweeps, rows, tables, charts."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from pbmpm.lab.accuracy.case import Case, ErrorMeasure, Measurement, Setting, parse_variant, settings_of
from pbmpm.lab.accuracy.explore import Explorer, LeftOut, next_iterations, next_rate
from pbmpm.lab.accuracy.registry import all_cases, find_cases
from pbmpm.lab.accuracy.parts import merged
from pbmpm.lab.accuracy.sweep import TIMINGS, Choice, Sweep, row_of
from pbmpm.lab.accuracy.table import legend, table
from pbmpm.lab.errors import InputError

ROW_KEYS = {
    "case",
    "solver",
    "dims",
    "rate_hz",
    "iterations",
    "cell_m",
    "error",
    "error_kind",
    "truth",
    "ms_per_simulated_second",
    "iterations_used",
    "stable",
}


def accuracy(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pbmpm", "accuracy", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def test_json_and_chart(tmp_path: Path) -> None:
    options = ("--solvers", "paper,dual-cells-flip0.9", "--rates", "60,120", "--iterations", "2,5", "--cells", 8)
    done = accuracy("dam-break", *options, "--converged", "--chart", tmp_path, "--json", "-")
    assert done.returncode in (0, 1), done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    rows = report["rows"]
    assert [(row["variant"], row["rate_hz"], row["iterations"]) for row in rows] == [
        (variant, rate, count) for variant in ("paper", "dual-cells-flip0.9") for rate in (60, 120) for count in (2, 5)
    ]
    for row in rows:
        assert row.keys() >= ROW_KEYS
        assert row["cell_m"] == 1 / 8 and row["dims"] == 2 and row["error_kind"] == "model"
        assert row["error"] == row["errors"]["front_rms_shifted"] > 0
        assert row["iterations_used"] == row["iterations"] and row["ms_per_simulated_second"] > 0
    lively = rows[-1]
    assert (lively["solver"], lively["pressure"], lively["flip"]) == ("dual", "cells", 0.9)
    assert lively["solver_error"] > 0 and lively["converged_error"] > 0
    assert report["cases"][0]["case"] == "dam-break" and report["cases"][0]["truth"] == lively["truth"]
    assert {"isa", "cpu", "date", "threads"} <= set(report["machine"])
    assert Image.open(tmp_path / "dam-break.png").width > 800


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("no-such-case",), "there is no case 'no-such-case' (there are: dam-break"),
        (("column", "--solvers", "paper,newton"), "'newton' is not a solver"),
        (("column", "--solvers", "dual-flip1.5"), "'flip1.5'"),
        (("column", "--solvers", "dual-sound20"), "'sound20'"),
        (("column", "--rates", "0"), "above 0"),
    ],
)
def test_bad_input_is_exit_code_2(arguments: tuple[str, ...], said: str) -> None:
    done = accuracy(*arguments)
    assert done.returncode == 2 and said in done.stderr


def test_every_case_is_complete() -> None:
    cases = all_cases()
    assert len({case.name for case in cases}) == len(cases)
    for case in cases:
        assert case.truth and case.title and case.length > 0 and case.length_name and case.dimension in (2, 3)
        assert case.error_kinds and len({measure.name for measure in case.error_kinds}) == len(case.error_kinds)
        for quick in (True, False):
            settings = case.sweep(quick)
            assert settings and len(set(settings)) == len(settings)


def test_find_cases_keeps_the_order_asked_for() -> None:
    assert [case.name for case in find_cases(["column", "dam-break"])] == ["column", "dam-break"]
    with pytest.raises(InputError, match="'x'"):
        find_cases(["x"])


@pytest.mark.parametrize("variant", ["paper", "dual-cells", "dual-cells-flip0.9", "primal-bdf2", "explicit", "explicit-flip0.9-sound20"])
def test_variants_are_written_as_they_are_read(variant: str) -> None:
    assert Setting(rate_hz=60.0, iterations=5, cells=16, **parse_variant(variant)).variant == variant


def test_settings_of_has_the_explicit_solver_once_per_rate_and_bounds_the_work() -> None:
    settings = settings_of(("dual", "explicit"), (60.0, 120.0), (1, 97), (8,), most_work=6000)
    assert [(item.solver, item.rate_hz, item.iterations) for item in settings] == [
        ("dual", 60.0, 1),
        ("dual", 60.0, 97),
        ("dual", 120.0, 1),
        ("explicit", 60.0, 1),
        ("explicit", 120.0, 1),
    ]


class Stub(Case):
    """A case whose error is 1 / iterations, and which breaks with the paper's solver."""

    name = "stub"
    title = "Stub"
    dimension = 2
    kind = "liquid"
    truth = "0"
    error_kinds = (ErrorMeasure("error", "discretisation", "%", "what is left"),)
    length, length_name = 2.0, "side"
    measured: list[Setting] = []

    def sweep(self, quick: bool) -> list[Setting]:
        return settings_of(("paper", "dual"), (60.0, 120.0), (1, 2), (8,)) + settings_of(("explicit",), (960.0,), (1,), (8,))

    def measure(self, setting: Setting) -> Measurement:
        self.measured.append(setting)
        if setting.solver == "paper":
            return Measurement({"error": None}, 1.0, 1.0, 0.0, False, ["it blew up at 1 s"])
        return Measurement({"error": 1 / setting.iterations}, 1.0, 1.0, 0.0, True, observed=(1 / setting.iterations,))


def test_failed_settings_stay_in_rows_and_table() -> None:
    report = Sweep().run(Stub(), Stub().sweep(False))
    assert [row["stable"] for row in report.rows] == [False] * 4 + [True] * 5
    assert table(report).count("FAILED: it blew up at 1 s") == 4
    assert "error [%], discretisation: what is left" in legend(report)
    # Nobody searched, so nobody knows what the solvers reach.
    assert report.facts()["cut_short"] == [(8, "dual"), (8, "explicit"), (8, "paper")] and not report.facts()["explored"]


def test_errors_are_split_by_the_converged_solution_which_is_computed_once() -> None:
    Stub.measured.clear()
    case = Stub()
    report = Sweep(with_converged=True).run(case, case.sweep(False))
    dual = report.rows[4]
    assert dual["solver_error"] == pytest.approx(1 - 1 / case.converged_iterations)
    assert dual["converged_error"] == pytest.approx(1 / case.converged_iterations)
    assert report.rows[-1]["solver_error"] is None  # the explicit solver has no iterations
    assert [setting.iterations for setting in Stub.measured].count(case.converged_iterations) == 2  # one per rate


def test_a_choice_fills_in_what_the_sweep_has() -> None:
    case = Stub()
    assert Choice().settings(case) == case.sweep(False)
    explicit = replace(case.sweep(False)[-1], rate_hz=960.0)
    assert Choice(variants=["explicit"]).settings(case) == [explicit]
    chosen = Choice(variants=["dual-cells"], iterations=[7]).settings(case)
    assert [(item.variant, item.rate_hz, item.iterations) for item in chosen] == [
        ("dual-cells", 60.0, 7),
        ("dual-cells", 120.0, 7),
    ]


class Priced(Stub):
    """Errors and costs by a law: the error falls with the rate and the iterations, the cost is their product."""

    clock = 0.0
    """Processor time that measuring has taken [s]: one for each setting."""
    sharpness = {"paper": 2.0, "dual": 0.1, "explicit": 10.0}
    measured: list[Setting] = []

    def sweep(self, quick: bool) -> list[Setting]:
        coarse = settings_of(("paper", "dual", "dual-cells"), (30.0, 480.0), (2, 20), (8,))
        return coarse + [Setting("explicit", 480.0, 1, 8, sound=10.0)] + settings_of(("dual",), (60.0,), (2,), (16,))

    def measure(self, setting: Setting) -> Measurement:
        self.measured.append(setting)
        Priced.clock += 1.0
        error = self.sharpness[setting.solver] / setting.rate_hz + 0.1 / setting.iterations**2 / setting.rate_hz**0.5
        cost = setting.rate_hz * (setting.iterations + 3) * (1.5 if setting.pressure == "cells" else 1.0)
        # Timings are noisy: each one of the same setting is 1 ms shorter than the one before.
        cost -= self.measured.count(setting)
        stable = setting.solver != "explicit" or setting.rate_hz > 30.0 * setting.sound
        return Measurement({"error": error}, cost, 1.0, 0.0, stable, [] if stable else ["it blew up"])


@pytest.fixture
def priced(monkeypatch: pytest.MonkeyPatch) -> Priced:
    """The case, with a clock that only its measurements move."""
    Priced.measured.clear()
    monkeypatch.setattr("pbmpm.lab.accuracy.explore.time.process_time", lambda: Priced.clock)
    return Priced()


def test_search_finds_the_front_between_the_settings_of_the_sweep(priced: Priced) -> None:
    """At an error of 1 % the law's cheapest dual setting is 90 Hz x 3: 0.0011 + 0.1 / 9 / sqrt(90) = 0.0023; with 2 iterations
    or at 15 Hz more is lost. The sweep alone has 30 and 480 Hz x 2 and 20."""
    report = Sweep().search(priced, 300.0)
    assert set(priced.sweep(False)) <= set(report.settings) and report.facts()["explored"]
    stable = [row for row in report.rows if row["stable"] and row["cells"] == 8]
    for solver in ("paper", "dual"):
        own = [row for row in stable if row["solver"] == solver]
        front = [row for row in own if not any(beats(other, row) for other in own)]
        inside = [row for row in front if 0.005 <= row["error"] <= 0.05]
        assert len(inside) >= 4
        tried = {(item["rate_hz"], item["iterations"], item["variant"]) for item in own}
        # What is next to the front was tried.
        for row in inside:
            slower = next_rate(row["rate_hz"], False)
            assert (slower, row["iterations"], row["variant"]) in tried or slower < priced.slowest_hz
            assert (row["rate_hz"], next_iterations(row["iterations"], False), row["variant"]) in tried
    moduli = {setting.sound for setting in report.settings if setting.solver == "explicit"}
    assert {5.0, 10.0} <= moduli
    assert any(not row["stable"] for row in report.rows)


def beats(one: dict[str, Any], other: dict[str, Any]) -> bool:
    return one["ms_per_simulated_second"] < other["ms_per_simulated_second"] and one["error"] <= other["error"]


def test_settings_on_a_front_are_timed_again_and_the_cheapest_counts(priced: Priced) -> None:
    report = Sweep().search(priced, 100.0)
    again = [setting for setting in report.settings if Priced.measured.count(setting) == TIMINGS]
    assert again and all(Priced.measured.count(setting) in (1, TIMINGS) for setting in report.settings)
    row = report.rows[report.settings.index(again[0])]
    scale = 1.5 if again[0].pressure == "cells" else 1.0
    assert row["ms_per_simulated_second"] == again[0].rate_hz * (again[0].iterations + 3) * scale - TIMINGS


def test_search_leaves_out_what_takes_too_long_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock on which a setting takes a second per 1000 of its work: 480 Hz x 20 takes 11 s, more than all there is."""
    clock = [0.0]
    monkeypatch.setattr("pbmpm.lab.accuracy.explore.time.process_time", lambda: clock[0])
    rows: list[Setting] = []

    def measure(setting: Setting) -> dict[str, Any]:
        clock[0] += setting.work / 1000.0
        rows.append(setting)
        return row_of(Priced(), setting, Measurement({"error": 0.04}, 1.0, 1.0, 0.0, True), None)

    explorer = Explorer(Priced(), measure, 10.0, 8)
    explorer.run()
    assert {(left.setting.rate_hz, left.setting.iterations) for left in explorer.left_out.values()} >= {(480.0, 20)}
    assert all(setting.work <= 10000.0 for setting in rows)
    assert set(explorer.cut_short()) >= {"paper", "dual"}
    assert "would take 11 s" in next(left.text() for left in explorer.left_out.values() if left.setting.rate_hz == 480.0)


def test_what_the_search_begins_with_takes_no_time_from_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the dearest settings of the sweep each solver but one has spent more than a fifth of the 20 s before the search
    begins. Each gets its third of them all the same: at half a second per setting 13 or 14 of them, as no search is over
    before."""
    clock = [0.0]
    monkeypatch.setattr("pbmpm.lab.accuracy.explore.time.process_time", lambda: clock[0])
    case = Priced()
    begun, searched = set(case.start(8)), dict.fromkeys(("paper", "dual", "explicit"), 0)

    def measure(setting: Setting) -> dict[str, Any]:
        clock[0] += 8.0 if setting in begun else 0.5
        searched[setting.solver] += setting not in begun
        # Better and dearer with the rate: all are on the front, and the search has no end.
        found = Measurement({"error": 1.0 / (1.0 + setting.work)}, setting.work, 1.0, 0.0, True)
        return row_of(case, setting, found, None)

    monkeypatch.setattr(Explorer, "affordable", lambda *_: True)
    explorer = Explorer(case, measure, 20.0, 8)
    explorer.run()
    assert set(searched.values()) <= {13, 14}


class Converging(Priced):
    """Its converged solutions leave an error that falls with the rate; the good settings and their costs are the law's."""

    def solve(self, setting: Setting) -> Measurement:
        self.measured.append(setting)
        Priced.clock += 1.0
        return Measurement({"error": 1.0 / setting.rate_hz}, 1.0, 1.0, 0.0, True, observed=(1.0 / setting.rate_hz,))


def test_all_good_accelerated_settings_are_compared_with_converged_ones(priced: Priced) -> None:
    """Also those that others on the front undercut, so that no timing decides which."""
    report = Sweep(with_converged=True).search(Converging(), 300.0)
    rows = [row for row in report.rows if row["solver"] == "dual" and row["cells"] == 8]
    good = [row for row in rows if row["error"] <= 0.05]
    assert any(beats(other, row) for row in good for other in good)
    assert [row["converged_error"] for row in good] == pytest.approx([1.0 / row["rate_hz"] for row in good])


def test_converged_solutions_that_take_too_long_are_those_of_the_worse_settings(
    priced: Priced, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Time for two of them: those of the two rates with the least errors. The dearest part of the dual's equals the paper's
    converged solution, which costs nothing again."""
    monkeypatch.setattr("pbmpm.lab.accuracy.sweep.REFERENCES_SHARE", 0.02)
    report = Sweep(with_converged=True).search(Converging(), 100.0)
    rows = [row for row in report.rows if row["solver"] == "dual" and row["cells"] == 8]
    known = {(row["variant"], row["rate_hz"]) for row in rows if row["converged_error"] is not None}
    assert len(known) == 2
    assert min(rows, key=lambda row: row["error"])["converged_error"] is not None


def test_search_on_several_grids_begins_with_the_same_courant_numbers(priced: Priced) -> None:
    """Twice as many cells: the explicit solver at twice the rate, the paper's also, the dual as it was."""
    start = priced.start(16)
    explicit = [setting.rate_hz for setting in start if setting.solver == "explicit"]
    dual = {setting.rate_hz for setting in start if setting.solver == "dual"}
    paper = {setting.rate_hz for setting in start if setting.solver == "paper"}
    assert (explicit, dual, paper) == ([960.0], {30.0, 480.0}, {60.0, 960.0})
    assert all(setting.cells == 16 for setting in start) and len(set(start)) == len(start)
    report = Sweep().search(priced, 100.0, (8, 16))
    assert report.facts()["compared_cells"] == [8, 16]
    assert {(setting.cells, setting.solver) for setting in report.settings} == {
        (cells, solver) for cells in (8, 16) for solver in ("paper", "dual", "explicit")
    }


def test_cells_alone_choose_the_grids_of_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Stub, "finer", (32, 16))
    assert Choice(cells=[24]).open and not Choice(cells=[24], rates=[60.0]).open
    assert Choice(cells=[24]).grids(Stub()) == (24,)
    assert Choice(finest=True).grids(Stub()) == (32,)
    assert Choice().grids(Stub()) == () and Stub().compared_cells == (8, 32, 16)


def test_a_search_that_has_an_end_is_not_cut_short(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock that stands still all neighbours get tried; one setting left out is enough to be short of time."""
    monkeypatch.setattr("pbmpm.lab.accuracy.explore.time.process_time", lambda: 0.0)
    case = Priced()
    explorer = Explorer(case, lambda setting: row_of(case, setting, case.measure(setting), None), 10.0, 8)
    explorer.run()
    assert explorer.cut_short() == []
    dear = replace(explorer.case.start(8)[-1], rate_hz=1e5)
    explorer.left_out[dear] = LeftOut(dear, 100.0)
    assert explorer.cut_short() == ["explicit"]


def test_ladders() -> None:
    assert [next_rate(60.0, True), next_rate(90.0, True)] == [90.0, 120.0]
    assert [next_rate(60.0, False), next_rate(100.0, False)] == [45.0, 90.0]
    assert [next_iterations(5, True), next_iterations(150, True), next_iterations(200, True)] == [7, 200, 200]
    assert [next_iterations(count, False) for count in (5, 6, 1)] == [4, 5, 1]


def report_file(path: Path, names: list[str], cpu: str = "a") -> Path:
    """A saved report with a row per case, whose error is the length of the file's name."""
    report = {
        "rows": [{"case": name, "error": len(path.name)} for name in names],
        "cases": [{"case": name} for name in names],
        "stable_means": "",
        "versions": {},
        "machine": {"cpu": cpu, "isa": "AVX2"},
    }
    path.write_text(json.dumps(report), encoding="utf-8")
    return path


def test_saved_reports_are_put_together_the_last_of_a_case_counts(tmp_path: Path) -> None:
    files = [report_file(tmp_path / "a.json", ["drop", "column"]), report_file(tmp_path / "later.json", ["column"])]
    whole = merged(files, ["column", "drop", "couette"])
    assert [facts["case"] for facts in whole["cases"]] == ["column", "drop"]
    assert [(row["case"], row["error"]) for row in whole["rows"]] == [("column", 10), ("drop", 6)]


def test_an_interrupted_sweep_goes_on_where_it_ended(tmp_path: Path) -> None:
    """A file with one of two cases in it: its row stays as it is, even one that nobody could have measured."""
    rows = tmp_path / "rows.json"
    options = ("--solvers", "dual", "--rates", "30", "--iterations", "2", "--cells", 8, "--json", rows)
    assert accuracy("taylor-green", "couette", *options).returncode == 0
    report = json.loads(rows.read_text())
    report["cases"] = report["cases"][:1]
    report["rows"] = [{**report["rows"][0], "error": 0.125}]
    rows.write_text(json.dumps(report))
    assert accuracy("taylor-green", "couette", *options, "--resume").returncode == 0
    found = json.loads(rows.read_text())
    assert [(row["case"], row["error"] == 0.125) for row in found["rows"]] == [("taylor-green", True), ("couette", False)]
    again = accuracy("taylor-green", *options, "--resume")
    assert again.returncode == 0 and "couette" in again.stdout and json.loads(rows.read_text()) == found
    other = accuracy("taylor-green", *options[:3], "60", *options[4:], "--resume")
    assert other.returncode == 2 and "measured with other options" in other.stderr
    assert json.loads(rows.read_text()) == found
    nowhere = accuracy("taylor-green", "--resume", "--json", "-")
    assert nowhere.returncode == 2 and "--resume needs a file" in nowhere.stderr


def test_saved_reports_that_do_not_fit_are_refused(tmp_path: Path) -> None:
    one, other = report_file(tmp_path / "a.json", ["drop"]), report_file(tmp_path / "b.json", ["column"], "b")
    with pytest.raises(InputError, match="different machines"):
        merged([one, other], ["drop", "column"])
    with pytest.raises(InputError, match="none of these"):
        merged([one], ["column"])
    (tmp_path / "c.json").write_text("[1]")
    with pytest.raises(InputError, match=r"c\.json: not what"):
        merged([tmp_path / "c.json"], ["drop"])
    (tmp_path / "c.json").write_text("{")
    with pytest.raises(InputError, match=r"c\.json: not JSON"):
        merged([tmp_path / "c.json"], ["drop"])


def test_page_from_saved_rows_says_how_to_measure_them_again(tmp_path: Path) -> None:
    rows, page = tmp_path / "rows.json", tmp_path / "page.html"
    options = ("--solvers", "paper,dual", "--rates", "30", "--iterations", "2", "--cells", 8)
    assert accuracy("taylor-green", *options, "--json", rows).returncode == 0
    shown = accuracy("taylor-green", "--from", rows, "--html", page)
    assert shown.returncode == 0 and "explicit not measured" in shown.stdout
    assert "<code>pbmpm accuracy taylor-green</code>" in page.read_text(encoding="utf-8")
    drawn = accuracy("taylor-green", "--from", rows, "--chart", tmp_path)
    assert drawn.returncode == 2 and "--chart needs the curves" in drawn.stderr
