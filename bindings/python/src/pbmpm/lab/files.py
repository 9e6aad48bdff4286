"""Files that are either complete or not there."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@contextmanager
def replace_when_complete(path: Path) -> Iterator[Path]:
    """Gives a temporary path beside ``path``; it takes the final name only when the block ends without an error."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None
    finally:
        temporary.unlink(missing_ok=True)


def json_text(data: Any) -> str:
    """Indented JSON; numbers that are not finite, which JSON has no word for, become null."""
    return json.dumps(_without_nan(data), indent=2, allow_nan=False)


def _without_nan(data: Any) -> Any:
    if isinstance(data, dict):
        return {key: _without_nan(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_without_nan(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def save_figure(figure: Figure, path: Path, dpi: int = 110) -> None:
    """Writes a figure as PNG, complete or not at all, into a folder that is made when missing."""
    path.parent.mkdir(parents=True, exist_ok=True)
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # slow to load; most commands draw nothing

    FigureCanvasAgg(figure)  # a canvas without a window
    with replace_when_complete(path) as temporary:
        figure.savefig(temporary, format="png", dpi=dpi)


def write_json(data: Any, path: Path) -> None:
    """Writes JSON, complete or not at all."""
    with replace_when_complete(path) as temporary:
        temporary.write_text(json_text(data) + "\n", encoding="utf-8")
