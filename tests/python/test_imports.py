"""The rooms of the Python package: imports only point down, and the binding needs cffi and NumPy alone."""

from __future__ import annotations

import ast
import graphlib
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

BINDING = {"_cffi_backend", "numpy"}
"""What ``import pbmpm`` may take from outside of the standard library."""
COSTLY = {"click", "dask", "distributed", "jinja2", "matplotlib", "meshio", "PIL", "plotly", "plyfile", "pydantic", "scipy", "tqdm", "trimesh"}


def modules(package: Path) -> dict[str, Path]:
    """Files by the names of their modules; a package stands for its ``__init__.py``."""
    return {
        ".".join([package.name, *path.relative_to(package).with_suffix("").parts]).removesuffix(".__init__"): path
        for path in package.rglob("*.py")
    }


def statements(node: ast.AST) -> Iterator[ast.Import | ast.ImportFrom]:
    """All imports, within functions too, but those for type checkers."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child
        elif not (isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test)):
            yield from statements(child)


def imported(name: str, path: Path) -> Iterator[str]:
    """Absolute names of what a module imports, with the members that may be modules."""
    for statement in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(statement, ast.Import):
            yield from (alias.name for alias in statement.names)
            continue
        start = name.split(".") + ["__init__"] * (path.name == "__init__.py")
        base = start[: len(start) - statement.level] if statement.level else []
        source = ".".join([*base, *([statement.module] if statement.module else [])])
        members = [f"{source}.{alias.name}" for alias in statement.names]
        yield from members
        if statement.module:
            yield source


def graph(package: Path) -> dict[str, set[str]]:
    known = modules(package)
    return {name: {other for other in imported(name, path) if other in known and other != name} for name, path in known.items()}


@pytest.fixture(scope="module")
def package(root: Path) -> Path:
    return root / "bindings" / "python" / "src" / "pbmpm"


def test_no_module_imports_itself_by_a_circle(package: Path) -> None:
    list(graphlib.TopologicalSorter(graph(package)).static_order())


def test_a_planted_circle_is_found(tmp_path: Path) -> None:
    planted = tmp_path / "planted"
    planted.mkdir()
    (planted / "__init__.py").write_text("")
    (planted / "one.py").write_text("def late():\n    from . import two\n")
    (planted / "two.py").write_text("from .one import late\n")
    with pytest.raises(graphlib.CycleError):
        list(graphlib.TopologicalSorter(graph(planted)).static_order())


def test_the_binding_does_not_know_the_lab(package: Path) -> None:
    found = {name: {other for other in needed if other.startswith("pbmpm.lab")} for name, needed in graph(package).items() if not name.startswith("pbmpm.lab")}
    assert {name for name, needed in found.items() if needed} == {"pbmpm.__main__"}


def test_the_binding_loads_cffi_and_numpy_alone() -> None:
    code = "import json, sys, pbmpm; print(json.dumps(sorted({name.split('.')[0] for name in sys.modules})))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(json.loads(done.stdout))
    assert loaded >= BINDING and not loaded & COSTLY


def test_the_command_says_what_to_install(tmp_path: Path) -> None:
    code = "import sys; sys.modules['click'] = None\nfrom pbmpm.__main__ import main\nmain()"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "pip install 'pbmpm[lab]'" in done.stderr and "Traceback" not in done.stderr
