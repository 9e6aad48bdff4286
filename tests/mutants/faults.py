"""Where faults can be planted in C and ISPC text, and which. A fault changes one line."""

from __future__ import annotations

import hashlib
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

#: What is code but says nothing of behaviour: declarations of types, includes, what only a compiler reads.
_IDLE = re.compile(r"^\s*(#|typedef|extern|_Static_assert|static_assert|export\b.*\);$|\}|\{|case [\w ]+:$|default:$)")
_NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?f?|\d+e[-+]?\d+f?|\d+u?)(?![\w.])")
#: A declaration up to its value: a larger array changes nothing.
_DECLARED = re.compile(r"^\s*(?:static |const |uniform )*(?:float|double|bool|char|size_t|u?int(?:\d+_t)?|[A-Z]\w*) [^=;]*")
_CALL = re.compile(r"^(\s*)([a-z]\w*\(.*\));$")
_IF = re.compile(r"\b(c?if|c?while) \(")


@dataclass(frozen=True)
class Fault:
    file: str  #: relative to the top folder
    line: int  #: from 1
    kind: str
    before: str
    after: str

    @property
    def name(self) -> str:
        """The same as long as the line is the same, wherever it stands; two faults of equal lines are told apart by their places."""
        return hashlib.sha1(f"{self.file}\0{self.line}\0{self.before}\0{self.after}".encode()).hexdigest()[:12]

    @property
    def key(self) -> tuple[str, str, str]:
        return self.file, self.before.strip(), self.after.strip()

    def diff(self) -> str:
        return f"{self.file}:{self.line} ({self.kind})\n  - {self.before.strip()}\n  + {self.after.strip()}"


