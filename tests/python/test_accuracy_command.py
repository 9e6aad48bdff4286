"""The accuracy command on small versions of its cases."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

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
