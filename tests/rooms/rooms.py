"""Holds the order of the rooms of src: an include points to the same room or a lower one, no circle leads back to a file, and no function
of src or of the kernels beside it has more than seven parameters.

A file is what one name stands for: NAME.h and NAME.c include as one. `rooms.py SRC` prints what breaks the order, and the exit status is then 1;
`rooms.py --planted SRC` plants such includes into a copy, one at a time, and asks whether each is found.
"""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
from pathlib import Path

#: From top to bottom. Folders in a room belong to it.
ROOMS = ("api", "services", "skin", "snapshot", "step", "solvers", "world", "contact", "grid", "matter", "shape", "base")
_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
#: Of other folders than src: the public headers, and what C and the kernels share.
_FOREIGN = re.compile(r"pbmpm/\w+\.h|(kernel|surface)_types\.h")


def included(source: Path) -> dict[str, set[str]]:
    """What each file of src includes, both named from src."""
    files = {str(path.relative_to(source)): path for path in sorted(source.rglob("*")) if path.suffix in (".c", ".h")}
    return {name: {it for it in _INCLUDE.findall(path.read_text(encoding="utf-8")) if not _FOREIGN.fullmatch(it)} for name, path in files.items()}


def order_problems(source: Path, includes: dict[str, set[str]]) -> list[str]:
    """Files in no room, includes of no file of src, and those that point upwards."""
    problems = []
    for name, others in includes.items():
        room = name.split("/")[0]
        if room not in ROOMS:
            problems.append(f"{name} is in no room")
            continue
        for other in sorted(others):
            if not (source / other).is_file() or other.split("/")[0] not in ROOMS:
                problems.append(f"{name} includes {other}, which is no file in a room: includes are named from src")
            elif ROOMS.index(other.split("/")[0]) < ROOMS.index(room):
                problems.append(f"{name} includes {other}, which is above it")
    return problems


def circles(includes: dict[str, set[str]]) -> list[str]:
    """One circle for each file that one leads back to, as the names along it; each circle once."""
    edges: dict[str, set[str]] = {}
    for name, others in includes.items():
        own = name.rsplit(".", 1)[0]
        edges.setdefault(own, set()).update(stem for it in others if (stem := it.rsplit(".", 1)[0]) != own)
    found: dict[frozenset[str], str] = {}
    for start in edges:
        way = _way_back(edges, start)
        if way and frozenset(way) not in found:
            found[frozenset(way)] = " -> ".join([*way, start])
    return list(found.values())


def _way_back(edges: dict[str, set[str]], start: str) -> list[str]:
    """The shortest way from a file to itself, without its end; empty if there is none."""
    before: dict[str, str] = {}
    now = [start]
    while now:
        after = []
        for name in now:
            for other in sorted(edges.get(name, ())):
                if other == start:
                    way = [name]
                    while way[0] != start:
                        way.insert(0, before[way[0]])
                    return way
                if other not in before:
                    before[other] = name
                    after.append(other)
        now = after
    return []


PARAMETERS_MOST = 7
_FUNCTION = re.compile(r"^[a-z][\w \*]*?\b(\w+)\(([^;{}()]*)\)\s*\{", re.MULTILINE)


def long_lists(source: Path) -> list[str]:
    """Functions with more parameters than a reader keeps apart."""
    found = []
    for path in [*sorted(source.rglob("*.c")), *sorted((source.parent / "ispc").glob("*.isp*"))]:
        for name, parameters in _FUNCTION.findall(path.read_text(encoding="utf-8")):
            count = parameters.count(",") + 1
            if count > PARAMETERS_MOST:
                found.append(f"{path.relative_to(source.parent)}: {name}() has {count} parameters")
    return found


def problems_of(source: Path) -> list[str]:
    includes = included(source)
    return order_problems(source, includes) + [f"a circle: {it}" for it in circles(includes)] + long_lists(source)


#: A file, what is written at its end, and a part of what has to be said of it.
PLANTED = (
    ("base/memory.c", '#include "world/world.h"', "base/memory.c includes world/world.h, which is above it"),
    ("matter/particles.h", '#include "grid/grid.h"', "matter/particles.h includes grid/grid.h, which is above it"),
    ("contact/contacts.c", '#include "contact/walls.h"', "a circle: contact/contacts -> contact/walls -> contact/walls_list -> contact/contacts"),
    ("solvers/dual/dual.c", '#include "solvers/joint.h"', "a circle: solvers/dual/dual -> solvers/joint -> solvers/dual/dual"),
    ("world/depth.c", '#include "depth.h"', "world/depth.c includes depth.h, which is no file in a room"),
    ("attic/things.h", "", "attic/things.h is in no room"),
    ("base/memory.c", "void f(int a, int b, int c, int d, int e, int f, int g, int h) {}", "src/base/memory.c: f() has 8 parameters"),
    ("../ispc/compression.isph", "static void f(int a, int b, int c, int d, int e, int f, int g, int h) {}", "ispc/compression.isph: f() has 8 parameters"),
)


def missed(source: Path) -> list[str]:
    """What was planted and not found."""
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "src"
        shutil.copytree(source, copy)
        shutil.copytree(source.parent / "ispc", copy.parent / "ispc")
        for name, text, expected in PLANTED:
            file = copy / name
            before = file.read_bytes() if file.is_file() else None
            file.parent.mkdir(exist_ok=True)
            file.write_bytes((before or b"") + text.encode() + b"\n")
            if not any(expected in it for it in problems_of(copy)):
                failures.append(f"not found: {name} with {text or 'nothing in it'}")
            file.unlink() if before is None else file.write_bytes(before)
    return failures


def main() -> int:
    planted = sys.argv[1:2] == ["--planted"]
    arguments = sys.argv[2:] if planted else sys.argv[1:]
    if len(arguments) != 1 or not Path(arguments[0]).is_dir():
        print(__doc__)
        return 2
    problems = missed(Path(arguments[0])) if planted else problems_of(Path(arguments[0]))
    print("\n".join(problems) or ("all that was planted was found" if planted else f"in order: {' > '.join(ROOMS)}; no circle"))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
