"""Writes the table of the sizes that each structure had in each version, for the library."""

from __future__ import annotations

from pathlib import Path

from .model import Api, Structure
from .parser import parse

_HEADER = """/* Generated from the public headers and those of older versions in tests/abi by bindings/generator; a test compares it with them. Do not
 * edit. PBMPM_SIZED(structure, what sets its size, size in this version, sizes before). */"""


def emit(api: Api, versions: Path) -> str:
    """C text for an include: one macro call per structure that begins with its size. A size is told by the last field that a version had."""
    functions = {item.name for item in api.functions}
    older = [parse(folder) for folder in sorted(versions.glob("*/include"), key=_number, reverse=True)]
    lines = [_HEADER]
    for structure in api.structures:
        if not grows(structure):
            continue
        remedy = f"fill it by {structure.name}_init()"
        if f"{structure.name}_init" not in functions:
            remedy = f"set it to sizeof({structure.name})"
        ends = ", ".join(f"END({structure.name}, {name})" for name in _last_fields(structure, older))
        lines.append(f'PBMPM_SIZED({structure.name}, "{remedy}", {ends})')
    return "\n".join(lines) + "\n"


def grows(structure: Structure) -> bool:
    """Structures that begin with their size may grow; all others never change."""
    return structure.fields[0].name == "size"


def _number(folder: Path) -> tuple[int, ...]:
    return tuple(map(int, folder.parent.name.split(".")))


def _last_fields(structure: Structure, older: list[Api]) -> list[str]:
    """The last field of each version that had the structure, newest first, each once."""
    versions = [structure, *(item for api in older for item in api.structures if item.name == structure.name)]
    return list(dict.fromkeys(item.fields[-1].name for item in versions))
