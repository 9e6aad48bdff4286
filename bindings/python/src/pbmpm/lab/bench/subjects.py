"""What is measured: matter in motion, with 8 particles per cell in 3D and 4 in 2D.

The 3D scenes are those of ``samples/scenes/bench_liquid_3d.json`` and ``bench_elastic_3d.json``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..parsing import parse_scene
from ..scenes.scene import Scene

RATE_HZ = 120.0
ITERATIONS = 10
CELL = 0.05

BULK_MODULUS = 2e4
"""Of the liquid [Pa], for the solvers with moduli: sound of 4.5 m/s, within the explicit solver's reach at this rate and cell."""


def _scene(
    name: str, dimension: int, high: list[float], material: dict[str, Any], fills: list[dict[str, Any]], **domain: Any
) -> Scene:
    return parse_scene(
        {
            "format": "pbmpm-scene",
            "version": 1,
            "name": name,
            "dimension": dimension,
            "cell_size": CELL,
            "gravity": [0, -9.81, 0][:dimension],
            "domain": {"min": [0] * dimension, "max": high, **domain},
            "seconds": 1.5,
            "rate_hz": RATE_HZ,
            "iterations": ITERATIONS,
            "materials": {"matter": material},
            "fills": fills,
        }
    )


def _block(position: list[float], half_extents: list[float], **more: Any) -> dict[str, Any]:
    return {"shape": {"kind": "box", "position": position, "half_extents": half_extents}, "material": "matter", **more}


def _dam_break_3d(material: dict[str, Any]) -> Scene:
    return _scene("dam_break", 3, [4, 3, 1.25], material, [_block([0.625, 1, 0.625], [0.625, 1, 0.625])])


def _dam_break_2d(material: dict[str, Any]) -> Scene:
    return _scene("dam_break", 2, [16, 12], material, [_block([2.5, 3], [2.5, 3])])


_HEIGHTS = (0.5, 0.65, 0.8, 0.65, 0.8, 0.5, 0.8, 0.5, 0.65)
_FALLS = (-0.5, 0, -0.25, -0.25, -0.5, 0, 0, -0.25, -0.5)


def _falling_blocks_3d(material: dict[str, Any]) -> Scene:
    """Nine blocks that fall, drift to the middle, bounce and collide."""
    fills = []
    for i, (height, fall) in enumerate(zip(_HEIGHTS, _FALLS)):
        row, column = divmod(i, 3)
        drift = [0.5 - 0.5 * row, fall, 0.5 - 0.5 * column]
        fills.append(_block([0.7 + row, height, 0.7 + column], [0.35] * 3, velocity=drift, seed=i + 1))
    return _scene("blocks", 3, [3.4, 2, 3.4], material, fills, friction=0.2)


def _falling_blocks_2d(material: dict[str, Any]) -> Scene:
    fills = [
        _block([2.5 + 4 * i, 2 + 0.5 * (i % 2)], [1.5, 1.5], velocity=[0.5 - 0.25 * i, -0.5], seed=i + 1) for i in range(5)
    ]
    return _scene("blocks", 2, [21, 8], material, fills, friction=0.2)


Maker = Callable[[dict[str, Any]], Scene]

MATERIALS: dict[str, tuple[dict[str, Any], dict[int, Maker]]] = {
    "liquid": ({"kind": "liquid", "bulk_modulus": BULK_MODULUS}, {2: _dam_break_2d, 3: _dam_break_3d}),
    "elastic": ({"kind": "elastic"}, {2: _falling_blocks_2d, 3: _falling_blocks_3d}),
    "sand": ({"kind": "sand"}, {2: _dam_break_2d, 3: _dam_break_3d}),
    "visco": ({"kind": "visco"}, {2: _dam_break_2d, 3: _dam_break_3d}),
}
"""Per kind of matter its parameters, and what it does in each dimension."""

QUICK_MATERIALS = ("liquid", "elastic")
"""Measured unless others are asked for."""

VARIANTS = ("convergent", "paper", "dual", "dual-cells", "primal", "explicit")
"""Solvers with their options."""


def scene_of(material: str, dimension: int) -> Scene:
    """The scene of a kind of matter."""
    parameters, makers = MATERIALS[material]
    return makers[dimension](parameters)


def small_scene(material: str, dimension: int) -> Scene:
    """A block of 4 cells a side that falls."""
    parameters, _ = MATERIALS[material]
    return _scene("small", dimension, [1.0] * dimension, parameters, [_block([0.5] * dimension, [2 * CELL] * dimension)])


def applies(variant: str, material: str) -> bool:
    """Whether a variant differs from the plain solver with this matter: pressures stand in cells only in liquids."""
    return variant != "dual-cells" or material == "liquid"
