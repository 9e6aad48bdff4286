"""A light elastic block that falls into a pool and floats: liquid and elastic matter in one solver.

Archimedes: at rest the block displaces its own weight of liquid. Its mean density is half the liquid's, so half of it
is under water; it is twice as wide as high, which floats upright.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import pbmpm

from ...meter import stepping_clock
from ...simulation import RunSettings
from .stage import failures, lattice

GRAVITY = 9.81
_SPEED_LIMIT = 15.0  # [m/s]; the fall ends at less than 3 m/s


@dataclass(frozen=True)
class Floated:
    """What a run gave; lengths in metres."""

    depth: float | None  #: of the block's lower face below the water, mean over the last second; None when it failed
    truth: float  #: Archimedes' depth for the volume that the block has
    water_height: float | None  #: mean over the last second, of the water beside the block
    water_truth: float
    strain: float | None  #: largest deviation of a principal stretch of the block from 1, median over its particles
    effective_young: float  #: what the solver says it can hold [Pa]
    ms_per_simulated_second: float
    predicted_error: float
    reasons: list[str]

    @property
    def error(self) -> float | None:
        """Of the depth, over the height of the block's part under water."""
        return None if self.depth is None else abs(self.depth - self.truth) / self.truth


@dataclass(frozen=True)
class FloatingBlock:
    """A closed tank with a pool, and a block let go just above it."""

    cell_size: float = 1.0 / 32.0
    tank_cells: tuple[int, int] = (40, 40)
    pool_cells: int = 16
    block_cells: tuple[int, int] = (12, 6)
    young: float = 2.5e6  #: of the block [Pa]
    poisson: float = 0.25
    density: float = 500.0
    seconds: float = 4.0

    @classmethod
    def at_resolution(cls, cells_per_metre: int) -> FloatingBlock:
        """The same tank and block on other cells; a multiple of 16 per metre, so that all edges are edges of cells."""
        scale = cells_per_metre / 32.0

        def sized(count: int) -> int:
            return round(scale * count)

        return cls(
            1.0 / cells_per_metre,
            (sized(cls.tank_cells[0]), sized(cls.tank_cells[1])),
            sized(cls.pool_cells),
            (sized(cls.block_cells[0]), sized(cls.block_cells[1])),
        )

    def float_up(self, settings: RunSettings) -> Floated:
        """Lets the block fall and waits until it rests."""
        dx, dt, clock = self.cell_size, settings.dt, stepping_clock(settings.threads)
        water = lattice([0.0, 0.0], [self.tank_cells[0] * dx, self.pool_cells * dx], dx)
        left = 0.5 * (self.tank_cells[0] - self.block_cells[0])
        corner = np.array([left, self.pool_cells + 1.0]) * dx
        block = lattice(corner, corner + np.array(self.block_cells) * dx, dx)
        domain = ([0.0, 0.0], [self.tank_cells[0] * dx, self.tank_cells[1] * dx])
        capacity, gravity = len(water) + len(block), [0.0, -GRAVITY]
        with pbmpm.World(2, dx, capacity=capacity, gravity=gravity, domain=domain, **settings.for_world()) as world:
            liquid = world.add_material(pbmpm.Liquid())
            elastic = world.add_material(
                pbmpm.Elastic(density=self.density, young_modulus=self.young, poisson_ratio=self.poisson)
            )
            wet, dry = world.add_particles(liquid, water), world.add_particles(elastic, block)
            young = elastic.effective(dt / settings.substeps).young_modulus
            steps = max(1, round(self.seconds / dt))
            spent, predicted, samples, reasons, done = 0.0, 0.0, [], [], 0
            for done in range(1, steps + 1):
                begin = clock()
                world.step(dt)
                spent += clock() - begin
                stats = world.stats
                predicted += stats.predicted_error
                reasons = failures(stats, _SPEED_LIMIT)
                if reasons:
                    break
                if done * dt > self.seconds - 1.0:
                    samples.append(self._look(world, wet, dry))
        depth, height, deviation = np.mean(samples, axis=0) if samples and not reasons else (None, None, None)
        truth = self.density / 1000.0 * self.block_cells[1] * dx
        under = truth * self.block_cells[0] / self.tank_cells[0]
        cost = 1e3 * spent / (done * dt)
        return Floated(
            depth, truth, height, self.pool_cells * dx + under, deviation, young, cost, predicted / done, reasons
        )

    def _look(self, world: pbmpm.World, wet: np.ndarray, dry: np.ndarray) -> tuple[float, float, float]:
        """Depth of the block and height of the water [m], and the block's strain."""
        places = world.positions.array()
        block, water = places[world.find(dry)], places[world.find(wet)]
        reach = np.abs(water[:, 0] - block[:, 0].mean()) > (0.5 * self.block_cells[0] + 3.0) * self.cell_size
        # A resting column is twice as high as the mean of its particles' heights.
        height = 2.0 * float(water[reach, 1].mean())
        bottom = float(block[:, 1].mean()) - 0.5 * self.block_cells[1] * self.cell_size
        stretches = np.linalg.svd(world.deformations.array()[world.find(dry)], compute_uv=False)
        return height - bottom, height, float(np.median(np.abs(stretches - 1.0).max(axis=1)))
