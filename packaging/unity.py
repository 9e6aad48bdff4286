"""The Unity package: its .meta files, and the folder that Unity loads, put together from bindings/unity and the C# binding.

    unity.py metas             writes the .meta files of bindings/unity
    unity.py assemble FOLDER   leaves the whole package in FOLDER, with the libraries that are built
    unity.py pack              leaves dist/com.pbmpm.unity-VERSION.tgz

Unity knows files by the GUID in their .meta. GUIDs follow from the path alone, so that scenes find their scripts in later versions.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import shutil
import sys
import tarfile
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "bindings" / "unity"
CORE = "Runtime/Core"


@dataclass(frozen=True)
class Plugin:
    """A native library in the package, and where it is used."""

    path: str
    target: str
    """Of packaging: the library is taken from build/TARGET/lib, or from the folder that is named after the system alone."""
    platform: str
    """Unity's name of the players."""
    system: str
    """Unity's name of the editor's system."""
    cpu: str = "x86_64"

    def built(self) -> Path:
        """Where the library would be, links followed."""
        name = Path("lib") / Path(self.path).name
        whole, system = (ROOT / "build" / folder / name for folder in (self.target, self.target.split("-")[0]))
        return (whole if whole.exists() else system).resolve()


PLUGINS = (
    Plugin("Runtime/Plugins/Linux/x86_64/libpbmpm.so", "linux-x64", "Linux64", "Linux"),
    Plugin("Runtime/Plugins/Windows/x86_64/pbmpm.dll", "windows-x64", "Win64", "Windows"),
    Plugin("Runtime/Plugins/macOS/x86_64/libpbmpm.dylib", "macos-x64", "OSXUniversal", "OSX"),
    Plugin("Runtime/Plugins/macOS/arm64/libpbmpm.dylib", "macos-arm64", "OSXUniversal", "OSX", "ARM64"),
)
PLATFORMS = ("Linux64", "OSXUniversal", "Win", "Win64")
IMPORTERS = {
    ".cs": "MonoImporter",
    ".asmdef": "AssemblyDefinitionImporter",
    ".shader": "ShaderImporter",
    ".hlsl": "ShaderIncludeImporter",
    ".md": "TextScriptImporter",
}


# .meta files


def guid(path: str) -> str:
    return hashlib.md5(f"com.pbmpm.unity/{path}".encode()).hexdigest()


def importer(path: str, is_folder: bool) -> str:
    """How Unity takes the file in, as it writes that itself."""
    plugin = next((one for one in PLUGINS if one.path == path), None)
    if plugin is not None:
        return _plugin_importer(plugin)
    if is_folder:
        return "folderAsset: yes\nDefaultImporter:\n" + _common()
    name = "PackageManifestImporter" if path == "package.json" else IMPORTERS[Path(path).suffix]
    extra = "  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n  icon: {instanceID: 0}\n" if name == "MonoImporter" else ""
    return f"{name}:\n" + _common(extra)


def _common(extra: str = "") -> str:
    return f"  externalObjects: {{}}\n{extra}  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def _plugin_importer(plugin: Plugin) -> str:
    excluded = "".join(f"        Exclude {name}: {int(name != plugin.platform)}\n" for name in PLATFORMS)
    sections = [
        _section("'': Any", False, "        Exclude Editor: 0\n" + excluded),
        _section("Any: ", False, None),
        _section("Editor: Editor", True, f"        CPU: {plugin.cpu}\n        DefaultValueInitialized: true\n        OS: {plugin.system}\n"),
        *(
            _section(f"Standalone: {name}", name == plugin.platform, f"        CPU: {plugin.cpu if name == plugin.platform else 'None'}\n")
            for name in PLATFORMS
        ),
    ]
    extra = (
        "  serializedVersion: 2\n  iconMap: {}\n  executionOrder: {}\n  defineConstraints: []\n  isPreloaded: 0\n  isOverridable: 0\n"
        "  isExplicitlyReferenced: 0\n  validateReferences: 1\n  platformData:\n" + "".join(sections)
    )
    return "PluginImporter:\n" + _common(extra)


def _section(name: str, enabled: bool, settings: str | None) -> str:
    values = " {}\n" if settings is None else "\n" + settings
    return f"  - first:\n      {name}\n    second:\n      enabled: {int(enabled)}\n      settings:{values}"


def meta(path: str, is_folder: bool) -> str:
    return f"fileFormatVersion: 2\nguid: {guid(path)}\n{importer(path, is_folder)}"


def assets(root: Path) -> dict[str, bool]:
    """Paths that Unity takes in, and whether they are folders. It passes over what ends with ~; samples get .meta files all the same, which
    go with them into the user's project."""
    found = {}
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix == ".meta" or name.startswith("Documentation~") or name == "Samples~" or "/." in f"/{name}":
            continue
        found[name] = path.is_dir()
    return found


def source_assets() -> dict[str, bool]:
    """Those of bindings/unity, and the libraries that packaging puts there, with their folders."""
    found = assets(SOURCE)
    for plugin in PLUGINS:
        found[plugin.path] = False
        found.update({parent.as_posix(): True for parent in Path(plugin.path).parents if parent.as_posix() != "."})
    return found


def write_metas(root: Path, wanted: dict[str, bool]) -> None:
    for path in root.rglob("*.meta"):
        if path.relative_to(root).as_posix().removesuffix(".meta") not in wanted:
            path.unlink()
    for name, is_folder in wanted.items():
        target = root / f"{name}.meta"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(meta(name, is_folder), encoding="utf-8")


# The package


def assemble(target: Path) -> list[str]:
    """Copies everything to where Unity looks for it. Returns the libraries that were not built."""
    shutil.copytree(SOURCE, target, ignore=shutil.ignore_patterns("*.meta"))
    for file in sorted((ROOT / "bindings" / "csharp" / "src").glob("*.cs")):
        shutil.copy(file, target / CORE)
    shutil.copy(ROOT / "LICENSE", target / "LICENSE.md")
    missing = []
    for plugin in PLUGINS:
        if plugin.built().is_file():
            (target / plugin.path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(plugin.built(), target / plugin.path)
        else:
            missing.append(plugin.path)
    for folder in sorted((target / "Runtime" / "Plugins").rglob("*"), reverse=True):
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()
    write_metas(target, assets(target))
    return missing


def pack() -> Path:
    """A tarball as the package manager wants it: all below the folder `package`. Equal contents give equal bytes."""
    manifest = json.loads((SOURCE / "package.json").read_text(encoding="utf-8"))
    archive = ROOT / "dist" / f"{manifest['name']}-{manifest['version']}.tgz"
    archive.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work) / "package"
        for path in assemble(folder):
            print(f"not built, so not in the package: {path}")
        bytes_ = io.BytesIO()
        with tarfile.open(fileobj=bytes_, mode="w") as tar:
            for path in sorted(folder.rglob("*")):
                tar.add(path, path.relative_to(work).as_posix(), recursive=False, filter=_plain)
    archive.write_bytes(gzip.compress(bytes_.getvalue(), mtime=0))
    return archive


def _plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    entry.uid = entry.gid = entry.mtime = 0
    entry.uname = entry.gname = ""
    entry.mode = 0o755 if entry.isdir() else 0o644
    return entry


def main(words: list[str]) -> None:
    match words:
        case ["metas"]:
            write_metas(SOURCE, source_assets())
        case ["assemble", folder]:
            for path in assemble(Path(folder)):
                print(f"not built, so not in the package: {path}")
        case ["pack"]:
            print(pack())
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
