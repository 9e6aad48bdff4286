"""The examples of the Python package do what they say."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import pbmpm


def test_the_example_of_the_readme_runs(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (root / "bindings" / "python" / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(example, "README.md", "exec"), {})
    figures, highest = capsys.readouterr().out.splitlines()
    assert figures.endswith("[]")
    assert 0 < float(highest) < 1


def test_the_example_of_the_module_runs() -> None:
    results = doctest.testmod(pbmpm)
    assert results.attempted > 0 and results.failed == 0
