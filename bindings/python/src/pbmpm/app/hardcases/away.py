"""What is known to fail away from the cases' own rates and iterations, as the full map finds it: where, why, and by how much."""

from __future__ import annotations

from .case import DUAL, ELASTIC, KnownFailure

Places = tuple[tuple[float, int], ...]


def _places(text: str) -> Places:
    """From "60x5 120x10": rates with iterations."""
    return tuple((float(rate), int(count)) for rate, _, count in (word.partition("x") for word in text.split()))


KNOWN_AWAY: dict[str, tuple[KnownFailure, ...]] = {
    "H11": (
        KnownFailure(
            "a body that bears its weight is asked for three times what 10 iterations hold (most_asked() in src/dual.c). Crushed by its fall it keeps strains that its"
            " particles hold against each other (their J is 0.2 off the mean), and once stiff, and at rest, it stands up to half a cell higher, as high as it fell: 1.01 (x 5) and"
            " 1.02 to 1.10 (x 10, eight seeds) of the start's energy. Asked for half as much it passes (1.006), but a column of 48 cells at 60 Hz x 5 stands"
            " at 0.40 of its height, 0.45 being asked for (test_deep_solids.py)",
            (DUAL,),
            materials=(ELASTIC,),
            dimensions=(2,),
            places=_places("15x5 15x10"),
        ),
    ),
}