def bare(text: str) -> list[str]:
    """The lines with blanks in place of comments and literal text, so that columns stay."""

    def blank(match: re.Match[str]) -> str:
        return re.sub(r"[^\n]", " ", match[0])

    return re.sub(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'", blank, text, flags=re.DOTALL).splitlines()


def _swap(pairs: dict[str, str], pattern: str) -> Callable[[str, str], Iterator[str]]:
    finder = re.compile(pattern)

    def changes(line: str, code: str) -> Iterator[str]:
        for match in finder.finditer(code):
            yield line[: match.start(1)] + pairs[match[1]] + line[match.end(1) :]

    return changes


def _constants(line: str, code: str) -> Iterator[str]:
    declared = _DECLARED.match(code)
    for match in _NUMBER.finditer(code):
        text = match[1]
        if declared and match.end() <= declared.end() and code[match.start() - 1] == "[":
            continue
        if text.rstrip("u").isdigit():
            changed = str(int(text.rstrip("u")) + 1) + ("u" if text.endswith("u") else "")
        else:
            value = float(text.rstrip("f"))
            changed = f"{value * 1.5 if value else 1.0!r}" + ("f" if text.endswith("f") else "")
        yield line[: match.start(1)] + changed + line[match.end(1) :]


def _signs(line: str, code: str) -> Iterator[str]:
    for match in re.finditer(r"(?:[=(,?:]|return) (-)(?=[\w(])|\((-)(?=[\w(])", code):
        place = match.start(1) if match[1] else match.start(2)
        yield line[:place] + line[place + 1 :]
    for match in re.finditer(r"(?:[^=!<>]= |return |\+ )(?=[a-zA-Z(])", code):
        rest = code[match.end() :]
        # Of what is no number a sign changes nothing, or does not compile.
        if rest.rstrip().endswith(";") and not re.match(r"&|(true|false|result|fail|NULL)\b|\(?const|[A-Z]\w+\)", rest) and not re.search(r"\?|\|\||&&|[=!<>]=| [<>] |!", rest):
            yield line[: match.end()] + "-" + line[match.end() :]


def _dropped(line: str, code: str) -> Iterator[str]:
    match = _CALL.match(code)
    if match and not match[2].startswith(("return", "sizeof")):
        yield f"{match[1]};"


def _negated(line: str, code: str) -> Iterator[str]:
    for match in _IF.finditer(code):
        depth, end = 1, match.end()
        while end < len(code) and depth:
            depth += {"(": 1, ")": -1}.get(code[end], 0)
            end += 1
        if depth == 0:
            yield f"{line[: match.end()]}!({line[match.end() : end - 1]}){line[end - 1 :]}"


KINDS: dict[str, Callable[[str, str], Iterator[str]]] = {
    "bound": _swap({"<": "<=", "<=": "<", ">": ">=", ">=": ">"}, r" (<=?|>=?) "),
    "sum": _swap({"+": "-", "-": "+", "+=": "-=", "-=": "+="}, r"(?<=[\w)\]]) ([-+]=?) "),
    "sign": _signs,
    "constant": _constants,
    "call dropped": _dropped,
    "condition negated": _negated,
    "logic": _swap({"&&": "||", "||": "&&", "==": "!=", "!=": "=="}, r" (&&|\|\||==|!=) "),
}


def faults_of(root: Path, file: str) -> Iterator[Fault]:
    text = (root / file).read_text(encoding="utf-8")
    inside = False
    for number, (line, code) in enumerate(zip(text.splitlines(), bare(text), strict=True), 1):
        if code.startswith("{"):
            inside = True
        one_line = re.match(r"^(static |const |inline |unmasked |export )*[\w *]+\(.*\)\s*\{.*\}$", code)
        if (inside or one_line) and not _IDLE.match(code) and code.strip():
            begin = code.index("{") + 1 if one_line and not inside else 0
            for kind, changes in KINDS.items():
                seen = set()
                for after in changes(line, " " * begin + code[begin:]):
                    if after != line and after not in seen:
                        seen.add(after)
                        yield Fault(file, number, kind, line, after)
        if code.startswith("}"):
            inside = False
        elif not inside and code.rstrip().endswith(") {"):
            inside = True


def choose(root: Path, files: list[str], seed: int) -> Iterator[Fault]:
    """Faults in an order that the seed decides: files in turn, in each the kinds in turn, of each a place at random; no line twice."""
    chance = random.Random(seed)
    heaps: dict[str, dict[str, list[Fault]]] = {}
    for file in sorted(files):
        heaps[file] = {kind: [] for kind in chance.sample(list(KINDS), len(KINDS))}
        for fault in faults_of(root, file):
            heaps[file][fault.kind].append(fault)
        for faults in heaps[file].values():
            chance.shuffle(faults)
    used: set[tuple[str, int]] = set()
    turns = sorted(heaps)
    while turns:
        chance.shuffle(turns)
        turns.sort(key=lambda file: Path(file).parent.as_posix(), reverse=True)  # kernels are built once less if one fault of them follows another
        for file in list(turns):
            fault = _next_of(heaps[file], used)
            if fault:
                yield fault
            else:
                turns.remove(file)


def _next_of(kinds: dict[str, list[Fault]], used: set[tuple[str, int]]) -> Fault | None:
    """Takes one of the kind whose turn it is, which goes to the end of the queue."""
    for kind in list(kinds):
        faults = kinds.pop(kind)
        while faults:
            fault = faults.pop()
            if (fault.file, fault.line) not in used:
                used.add((fault.file, fault.line))
                kinds[kind] = faults
                return fault
    return None


def equivalents(file: Path) -> dict[tuple[str, str, str], str]:
    """Faults that no test can find, with the reason: file, line before and after, without blanks at their ends."""
    known: dict[tuple[str, str, str], str] = {}
    for block in file.read_text(encoding="utf-8").split("\n\n"):
        lines = [line for line in block.splitlines() if line and not line.startswith("#")]
        if lines:
            where, before, after, reason = lines
            known[where, before.removeprefix("  - "), after.removeprefix("  + ")] = reason.strip()
    return known


_VALUE = r"-?(?:\d+\.\d*|\d*\.\d+|\d+)(?:e[-+]?\d+)?f?"
_NAMED = re.compile(rf"\b([A-Z][A-Z0-9_]+) = ({_VALUE}(?: [*/+-] {_VALUE})*)(?=[,;])")
_DEFINED = re.compile(rf"^#define ([A-Z][A-Z0-9_]+) ({_VALUE})(?=\s|$)")
_COUNTED = re.compile(r"\b([A-Z_]*(?:ROUNDS|STEPS|EVALUATIONS|HALVINGS|MEMORY|STAGES|LEVELS|SAMPLES|BINS)[A-Z_]*) = (\d+)(?=[, ])")
#: Of mathematics, of number formats, and marks: nothing that could be chosen otherwise.
_GIVEN = re.compile(r"^(?:PI|TURN|LN2_.*|HALF_PI_.*|.*UNKNOWN.*|.*NONE.*|.*NOTHING.*|GUESS_KEEPS_ALL|.*MAX_ISA.*)$")


@dataclass(frozen=True)
class Constant:
    """A number with a name: what somebody chose, so that half or twice of it is a question that a test should answer."""

    file: str
    line: int  #: from 1
    name: str
    value: str
    about: str  #: the comment beside it, or the one above

    @property
    def key(self) -> str:
        """A verdict counts as long as this stays."""
        return f"{self.file} {self.name} = {self.value}"

    def fault(self, text: str, factor: float) -> Fault:
        """The line with half or twice the value."""
        suffix = "f" if self.value.endswith("f") else ""
        if self.value.isdigit():
            changed = text.replace(f"{self.name} = {self.value}", f"{self.name} = {int(factor * int(self.value))}")
        else:
            changed = text.replace(f"{self.name} = {self.value}", f"{self.name} = {factor}{suffix} * ({self.value})")
        if changed == text:
            changed = text.replace(f"{self.name} {self.value}", f"{self.name} ({factor}{suffix} * {self.value})", 1)
        return Fault(self.file, self.line, "halved" if factor < 1.0 else "doubled", text, changed)


def constants_of(root: Path, file: str) -> Iterator[Constant]:
    """The named real numbers of a file, and the counts of what it does again and again."""
    text = (root / file).read_text(encoding="utf-8")
    lines = text.splitlines()
    for number, (line, code) in enumerate(zip(lines, bare(text), strict=True), 1):
        named = _NAMED.finditer(code) if re.match(r"\s*static const (double|float) ", code) else filter(None, [_DEFINED.match(code)])
        for match in named:
            if "." in match[2] or "e" in match[2]:
                if not _GIVEN.search(match[1]):
                    yield Constant(file, number, match[1], match[2], _about(lines, number - 1))
        for match in _COUNTED.finditer(code) if re.match(r"\s*enum \{", code) else ():
            yield Constant(file, number, match[1], match[2], _about(lines, number - 1))


def _about(lines: list[str], place: int) -> str:
    """The comment behind a line, the one above it, or the one above its function."""
    beside = re.search(r"/\*\s*(.*?)\s*\*/|//\s*(.*)$", lines[place])
    if beside:
        return beside[1] or beside[2]
    inside = lines[place].startswith(" ")
    return _above(lines, place) or (_above(lines, _function(lines, place)) if inside else "")


def _function(lines: list[str], place: int) -> int:
    """The line where the function begins that a line is in."""
    opened = next((at for at in range(place, 0, -1) if lines[at] == "{"), place)
    return next((at + 1 for at in range(opened - 1, 0, -1) if not lines[at] or re.match(r"\s*(/\*|\*|//)|.*\*/$", lines[at])), place)


def _above(lines: list[str], place: int) -> str:
    """The comment that ends above a line, or above others that declare constants; a blank line ends the search."""
    above: list[str] = []
    for line in reversed(lines[max(0, place - 12) : place]):
        if not re.match(r"\s*(/\*|\*|//)", line):
            if above or not re.match(r"\s*(static const|enum|#define)", line):
                break
            continue
        above.append(re.sub(r"^\s*(/\*|\*/?|//)\s*|\s*\*/\s*$", "", line))
        if re.match(r"\s*/\*", line):
            break
    return " ".join(reversed(above)).strip()


def constants(root: Path) -> list[Constant]:
    """All of the library's, in the order of their files."""
    files = sorted(str(path.relative_to(root)) for pattern in ("src/**/*.[ch]", "ispc/*.h", "ispc/*.isph") for path in root.glob(pattern))
    return [constant for file in files for constant in constants_of(root, file)]


def constant_faults(root: Path, known: dict[str, dict[str, str]]) -> Iterator[Fault]:
    """Half and twice of each constant, but for those with a verdict; headers and kernels last, which take longest to build."""
    for constant in sorted(constants(root), key=lambda it: (it.file.startswith("ispc"), it.file.endswith(".h"))):
        text = (root / constant.file).read_text(encoding="utf-8").split("\n")[constant.line - 1]
        faults = (constant.fault(text, factor) for factor in (0.5, 2.0))
        yield from (fault for fault in faults if fault.kind not in known.get(constant.key, {}))
