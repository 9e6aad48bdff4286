"""A library that does not fit is refused when the package is imported."""

from __future__ import annotations

import importlib.metadata
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import cffi
import pytest

import pbmpm
from generator import cdef, parser
from pbmpm import _library
from pbmpm._ffi import ffi
from pbmpm._library import lib


@pytest.fixture(scope="module")
def declarations(root: Path) -> str:
    return cdef.emit(parser.parse(root / "include"))


def import_with(library: Path | str, code: str = "import pbmpm") -> subprocess.CompletedProcess[str]:
    """Imports the package in a fresh interpreter with another library."""
    environment = {**os.environ, "PBMPM_LIBRARY": str(library)}
    return subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)


def test_the_library_has_the_layout_of_the_headers() -> None:
    own, theirs = _library.own_layout(ffi), _library.library_layout(ffi, lib)
    assert own == theirs
    assert own["pbmpm_particle_id", "generation"] == (4, 4)


@pytest.mark.parametrize(
    ("right", "wrong", "named"),
    [
        ("float radius;", "double radius;", "pbmpm_shape.radius"),
        ("float density; float relaxation;", "float relaxation; float density;", "pbmpm_material_def.relaxation"),
        ("float position[3]; uint32_t substep;", "float position[4]; uint32_t substep;", "pbmpm_event"),
        ("int32_t iterations; float gravity", "int32_t rounds; float gravity", "pbmpm_settings.rounds"),
    ],
    ids=["type", "order", "length", "name"],
)
def test_a_wrong_mirror_is_refused(declarations: str, right: str, wrong: str, named: str) -> None:
    assert right in declarations
    mirror = cffi.FFI()
    mirror.cdef(declarations.replace(right, wrong))
    theirs = _library.library_layout(ffi, lib)
    with pytest.raises(ImportError, match=re.escape(named)):
        _library.check_layout(_library.own_layout(mirror), theirs)


def test_a_library_may_have_appended_to_a_structure_with_a_size() -> None:
    own = _library.own_layout(ffi)
    offset, size = own["pbmpm_stats", ""]
    newer = {**own, ("pbmpm_stats", ""): (offset, size + 8), ("pbmpm_stats", "later"): (size, 8)}
    _library.check_layout(own, newer)
    with pytest.raises(ImportError, match="pbmpm_stats"):
        _library.check_layout(newer, own)


def test_a_structure_without_a_size_may_not_grow() -> None:
    own = _library.own_layout(ffi)
    with pytest.raises(ImportError, match="pbmpm_layout_entry"):
        _library.check_layout(own, {**own, ("pbmpm_layout_entry", ""): (0, own["pbmpm_layout_entry", ""][1] + 8)})


def fake_library(version: int, abi: int) -> SimpleNamespace:
    return SimpleNamespace(pbmpm_version=lambda: version, pbmpm_abi_version=lambda: abi)


def test_version_and_abi() -> None:
    version, abi = lib.pbmpm_version(), lib.pbmpm_abi_version()
    _library.check_version(ffi, fake_library(version + 1, abi))
    with pytest.raises(ImportError, match=f"needs ABI {abi}, but the shared library has ABI {abi + 1}"):
        _library.check_version(ffi, fake_library(version, abi + 1))
    with pytest.raises(ImportError, match="or later"):
        _library.check_version(ffi, fake_library(version - 1, abi))


def test_the_version_is_that_of_the_headers(root: Path) -> None:
    api = parser.parse(root / "include")
    numbers = [str(api.constant(f"PBMPM_VERSION_{part}")) for part in ("MAJOR", "MINOR", "PATCH")]
    assert pbmpm.__version__ == ".".join(numbers)


def test_a_missing_library_is_named() -> None:
    result = import_with("/no/such/libpbmpm.so")
    assert result.returncode == 1
    assert "LibraryError: pbmpm: there is no shared library at /no/such/libpbmpm.so" in result.stderr
    assert "PBMPM_LIBRARY" in result.stderr


def test_a_file_that_is_no_library_is_refused(tmp_path: Path) -> None:
    broken = tmp_path / "libpbmpm.so"
    broken.write_text("not a library")
    result = import_with(broken)
    assert result.returncode == 1 and f"cannot load the shared library {broken}" in result.stderr


def test_another_library_is_refused() -> None:
    import _cffi_backend

    result = import_with(_cffi_backend.__file__)
    assert result.returncode == 1 and "LibraryError: pbmpm: cannot load the shared library" in result.stderr


def test_the_environment_variable_chooses_the_library() -> None:
    result = import_with(pbmpm.library_path(), "import pbmpm; print(pbmpm.library_path())")
    assert result.stdout.strip() == str(pbmpm.library_path())


def test_one_wheel_for_all_pythons_holds_the_library() -> None:
    package = importlib.metadata.distribution("pbmpm")
    assert "Tag: py3-none-" in (package.read_text("WHEEL") or "")
    assert pbmpm.__version__ == package.version
    shipped = {str(file) for file in package.files or ()}
    assert {f"pbmpm/{pbmpm.library_path().name}", "pbmpm/_ffi.py", "pbmpm/py.typed"} <= shipped


def test_the_instruction_set_has_a_name() -> None:
    assert pbmpm.isa() in ("SSE4", "AVX2", "AVX-512")


def test_the_build_tells_whether_it_is_strict() -> None:
    assert pbmpm.is_strict() in (True, False)


def test_all_materials_are_built() -> None:
    assert set(pbmpm.built_materials()) == {pbmpm.Liquid, pbmpm.Elastic, pbmpm.Sand, pbmpm.Visco}
