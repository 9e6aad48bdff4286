"""Compiles the assembled package as Unity would: each assembly definition with the references that it names and no others.

compile.py PACKAGE OUTPUT    with the compiler in PBMPM_CSC (mcs -langversion:7.2), against stand-ins for the engine and the editor
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from validate import ROOT, assemblies

HERE = ROOT / "tests" / "unity"
COMPILER = shlex.split(os.environ.get("PBMPM_CSC", "mcs -langversion:7.2"))
DEFINES = ("UNITY_5_3_OR_NEWER", "UNITY_2021_2_OR_NEWER", "UNITY_2021_3_OR_NEWER", "UNITY_INCLUDE_TESTS")
CHECKS = "ENABLE_UNITY_COLLECTIONS_CHECKS"
FRAMEWORK = ("System.dll", "System.Core.dll", "System.Numerics.dll")
TESTING = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}


def compile_one(output: Path, sources: list[Path], references: list[str] = [], options: tuple[str, ...] = ()) -> None:  # noqa: B006 # not changed
    kind = "exe" if output.suffix == ".exe" else "library"
    command = [*COMPILER, "-warn:4", "-warnaserror", f"-target:{kind}", f"-out:{output.name}", *options]
    command += [f"-r:{name}" for name in (*FRAMEWORK, *references)] + [str(path) for path in sorted(sources)]
    if subprocess.run(command, cwd=output.parent, check=False).returncode != 0:
        sys.exit(f"{output.name} does not compile")


def compile_engine(output: Path) -> None:
    compile_one(output / "UnityEngine.dll", list((HERE / "engine").glob("*.cs")), options=("-unsafe",))
    compile_one(output / "UnityEditor.dll", list((HERE / "editor").glob("*.cs")), ["UnityEngine.dll"])
    compile_one(output / "TestFramework.dll", [HERE / "player" / "NUnit.cs"], ["UnityEngine.dll"])


def compile_package(package: Path, output: Path, defines: tuple[str, ...]) -> None:
    """Assemblies in the order of their references."""
    waiting = assemblies(package)
    done: set[str] = set()
    while waiting:
        ready = [name for name, (_, read) in waiting.items() if set(read["references"]) - TESTING <= done]
        if not ready:
            sys.exit(f"assemblies that wait for each other: {', '.join(waiting)}")
        for name in ready:
            folder, read = waiting.pop(name)
            compile_assembly(package, output, folder, read, defines)
            done.add(name)


def compile_assembly(package: Path, output: Path, folder: Path, read: dict, defines: tuple[str, ...]) -> None:
    inner = [other for other, _ in assemblies(package).values() if other != folder and folder in other.parents]
    sources = [path for path in folder.rglob("*.cs") if not any(other in path.parents for other in inner)]
    references = ["UnityEngine.dll", *(f"{other}.dll" for other in read["references"] if other not in TESTING)]
    if "Editor" in read.get("includePlatforms", []):
        references.append("UnityEditor.dll")
    if TESTING & set(read["references"]):
        references.append("TestFramework.dll")
    options = (*(f"-define:{name}" for name in defines), *(("-unsafe",) if read.get("allowUnsafeCode") else ()))
    compile_one(output / f"{read['name']}.dll", sources, references, options)


def compile_samples(package: Path, output: Path) -> None:
    """As scripts of the user, with the old input manager and without it."""
    references = ["UnityEngine.dll", "Pbmpm.Core.dll", "Pbmpm.Components.dll"]
    sources = list((package / "Samples~").rglob("*.cs"))
    compile_one(output / "SamplesNewInput.dll", sources, references)
    compile_one(output / "SampleScripts.dll", sources, references, ("-define:ENABLE_LEGACY_INPUT_MANAGER",))


def compile_readme(package: Path, output: Path) -> None:
    """Its example, as a user's script."""
    example = output / "Example.cs"
    example.write_text("\n".join(re.findall(r"```csharp\n(.*?)```", (package / "README.md").read_text(encoding="utf-8"), re.DOTALL)), encoding="utf-8")
    compile_one(output / "Example.dll", [example], ["UnityEngine.dll", "Pbmpm.Core.dll", "Pbmpm.Components.dll"])


def main(package: Path, output: Path) -> None:
    output.mkdir(parents=True, exist_ok=True)
    compile_engine(output)
    compile_package(package, output, DEFINES)  # as in a player
    compile_package(package, output, (*DEFINES, "UNITY_EDITOR", CHECKS))  # as in the editor; this one is run
    compile_samples(package, output)
    compile_readme(package, output)
    player = HERE / "player"
    references = ["UnityEngine.dll", "Pbmpm.Core.dll", "Pbmpm.Components.dll"]
    compile_one(output / "RunTests.exe", [player / "RunTests.cs"], [*references, "TestFramework.dll"])
    compile_one(output / "Frames.exe", [player / "Frames.cs", player / "Scene.cs"], references)
    compile_one(output / "Reload.exe", [player / "Reload.cs", player / "Scene.cs"], references)
    compile_one(output / "Samples.exe", [player / "Samples.cs"], [*references, "SampleScripts.dll"])


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
