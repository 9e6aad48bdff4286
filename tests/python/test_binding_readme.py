"""The examples of the Python package do what they say."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import pbmpm


def test_the_examples_of_the_readme_run(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In their order, in one program: later ones may use the imports of the first."""
    text = (root / "bindings" / "python" / "README.md").read_text(encoding="utf-8")
    names: dict[str, object] = {}
    printed = []
    for example in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        exec(compile(example, "README.md", "exec"), names)
        printed.append(capsys.readouterr().out.splitlines())
    (figures, highest), (under,), (solver,), _, (along,) = printed[:5]
    assert figures.endswith("[]") and 0 < float(highest) < 1
    assert 0.1 < float(under) < 0.9  # the boat swims, and still bobs
    assert "Stop.ITERATIONS" in solver
    assert 0.6 < float(along) < 2.0  # it began at 0.2


def test_the_example_of_the_module_runs() -> None:
    results = doctest.testmod(pbmpm)
    assert results.attempted > 0 and results.failed == 0
