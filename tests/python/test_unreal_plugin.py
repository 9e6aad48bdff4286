"""The Unreal plugin's descriptors, the rules of its build, and its package; tests/unreal compiles and runs its sources."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PLUGIN = ROOT / "bindings" / "unreal" / "Pbmpm"
TYPES = {"Runtime", "RuntimeNoCommandlet", "Developer", "Editor", "EditorNoCommandlet", "UncookedOnly", "ClientOnly", "ServerOnly"}
PHASES = {"EarliestPossible", "PostConfigInit", "PostSplashScreen", "PreEarlyLoadingScreen", "PreLoadingScreen", "PreDefault", "Default", "PostDefault", "PostEngineInit"}
FIELDS = {
    "FileVersion", "Version", "VersionName", "FriendlyName", "Description", "Category", "CreatedBy", "CreatedByURL", "DocsURL", "MarketplaceURL", "SupportURL",
    "CanContainContent", "IsBetaVersion", "Installed", "Modules", "Plugins",
}  # fmt: skip
ENGINE = {"Core", "CoreUObject", "Engine", "Landscape", "Projects", "RenderCore", "Niagara"}
"""Modules of Unreal's own that the plugin names."""


def problems(plugin: Path) -> list[str]:
    """What is wrong with a plugin's folder."""
    descriptor = json.loads((plugin / "Pbmpm.uplugin").read_text(encoding="utf-8"))
    found = [f"unknown field {name}" for name in descriptor.keys() - FIELDS]
    if descriptor.get("FileVersion") != 3:
        found.append("FileVersion is not 3")
    folders = {path.name for path in (plugin / "Source").iterdir() if path.name != "ThirdParty"}
    external = {path.name for path in (plugin / "Source" / "ThirdParty").iterdir()}
    modules = {module["Name"]: module for module in descriptor["Modules"]}
    found += [f"{name} is a folder or a module, and not both" for name in folders ^ modules.keys()]
    for name, module in modules.items():
        if module["Type"] not in TYPES or module["LoadingPhase"] not in PHASES:
            found.append(f"{name} has an unknown type or phase")
        if not list((plugin / "Source" / name).rglob("*.cpp")) or not any(
            "IMPLEMENT_MODULE" in path.read_text(encoding="utf-8") and name in path.read_text(encoding="utf-8") for path in (plugin / "Source" / name).rglob("*.cpp")
        ):
            found.append(f"{name} implements no module")
    for folder in [plugin / "Source" / name for name in folders] + [plugin / "Source" / "ThirdParty" / name for name in external]:
        rules = folder / f"{folder.name}.Build.cs"
        if not rules.exists():
            found.append(f"{folder.name} has no Build.cs")
            continue
        text = rules.read_text(encoding="utf-8")
        if not re.search(rf"public class {folder.name} : ModuleRules\b", text) or not re.search(rf"public {folder.name}\(ReadOnlyTargetRules Target\) : base\(Target\)", text):
            found.append(f"{rules.name} has no class {folder.name} of module rules")
        if text.count("{") != text.count("}") or text.count("(") != text.count(")"):
            found.append(f"{rules.name} has brackets that do not match")
        named = {name for line in re.findall(r"DependencyModuleNames\.AddRange\(new string\[\] \{([^}]*)\}", text) for name in re.findall(r'"(\w+)"', line)}
        found += [f"{rules.name} depends on {name}, which is unknown" for name in named - ENGINE - folders - external]
    enabled = {entry["Name"] for entry in descriptor.get("Plugins", []) if entry["Enabled"]}
    if "PbmpmNiagara" in modules and "Niagara" not in enabled:
        found.append("the plugin Niagara is not enabled")
    return found


def test_the_plugin_is_well_formed() -> None:
    assert problems(PLUGIN) == []


def test_its_version_is_the_librarys() -> None:
    text = (ROOT / "include" / "pbmpm" / "version.h").read_text(encoding="utf-8")
    version = ".".join(re.search(rf"PBMPM_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))  # type: ignore[index]
    assert json.loads((PLUGIN / "Pbmpm.uplugin").read_text(encoding="utf-8"))["VersionName"] == version


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("Pbmpm.uplugin", '"Runtime"', '"Realtime"'),
        ("Pbmpm.uplugin", '"PbmpmNiagara"', '"PbmpmSmoke"'),
        ("Source/PbmpmRuntime/PbmpmRuntime.Build.cs", '"PbmpmLibrary"', '"PbmpmLib"'),
        ("Source/PbmpmRuntime/PbmpmRuntime.Build.cs", "public class PbmpmRuntime", "public class Pbmpm"),
        ("Source/PbmpmNiagara/Private/PbmpmNiagaraComponent.cpp", "IMPLEMENT_MODULE", "IMPLEMENT"),
    ],
)
def test_faults_are_found(tmp_path: Path, file: str, old: str, new: str) -> None:
    copy = Path(shutil.copytree(PLUGIN, tmp_path / "Pbmpm"))
    text = (copy / file).read_text(encoding="utf-8")
    (copy / file).write_text(text.replace(old, new, 1), encoding="utf-8")
    assert problems(copy) != []


def test_a_module_without_rules_is_found(tmp_path: Path) -> None:
    copy = Path(shutil.copytree(PLUGIN, tmp_path / "Pbmpm"))
    (copy / "Source" / "ThirdParty" / "PbmpmLibrary" / "PbmpmLibrary.Build.cs").unlink()
    assert problems(copy) == ["PbmpmLibrary has no Build.cs"]


def test_the_package_holds_what_the_rules_name(tmp_path: Path) -> None:
    """With an empty file for a library: nothing is run."""
    top = tmp_path / "pbmpm"
    for folder in ("bindings/unreal", "bindings/engine", "include", "packaging", "samples", "src/api"):
        shutil.copytree(ROOT / folder, top / folder, ignore=shutil.ignore_patterns("pictures", "*.gif"))
    shutil.copy(ROOT / "LICENSE", top)
    (top / "libpbmpm.so").write_bytes(b"")
    names = ["libpbmpm.so"]
    if shutil.which("llvm-dlltool-19") or shutil.which("llvm-dlltool"):
        (top / "pbmpm.dll").write_bytes(b"")
        names.append("pbmpm.dll")
    subprocess.run(["sh", "packaging/unreal.sh", *names], cwd=top, check=True, stdout=subprocess.DEVNULL)
    (archive,) = (top / "dist").glob("Pbmpm-unreal-*.zip")
    held = set(zipfile.ZipFile(archive).namelist())
    rules = (PLUGIN / "Source" / "ThirdParty" / "PbmpmLibrary" / "PbmpmLibrary.Build.cs").read_text(encoding="utf-8")
    binaries = re.findall(r"\$\(PluginDir\)/([\w./]+)", rules)
    assert len(binaries) == 2
    wanted = [name for name in binaries if name.endswith(".so.1") or len(names) == 2]
    wanted += ["Pbmpm.uplugin", "README.md", "LICENSE"]
    wanted += [f"Source/ThirdParty/PbmpmLibrary/include/{name}" for name in ("pbmpm/pbmpm.hpp", "pbmpm/world.h", "pbmpm_engine/simulation.hpp")]
    wanted += ["Source/ThirdParty/PbmpmLibrary/lib/Win64/pbmpm.lib"] if len(names) == 2 else []
    assert [name for name in wanted if f"Pbmpm/{name}" not in held] == []
