"""Files that are either complete or not there."""

from __future__ import annotations

import json
import os
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator


@contextmanager
def replace_when_complete(path: Path) -> Iterator[Path]:
    """Gives a temporary path beside ``path``; it takes the final name only when the block ends without an error."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_json(data: Any, path: Path) -> None:
    """Writes indented JSON, complete or not at all."""
    with replace_when_complete(path) as temporary:
        temporary.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n", encoding="utf-8")
