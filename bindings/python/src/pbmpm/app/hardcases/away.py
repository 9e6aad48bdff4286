"""What is known to fail away from the cases' own rates and iterations, as the full map finds it: where, why, and by how much."""

from __future__ import annotations

from .case import DUAL, ELASTIC, LIQUID, PAPER, PRIMAL, KnownFailure

Places = tuple[tuple[float, int], ...]


def _places(text: str) -> Places:
    """From "60x5 120x10": rates with iterations."""
    return tuple((float(rate), int(count)) for rate, _, count in (word.partition("x") for word in text.split()))


_SLOT = ("trapped between boxes",)
KNOWN_AWAY: dict[str, tuple[KnownFailure, ...]] = {
    "H09": (
        KnownFailure(
            "a light block whose modulus is below twice the heavy one's weight is crushed and leaves at up to 1.6 times its own speed of sound:"
            " to the ceiling, 2.7 times the start's height, without gain of energy",
            (PAPER,),
            ("1:1000", "1:10000"),
            (ELASTIC,),
            places=_places("60x10 120x1 120x2 120x5 120x10 120x20 240x1 240x2 240x5 240x10 480x1 480x2 480x5 480x10"),
        ),
        KnownFailure(
            "two iterations let the heavy liquid bounce on the light one: energy up to 1.006 of the start's",
            (DUAL,),
            ("1:10",),
            (LIQUID,),
            places=_places("60x2 120x2"),
        ),
        KnownFailure(
            "the light liquid, crushed to a twentieth by 10,000 times its weight, cannot lift it in so few iterations and stays below",
            (DUAL,),
            ("1:10000",),
            (LIQUID,),
            (2,),
            places=_places("60x20 240x5"),
        ),
    ),
    "H11": (
        KnownFailure(
            "a solve of one iteration is soft; strained matter that gets 50 stiffens and holds more energy: 1.03 of the start's",
            (DUAL,),
            materials=(ELASTIC,),
            dimensions=(2,),
            places=_places("240x1"),
        ),
    ),
    "H14": (
        KnownFailure(
            "fast matter passes through itself, where F is clamped: size wrong by half to all",
            (PRIMAL,),
            ("stretched to 10",),
            places=_places("120x20 240x20 480x20"),
        ),
    ),
    "H16": (
        KnownFailure(
            "crushed to nothing and let go at once it leaves a sixth faster than its sound",
            (PRIMAL,),
            _SLOT,
            (LIQUID,),
            places=_places("30x1 60x1 60x2 120x2 120x10 120x20 240x5"),
        ),
        KnownFailure(
            "0.80 to 0.94 of the particles recover their volume: some stay folded",
            (PAPER, DUAL, PRIMAL),
            _SLOT,
            (ELASTIC,),
            places=_places("60x20 240x5 240x10 240x20 480x5 480x10 480x20"),
        ),
    ),
    "H19": (
        KnownFailure(
            "a pool keeps stirring: with one iteration by 1e-6 to 1e-2 of m g H, with ten in bursts of 1e-5, and the second half of the run may have"
            " 4.4 times the energy of the first",
            (PAPER, DUAL),
            materials=(LIQUID,),
            places=_places("15x1 30x1 60x1 60x10 240x1"),
        ),
        KnownFailure(
            "a block that swings slowly is looked at 20 times only: its energy falls to a fifth, what is seen rises by a quarter",
            (DUAL,),
            materials=(ELASTIC,),
            dimensions=(2,),
            places=_places("240x1"),
        ),
    ),
}
