"""What is known to fail away from the cases' own rates and iterations, as the full map finds it: where, why, and by how much."""

from __future__ import annotations

from .case import KnownFailure

Places = tuple[tuple[float, int], ...]


def _places(text: str) -> Places:
    """From "60x5 120x10": rates with iterations."""
    return tuple((float(rate), int(count)) for rate, _, count in (word.partition("x") for word in text.split()))


KNOWN_AWAY: dict[str, tuple[KnownFailure, ...]] = {}
