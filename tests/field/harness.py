"""What all rooms of the field tests share: cases with variants, one run of a case, and tanks that may stand anywhere.

Every check names where its band comes from. Lengths are forgiven half a particle spacing (a quarter of a cell) for the
mean height of matter and one spacing (half a cell) for a surface; that is what the particles can tell. A speed of matter
at rest is 0; 10 mm/s is a fifth of a cell per second at the cells used here, which no eye sees.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pbmpm import Box, Friction, Plane, Solver, World

G = 9.81
MEAN, SURFACE = 0.25, 0.5
"""What lengths are forgiven [cells]: see above."""


@dataclass(frozen=True)
class Variant:
    """A case with its parameters."""

    room: str
    case: str
    label: str
    function: Callable[..., None]
    parameters: dict[str, Any]

    @property
    def name(self) -> str:
        """How the runner and pytest call it."""
        return f"{self.case}[{self.label}]"


VARIANTS: list[Variant] = []
"""All of all rooms that have been imported, in their order."""


def case(**variants: dict[str, Any]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Registers a case: a label and keyword arguments per variant."""

    def register(function: Callable[..., None]) -> Callable[..., None]:
        room = function.__module__
        VARIANTS.extend(Variant(room, function.__name__, label, function, more) for label, more in variants.items())
        return function

    return register


@dataclass
class Run:
    """One variant at one setting: it makes worlds, steps them, keeps the clock and collects checks."""

    variant: Variant
    rate: float
    iterations: int
    solver: str
    rows: list[dict[str, Any]] = field(default_factory=list)
    cpu: float = 0.0
    simulated: float = 0.0

    @property
    def dt(self) -> float:
        """[s]"""
        return 1.0 / self.rate

    def go(self) -> Run:
        """Runs it; what cannot be run has failed."""
        try:
            self.variant.function(self, **self.variant.parameters)
        except Exception as error:
            self.check(f"could not be run: {error!r}", math.nan, 0, 0, why="it has to run")
        return self

    def world(self, dimension: int, cell: float, gravity: Any = None, **more: Any) -> World:
        """A world with gravity down the second axis, unless said otherwise."""
        down = gravity if gravity is not None else [0.0, -G] + [0.0] * (dimension - 2)
        own = {"solver": Solver[self.solver.upper()], "iterations": self.iterations, "threads": 1, "capacity": 60_000}
        return World(dimension, cell, gravity=down, **{**own, **more})

    def steps(self, world: World, seconds: float, before: Callable[[float], None] | None = None, after: Callable[[float], None] | None = None) -> None:
        """Steps; ``before`` is told the time at the end of the step that comes, ``after`` that of the step that was."""
        for k in range(round(seconds * self.rate)):
            end = (k + 1) * self.dt
            if before:
                before(end)
            begin = time.process_time()
            world.step(self.dt)
            self.cpu += time.process_time() - begin
            self.simulated += self.dt
            if after:
                after(end)

    def check(self, what: str, value: float, low: float, high: float, unit: str = "", *, why: str) -> None:
        """Notes a figure and whether it lies in its band; ``why`` names what the band comes from."""
        passed = bool(np.isfinite(value) and low <= value <= high)
        names = {"room": self.variant.room, "case": self.variant.case, "variant": self.variant.label}
        setting = {"setting": f"{self.rate:g}x{self.iterations}", "solver": self.solver}
        result = {"what": what, "value": float(value), "low": low, "high": high, "unit": unit, "why": why, "passed": passed}
        self.rows.append({**names, **setting, **result})

    def near(self, what: str, value: float, true: float, cells: float, cell: float, *, why: str) -> None:
        """A length that has to be within so many cells of the true one; the figure is the error in cells."""
        self.check(f"{what}, off by", (value - true) / cell, -cells, cells, "cells", why=why)


