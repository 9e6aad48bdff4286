"""Writes the P/Invoke declarations for C#.

Structures and enumerations become blittable types of the namespace ``Pbmpm``, those that hold pointers and the
functions go to ``Pbmpm.Native``. Functions keep their C names. What C calls by a pointer to a function is an address in
structures and parameters, so that they stay blittable, and has a delegate of its type beside them. At the end stands a
list of where every field really lies, which the binding compares with the library's own list when it loads.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape

from .model import Api, Constant, Enumeration, Field, Function, Kind, Signature, Structure, Type

_HEADER = "// Generated from the public headers by bindings/generator; a test compares it with them. Do not edit."
_NAMESPACES = ("System", "System.Collections.Generic", "System.Runtime.InteropServices", "Pbmpm.Native")
_PREFIX = "pbmpm_"
_FORCE_WIDTH = "_FORCE32"
_INDENT = "    "
_AXES = ("X", "Y", "Z", "W")

#: Where the run time looks for the functions: in the program itself where the library is linked into it. Unity's editor
#: loads the library of its own machine whatever it builds for.
_LIBRARY_NAME = """#if PBMPM_STATIC || (!UNITY_EDITOR && (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS || UNITY_WEBGL))
public const string LibraryName = "__Internal";
#else
public const string LibraryName = "pbmpm";
#endif"""

_SCALARS = {
    "float": "float",
    "double": "double",
    "int": "int",
    "int8_t": "sbyte",
    "int16_t": "short",
    "int32_t": "int",
    "int64_t": "long",
    "uint8_t": "byte",
    "uint16_t": "ushort",
    "uint32_t": "uint",
    "uint64_t": "ulong",
    "char": "byte",
    "_Bool": "byte",
    "size_t": "UIntPtr",
    "uintptr_t": "UIntPtr",
    "ptrdiff_t": "IntPtr",
    "intptr_t": "IntPtr",
}
#: Words of C# that are ordinary names in C.
_KEYWORDS = frozenset(
    "as base bool byte checked decimal delegate event explicit fixed foreach implicit in interface internal is lock "
    "namespace new null object operator out override params private protected public readonly ref sbyte sealed string "
    "this throw try typeof unchecked using virtual".split()
)


class UnsupportedType(Exception):
    """The headers use a type that has no blittable counterpart in C#."""


def emit(api: Api) -> str:
    """The text of ``Native.g.cs``."""
    plain = [item for item in api.structures if not _holds_pointers(item)]
    raw = [item for item in api.structures if _holds_pointers(item)]
    public = [_constants(api.constants), *map(_enumeration, api.enumerations)]
    public += [_vector(scalar, length) for scalar, length in _vectors(api)]
    filled = {item.name for item in api.functions}
    public += [_structure(item, f"{item.name}_init" in filled) for item in plain]
    native = [_structure(item, f"{item.name}_init" in filled) for item in raw]
    native += [_delegate(_type_name(item.name), item.signature, item.doc) for item in api.callbacks]
    native += [delegate for item in api.structures for delegate in _field_delegates(item)]
    native += [_functions(api.functions), _mirror(api.structures)]
    used = [f"using {name};" for name in _NAMESPACES]
    return "\n".join([_HEADER, *used, "", _namespace("Pbmpm", public), "", _namespace("Pbmpm.Native", native), ""])


# Blocks of text


def _indent(text: str) -> str:
    return "\n".join(_INDENT + line if line else line for line in text.split("\n"))


def _block(head: str, body: str, doc: str = "") -> str:
    return f"{_doc(doc)}{head}\n{{\n{_indent(body)}\n}}"


def _namespace(name: str, items: Iterable[str]) -> str:
    return _block(f"namespace {name}", "\n\n".join(items))


def _doc(text: str) -> str:
    """A documentation comment with the line end after it, or nothing."""
    if not text:
        return ""
    lines = f"<summary>{escape(text)}</summary>".split("\n")
    return "".join(f"/// {line}".rstrip() + "\n" for line in lines)


# Names


def _words(name: str) -> list[str]:
    return name.removeprefix(_PREFIX).removeprefix(_PREFIX.upper()).split("_")


