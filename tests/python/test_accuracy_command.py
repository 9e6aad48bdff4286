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

from pbmpm.app.accuracy.case import Case, ErrorMeasure, Measurement, Setting, parse_variant, settings_of
from pbmpm.app.accuracy.registry import all_cases, find_cases
from pbmpm.app.accuracy.sweep import Choice, Sweep
from pbmpm.app.accuracy.table import legend, table
from pbmpm.app.errors import InputError

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
    command = [sys.executable, "-m", "pbmpm.app", "accuracy", *map(str, arguments)]
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


@pytest.mark.parametrize("variant", ["paper", "dual-cells", "dual-cells-flip0.9", "primal-bdf2", "explicit"])
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
