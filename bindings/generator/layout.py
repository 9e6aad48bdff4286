"""Writes the list of structures and fields that the library compiles into its table of layouts."""

from __future__ import annotations

from .model import Api

_HEADER = "/* Generated from the public headers by bindings/generator; tests compare it with them. Do not edit. */"


def emit(api: Api) -> str:
    """C text for an include: one macro call per structure and one per field."""
    lines = [_HEADER]
    for structure in api.structures:
        lines.append(f"PBMPM_LAYOUT_STRUCT({structure.name})")
        lines.extend(f"PBMPM_LAYOUT({structure.name}, {field.name})" for field in structure.fields)
    return "\n".join(lines) + "\n"
