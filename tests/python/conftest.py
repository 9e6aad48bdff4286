"""Shared by all Python tests. The package under test is the installed one, with the built library inside."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import pbmpm

ROOT = Path(__file__).resolve().parents[2]

# The generator is a build tool and not part of the installed package.
sys.path.insert(0, str(ROOT / "bindings"))


@pytest.fixture(scope="session")
def root() -> Path:
    """The top folder of the source tree."""
    return ROOT


@pytest.fixture(params=[2, 3], ids=["2D", "3D"])
def dimension(request: pytest.FixtureRequest) -> int:
    return request.param


@pytest.fixture
def world(dimension: int) -> Iterator[pbmpm.World]:
    """An empty closed box of 2 m, once per dimension; gravity acts along the second axis."""
    gravity = (0.0, -10.0, 0.0)[:dimension]
    domain = ([0.0] * dimension, [2.0] * dimension)
    with pbmpm.World(dimension, 0.1, capacity=5000, gravity=gravity, domain=domain, threads=1) as made:
        yield made


@pytest.fixture
def water(world: pbmpm.World) -> pbmpm.Material:
    return world.add_material(pbmpm.Liquid())


@pytest.fixture
def pool(world: pbmpm.World, water: pbmpm.Material) -> pbmpm.World:
    """The world with a block of water in its middle."""
    world.fill(pbmpm.Box([1.0] * world.dimension, [0.2] * world.dimension), water)
    return world
