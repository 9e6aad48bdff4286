"""Where a constant acts: a library that notes in which runs half or twice of it would change anything.

`plant` rewrites a copy of the sources. Each expression that uses a constant is worked out three times: with half of it, with twice, and as it is. What
differs is noted, and the last is what counts, so the library does what it always does. Where nothing differed in a whole run, the run with the changed
constant is the same to the bit. `build` compiles the copy; what cannot be worked out three times counts as noted when it is read, or always.
The library writes its notes at exit: a line "NUMBER half twice" per constant, into the file that PBMPM_TRACE names and its process number.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

from faults import Constant, bare

C_PART = """
#include <stdbool.h>
extern unsigned char pbmpm_noted[];
#define PBMPM_TRIED(number, plain, half, twice) __extension__({ \\
    const __typeof__(plain) half_ = (half), twice_ = (twice), plain_ = (plain); \\
    if (half_ != plain_) pbmpm_noted[2 * (number)] = 1; \\
    if (twice_ != plain_) pbmpm_noted[2 * (number) + 1] = 1; \\
    plain_; })
#define PBMPM_READ(number, plain) __extension__({ pbmpm_noted[2 * (number)] = pbmpm_noted[2 * (number) + 1] = 1; (plain); })
"""
NOTES = """
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
unsigned char pbmpm_noted[2 * %(count)d];
__attribute__((destructor)) static void write_notes(void) {
    const char *name = getenv("PBMPM_TRACE");
    char path[4096];
    if (!name) return;
    snprintf(path, sizeof path, "%%s.%%ld", name, (long)getpid());
    FILE *file = fopen(path, "w");
    for (int i = 0; file && i < %(count)d; i++) fprintf(file, "%%d %%d %%d\\n", i, pbmpm_noted[2 * i], pbmpm_noted[2 * i + 1]);
    if (file) fclose(file);
}
"""
ISPC_PART = """
#if defined(ISPC) && !defined(PBMPM_TRIED_ONCE)
#define PBMPM_TRIED_ONCE
extern uniform unsigned int8 pbmpm_noted[%(size)d];
%(overloads)s
#endif
"""
OVERLOAD = """static inline %(kind)s PBMPM_TRIED(uniform int number, %(kind)s plain, %(kind)s half, %(kind)s twice) {
    if (%(half)s) pbmpm_noted[2 * number] = 1;
    if (%(twice)s) pbmpm_noted[2 * number + 1] = 1;
    return plain;
}
static inline %(kind)s PBMPM_READ(uniform int number, %(kind)s plain) { pbmpm_noted[2 * number] = pbmpm_noted[2 * number + 1] = 1; return plain; }
"""
TRIED, READ, LEFT = range(3)
"""How a line is rewritten: what compiles best comes first."""


@dataclass
class Line:
    """One that uses constants."""

    file: Path
    number: int  #: from 0
    text: str
    constants: list[tuple[int, Constant]]
    way: int = TRIED

    def rewritten(self) -> str:
        if self.way == LEFT:
            return self.text
        if self.way == READ:
            text = self.text
            for number, constant in self.constants:
                text = re.sub(rf"\b{constant.name}\b", f"PBMPM_READ({number}, {constant.name})", text)
            return text
        spans: dict[tuple[int, int], list[tuple[int, Constant]]] = {}
        for number, constant in self.constants:
            span = expression_around(self.text, constant.name)
            if span is None:
                self.way = READ
                return self.rewritten()
            spans.setdefault(span, []).append((number, constant))
        text, limit = self.text, len(self.text)
        for begin, end in sorted(spans, reverse=True):
            if end > limit:  # expressions within each other
                self.way = READ
                return self.rewritten()
            text, limit = text[:begin] + tried(text[begin:end], spans[begin, end]) + text[end:], begin
        return text


def tried(expression: str, constants: list[tuple[int, Constant]]) -> str:
    plain = f"({expression})"
    for number, constant in constants:
        half, twice = (re.sub(rf"\b{constant.name}\b", changed(constant, factor), expression) for factor in (0.5, 2.0))
        plain = f"PBMPM_TRIED({number}, {plain}, ({half}), ({twice}))"
    return plain


def changed(constant: Constant, factor: float) -> str:
    if constant.value.isdigit():
        return str(int(factor * int(constant.value)))
    return f"({factor}{'f' if constant.value.endswith('f') else ''} * ({constant.value}))"


def expression_around(text: str, name: str) -> tuple[int, int] | None:
    """The whole expression that a name stands in: what is returned, assigned or asked; nothing if it does not begin and end in this line."""
    code = bare(text)[0] if text else ""
    found = re.search(rf"\b{name}\b", code)
    begin = _begin(code, found.start()) if found else None
    if begin is None:
        return None
    depth = 0
    for end in range(begin, len(code)):
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(code[end], 0)
        if depth < 0 or (depth == 0 and code[end] in ",;"):
            return begin, end
    return None


def _begin(code: str, place: int) -> int | None:
    depth = 0
    for at in range(place - 1, -1, -1):
        if code[at] in ")]}":
            depth += 1
        elif code[at] in "([{" and depth:
            depth -= 1
        elif depth == 0:
            if code[at] in "({;" and (code[at] == ";" or re.search(r"\bc?(?:if|while) $", code[:at])):
                return at + 1
            before = re.search(r"(?:\breturn | [-+*/]?= )$", code[: at + 1])
            if before:
                return at + 1
    return None


@dataclass
class Traced:
    """A tree with notes planted."""

    tree: Path
    studied: list[Constant]
    lines: list[Line] = field(default_factory=list)
    always: set[int] = field(default_factory=set)

    def plant(self) -> None:
        for number, constant in enumerate(self.studied):
            for file in self._readers(constant):
                self._look_for(file, number, constant)
        self._write(self.lines)
        count = max(1, len(self.studied))
        (self.tree / "tried.h").write_text(C_PART, encoding="utf-8")
        kinds = [(f"{uniform}{kind}", uniform) for kind in ("bool", "int", "float") for uniform in ("", "uniform ")]
        overloads = "".join(OVERLOAD % {"kind": kind, **{it: f"{it} != plain" if uniform else f"any({it} != plain)" for it in ("half", "twice")}} for kind, uniform in kinds)
        self._append(self.tree / "ispc/kernel_types.h", ISPC_PART % {"size": 2 * count, "overloads": overloads})
        self._append(self.tree / "src/base/memory.c", NOTES % {"count": count})

    def build(self, make: Callable[[], str]) -> None:
        """Until all compiles; `make` gives what the compilers say, nothing if they are content."""
        while complaints := make():
            blamed = {(Path(file).name, int(line) - 1) for file, line in re.findall(r"(\S+?):(\d+):(?:\d+:)?\s*(?:[Ee]rror|note: in expansion of macro .PBMPM_)", complaints)}
            again = [line for line in self.lines if (line.file.name, line.number) in blamed and line.way < LEFT]
            if not again:
                raise SystemExit(f"the traced library does not build:\n{complaints[-4000:]}")
            for line in again:
                line.way += 1
                if line.way == LEFT:
                    self.always |= {number for number, _ in line.constants}
            self._write(again)

    def _readers(self, constant: Constant) -> Iterable[Path]:
        own = self.tree / constant.file
        if own.suffix == ".c":
            return [own]
        return sorted([*self.tree.glob("src/**/*.[ch]"), *self.tree.glob("ispc/*.is*"), *self.tree.glob("ispc/*.h")])

    def _look_for(self, file: Path, number: int, constant: Constant) -> None:
        text = file.read_text(encoding="utf-8")
        if not re.search(rf"\b{constant.name}\b", text):
            return
        own_file = file == self.tree / constant.file
        if not own_file and re.search(rf"^\s*(?:static const|enum|#define).*\b{constant.name}\b[ =]", text, re.MULTILINE):
            return  # another one of this name
        for at, (line, code) in enumerate(zip(text.split("\n"), bare(text))):
            if not re.search(rf"\b{constant.name}\b", code) or (own_file and at == constant.line - 1):
                continue
            if not code.startswith(" ") and not re.match(r"^(?:static |const |inline |unmasked |export )*[\w *]+\(.*\)\s*\{.*\}$", code):
                self.always.add(number)  # part of another constant
                continue
            known = next((it for it in self.lines if it.file == file and it.number == at), None)
            if known is None:
                known = Line(file, at, line, [])
                self.lines.append(known)
            known.constants.append((number, constant))

    def _write(self, lines: list[Line]) -> None:
        for file in {line.file for line in lines}:
            text = file.read_text(encoding="utf-8").split("\n")
            for line in lines:
                if line.file == file:
                    text[line.number] = line.rewritten()
            file.write_text("\n".join(text), encoding="utf-8")

    @staticmethod
    def _append(file: Path, text: str) -> None:
        file.write_text(file.read_text(encoding="utf-8") + text, encoding="utf-8")


def noted(trace: Path) -> dict[int, tuple[bool, bool]]:
    """What the processes of a run wrote, together."""
    found: dict[int, tuple[bool, bool]] = {}
    for file in trace.parent.glob(trace.name + ".*"):
        for line in file.read_text(encoding="utf-8").splitlines():
            number, half, twice = (int(it) for it in line.split())
            before = found.get(number, (False, False))
            found[number] = before[0] or half > 0, before[1] or twice > 0
        file.unlink()
    return found
