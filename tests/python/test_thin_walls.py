"""Walls thinner than a cell: what is beyond them is bound to the faces that it sees, and what runs along one wall of a corner does not pass the other."""

from __future__ import annotations

import math

import numpy as np
import pytest

import pbmpm

CELL, WIDTH, HIGH = 0.05, 1.6, 1.0


def turned(angle: float) -> np.ndarray:
    """Columns: the axes of a frame that is turned by so many degrees."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.array([[c, -s], [s, c]])


def glass(world: pbmpm.World, axes: np.ndarray, shift: float, thick: float) -> None:
    """A floor and two walls of boxes whose corners overlap."""
    rotation = math.atan2(axes[1, 0], axes[0, 0])
    for low, top in (
        ((-thick, -thick), (0, HIGH)),
        ((WIDTH, -thick), (WIDTH + thick, HIGH)),
        ((-thick, -thick), (WIDTH + thick, 0)),
    ):
        middle, half = np.add(low, top) / 2, np.subtract(top, low) / 2
        world.add_collider(pbmpm.Box((axes @ middle + shift).tolist(), half.tolist(), rotation=rotation), friction=pbmpm.Friction.SLIP)


@pytest.mark.parametrize(("cells", "shift", "angle"), [(0.05, 0.8, 45), (0.05, 0.3, 30), (0.2, 0.3, 30), (0.1, 0.0, 0)])
def test_nothing_leaves_a_glass_with_thin_walls(cells: float, shift: float, angle: float) -> None:
    axes, depth = turned(angle), 0.6
    with pbmpm.World(2, CELL, gravity=(-9.81 * axes[:, 1]).tolist()) as world:
        glass(world, axes, shift * CELL, cells * CELL)
        side = np.arange(CELL / 4, WIDTH, CELL / 2)
        places = np.array([(x, y) for x in side for y in side if y < depth])
        world.add_particles(world.add_material(pbmpm.Liquid()), places @ axes.T + shift * CELL)
        for _ in range(180):
            world.step(1 / 60)
        inside = (world.positions.array() - shift * CELL) @ axes
        assert inside[:, 1].min() > -cells * CELL / 2
        assert inside[:, 0].min() > -cells * CELL / 2 and inside[:, 0].max() < WIDTH + cells * CELL / 2
        assert abs(2 * inside[:, 1].mean() - depth) < 0.5 * CELL


def passed(before: np.ndarray, after: np.ndarray, thick: float) -> np.ndarray:
    """Which places were in the glass, below its rim, and are beyond a wall now."""

    def out(places: np.ndarray) -> np.ndarray:
        return (places[:, 0] < -thick / 2) | (places[:, 1] < -thick / 2) | (places[:, 0] > WIDTH + thick / 2)

    return ~out(before) & out(after) & (before[:, 1] < HIGH - CELL)


@pytest.mark.parametrize(("cells", "shift", "angle"), [(0.05, 0.3, 30), (0.1, 0.8, 30), (0.05, 0.8, 45), (0.2, 0.0, 0)])
def test_water_that_is_thrown_into_a_corner_does_not_pass_it(cells: float, shift: float, angle: float) -> None:
    axes, thick = turned(angle), cells * CELL
    with pbmpm.World(2, CELL, gravity=(-9.81 * axes[:, 1]).tolist()) as world:
        glass(world, axes, shift * CELL, thick)
        side = np.arange(CELL / 4, 0.8, CELL / 2)
        places = np.array([(x + 0.02, y + 0.3) for x in side for y in side if y < 0.4])
        speeds = np.tile(axes @ (-3.0, -6.0), (len(places), 1)).astype(np.float32)
        world.add_particles(world.add_material(pbmpm.Liquid()), places @ axes.T + shift * CELL, speeds)
        before = None
        for _ in range(180):
            world.step(1 / 60)
            order = np.lexsort(world.ids.array().T)
            inside = ((world.positions.array() - shift * CELL) @ axes)[order]
            assert before is None or not passed(before, inside, thick).any()
            before = inside
