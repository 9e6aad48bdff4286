"""Finds, loads and checks the shared library.

The declarations in ``_ffi`` are generated from the public headers when the package is built. Before anything else is
called, the version, the ABI number and the layout of every structure are compared with what the library says about
itself, so that a library that does not fit is refused with a message instead of corrupting memory.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from ._ffi import ffi

#: Names a library to load instead of the one in the package.
PATH_VARIABLE = "PBMPM_LIBRARY"

#: (structure, field) -> (offset, size) in bytes; an empty field name stands for the whole structure.
Layout = dict[tuple[str, str], tuple[int, int]]


class LibraryError(ImportError):
    """The shared library is missing, cannot be loaded, or does not fit this package."""


def library_path() -> Path:
    """The file that is (to be) loaded: ``$PBMPM_LIBRARY`` or the library in the package."""
    chosen = os.environ.get(PATH_VARIABLE)
    if chosen:
        path, origin = Path(chosen), f"named by the environment variable {PATH_VARIABLE}"
    else:
        name = {"win32": "pbmpm.dll", "darwin": "libpbmpm.dylib"}.get(sys.platform, "libpbmpm.so")
        path, origin = Path(__file__).parent / name, "which belongs to the package"
    if not path.is_file():
        raise LibraryError(
            f"pbmpm: there is no shared library at {path}, {origin}. Install the package again, "
            f"or set {PATH_VARIABLE} to the path of the library."
        )
    return path


def own_layout(declarations: Any) -> Layout:
    """The layout of every structure as cffi understands the headers."""
    layout: Layout = {}
    for name in declarations.list_types()[1]:
        structure = declarations.typeof(name)
        layout[name, ""] = (0, declarations.sizeof(structure))
        for field, place in structure.fields:
            layout[name, field] = (place.offset, declarations.sizeof(place.type))
    return layout


def library_layout(declarations: Any, library: Any) -> Layout:
    """The layout of every structure as the library was compiled."""
    entries = declarations.new("pbmpm_layout_entry **")
    count = declarations.new("uint32_t *")
    if library.pbmpm_layout_table(entries, count) != 0:
        raise LibraryError("pbmpm: the library does not tell its layouts")
    text = declarations.string
    return {
        (text(entry.structure).decode(), text(entry.field).decode()): (entry.offset, entry.size)
        for entry in (entries[0][i] for i in range(count[0]))
    }


def check_layout(own: Layout, theirs: Layout) -> None:
    """Compares what this package expects with what the library has.

    A newer library may have appended fields to a structure that begins with its size; everything else must be equal.
    The error names the first field that differs: the library's table lists structures before those that contain them.
    """
    order = {structure: i for i, (structure, _) in enumerate(theirs)}
    fields_first = sorted(own, key=lambda entry: (order.get(entry[0], len(order)), entry[1] == ""))
    for structure, field in fields_first:
        expected = own[structure, field]
        found = theirs.get((structure, field))
        may_grow = own.get((structure, "size"), (-1, 0))[0] == 0
        grown = found is not None and not field and found[1] > expected[1] and may_grow
        if found != expected and not grown:
            what = f"{structure}.{field}" if field else structure
            has = "does not have it" if found is None else f"has it at offset {found[0]} with {found[1]} bytes"
            raise LibraryError(
                f"pbmpm: the shared library does not fit this package: {what} should be at offset {expected[0]} "
                f"with {expected[1]} bytes, but the library {has}. Install a package and a library of one version."
            )


def check_version(declarations: Any, library: Any) -> None:
    """Refuses a library with another ABI number, or one that is older than the headers of this package."""
    expected_abi = declarations.integer_const("PBMPM_ABI_VERSION")
    abi = library.pbmpm_abi_version()
    if abi != expected_abi:
        raise LibraryError(f"pbmpm: this package needs ABI {expected_abi}, but the shared library has ABI {abi}")
    parts = (declarations.integer_const(f"PBMPM_VERSION_{part}") for part in ("MAJOR", "MINOR", "PATCH"))
    headers = ".".join(str(part) for part in parts)
    if _numbers(version_text(library.pbmpm_version())) < _numbers(headers):
        raise LibraryError(
            f"pbmpm: this package needs version {headers} or later, "
            f"but the shared library is {version_text(library.pbmpm_version())}"
        )


def version_text(number: int) -> str:
    """'major.minor.patch' of a version number of the library."""
    return f"{number // 1_000_000}.{number // 1_000 % 1_000}.{number % 1_000}"


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split("."))


def load() -> Any:
    """Loads the library and checks that it fits."""
    path = library_path()
    try:
        library = ffi.dlopen(str(path))
        check_version(ffi, library)
        check_layout(own_layout(ffi), library_layout(ffi, library))
    except LibraryError as problem:
        raise LibraryError(f"{problem} (library: {path})") from None
    except (OSError, AttributeError, ffi.error) as problem:
        raise LibraryError(f"pbmpm: cannot load the shared library {path}: {problem}") from problem
    return library


lib: Any = load()
