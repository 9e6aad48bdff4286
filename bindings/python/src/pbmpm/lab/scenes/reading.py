"""JSON files, and what is wrong with them in words."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ..errors import InputError
from ..._fixed import nearest
from ..hints import file_like
from .scene import Part


def read_json(path: Path) -> Any:
    """Decodes a file; InputError says what is wrong with it, and where."""
    if path.suffix.lower() in (".yaml", ".yml"):
        raise InputError(f"{path}: this is YAML; scenes and presets are JSON")
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file{file_like(path)}") from None
    except IsADirectoryError:
        raise InputError(f"{path}: is a folder, not a file") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file") from None
    if not text.strip():
        raise InputError(f"{path}: the file is empty")
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise InputError(f"{path}: cannot be read: brackets are nested too deeply") from None
    except ValueError as error:  # a number of thousands of digits
        raise InputError(f"{path}: cannot be read: {error}") from None


def describe_problems(error: ValidationError, data: Any, source: str) -> str:
    """One line for each field that is wrong."""
    lines = []
    for item in error.errors():
        message = item["msg"].removeprefix("Value error, ")
        if item["type"] == "extra_forbidden":
            message = f"unknown field{_meant(item['loc'][-1])}"
        elif item["type"] == "literal_error":
            expected = item["ctx"]["expected"]
            message = f"{item['input']!r} is not one of {expected}"
            message += nearest(item["input"], re.findall(r"'(\w+)'", expected))
        elif item["type"] == "union_tag_invalid":
            message = f"'{item['ctx']['tag']}' is not one of {item['ctx']['expected_tags']}"
            message += nearest(item["ctx"]["tag"], re.findall(r"'(\w+)'", item["ctx"]["expected_tags"]))
        elif item["type"] == "union_tag_not_found":
            message = f"the field {item['ctx']['discriminator']} is missing: it says what this is"
        elif item["type"] in ("list_type", "too_short", "too_long") and any(item["loc"][-1] in kind.vectors() for kind in Part.kinds()):
            message = f"needs {data.get('dimension', '2 or 3')} numbers in brackets, one per axis"
        elif item["type"] == "missing":
            message = "this field is required"
        elif isinstance(item["input"], str | int | float | bool | None) and item["type"] != "value_error":
            message = f"{message.replace('Input should be', 'must be')}, not {json.dumps(item['input'])}"
        lines.append(f"{source}: {_field_path(item['loc'], data)}: {message}")
    return "\n".join(dict.fromkeys(lines))


def _meant(name: int | str) -> str:
    """What an unknown field may have been meant for: one that belongs elsewhere, or one of a like name."""
    owners = _all_fields()
    if name in owners:
        return f" here; it belongs to {owners[str(name)]}"
    return nearest(name, owners)


def _all_fields() -> dict[str, str]:
    """The names of the fields of all parts of a scene, and what they belong to."""
    names = dict[str, str]()
    for part in Part.kinds():
        for name in part.model_fields:
            names.setdefault(name, f"the scene's {part.__name__.strip('_').removesuffix('Part').lower()}" if part.__name__ != "Scene" else "the scene itself")
    return names


def _field_path(location: tuple[int | str, ...], data: Any) -> str:
    """The path as the user wrote it: without the names of union members that pydantic puts in between."""
    path = ""
    for position, step in enumerate(location):
        last = position == len(location) - 1
        known = _holds(data, step)
        if not known and not (last and isinstance(data, dict) and isinstance(step, str)):
            continue
        path += f"[{step}]" if isinstance(step, int) else f".{step}" if path else step
        data = data[step] if known else None
    return path or "the scene"


def _holds(data: Any, step: int | str) -> bool:
    if isinstance(data, dict):
        return step in data
    return isinstance(data, list) and isinstance(step, int) and step < len(data)