def _pascal(words: Iterable[str]) -> str:
    return "".join(word.capitalize() for word in words)


def _type_name(name: str) -> str:
    return _pascal(_words(name))


def _parameter_name(name: str) -> str:
    first, *rest = _words(name)
    joined = first.lower() + _pascal(rest)
    return f"@{joined}" if joined in _KEYWORDS else joined


def _member_names(members: tuple[Constant, ...]) -> list[str]:
    """The names without the words that all of them begin with."""
    names = [_words(member.name) for member in members]
    shared = 0
    while len(names) > 1 and all(len(words) > shared + 1 and words[shared] == names[0][shared] for words in names):
        shared += 1
    return [_pascal(words[shared:]) for words in names]


# Types


def _base(type_: Type) -> str:
    """The type without pointers and array."""
    if type_.kind in (Kind.STRUCT, Kind.ENUM):
        return _type_name(type_.name)
    if type_.kind is Kind.SCALAR and type_.name in _SCALARS:
        return _SCALARS[type_.name]
    raise UnsupportedType(f"C# has no counterpart of {type_}")


def _is_address(type_: Type) -> bool:
    """Pointers to functions, to text and to anything: the binding only hands them on."""
    return type_.kind in (Kind.CALLBACK, Kind.FUNCTION, Kind.VOID) or (type_.name == "char" and type_.pointers > 0)


def _pointer(type_: Type) -> str:
    if _is_address(type_):
        return "IntPtr" + "*" * (type_.pointers - 1)
    return _base(type_) + "*" * type_.pointers


def _vector_name(type_: Type) -> str:
    """The structure that stands for an array of fixed length."""
    if type_.kind is not Kind.SCALAR or type_.pointers or type_.length not in range(2, len(_AXES) + 1):
        raise UnsupportedType(f"an array that is no vector of 2 to {len(_AXES)} numbers: {type_}")
    return f"{_base(type_).capitalize()}{type_.length}"


def _field_type(type_: Type) -> str:
    if _is_optional(type_):
        return "IntPtr"
    return _pointer(type_) if type_.length is None else _vector_name(type_)


def _is_optional(type_: Type) -> bool:
    """A member that refers to another structure, null as a rule: the binding sets it where the call is made."""
    return type_.kind is Kind.STRUCT and type_.pointers == 1


def _parameter_type(type_: Type) -> str:
    return _pointer(type_) if type_.length is None else f"{_vector_name(type_)}*"


def _holds_pointers(structure: Structure) -> bool:
    return any(field.type.pointers > 0 and not _is_optional(field.type) for field in structure.fields)


def _vectors(api: Api) -> list[tuple[str, int]]:
    """Element type and length of all vectors that the API uses, in order of appearance."""
    fields = [field.type for structure in api.structures for field in structure.fields]
    parameters = [item.type for function in api.functions for item in function.signature.parameters]
    arrays = [type_ for type_ in fields + parameters if type_.length is not None]
    return list(dict.fromkeys((_base(type_), type_.length or 0) for type_ in arrays))


# Declarations


def _constants(constants: tuple[Constant, ...]) -> str:
    body = "\n".join(
        f"{_doc(item.doc)}public const {_integer_type(item.value)} {_type_name(item.name)} = {item.value};"
        for item in constants
    )
    return _block("public static class Constants", body, "Numbers of the C headers.")


def _integer_type(value: int) -> str:
    return "int" if -(1 << 31) <= value < 1 << 31 else "long"


def _enumeration(item: Enumeration) -> str:
    members = tuple(member for member in item.members if not member.name.endswith(_FORCE_WIDTH))
    body = "\n".join(
        f"{_doc(member.doc)}{name} = {member.value},"
        for name, member in zip(_member_names(members), members, strict=True)
    )
    return _block(f"public enum {_type_name(item.name)} : int", body, item.doc)


