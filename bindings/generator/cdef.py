"""Writes the declarations for cffi."""

from __future__ import annotations

from .model import Api, Callback, Declaration, Enumeration, Function, Kind, Signature, Structure, Type


def emit(api: Api) -> str:
    """The text for ``FFI.cdef()``."""
    constants = [f"#define {item.name} {item.value}" for item in api.constants]
    return "\n".join(constants + [_declaration(item) for item in api.declarations]) + "\n"


def _declaration(item: Declaration) -> str:
    if isinstance(item, Enumeration):
        members = ", ".join(f"{member.name} = {member.value}" for member in item.members)
        return f"typedef enum {item.name} {{ {members} }} {item.name};"
    if isinstance(item, Structure):
        fields = " ".join(f"{_variable(field.type, field.name)};" for field in item.fields)
        return f"typedef struct {item.name} {{ {fields} }} {item.name};"
    if isinstance(item, Callback):
        return f"typedef {_function(item.name, item.signature)};"
    assert isinstance(item, Function)
    return f"{_function(item.name, item.signature)};"


def _function(declarator: str, signature: Signature) -> str:
    parameters = ", ".join(_variable(item.type, item.name) for item in signature.parameters)
    return _variable(signature.result, f"{declarator}({parameters or 'void'})")


def _variable(type_: Type, declarator: str) -> str:
    declarator = "*" * type_.pointers + declarator
    if type_.kind is Kind.FUNCTION:
        assert type_.signature is not None
        return _function(f"({declarator})", type_.signature)
    array = "" if type_.length is None else f"[{type_.length}]"
    return f"{'const ' if type_.const else ''}{type_.name} {declarator}{array}"