class Frame:
    """A place that things are built in: turned by an angle [degrees] about the third axis and shifted [m].

    Gravity points down in the frame, so what is true in it does not depend on the angle.
    """

    def __init__(self, dimension: int = 2, angle: float = 0.0, shift: Any = 0.0) -> None:
        self.dimension, self.angle = dimension, math.radians(angle)
        self.shift = np.zeros(dimension) + np.asarray(shift, float)
        c, s = math.cos(self.angle), math.sin(self.angle)
        self.turn = np.eye(dimension)
        self.turn[:2, :2] = [[c, -s], [s, c]]
        self.up = self.turn[:, 1]
        self.gravity = (-G * self.up).tolist()
        half = self.angle / 2
        self.rotation: Any = self.angle if dimension == 2 else (0.0, 0.0, math.sin(half), math.cos(half))

    def out(self, points: Any) -> np.ndarray:
        """From the frame to the world."""
        return np.asarray(points, float) @ self.turn.T + self.shift

    def local(self, points: Any) -> np.ndarray:
        """From the world to the frame."""
        return (np.asarray(points, float) - self.shift) @ self.turn

    def box(self, low: Any, high: Any) -> Box:
        """A box between two corners of the frame."""
        low, high = np.asarray(low, float), np.asarray(high, float)
        return Box(self.out((low + high) / 2).tolist(), ((high - low) / 2).tolist(), rotation=self.rotation)

    def plane(self, point: Any, normal: Any) -> Plane:
        """A plane of the frame."""
        return Plane(self.out(point).tolist(), (self.turn @ np.asarray(normal, float)).tolist())

    def levels(self, world: World, points: Any) -> np.ndarray:
        """Height of the surface in the frame, over points of the frame (their second coordinates do not matter)."""
        return world.query_heights(self.out(points), direction=self.up) - self.up @ self.shift

    def positions(self, world: World) -> np.ndarray:
        """Particles in the frame."""
        return self.local(world.positions.array())


def tank(world: World, frame: Frame, width: float, high: float, kind: str, thick: float = 0.5, floor: bool = True, **collider: Any) -> list[Any]:
    """Walls at 0 and ``width`` along the first axis (in 3D along the third, too) and a floor at 0: planes, or boxes that overlap at the corners."""
    d, made = frame.dimension, []
    more = {"friction": Friction.SLIP, **collider}
    sides = [0] if d == 2 else [0, 2]
    for axis in sides:
        for end in (0.0, width):
            if kind == "planes":
                point, normal = np.zeros(d), np.zeros(d)
                point[axis], normal[axis] = end, 1.0 if end == 0.0 else -1.0
                made.append(world.add_collider(frame.plane(point, normal), **more))
            else:
                low, top = np.full(d, -thick), np.full(d, width + thick)
                top[1] = high
                low[axis], top[axis] = (end - thick, end) if end == 0.0 else (end, end + thick)
                made.append(world.add_collider(frame.box(low, top), **more))
    if floor and kind == "planes":
        made.append(world.add_collider(frame.plane(np.zeros(d), np.eye(d)[1]), **more))
    elif floor:
        low, top = np.full(d, -thick), np.full(d, width + thick)
        top[1] = 0.0
        made.append(world.add_collider(frame.box(low, top), **more))
    return made


def pool(world: World, frame: Frame, low: Any, high: Any, parameters: Any, **fill: Any) -> Any:
    """Fills a box of the frame and returns its material."""
    material = world.add_material(parameters)
    world.fill(frame.box(low, high), material, **fill)
    return material


def lattice(low: Any, high: Any, spacing: float) -> np.ndarray:
    """The centres of a lattice between two corners, shape (n, d)."""
    axes = [np.arange(a + spacing / 2, b, spacing) for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(axes))


def rms(world: World, rows: Any = None, drift: Any = 0.0) -> float:
    """Root mean square of the particles' speeds (all of one mass) against a drift."""
    v = world.velocities.array() - np.asarray(drift)
    v = v if rows is None else v[rows]
    return math.sqrt((v**2).sum(1).mean())


def rows_of(world: World, material: Any) -> np.ndarray:
    """Mask of the particles of a material."""
    return (world.material_indices.array() == material.index).ravel()


def settings(text: str) -> list[tuple[float, int]]:
    """From "60x5,240x5" to rates and iterations."""
    return [(float(rate), int(count)) for rate, count in (part.split("x") for part in text.split(","))]
