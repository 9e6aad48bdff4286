"""What commands write to stderr beside their progress."""

from __future__ import annotations

import re

LINE = re.compile(r"^\S.*: [\d.e+]+(/[\d.e+]+)? \S+ \[.*\]$")


def without_progress(text: str) -> list[str]:
    """The lines of a redirected stderr that are no progress; a slow machine gets some of these."""
    return [line for line in text.splitlines() if not LINE.match(line)]
