"""From decoded JSON to a scene that has been checked."""

from __future__ import annotations

from typing import Any

from pydantic import ValidationError

from .effects.catalogue import missing
from .errors import InputError
from .scenes.reading import describe_problems
from .scenes.scene import FORMAT_NAME, Scene
from .scenes.checks import scene_problems


def parse_scene(data: Any, source: str = "scene") -> Scene:
    """Checks decoded JSON and makes a Scene of it; InputError names each field that is wrong."""
    if not isinstance(data, dict) or data.get("format") != FORMAT_NAME:
        raise InputError(f"{source}: not a scene: the field 'format' must be \"{FORMAT_NAME}\"")
    try:
        scene = Scene.model_validate(data)
    except ValidationError as error:
        raise InputError(describe_problems(error, data, source)) from None
    problems = scene_problems(scene) or missing(scene)
    if problems:
        raise InputError("\n".join(f"{source}: {problem}" for problem in problems))
    return scene
