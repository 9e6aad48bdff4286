"""Effects that no scene has: what the host asks of a world besides its steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import pbmpm

from ..state import State

POINTS = 64
"""Where the fields are asked for."""

Advance = Callable[[float], None]
"""A step of so many seconds, with all that the host does about it."""


@dataclass(frozen=True)
class HostEffect:
    """Something that a host may do in each step. `prepare` makes the step that does it."""

    name: str
    description: str
    typical: str
    prepare: Callable[[pbmpm.World, State], Advance]
    host_bytes: Callable[[pbmpm.World], int] = lambda _: 0
    """Memory of the host's own that it takes."""


def _statistics(world: pbmpm.World, _: State) -> Advance:
    def advance(dt: float) -> None:
        world.step(dt)
        _ = world.stats, world.events

    return advance


def _queries(world: pbmpm.World, state: State) -> Advance:
    low, high = state.positions.min(axis=0), state.positions.max(axis=0)
    middle, half = 0.5 * (low + high), np.maximum(0.25 * (high - low), 1e-6)
    region = pbmpm.Box(middle.tolist(), half.tolist())
    shares = np.linspace(0.0, 1.0, POINTS)[:, None]
    points = low + shares * (high - low)

    def advance(dt: float) -> None:
        world.step(dt)
        world.query_region(region)
        world.query_points(points)

    return advance


def _snapshots(world: pbmpm.World, _: State) -> Advance:
    buffer = bytearray(2 * world.snapshot_bytes)

    def advance(dt: float) -> None:
        world.step(dt)
        world.snapshot_into(buffer)

    return advance


def _background(world: pbmpm.World, _: State) -> Advance:
    def advance(dt: float) -> None:
        world.step_begin(dt)
        world.step_end()

    return advance


HOST_EFFECTS = (
    HostEffect("statistics", "figures and events of the step", "read after each step", _statistics),
    HostEffect("queries", "asking where matter is", f"a region and {POINTS} points after each step", _queries),
    HostEffect(
        "snapshots",
        "saving the state",
        "one after each step; its bytes are the host's",
        _snapshots,
        lambda world: world.snapshot_bytes,
    ),
    HostEffect("background_step", "steps while the host does something else", "each step", _background),
)
"""In the order of reports."""
