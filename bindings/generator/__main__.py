"""Command line: ``python -m generator cdef|csharp|fuzz|layout --headers include --output FILE``."""

from __future__ import annotations

import argparse
import importlib
import sys
from pathlib import Path

from .parser import ParseError, parse

_TARGETS = {
    "cdef": "declarations for cffi",
    "csharp": "P/Invoke declarations for C#",
    "fuzz": "calls of every function with arguments out of bytes, for the fuzz target of them",
    "layout": "the list of structures and fields in the library",
}


def main() -> int:
    arguments = argparse.ArgumentParser(prog="python -m generator", description="Writes bindings from the C headers.")
    arguments.add_argument("target", choices=_TARGETS, help="; ".join(f"{k}: {v}" for k, v in _TARGETS.items()))
    arguments.add_argument("--headers", type=Path, required=True, help="folder that holds pbmpm/pbmpm.h")
    arguments.add_argument("--output", type=Path, required=True, help="file to write")
    options = arguments.parse_args()
    try:
        api = parse(options.headers)
    except (ParseError, OSError) as problem:
        print(f"generator: {problem}", file=sys.stderr)
        return 2
    emitter = importlib.import_module(f".{options.target}", __package__)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(emitter.emit(api), encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
