"""Writes calls of every exported function with arguments that come out of bytes, for the fuzz target ``tests/fuzz/fuzz_calls.c``, which defines what
the text uses: numbers, identifiers, arrays, memory.

Every structure that a call reads begins with the library's defaults (or zeros), of which some fields are changed; enumerations are raw integers. Arrays
are longer than any count that is passed with them, unless they are null.
"""

from __future__ import annotations

from .model import Api, Function, Kind, Parameter, Structure, Type

_HEADER = "/* Generated from the public headers by bindings/generator; tests compare it with them. Do not edit. */"
_ID = "_id"
_AMOUNTS = ("count", "capacity", "size", "bytes")


def emit(api: Api) -> str:
    """C text for an include."""
    filled = {function.name.removesuffix("_init") for function in api.functions if function.name.endswith("_init")}
    ids = [item.name for item in api.structures if item.name.endswith(_ID)]
    read = [item for item in api.structures if _is_read(api, item.name)]
    parts = [_HEADER, "enum Pool { " + ", ".join(f"POOL_{name}" for name in ids) + ", POOLS };", ""]
    parts += [_maker(item, item.name in filled) for item in read]
    sized = {item.name for item in api.structures if item.fields[0].name == "size"}
    parts.append("static void make_call(Bytes *in, uint32_t which)\n{\n    switch (which) {")
    parts += [_call(number, function, sized) for number, function in enumerate(api.functions)]
    parts.append(f"    }}\n}}\n\nenum {{ CALLS = {len(api.functions)} }};\n")
    return "\n".join(parts)


def _is_read(api: Api, name: str) -> bool:
    """Whether a function takes the structure, by value or in const memory, alone or in another."""
    for function in api.functions:
        for item in function.signature.parameters:
            if item.type.name == name and (item.type.const or item.type.pointers == 0) and item.type.pointers < 2:
                return True
    return any(
        field.type.name == name and field.type.pointers < 2 and _is_read(api, structure.name)
        for structure in api.structures
        for field in structure.fields
    )


# Structures


def _maker(item: Structure, has_defaults: bool) -> str:
    head = f"static void make_{item.name}(Bytes *in, {item.name} *it)\n{{\n"
    if item.name.endswith(_ID):
        return f"{head}    pick(in, POOL_{item.name}, &it->index, &it->generation);\n}}\n"
    if any(field.type.kind is Kind.FUNCTION for field in item.fields):
        return f"{head}    hooks_{item.name}(in, it);\n}}\n"
    begin = f"    (void){item.name}_init(it, sizeof *it);" if has_defaults else "    memset(it, 0, sizeof *it);"
    cases = [f"        case {number}: {_change(field.name, field.type)} break;" for number, field in enumerate(item.fields)]
    return (
        f"{head}{begin}\n    for (uint32_t n = changes(in); n > 0; n--)\n        switch (bytes_u8(in) % {len(cases)}) {{\n"
        + "\n".join(cases)
        + f"\n        }}\n    LIMIT({item.name}, it);\n}}\n"
    )


def _change(name: str, type_: Type) -> str:
    if name == "size":
        return "it->size = odd_size(in, sizeof *it);"
    if type_.pointers:
        if type_.kind is Kind.STRUCT:
            own = f"static {type_.name} {name}[ARRAY]; for (int i = 0; i < ARRAY; i++) make_{type_.name}(in, &{name}[i]);"
            return f"{{ {own} it->{name} = bytes_u8(in) % 2 ? {name} : NULL; }}"
        return f"it->{name} = {_array(type_)};"
    if type_.length is not None:
        amounts = "count" in name
        return " ".join(f"it->{name}[{i}] = {_value(type_, amounts)};" for i in range(type_.length))
    if type_.kind is Kind.STRUCT:
        return f"make_{type_.name}(in, &it->{name});"
    return f"it->{name} = {_value(type_, 'count' in name)};"


def _value(type_: Type, amount: bool = False) -> str:
    if amount:
        return f"({type_.name})amount(in, ARRAY)"
    if type_.kind is Kind.ENUM:
        return f"({type_.name})raw_enum(in)"
    return f"({type_.name}){'real' if type_.name in ('float', 'double') else 'whole'}(in)"