def _vector(scalar: str, length: int) -> str:
    name, axes = f"{scalar.capitalize()}{length}", _AXES[:length]
    fields = "\n".join(f"public {scalar} {axis};" for axis in axes)
    parameters = ", ".join(f"{scalar} {axis.lower()}" for axis in axes)
    constructor = _block(f"public {name}({parameters})", "\n".join(f"{axis} = {axis.lower()};" for axis in axes))
    doc = f"{length} numbers, in C an array."
    head = f"[StructLayout(LayoutKind.Sequential)]\npublic partial struct {name}"
    return _block(head, f"{fields}\n\n{constructor}", doc)


def _structure(item: Structure, has_defaults: bool) -> str:
    """A structure; with ``has_defaults`` the library has a function that fills it."""
    body = "\n".join(map(_field, item.fields))
    if has_defaults:
        body += f"\n\n{_defaults(item)}"
    unsafe = "unsafe " if has_defaults or _holds_pointers(item) else ""
    head = f"[StructLayout(LayoutKind.Sequential)]\npublic {unsafe}partial struct {_type_name(item.name)}"
    return _block(head, body, item.doc)


def _defaults(item: Structure) -> str:
    name = _type_name(item.name)
    call = f"Methods.{item.name}_init(&it, (UIntPtr)sizeof({name}))"
    body = f"Library.Check();\n{name} it;\nLibrary.Require({call});\nreturn it;"
    return _block(f"public static {name} Default", _block("get", body), "The library's defaults.")


def _field(field: Field) -> str:
    return f"{_doc(field.doc)}public {_field_type(field.type)} {_type_name(field.name)};"


def _functions(functions: tuple[Function, ...]) -> str:
    doc = "The name that the run time looks for; it adds what the platform wants around it. With PBMPM_STATIC: the program."
    library = f"{_doc(doc)}{_LIBRARY_NAME}"
    body = "\n\n".join([library, *map(_function, functions)])
    return _block("public static unsafe class Methods", body, "The functions of the C library, as they are.")


def _function(item: Function) -> str:
    attribute = "[DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]"
    return f"{_doc(item.doc)}{attribute}\npublic static extern {_call(item.name, item.signature)};"


def _call(name: str, signature: Signature) -> str:
    """Result, name and parameters of something that can be called."""
    parameters = ", ".join(f"{_parameter_type(it.type)} {_parameter_name(it.name)}" for it in signature.parameters)
    result = signature.result
    returned = "void" if result.kind is Kind.VOID and not result.pointers else _pointer(result)
    return f"{returned} {name}({parameters})"


def _delegate(name: str, signature: Signature, doc: str) -> str:
    attribute = "[UnmanagedFunctionPointer(CallingConvention.Cdecl)]"
    return f"{_doc(doc)}{attribute}\npublic unsafe delegate {_call(name, signature)};"


def _field_delegates(structure: Structure) -> Iterator[str]:
    """The types of the functions that a structure points to."""
    for field in structure.fields:
        if field.type.kind is Kind.FUNCTION and field.type.signature is not None:
            name = _type_name(structure.name) + _type_name(field.name)
            yield _delegate(name, field.type.signature, f"What {structure.name}.{field.name} points to.")


# The list of fields as the C# compiler laid them out


def _mirror(structures: tuple[Structure, ...]) -> str:
    calls = "\n".join(f"{_type_name(item.name)}(fields);" for item in structures)
    everything = _block(
        "internal static List<MirrorField> All()",
        f"var fields = new List<MirrorField>();\n{calls}\nreturn fields;",
        "All fields of all structures; a structure follows its fields.",
    )
    body = "\n\n".join([everything, *map(_mirror_structure, structures)])
    return _block("internal static unsafe class Mirror", body, "Where the fields of the structures above lie.")


def _mirror_structure(item: Structure) -> str:
    name = _type_name(item.name)
    grows = "true" if item.fields[0].name == "size" else "false"
    return _block(
        f"static void {name}(List<MirrorField> fields)",
        "\n".join([f"var it = default({name});", *_mirror_fields(item)])
        + f'\nfields.Add(new MirrorField("{item.name}", "", &it, &it, &it + 1, {grows}));',
    )


def _mirror_fields(item: Structure) -> Iterator[str]:
    for field in item.fields:
        place = f"&it.{_type_name(field.name)}"
        yield f'fields.Add(new MirrorField("{item.name}", "{field.name}", &it, {place}, {place} + 1, false));'
