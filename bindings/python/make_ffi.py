"""Writes pbmpm/_ffi.py, cffi's out-of-line ABI module: ``python make_ffi.py INCLUDE_FOLDER OUTPUT``."""

import sys
from pathlib import Path

import cffi

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from generator import cdef, parser  # noqa: E402  (found through the line above)


def main() -> None:
    include, output = sys.argv[1:]
    builder = cffi.FFI()
    builder.cdef(cdef.emit(parser.parse(Path(include))))
    builder.set_source("pbmpm._ffi", None)
    builder.emit_python_code(output)


if __name__ == "__main__":
    main()
