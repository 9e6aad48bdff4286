"""Progress away from a terminal: lines now and then."""

from __future__ import annotations

import io

import pytest
from progress_lines import without_progress

from pbmpm.lab import progress


def test_a_redirected_bar_writes_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    stderr, clock = io.StringIO(), [0.0]
    monkeypatch.setattr("sys.stderr", stderr)
    monkeypatch.setattr("pbmpm.lab.progress.time.monotonic", lambda: clock[0])
    with progress.progress_bar(40, "run", "map") as bar:
        for _ in range(40):
            clock[0] += 1.0
            bar.set_postfix_str("H04")
            bar.update()
    lines = stderr.getvalue().splitlines()
    assert 3 <= len(lines) <= 4 and all(line.startswith("map: ") and "/40 run [" in line for line in lines)
    assert without_progress(stderr.getvalue()) == []


def test_what_is_soon_done_writes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    stderr = io.StringIO()
    monkeypatch.setattr("sys.stderr", stderr)
    with progress.progress_bar(3, "run", "map") as bar:
        for _ in range(3):
            bar.update()
    assert stderr.getvalue() == ""
