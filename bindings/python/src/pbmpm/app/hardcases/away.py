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
            places=_places("60x10 120x5 120x10 120x20 240x1 240x2 240x5 480x1 480x2 480x5"),
        ),
        KnownFailure("the same: the light block does not bear the heavy one", (PAPER,), ("1:100",), (ELASTIC,), (2,), places=_places("120x1")),
        KnownFailure(
            "iterations damp: 9,600 of them per second let the liquids change places more slowly than the 10 s that the case lasts",
            (PAPER,),
            ("1:10",),
            (LIQUID,),
            places=_places("480x20"),
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
            "crushed to nothing and let go at once it leaves faster than its sound, up to half as fast again (60 Hz x 2)",
            (PRIMAL,),
            _SLOT,
            (LIQUID,),
            (2,),
            places=_places("15x2 30x1 60x1 60x2 120x1 120x10 120x20"),
        ),
        KnownFailure(
            "the same by half a percent, the speed of the boxes included",
            (PRIMAL,),
            _SLOT,
            (LIQUID,),
            (3,),
            places=_places("15x1"),
        ),
        KnownFailure(
            "crushed to nothing and let go at once it leaves a quarter faster than what pushed it and a fall",
            (DUAL,),
            _SLOT,
            (LIQUID,),
            (3,),
            places=_places("480x20"),
        ),
        KnownFailure(
            "0.80 to 0.87 of the particles recover their volume: some stay folded",
            (PAPER,),
            _SLOT,
            (ELASTIC,),
            places=_places("240x5 240x10 240x20 480x5 480x10 480x20"),
        ),
        KnownFailure(
            "0.934 of the particles recover their volume, 0.95 are asked for",
            (PRIMAL,),
            _SLOT,
            (ELASTIC,),
            (2,),
            places=_places("60x20"),
        ),
    ),
    "H19": (
        KnownFailure(
            "a pool keeps stirring, by 1e-6 to 1e-2 of m g H, in bursts: the second half of the run may have 3.6 times the energy of the first",
            (DUAL,),
            materials=(LIQUID,),
            dimensions=(2,),
            places=_places("15x1 15x20 30x2 30x5 30x20 60x1 60x10"),
        ),
        KnownFailure("the same, by a twelfth", (PAPER,), materials=(LIQUID,), dimensions=(3,), places=_places("15x1")),
        KnownFailure(
            "a block that swings slowly is looked at 20 times only: its energy falls to a fifth, what is seen rises by a quarter",
            (DUAL,),
            materials=(ELASTIC,),
            dimensions=(2,),
            places=_places("240x1"),
        ),
    ),
    "H21": (
        KnownFailure(
            "a splash makes of any difference many times as much: one in the last bit nearly doubles (2D) or grows tenfold (3D) in each step",
            (PRIMAL,),
            ("a million cells away",),
            (LIQUID,),
            places=_places("15x20 60x10"),
        ),
    ),
}
