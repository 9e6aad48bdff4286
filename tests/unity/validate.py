"""What Unity would complain about in the package, without Unity: validate.py [FOLDER] prints it, and ends with 1 if there is anything.

FOLDER is the package as packaging/unity.py assembles it; without one it is bindings/unity, where libraries and the C# binding are still missing.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging"))
import unity  # noqa: E402 # beside this only through the path

WANTED = ("package.json", "README.md", "CHANGELOG.md", "Runtime", "Editor", "Tests/Runtime", "Tests/Editor", "Samples~", "Documentation~")
ENGINE = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}


def problems(root: Path, *, assembled: bool) -> list[str]:
    wanted = unity.assets(root) if assembled else unity.source_assets()
    return [
        *(f"missing: {name}" for name in (*WANTED, *(("LICENSE.md",) if assembled else ())) if not (root / name).exists()),
        *_metas(root, wanted),
        *_manifest(root),
        *_assemblies(root),
        *_scripts(root),
        *(_libraries(root) if assembled else _copies(root)),
    ]


def _metas(root: Path, wanted: dict[str, bool]) -> list[str]:
    found = {path.relative_to(root).as_posix().removesuffix(".meta") for path in root.rglob("*.meta")}
    lost = [f"no .meta: {name}" for name in wanted if name not in found]
    stray = [f".meta of nothing: {name}" for name in sorted(found - set(wanted))]
    texts = {name: (root / f"{name}.meta").read_text(encoding="utf-8") for name in wanted if name in found}
    stale = [f"not as packaging/unity.py writes it: {name}.meta" for name, text in texts.items() if text != unity.meta(name, wanted[name])]
    guids: dict[str, str] = {}
    twins = []
    for name, text in texts.items():
        match = re.search(r"^guid: ([0-9a-f]{32})$", text, re.MULTILINE)
        if match is None:
            twins.append(f"no GUID: {name}.meta")
        elif guids.setdefault(match[1], name) != name:
            twins.append(f"the same GUID: {name} and {guids[match[1]]}")
    return [*lost, *stray, *stale, *twins]


def _manifest(root: Path) -> list[str]:
    manifest = json.loads((root / "package.json").read_text(encoding="utf-8"))
    header = (ROOT / "include" / "pbmpm" / "version.h").read_text(encoding="utf-8")
    numbers = [re.search(rf"PBMPM_VERSION_{part} (\d+)", header) for part in ("MAJOR", "MINOR", "PATCH")]
    version = ".".join(match[1] for match in numbers if match)
    found = []
    if manifest["version"] != version:
        found.append(f"package.json has version {manifest['version']}, the library {version}")
    if not re.fullmatch(r"[a-z0-9-]+(\.[a-z0-9-]+)+", manifest["name"]):
        found.append("package.json: names are small letters with dots")
    found += [f"package.json: no folder {sample['path']}" for sample in manifest["samples"] if not (root / sample["path"]).is_dir()]
    return found


def assemblies(root: Path) -> dict[str, tuple[Path, dict]]:
    """Folder and definition by name."""
    return {(read := json.loads(path.read_text(encoding="utf-8")))["name"]: (path.parent, read) for path in sorted(root.rglob("*.asmdef"))}


def _assemblies(root: Path) -> list[str]:
    known = assemblies(root)
    found = []
    for name, (folder, read) in known.items():
        if not (folder / f"{name}.asmdef").exists():
            found.append(f"{name}: its file has another name")
        found += [f"{name} refers to {other}, which is not there" for other in read["references"] if other not in known and other not in ENGINE]
        is_editor = read.get("includePlatforms") == ["Editor"]
        found += [f"{name} is for players and refers to {other}, which is not" for other in read["references"] if not is_editor and _is_editor(known, other)]
        if name == "pbmpm":
            found.append("an assembly must not have the name of the native library")
    return found


def _is_editor(known: dict[str, tuple[Path, dict]], name: str) -> bool:
    return name in known and known[name][1].get("includePlatforms") == ["Editor"]


def _scripts(root: Path) -> list[str]:
    """What compilers ahead of time cannot do, and scripts whose class Unity would not find."""
    found = []
    for path in sorted(root.rglob("*.cs")):
        name, text = path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")
        if re.search(r"Reflection\.Emit|\bdynamic\b|Activator\.CreateInstance|MakeGenericType", re.sub(r"//.*", "", text)):
            found.append(f"{name}: makes code at run time")
        if "using UnityEditor" in text and not name.startswith(("Editor/", "Tests/Editor/")):
            found.append(f"{name}: uses the editor in players")
        for kind in re.findall(r"class (\w+) : (?:MonoBehaviour|ScriptableObject|PbmpmPart|PbmpmRenderer|PbmpmMaterial|PbmpmStiffMaterial)\b", text):
            if kind != path.stem.split(".")[0] and f"abstract class {kind}" not in text:
                found.append(f"{name}: Unity looks for {kind} in {kind}.cs")
    return found


def _copies(root: Path) -> list[str]:
    """The C# binding is copied by packaging; a second one would grow old."""
    return [f"a copy of the C# binding: {path.name}" for path in sorted((root / unity.CORE).glob("*.cs"))]


def _libraries(root: Path) -> list[str]:
    binding = {path.name for path in (ROOT / "bindings" / "csharp" / "src").glob("*.cs")}
    found = [f"no {unity.CORE}/{name}" for name in sorted(binding) if not (root / unity.CORE / name).exists()]
    placed = {one.path for one in unity.PLUGINS}
    stray = [path.relative_to(root).as_posix() for path in root.rglob("*") if path.suffix in {".so", ".dll", ".dylib"}]
    return [*found, *(f"a library without import settings: {name}" for name in stray if name not in placed)]


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else unity.SOURCE
    told = problems(folder, assembled=len(sys.argv) > 1)
    print("\n".join(told) or f"{len(unity.assets(folder))} files and folders, nothing to complain about")
    sys.exit(bool(told))
