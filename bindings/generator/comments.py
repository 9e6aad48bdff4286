"""Finds the documentation comment that belongs to a line of a header.

The C parser sees no comments, but it knows the line of each declaration. Two forms are recognised::

    /** before one or several declarations without a blank line between them */
    type name; /**< on the line of a field or enumerator, possibly over several lines */
"""

from __future__ import annotations

import re
from pathlib import Path

_TRAILING = re.compile(r"/\*\*<(.*?)\*/", re.DOTALL)
_LEADING = re.compile(r"/\*\*(?!<)(.*?)\*/", re.DOTALL)


def _clean(comment: str) -> str:
    lines = [re.sub(r"^\s*\*?\s?", "", line).strip() for line in comment.strip().splitlines()]
    return "\n".join(lines).strip()


class Comments:
    """The documentation comments of one header, by line number (from 1)."""

    def __init__(self, text: str) -> None:
        self._lines = text.splitlines()
        self._trailing = {self._line_of(text, m.start()): _clean(m[1]) for m in _TRAILING.finditer(text)}
        self._leading = {self._line_of(text, m.end()): _clean(m[1]) for m in _LEADING.finditer(text)}

    @classmethod
    def of_file(cls, path: Path) -> Comments:
        return cls(path.read_text(encoding="utf-8"))

    @staticmethod
    def _line_of(text: str, position: int) -> int:
        return text.count("\n", 0, position) + 1

    def member(self, line: int) -> str:
        """The comment of a field or enumerator that is declared on this line."""
        return self._trailing.get(line) or self._leading.get(line - 1, "")

    def declaration(self, line: int) -> str:
        """The comment directly above this line."""
        return self._leading.get(line - 1, "")

    def paragraph(self, line: int) -> str:
        """The nearest comment above this line with no blank line between: functions of one kind share a comment."""
        line -= 1
        while line > 0 and self._lines[line - 1].strip():
            if line in self._leading:
                return self._leading[line]
            line -= 1
        return ""
