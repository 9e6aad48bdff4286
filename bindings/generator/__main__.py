"""Command line: ``python -m generator cdef|csharp|layout|sized|header|fuzz --headers include --output FILE``."""

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
    "sized": "the table of the sizes of structures in all versions, in the library",
    "header": "one header without comments, kept in tests/abi",
}


def main() -> int:
    arguments = argparse.ArgumentParser(prog="python -m generator", description="Writes bindings from the C headers.")
    arguments.add_argument("target", choices=_TARGETS, help="; ".join(f"{k}: {v}" for k, v in _TARGETS.items()))
    arguments.add_argument("--headers", type=Path, required=True, help="folder that holds pbmpm/pbmpm.h")
    arguments.add_argument("--output", type=Path, required=True, help="file to write")
    arguments.add_argument("--versions", type=Path, help="sized: folder with the headers of older versions")
    options = arguments.parse_args()
    if (options.versions is None) == (options.target == "sized"):
        arguments.error("--versions goes with the target sized, and with no other")
    try:
        api = parse(options.headers)
    except (ParseError, OSError) as problem:
        print(f"generator: {problem}", file=sys.stderr)
        return 2
    emitter = importlib.import_module(f".{options.target}", __package__)
    more = [options.versions] if options.versions else []
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(emitter.emit(api, *more), encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
