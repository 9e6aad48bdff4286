"""A hand: a grab holds what lies in its shape, whatever hangs from it, and its impulse is what it bears."""

from __future__ import annotations

import numpy as np
import pytest

import pbmpm
from pbmpm import ForceKind

G = 9.81
DT = 1 / 60
MATERIALS = {
    "jelly": pbmpm.Elastic(young_modulus=5e4),
    "rubber": pbmpm.Elastic(young_modulus=1e6),
    "clay": pbmpm.Visco(density=1500),
}


class Held:
    """A block of one material in the air or on the floor, and a ball that grabs it at its middle."""

    def __init__(self, dimension: int, material: str, height: float, share: float = 0.22) -> None:
        """`share`: of the block's volume that the ball has."""
        self.cell = 0.025 if dimension == 2 else 0.05
        gravity, high = (0.0, -G, 0.0)[:dimension], (1.6, 2.0, 1.6)[:dimension]
        self.world = pbmpm.World(dimension, self.cell, gravity=gravity, domain=((0,) * dimension, high), domain_friction=0.5)
        matter = self.world.add_material(MATERIALS[material])
        self.middle, half = np.array((0.8, height, 0.8)[:dimension]), 6 * self.cell
        self.world.fill(pbmpm.Box(tuple(self.middle), (half,) * dimension), matter)
        volume = share * (2 * half) ** dimension
        self.radius = np.sqrt(volume / np.pi) if dimension == 2 else np.cbrt(0.75 * volume / np.pi)
        self.weight = float(self.world.masses[...].sum()) * G
        self.hands: list[pbmpm.Force] = []

    def grab(self) -> None:
        """One hand more."""
        shape = pbmpm.Sphere(tuple(self.middle), float(self.radius))
        self.hands.append(self.world.add_force(ForceKind.GRAB, shape=shape, velocity=(0.0,) * self.world.dimension))

    def move(self, velocity: np.ndarray, steps: int) -> None:
        """The hands go on at a velocity, in steps of 1/60 s."""
        for _ in range(steps):
            for hand in self.hands:
                hand.change(shape=pbmpm.Sphere(tuple(self.middle), float(self.radius)), velocity=tuple(velocity))
            self.world.step(DT)
            self.middle = self.middle + velocity * DT

    def centre(self) -> np.ndarray:
        """Of mass."""
        return np.asarray(self.world.positions[...].astype(float).mean(axis=0))


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_hand_holds_a_body_by_its_middle(dimension: int, material: str) -> None:
    """It sinks by less than the cell that the hand's edge is known to, and the hand bears its weight."""
    held = Held(dimension, material, 1.0)
    held.grab()
    held.move(np.zeros(dimension), 60)
    assert abs(held.centre()[1] - held.middle[1]) < held.cell
    assert np.array(held.hands[0].impulse)[1] / DT == pytest.approx(held.weight, rel=0.01)  # what still swings
    held.world.close()


def test_hands_at_one_place_bear_alike() -> None:
    """What two hold goes to each by half."""
    held = Held(2, "jelly", 1.0)
    held.grab()
    held.grab()
    held.move(np.zeros(2), 60)
    for hand in held.hands:
        assert np.array(hand.impulse)[1] / DT == pytest.approx(0.5 * held.weight, rel=0.01)
    held.world.close()


def test_hands_that_disagree_share_what_they_give() -> None:
    """Nodes that both hold go with the mean of their winds. What they pull against each other would be infinite; told is what matter gets."""
    held = Held(2, "jelly", 1.0)
    held.grab()
    held.grab()
    held.hands[0].velocity, held.hands[1].velocity = (0.1, 0.0), (-0.1, 0.0)
    for _ in range(30):
        held.world.step(DT)
    impulses = np.array([hand.impulse for hand in held.hands]) / DT
    assert impulses[:, 1] == pytest.approx(0.5 * held.weight, rel=0.02)
    assert np.abs(impulses[:, 0]).max() < 0.1 * held.weight
    held.world.close()


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_hand_lifts_a_body_and_lets_it_fall(dimension: int) -> None:
    """It leaves the floor with the hand. Let go, its middle is on the parabola of a body that rested: n(n+1)/2 g dt^2."""
    held = Held(dimension, "rubber", 6 * (0.025 if dimension == 2 else 0.05))
    held.move(np.zeros(dimension), 30)
    held.grab()
    up = np.zeros(dimension)
    up[1] = 0.5
    low = held.centre()[1]
    held.move(up, 60)
    held.move(0 * up, 60)
    assert held.centre()[1] - low == pytest.approx(0.5, abs=held.cell)
    held.hands[0].enabled = False
    high = held.centre()[1]
    for _ in range(12):
        held.world.step(DT)
    assert high - held.centre()[1] == pytest.approx(12 * 13 / 2 * G * DT**2, rel=0.01)
    held.world.close()


def test_no_hand_pushes_matter_through_a_floor() -> None:
    """Within a cell of an obstacle the obstacle comes first."""
    held = Held(2, "jelly", 0.15)
    held.move(np.zeros(2), 30)
    held.grab()
    count = held.world.stats.particle_count
    held.move(np.array([0.0, -0.5]), 24)
    assert held.world.stats.particle_count == count
    assert held.world.positions[...][:, 1].min() >= 0.0
    held.world.close()
