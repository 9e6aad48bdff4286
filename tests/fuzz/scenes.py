"""Reads damaged scene files: ``scenes.py [--seconds S] [--runs N] [--seed N] [FILE...]`` with the package installed (build/venv).

What is read is a scene, or an InputError says what is wrong with the file; anything else is a defect. The text of a sample is damaged in bytes or in its
values. A defect ends the run; its file is written to build/fuzz/work/scenes. FILEs are read as they are, before.
"""

from __future__ import annotations

import argparse
import copy
import hashlib
import json
import random
import sys
import time
import traceback
from pathlib import Path
from typing import Any

from pbmpm.lab.errors import InputError
from pbmpm.lab.loading import load_scene

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "fuzz" / "work" / "scenes"
CORPUS = ROOT / "tests" / "fuzz" / "corpus" / "scenes"
VALUES: list[Any] = [
    None, True, False, 0, 1, -1, 2, 3, 1.5, -0.0, 1e-300, 1e300, float("inf"), float("nan"), 2**31, 2**63, 2**64, -(2**63), 10**400, "", "x", "\0", "\ud800",
    "box", "water", "../x", "/", [], {}, [0], [0, 0], [0, 0, 0], [None], [[]], {"kind": "box"}, {"kind": "mesh", "file": "\0"}, {"kind": None}, [1e308, 1e308],
]  # fmt: skip
PIECES = [b"{", b"}", b"[", b"]", b",", b":", b'"', b"\\u0000", b"\\ud800", b"\xff", b"\0", b"1e999", b"-", b"NaN", b"9" * 5000, b"[" * 100000, b'{"a":' * 3000, b"\xef\xbb\xbf"]


def places(data: Any, way: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The ways to all values in decoded JSON."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    return [way, *(place for key, value in items for place in places(value, (*way, key)))]


def at(data: Any, way: tuple[Any, ...]) -> Any:
    for step in way:
        data = data[step]
    return data


def damaged_values(data: Any, others: list[Any], chance: random.Random) -> bytes:
    data = copy.deepcopy(data)
    for _ in range(chance.choice((1, 1, 1, 2, 5))):
        way = chance.choice(places(data))
        if not way:
            continue
        parent, key = at(data, way[:-1]), way[-1]
        other = chance.choice(others)
        kind = chance.randrange(5)
        if kind == 0:
            del parent[key]
        elif kind == 1 and isinstance(parent, dict):
            parent[chance.choice(("", "kind", "shape", "size", "\0", key + "s"))] = parent.pop(key)
        elif kind == 2:
            parent[key] = copy.deepcopy(at(other, chance.choice(places(other))))
        elif kind == 3 and isinstance(parent[key], (int, float)):
            parent[key] *= chance.choice((-1, 0.5, 2, 1e-3, 1e3, 1e9))
        else:
            parent[key] = copy.deepcopy(chance.choice(VALUES))
    return json.dumps(data).encode("utf-8", "surrogatepass")


def damaged_bytes(text: bytes, chance: random.Random) -> bytes:
    changed = bytearray(text)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        begin = chance.randrange(len(changed) + 1)
        end = min(len(changed), begin + chance.choice((0, 1, 1, 2, 8, 64)))
        changed[begin:end] = chance.choice((chance.choice(PIECES), bytes([chance.randrange(256)]), b"", text[begin : begin + 16]))
    return bytes(changed)


def read(path: Path) -> bool:
    """Whether the file is a scene. Raises what is a defect."""
    try:
        load_scene(path)
    except InputError as error:
        if not str(error).strip():
            raise AssertionError("an error without a message") from error
        str(error).encode("utf-8", "replace")
        return False
    return True


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--seconds", type=float, default=60.0)
    arguments.add_argument("--runs", type=int, default=10**9)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("files", nargs="*", type=Path)
    options = arguments.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    chance = random.Random(options.seed)
    samples = sorted((ROOT / "samples" / "scenes").glob("*.json")) + sorted((ROOT / "tests" / "python" / "data").rglob("*.json"))
    texts = [path.read_bytes() for path in samples if path.stat().st_size < 20000]
    decoded = [json.loads(text) for text in texts]
    for path in [*options.files, *sorted(CORPUS.glob("*"))]:
        read(path)
    runs = taken = 0
    end = time.monotonic() + options.seconds
    path = WORK / "scene.json"
    while runs < options.runs and time.monotonic() < end:
        which = chance.randrange(len(texts))
        text = damaged_values(decoded[which], decoded, chance) if chance.random() < 0.7 else damaged_bytes(texts[which], chance)
        path.write_bytes(text)
        runs += 1
        try:
            taken += read(path)
        except BaseException:
            kept = WORK / f"defect-{hashlib.sha1(text).hexdigest()[:12]}.json"
            kept.write_bytes(text)
            traceback.print_exc()
            print(f"after {runs} files: {kept}")
            return 1
    print(f"{runs} files read, {taken} of them scenes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
