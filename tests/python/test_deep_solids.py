"""Deep heaps of solids at 60 Hz x 5, as a game would run them: they bear their own weight and what falls on them.

At these settings sound would have to cross 3.6 cells per substep, and the pressure 48 of them. A dual solver that asks a solid for no more than 5 iterations
hold lets it fall in a row of cells, where F comes back to 1 and the positions do not.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pbmpm.lab.parsing import parse_scene
from pbmpm.lab.simulation import RunSettings, Simulation

CELL = 0.05  # [m]
SOLIDS: dict[str, dict[str, Any]] = {
    "elastic": {"kind": "elastic"},
    "visco": {"kind": "visco", "yield_strain": 0.17, "flow_rate": 1e9},
    "sand": {"kind": "sand"},
}
"""With the default modulus of 1e5 Pa."""


def simulation(kind: str, solver: str, cells: tuple[int, ...], **parts: Any) -> Simulation:
    """A tank of so many cells, 3 m high, at 60 Hz x 5; ``parts`` fill it."""
    d = len(cells)
    half = [0.5 * CELL * count for count in cells]
    low, high = [-size for size in half], list(half)
    low[1], high[1] = 0.0, 3.0
    data = {
        "format": "pbmpm-scene",
        "version": 1,
        "name": "deep",
        "dimension": d,
        "cell_size": CELL,
        "gravity": [0.0, -9.81, 0.0][:d],
        "domain": {"min": low, "max": high, "friction": 0.3},
        "seconds": 4.0,
        "rate_hz": 60.0,
        "iterations": 5,
        "materials": {"matter": SOLIDS[kind]},
        **parts,
    }
    scene = parse_scene(data, "deep")
    return Simulation(scene, RunSettings.of(scene, threads=1, solver=solver))


def column(kind: str, solver: str, cells: tuple[int, ...]) -> Simulation:
    """The tank with a column as wide as itself."""
    half = [0.5 * CELL * count for count in cells]
    position = [half[1] if axis == 1 else 0.0 for axis in range(len(cells))]
    shape = {"kind": "box", "position": position, "half_extents": half}
    return simulation(kind, solver, cells, fills=[{"shape": shape, "material": "matter", "particles_per_axis": 2}])


def fillings(at: Simulation) -> np.ndarray[Any, Any]:
    """Rest volume in each cell that holds particles, over the cell's."""
    places, masses = np.array(at.world.positions), np.array(at.world.masses)
    _, cell = np.unique(np.floor(places / CELL).astype(int), axis=0, return_inverse=True)
    return np.asarray(np.bincount(cell.ravel(), weights=masses / 1000.0) / CELL ** places.shape[1])


HEIGHTS = [
    ("dual", "elastic", (24, 48), 0.45),
    ("dual", "visco", (24, 48), 0.45),
    ("dual", "sand", (24, 48), 0.45),
    ("dual", "visco", (4, 36, 4), 0.45),
    ("primal", "elastic", (24, 48), 0.85),
    ("convergent", "visco", (24, 48), 0.85),
]


@pytest.mark.parametrize(("solver", "kind", "cells", "least"), HEIGHTS)
def test_a_deep_column_stands(solver: str, kind: str, cells: tuple[int, ...], least: float) -> None:
    """A converged solution stands at 0.90 of the height, a bar under its own weight at 0.91; the primal solver at 0.90 to 0.91, the dual at 0.54 to
    0.60. Asked for what 5 iterations hold and no more, the dual lets all of it lie in the lowest cells: 0.00 to 0.04, with a mean J of 1."""
    with column(kind, solver, cells) as at:
        for _ in range(180):
            at.step()
        top = np.percentile(np.array(at.world.positions)[:, 1], 99) / (cells[1] * CELL)
        ratio = float(np.mean(at.world.volume_ratios))
        assert least < top < 1.0
        assert ratio == pytest.approx(top, rel=0.1)  # volumes and places tell the same


@pytest.mark.parametrize(("solver", "most"), [("dual", 6.0), ("convergent", 4.0)])
def test_what_is_poured_heaps_up(solver: str, most: float) -> None:
    """The fullest cell holds 3.2 and 2.2 times its volume; 58 where the dual asks for no more than 5 iterations hold."""
    jet = {"kind": "box", "position": [0.0, 2.5], "half_extents": [3 * CELL, 2 * CELL]}
    emitter = {"shape": jet, "material": "matter", "rate": 0.6, "speed": 2.0, "particles_per_axis": 2}
    with simulation("visco", solver, (24, 1), emitters=[emitter]) as at:
        for _ in range(180):
            at.step()
        assert len(at.world) > 2500
        assert fillings(at).max() < most
