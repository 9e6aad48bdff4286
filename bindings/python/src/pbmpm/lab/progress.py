"""Progress on stderr: a bar on a terminal, a line now and then where stderr is redirected."""

from __future__ import annotations

import sys
import time
from typing import TextIO

from tqdm import tqdm

LINES_EVERY = 10.0
"""[s] between lines; what is done sooner prints none."""

_shown = True


def show_no_progress() -> None:
    """From now on: for a process whose runs are a part of what another one shows."""
    global _shown
    _shown = False


def progress_bar(total: float | None, unit: str, label: str, shown: bool = True) -> tqdm:
    """A tqdm bar with rate and time left, as far as the total is known; one that is not shown does nothing."""
    bar = sys.stderr.isatty()
    end = "[{rate_fmt}, {remaining} left{postfix}]" if total is not None else "[{elapsed}{postfix}]"
    done = "{n:.3g}/{total:.3g} {unit}" if total is not None else "{n:.3g} {unit}"
    scale = "{percentage:3.0f}% |{bar}| " if bar and total is not None else ""
    return tqdm(
        total=total,
        unit=unit,
        desc=label,
        bar_format=f"{{desc}}: {scale}{done} {end}",
        file=sys.stderr if bar else _Lines(sys.stderr),
        mininterval=0.2,
        leave=False,
        disable=not (shown and _shown),
    )


class _Lines:
    """A file that gets a state of a bar now and then, as a line of its own."""

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self._written = time.monotonic()

    def write(self, text: str) -> None:
        line = text.strip("\r\n ")
        if line and time.monotonic() - self._written >= LINES_EVERY:
            self._file.write(f"{line}\n")
            self._written = time.monotonic()

    def flush(self) -> None:
        self._file.flush()
