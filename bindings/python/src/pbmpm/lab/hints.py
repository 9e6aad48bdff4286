"""What a misspelt word may have meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def did_you_mean(word: object, words: Iterable[str]) -> str:
    """A question to put behind a message, or nothing where no word is like it."""
    near = difflib.get_close_matches(str(word).lower(), [known.lower() for known in words], 1)
    meant = [known for known in words if near and known.lower() == near[0]]
    return f"; did you mean '{meant[0]}'?" if meant else ""
