"""The examples in the README are the ones that are tested, and run as they stand."""

from __future__ import annotations

import re
from pathlib import Path

import pytest


def example(root: Path, language: str) -> str:
    """The only code block of that language in the README."""
    text = (root / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)
    return block


def test_the_c_example_is_the_sample(root: Path) -> None:
    """samples/minimal.c is compiled and run by CTest."""
    assert example(root, "c") == (root / "samples" / "minimal.c").read_text(encoding="utf-8")


def test_the_python_example_runs(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(example(root, "python"), "README.md", "exec"), {})
    particles, height = capsys.readouterr().out.split()
    assert int(particles) == 800
    assert 0.125 < float(height) < 0.5  # between that of the pool it becomes and that of the column it was: energy is not gained
