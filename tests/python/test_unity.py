"""The Unity package, as far as it can be looked at without compiling: layout, .meta files, assembly definitions, shaders."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "unity"))
import shaders  # noqa: E402 # beside the stand-ins for Unity
import validate  # noqa: E402
from validate import unity  # noqa: E402


@pytest.fixture
def package(tmp_path: Path) -> Path:
    unity.assemble(tmp_path / "package")
    return tmp_path / "package"


@pytest.fixture
def source(tmp_path: Path) -> Path:
    return Path(shutil.copytree(unity.SOURCE, tmp_path / "unity"))


def test_the_tree_has_no_flaw() -> None:
    assert validate.problems(unity.SOURCE, assembled=False) == []


def test_the_assembled_package_has_no_flaw(package: Path) -> None:
    assert validate.problems(package, assembled=True) == []


def test_packing_twice_gives_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "dist").mkdir()
    monkeypatch.setattr(unity, "ROOT", tmp_path)
    (tmp_path / "bindings" / "csharp").mkdir(parents=True)
    shutil.copytree(ROOT / "bindings" / "csharp" / "src", tmp_path / "bindings" / "csharp" / "src")
    shutil.copy(ROOT / "LICENSE", tmp_path)
    assert unity.pack().read_bytes() == unity.pack().read_bytes()


def test_identifiers_follow_from_the_path() -> None:
    """Scenes of users find their scripts by these."""
    assert unity.guid("Runtime/PbmpmWorld.cs") == "a0b30fb77961daebd0ba0f343dbadfe2"
    assert len({unity.guid(name) for name in unity.source_assets()}) == len(unity.source_assets())


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        ("Runtime/PbmpmWorld.cs.meta", None, None, "no .meta: Runtime/PbmpmWorld.cs"),
        ("Runtime/Plugins/Linux/x86_64/libpbmpm.so.meta", "OS: Linux", "OS: AnyOS", "not as packaging/unity.py writes it"),
        ("Runtime/PbmpmWorld.cs.meta", "guid: ", "guid: x", "no GUID"),
        ("Runtime/Pbmpm.Components.asmdef", '"Pbmpm.Core"', '"Pbmpm.Kernel"', "refers to Pbmpm.Kernel, which is not there"),
        ("Runtime/Pbmpm.Components.asmdef", '"Pbmpm.Core"', '"Pbmpm.Editor"', "is for players and refers to Pbmpm.Editor"),
        ("Runtime/StepClock.cs", "using System;", "using UnityEditor;", "uses the editor in players"),
        ("Runtime/PbmpmWorld.cs", "class PbmpmWorld :", "class PbmpmTank :", "Unity looks for PbmpmTank"),
        ("package.json", '"version": "', '"version": "9.', "package.json has version 9."),
        ("Editor", None, None, "missing: Editor"),
    ],
)
def test_a_flaw_is_told(source: Path, file: str, old: str | None, new: str | None, told: str) -> None:
    path = source / file
    if old is None or new is None:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    else:
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert any(told in line for line in validate.problems(source, assembled=False))


def test_a_script_without_a_meta_is_told(package: Path) -> None:
    (package / "Runtime" / "New.cs").write_text("class New {}\n", encoding="utf-8")
    assert validate.problems(package, assembled=True) == ["no .meta: Runtime/New.cs"]


def test_presets_have_the_fields_that_unity_reads() -> None:
    from pbmpm.lab.scenes.preset import FORMAT_NAME, Preset, PresetSettings

    text = (unity.SOURCE / "Runtime" / "PbmpmPreset.cs").read_text(encoding="utf-8")
    assert set(re.findall(r"^            public \w+ (\w+) = ", text, re.MULTILINE)) == set(PresetSettings.model_fields)
    assert f'"{FORMAT_NAME}"' in text
    assert f"version != {Preset.model_fields['version'].default}" in text


@pytest.mark.skipif(shutil.which("glslangValidator") is None, reason="glslangValidator is needed (Debian: glslang-tools)")
def test_shaders_parse() -> None:
    count, found = shaders.problems(shaders.SHADERS)
    assert found == []
    assert count == 2 * len(shaders.APIS) * 5  # a vertex and a fragment program of each of five passes
