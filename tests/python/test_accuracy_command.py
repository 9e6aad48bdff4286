"""The accuracy command on small versions of its cases."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from pbmpm.app.accuracy.column import Column
from pbmpm.app.accuracy.dam_break import DamBreak
from pbmpm.app.accuracy.sweep import TABLES, sweep, table
from pbmpm.app.simulation import RunSettings

DAM_BREAK_KEYS = {
    "rate_hz",
    "iterations",
    "ms_per_simulated_second",
    "front_rms",
    "front_rms_shifted",
    "shift",
    "height_rms",
    "volume_error_rms",
    "stable",
}


def test_dam_break_json_and_chart(tmp_path: Path) -> None:
    options = [
        "--rates",
        "60,120",
        "--iterations",
        "2,5",
        "--cells",
        "8",
        "--quick",
        "--chart",
        str(tmp_path / "chart.png"),
    ]
    command = [sys.executable, "-m", "pbmpm.app", "accuracy", "dam-break", *options, "--json", "-"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode in (0, 1), done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    assert report["case"] == "dam-break"
    assert [(row["rate_hz"], row["iterations"]) for row in report["rows"]] == [(60, 2), (60, 5), (120, 2), (120, 5)]
    assert all(set(row) >= DAM_BREAK_KEYS for row in report["rows"])
    assert report["cell_size"] == pytest.approx(1 / 8)
    assert {"isa", "cpu", "date", "threads"} <= set(report["machine"])
    assert Image.open(tmp_path / "chart.png").width > 800


def test_dam_break_reaches_the_experiment_at_a_moderate_setting() -> None:
    row = DamBreak(stability_seconds=2.0).measure(RunSettings(60.0, 1, 10, 1))
    assert row["front_rms"] <= 0.10
    assert row["front_rms_shifted"] <= 0.05
    assert row["height_rms"] <= 0.12
    assert row["reasons"] == []


def test_coarsest_dam_break_is_stable_for_20_seconds() -> None:
    row = DamBreak(stability_seconds=20.0).measure(RunSettings(30.0, 1, 1, 1))
    assert row["stable"], row["reasons"]


@pytest.mark.parametrize(("rate", "iterations"), [(120.0, 10), (240.0, 2), (240.0, 5)])
def test_column_sinks_as_the_law_says(rate: float, iterations: int) -> None:
    """Without volume feedback, as the law is derived. The feedback may change the height by a few percent."""
    row = Column(cells=16, seconds=4.0).measure(RunSettings(rate, 1, iterations, 1))
    assert row["stable"], row["reasons"]
    assert row["height_error_without_feedback"] == pytest.approx(row["height_error_law"], rel=0.1)
    assert row["volume_error_without_feedback"] == pytest.approx(row["volume_error_law"], rel=0.1)
    assert row["height_error"] == pytest.approx(row["height_error_law"], abs=0.05)
    assert row["volume_error_rms"] == pytest.approx(row["volume_error_law"], rel=0.25)


def test_an_unstable_setting_stays_in_the_table_as_failed() -> None:
    class Broken:
        name = "column"

        def facts(self) -> dict[str, Any]:
            return {"cell_size": 0.1}

        def measure(self, settings: RunSettings) -> dict[str, Any]:
            keys = [key for _, key, *_ in TABLES["column"][3:]]
            row = {"rate_hz": settings.rate_hz, "iterations": settings.iterations, "ms_per_simulated_second": 1.0}
            return {**row, **dict.fromkeys(keys), "stable": False, "reasons": ["it blew up at 1 s"]}

    text = table(sweep(Broken(), [30.0], [1, 2], threads=1))
    assert text.count("FAILED: it blew up at 1 s") == 2