def _array(type_: Type) -> str:
    if type_.kind is Kind.VOID or type_.name == "char":
        return "NULL"
    return f"array_of_{'reals' if type_.name == 'float' else 'wholes'}(in)"


# Calls


def _call(number: int, function: Function, sized: set[str]) -> str:
    lines: list[str] = []
    after: list[str] = []
    arguments: list[str] = []
    before: Parameter | None = None
    for item in function.signature.parameters:
        argument = _argument(function, item, before, lines, after, sized)
        lines.append(f"const __auto_type {item.name}_ = {argument};")  # so that bytes are taken in this order
        arguments.append(f"{item.name}_")
        before = item if item.type.pointers or item.type.length is not None else before
    call = f"{function.name}({', '.join(arguments)})"
    result = function.signature.result
    if result.kind is Kind.ENUM and result.name == "pbmpm_result":
        lines += [f'BEGIN("{function.name}");', f"const pbmpm_result result = {call};", f'END("{function.name}", result);']
        lines += [f"if (result == PBMPM_OK) {{ {' '.join(after)} }}"] if after else []
    elif result.name == "char":
        lines.append(f"read_text({call});")
    else:
        lines.append(f"(void){call};")
    body = "\n".join(f"        {line}" for line in lines)
    return f"    case {number}: {{\n{body}\n        break;\n    }}"


def _argument(function: Function, item: Parameter, before: Parameter | None, lines: list[str], after: list[str], sized: set[str]) -> str:
    type_, name = item.type, item.name
    if type_.pointers == 2:
        lines.append(f"{'const ' if type_.const else ''}{type_.name} *{name} = NULL;")
        return f"maybe(in, &{name})"
    if type_.kind is Kind.CALLBACK:
        return f"callback_{type_.name}(in)"
    if type_.kind is Kind.VOID:
        if name == "user":
            return "NULL"
        return "maybe(in, memory.data)"
    if type_.length is not None:
        lines.append(f"{type_.name} {name}[{type_.length}];")
        lines += [f"{name}[{i}] = {_value(type_)};" for i in range(type_.length)]
        return f"maybe(in, {name})"
    if type_.pointers == 1:
        return _pointer(item, lines, after, sized)
    if type_.kind is Kind.STRUCT:
        lines += [f"{type_.name} {name};", f"make_{type_.name}(in, &{name});"]
        return name
    if name in _AMOUNTS and before is not None:
        if function.name.endswith("_init"):
            return f"odd_size(in, sizeof *{before.name})"
        if before.type.kind is Kind.VOID:
            return "stored(in)" if before.type.const else "(uint64_t)amount(in, MEMORY)"
        return f"({type_.name})amount(in, ARRAY)"
    return _value(type_)


def _pointer(item: Parameter, lines: list[str], after: list[str], sized: set[str]) -> str:
    type_, name = item.type, item.name
    if type_.kind is Kind.STRUCT and type_.const:
        many = name.endswith("s") and type_.name.endswith(_ID)
        lines.append(f"{type_.name} {name}[{'ARRAY' if many else 1}];")
        lines.append(f"for (uint32_t i = 0; i < sizeof {name} / sizeof *{name}; i++) make_{type_.name}(in, &{name}[i]);")
        return f"maybe(in, {name})"
    if type_.const:
        if type_.kind is Kind.ENUM:
            lines += [f"{type_.name} {name}[ARRAY];", f"for (uint32_t i = 0; i < ARRAY; i++) {name}[i] = {_value(type_)};"]
            return f"maybe(in, {name})"
        return _array(type_)
    length = "ARRAY" if type_.kind is Kind.STRUCT else "REALS"
    lines.append(f"{type_.name} {name}[{length}];")
    lines.append(f"memset({name}, 0, sizeof {name});")
    if type_.name in sized:
        lines.append(f"{name}->size = (uint32_t)odd_size(in, sizeof *{name});")
    if type_.name.endswith(_ID):
        after.append(f"keep(POOL_{type_.name}, {name}->index, {name}->generation);")
    elif type_.kind is Kind.STRUCT:
        after.append(f"LOOK({type_.name}, {name});")
    elif name == "bytes":
        after.append("memory.stored = *bytes <= MEMORY ? *bytes : MEMORY;")
    return f"maybe(in, {name})"
