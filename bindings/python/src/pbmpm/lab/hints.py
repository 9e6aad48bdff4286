"""What a misspelt word may have meant."""

from __future__ import annotations

import difflib
import glob
from collections.abc import Iterable
from pathlib import Path

from .._fixed import nearest


def not_one_of(word: object, words: Iterable[str]) -> str:
    """What is wrong with a word that is none of some, and which of them it may have meant."""
    known = list(words)
    return f"'{word}' is not one of {', '.join(known)}{nearest(word, known)}"


def file_like(path: Path) -> str:
    """A question about a file that is not there: one of a like name beside it, or among the scenes of a checkout."""
    folders = (str(path.parent), "samples/scenes")
    near = [Path(name) for folder in folders for name in sorted(glob.glob(f"{glob.escape(folder)}/*{path.suffix or '.json'}")) if Path(name).is_file()]
    alike = difflib.get_close_matches(path.stem.lower(), [other.stem.lower() for other in near], 1)
    meant = [other for other in near if alike and other.stem.lower() == alike[0]]
    return f"; did you mean '{meant[0]}'?" if meant else ""
