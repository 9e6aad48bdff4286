"""What a minor version may do to the interface: the headers of each version that was kept, compared with those of now. See docs/abi.md."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from generator import header, model, parser, sized

ROOT = Path(__file__).resolve().parents[2]
KEPT = sorted(folder.parent.name for folder in (ROOT / "tests" / "abi").glob("*/include"))


def breaks(old: model.Api, new: model.Api) -> list[str]:
    """What of the old interface the new one does not keep."""
    found = []
    functions = {item.name: item.signature for item in new.functions}
    structures = {item.name: item for item in new.structures}
    enumerations = {item.name: {member.name: member.value for member in item.members} for item in new.enumerations}
    for function in old.functions:
        if functions.get(function.name) != function.signature:
            found.append(f"function {function.name}")
    for structure in old.structures:
        was = [(field.name, field.type) for field in structure.fields]
        now = [(field.name, field.type) for field in structures[structure.name].fields] if structure.name in structures else []
        if now[: len(was)] != was or (len(now) > len(was) and not sized.grows(structure)):
            found.append(f"structure {structure.name}")
    for enumeration in old.enumerations:
        for member in enumeration.members:
            if enumerations.get(enumeration.name, {}).get(member.name) != member.value:
                found.append(f"member {member.name}")
    limits = {item.name: item.value for item in new.constants}
    versions = re.compile("PBMPM_(VERSION|SNAPSHOT_VERSION)")
    found += [f"constant {item.name}" for item in old.constants if not versions.match(item.name) and limits.get(item.name) != item.value]
    return found


@pytest.fixture(scope="module")
def api() -> model.Api:
    return parser.parse(ROOT / "include")


@pytest.mark.parametrize("version", KEPT)
def test_the_interface_of_a_version_is_kept(version: str, api: model.Api) -> None:
    assert breaks(parser.parse(ROOT / "tests" / "abi" / version / "include"), api) == []


@pytest.mark.parametrize(
    ("before", "after", "named"),
    [
        ("uint32_t size; int32_t substeps;", "uint32_t size; int32_t moved; int32_t substeps;", "structure pbmpm_settings"),
        (" int32_t iterations;", " float iterations;", "structure pbmpm_settings"),
        (" int32_t iterations;", "", "structure pbmpm_settings"),
        ("world_id { uint32_t index; uint32_t generation; }", "world_id { uint32_t index; uint32_t generation; uint32_t more; }", "structure pbmpm_world_id"),
        ("pbmpm_world_wake", "pbmpm_world_rouse", "function pbmpm_world_wake"),
        ("pbmpm_world_step(pbmpm_world_id world, float dt)", "pbmpm_world_step(pbmpm_world_id world, double dt)", "function pbmpm_world_step"),
        ("PBMPM_ERROR_BUSY = 5", "PBMPM_ERROR_BUSY = 55", "member PBMPM_ERROR_BUSY"),
        ("PBMPM_MAX_FORCES 64", "PBMPM_MAX_FORCES 32", "constant PBMPM_MAX_FORCES"),
    ],
)  # fmt: skip
def test_a_planted_break_is_seen(before: str, after: str, named: str, api: model.Api, tmp_path: Path) -> None:
    text = header.emit(api)
    assert text.count(before) == 1 or before == "pbmpm_world_wake"
    assert breaks(api, changed(text.replace(before, after), tmp_path)) == [named]


def test_growth_is_no_break(api: model.Api, tmp_path: Path) -> None:
    text = header.emit(api).replace("float sleep_time; }", "float sleep_time; uint64_t later; }")
    text = text.replace("PBMPM_ERROR_FOREIGN = 12,", "PBMPM_ERROR_FOREIGN = 12, PBMPM_ERROR_LATER = 13,")
    assert "later" in text and "LATER" in text
    assert breaks(api, changed(text, tmp_path)) == []


def test_the_binding_works_with_a_library_that_is_ahead() -> None:
    """The binding of now on the library that tests/abi builds, whose structures have all grown by a field."""
    library = ROOT / "build" / "tests" / "tests" / "abi" / "grown" / "lib" / "libpbmpm.so"
    if not library.is_file():
        pytest.skip("the C tests build it")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    command += [f"tests/python/{name}.py" for name in ("test_binding_views", "test_queries", "test_snapshots")]
    environment = {**os.environ, "PBMPM_LIBRARY": str(library)}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-4000:]


def changed(text: str, folder: Path) -> model.Api:
    (folder / "pbmpm").mkdir()
    (folder / "pbmpm" / "pbmpm.h").write_text(text, encoding="utf-8")
    return parser.parse(folder)
