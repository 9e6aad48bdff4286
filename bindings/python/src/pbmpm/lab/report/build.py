"""What the shared library says about its own making."""

from __future__ import annotations

import re
from pathlib import Path

#: Compilers leave their names in what they make (ELF: section .comment).
_MARKS = (
    re.compile(rb"GCC: \([^)\0]*\) [\d.]+"),
    re.compile(rb"[\w ]*clang version [\d.]+"),
    re.compile(rb"Intel\(r\) Implicit SPMD Program Compiler \(Intel\(r\) ISPC\), [\d.]+"),
)


def compilers(library: Path) -> list[str]:
    """The compilers that a shared library names; empty when it names none."""
    contents = library.read_bytes()
    return [found[0].decode("ascii", "replace") for mark in _MARKS if (found := mark.search(contents))]
