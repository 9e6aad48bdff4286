"""Scene files: those of our own format and of the EA demo's."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .ea_scene import import_ea_scene, looks_like_ea_scene
from .parsing import parse_scene
from .scenes.reading import read_json
from .scenes.scene import Scene


def load_scene(path: Path) -> Scene:
    """Reads a scene of our own format or of the EA demo's, told apart by their contents."""
    data = read_json(path)
    if looks_like_ea_scene(data):
        return import_ea_scene(data, path.name)
    _find_files(data, path.parent)
    return parse_scene(data, str(path))


def _find_files(data: Any, folder: Path) -> None:
    """Makes the names of mesh files relative to the folder of the scene; what is no scene is left to the checks."""
    colliders = data.get("colliders") if isinstance(data, dict) else None
    for collider in colliders if isinstance(colliders, list) else []:
        shape = collider.get("shape") if isinstance(collider, dict) else None
        if isinstance(shape, dict) and isinstance(shape.get("file"), str):
            shape["file"] = str(folder / shape["file"])
