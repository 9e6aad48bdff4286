"""Builds the model from the headers: pcpp expands macros and includes, pycparser parses what is left.

Both are pure Python, so the generator needs no C compiler and sees the same thing on every platform.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import pcpp
from pycparser import c_ast, c_parser

from .comments import Comments
from .model import (
    Api,
    Callback,
    Constant,
    Declaration,
    Enumeration,
    Field,
    Function,
    Kind,
    Parameter,
    Signature,
    Structure,
    Type,
)

#: Types of the C library that the headers use. The parser only has to know that they are types.
_STANDARD_TYPES = tuple(f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)) + (
    "size_t",
    "ptrdiff_t",
    "intptr_t",
    "uintptr_t",
)
_PRELUDE_FILE = "standard-types"
_PREFIX = "PBMPM_"


class ParseError(Exception):
    """The headers use something that the model has no place for."""


class _Preprocessor(pcpp.Preprocessor):
    """Expands the project's own headers and leaves those of the C library out."""

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self.line_directive = "#line"
        self.headers = folder
        self.add_path(str(folder))

    def on_include_not_found(self, is_malformed: bool, is_system_include: bool, curdir: str, includepath: str) -> None:
        if is_system_include and not is_malformed:
            raise pcpp.OutputDirective(pcpp.Action.IgnoreAndRemove)
        raise ParseError(f"cannot find the header {includepath!r} in {self.headers}")

    def on_error(self, file: str, line: int, msg: str) -> None:
        raise ParseError(f"{file}:{line}: {msg}")

    def numbers(self) -> Iterator[Constant]:
        """Object-like macros of the project that stand for an integer."""
        for name, macro in self.macros.items():
            text = "".join(token.value for token in macro.value).strip()
            if name.startswith(_PREFIX) and macro.arglist is None and text:
                value, _ = self.evalexpr(self.tokenize(text))
                yield Constant(name, int(value), Comments.of_file(Path(macro.source)).paragraph(macro.lineno))


def parse(folder: Path, header: str = "pbmpm/pbmpm.h") -> Api:
    """Reads ``folder/header`` with everything it includes."""
    preprocessor = _Preprocessor(folder)
    path = folder / header
    preprocessor.parse(path.read_text(encoding="utf-8"), str(path))
    text = io.StringIO()
    preprocessor.write(text)
    prelude = "".join(f"typedef int {name};\n" for name in _STANDARD_TYPES)
    source = f'#line 1 "{_PRELUDE_FILE}"\n{prelude}{text.getvalue()}'
    reader = _Reader(tuple(preprocessor.numbers()))
    for node in c_parser.CParser().parse(source, str(path)).ext:
        if node.coord.file != _PRELUDE_FILE:
            reader.read(node)
    return Api(tuple(reader.constants), tuple(reader.declarations))


class _Reader:
    """Turns top-level declarations of the syntax tree into the model."""

    def __init__(self, constants: tuple[Constant, ...]) -> None:
        self.constants = list(constants)
        self.declarations: list[Declaration] = []
        self._values = {item.name: item.value for item in constants}
        self._kinds: dict[str, Kind] = {}
        self._comments: dict[str, Comments] = {}

    def read(self, node: c_ast.Node) -> None:
        if isinstance(node, c_ast.Typedef):
            self._read_typedef(node)
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl):
            doc = self._comments_at(node).paragraph(node.coord.line)
            self.declarations.append(Function(node.name, self._signature(node.type), doc))
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.Enum) and node.name is None:
            self.constants.extend(self._members(node.type))
        else:
            raise ParseError(f"{node.coord}: only typedefs, functions and enumerations are understood")

    def _read_typedef(self, node: c_ast.Typedef) -> None:
        inner = node.type.type if isinstance(node.type, c_ast.TypeDecl) else node.type
        doc = self._comments_at(inner).declaration(inner.coord.line)
        if isinstance(inner, c_ast.Struct) and inner.decls:
            self._declare(Kind.STRUCT, Structure(node.name, tuple(self._fields(inner)), doc))
        elif isinstance(inner, c_ast.Enum) and inner.values:
            self._declare(Kind.ENUM, Enumeration(node.name, tuple(self._members(inner)), doc))
        elif isinstance(inner, c_ast.FuncDecl):
            self._declare(Kind.CALLBACK, Callback(node.name, self._signature(inner), doc))
        else:
            raise ParseError(f"{node.coord}: typedef {node.name} is no structure, enumeration or function type")

    def _declare(self, kind: Kind, item: Structure | Enumeration | Callback) -> None:
        self._kinds[item.name] = kind
        self.declarations.append(item)

    def _comments_at(self, node: c_ast.Node) -> Comments:
        file = node.coord.file
        if file not in self._comments:
            self._comments[file] = Comments.of_file(Path(file))
        return self._comments[file]

    def _members(self, node: c_ast.Enum) -> Iterator[Constant]:
        following = 0
        for item in node.values.enumerators:
            value = following if item.value is None else self._value(item.value)
            self._values[item.name] = value
            following = value + 1
            yield Constant(item.name, value, self._comments_at(item).member(item.coord.line))

    def _fields(self, node: c_ast.Struct) -> Iterator[Field]:
        for item in node.decls:
            yield Field(item.name, self._type(item.type), self._comments_at(item).member(item.coord.line))

    def _signature(self, node: c_ast.FuncDecl) -> Signature:
        parameters = tuple(
            Parameter(item.name or "", self._type(item.type)) for item in (node.args.params if node.args else ())
        )
        if len(parameters) == 1 and parameters[0].type == Type(Kind.VOID, "void"):
            parameters = ()
        return Signature(self._type(node.type), parameters)

    def _type(self, node: c_ast.Node) -> Type:
        length = None
        if isinstance(node, c_ast.ArrayDecl):
            length, node = self._value(node.dim), node.type
        pointers = 0
        while isinstance(node, c_ast.PtrDecl):
            pointers, node = pointers + 1, node.type
        if isinstance(node, c_ast.FuncDecl):
            return Type(Kind.FUNCTION, "", pointers=pointers, length=length, signature=self._signature(node))
        if not isinstance(node, c_ast.TypeDecl) or not isinstance(node.type, c_ast.IdentifierType):
            raise ParseError(f"{node.coord}: a type that the model cannot describe")
        name = " ".join(node.type.names)
        kind = Kind.VOID if name == "void" else self._kinds.get(name, Kind.SCALAR)
        return Type(kind, name, "const" in node.quals, pointers, length)

    def _value(self, node: c_ast.Node) -> int:
        """The value of a constant expression."""
        if isinstance(node, c_ast.Constant):
            return int(node.value.rstrip("uUlL"), 0)
        if isinstance(node, c_ast.ID):
            return self._values[node.name]
        if isinstance(node, c_ast.UnaryOp) and node.op == "-":
            return -self._value(node.expr)
        operations = {"<<": int.__lshift__, "|": int.__or__, "+": int.__add__, "-": int.__sub__, "*": int.__mul__}
        if isinstance(node, c_ast.BinaryOp) and node.op in operations:
            return operations[node.op](self._value(node.left), self._value(node.right))
        raise ParseError(f"{node.coord}: a constant expression that the generator cannot evaluate")
