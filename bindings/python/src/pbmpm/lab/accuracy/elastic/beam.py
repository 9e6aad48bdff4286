"""Cantilevers: sinking and swinging under their own weight.

A beam is let go horizontally, straight and at rest. One run brakes it so that it sinks to the shape in which it hangs;
another lets it swing about that shape.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...simulation import RunSettings
from . import references, strain
from .signal import Oscillation, Swing, fit_oscillation, measure_swing
from .stage import PARTICLES_PER_AXIS, Calmer, Record, Stage, lattice, run
from .theory import Beam, Solid

GRAVITY = 9.81
REST_PERIODS = 2.5
SWING_PERIODS = 4.0
_SPEED_LIMIT = 10.0  # times the speed of a free fall over the length


@dataclass(frozen=True)
class Cantilever:
    """A beam along the first axis, clamped at 0, its lower face at height 0; 3D: as wide as high."""

    beam: Beam
    cells: int = 8  #: over the height
    gravity: float = GRAVITY
    model: str = strain.FIXED_COROTATED
    particles_per_axis: int = PARTICLES_PER_AXIS

    @property
    def cell_size(self) -> float:
        return self.beam.height / self.cells

    @property
    def frequency(self) -> float:
        """Of small swings [Hz]."""
        return self.beam.thick_angular_frequency() / (2.0 * math.pi)

    @property
    def tip_deflection(self) -> float:
        """How far the tip of the beam's axis hangs below the clamp [m]: the elastica, and what shear adds."""
        elastica = references.elastica_tip(self.beam.self_weight_load(self.gravity)) * self.beam.length
        return elastica + self.beam.shear_deflection(self.gravity)

    def build(self, settings: RunSettings) -> tuple[Stage, np.ndarray, np.ndarray]:
        """The beam before its first step, the identifiers of its particles and where they are."""
        solid, dimension = self.beam.solid, self.beam.solid.dimension
        size = np.array([self.beam.length] + [self.beam.height] * (dimension - 1))
        points = lattice([0.0] * dimension, size, self.cell_size, self.particles_per_axis)
        down = [0.0, -self.gravity, 0.0][:dimension]
        stage = Stage(solid, self.cell_size, settings, len(points), down, self.model)
        ids = stage.add_body(points, float(np.prod(size)))
        stage.clamp(axis=0, face=0.0, side=1)
        return stage, ids, points

    def let_go(self, settings: RunSettings, seconds: float, calm: bool = False) -> Record:
        """Runs for ``seconds``; the observed values are the displacements of the tip, along and up [m].

        The tip is extrapolated from the particles of the last two cells, so its place is that of the end of the axis.
        ``calm`` brakes the beam, so that it comes to rest where it hangs.
        """
        stage, ids, points = self.build(settings)
        with stage:
            last = ids[points[:, 0] > self.beam.length - self.cell_size]
            before = ids[np.abs(points[:, 0] - self.beam.length + 1.5 * self.cell_size) < 0.5 * self.cell_size]
            calmer = Calmer(stage, ids, self.frequency)

            def tip() -> np.ndarray:
                # Their centres are half a cell and one and a half cells before the end.
                return 1.5 * stage.mean_position(last)[:2] - 0.5 * stage.mean_position(before)[:2]

            def observe() -> np.ndarray:
                if calm:
                    calmer.look()
                return tip() - start

            start = tip()
            limit = _SPEED_LIMIT * math.sqrt(2.0 * self.gravity * self.beam.length)
            return run(stage, seconds, observe, limit)

    def hang(self, settings: RunSettings) -> tuple[Record, float | None]:
        """The run, and how far the tip hangs down at rest [m], where the integrator does not matter: backward Euler."""
        settings = replace(settings, integrator="euler")
        record = self.let_go(settings, REST_PERIODS / self.frequency, calm=True)
        return record, -float(record.values[-1, 1]) if record.stable else None

    def swing(self, settings: RunSettings) -> tuple[Record, Oscillation | None]:
        """The run, and the swing of the tip's height."""
        record = self.let_go(settings, SWING_PERIODS / self.frequency)
        if not record.stable:
            return record, None
        return record, fit_oscillation(record.times, record.values[:, 1], self.frequency)


def loaded_beam(load: float, slenderness: float, poisson: float = 0.3, dimension: int = 2) -> Beam:
    """A beam of 1 m whose own weight makes the dimensionless load q L^3 / (E* I).

    With q = rho g h and I = h^3 / 12 the load is 12 rho g L^3 / (E* h^2).
    """
    length, density = 1.0, 1000.0
    height = length / slenderness
    modulus = 12.0 * density * GRAVITY * length**3 / (load * height**2)
    young = modulus * (1.0 - poisson**2) if dimension == 2 else modulus
    return Beam(Solid(young, poisson, density, dimension), length, height)


@dataclass(frozen=True)
class TurekHronBeam:
    """The structural test CSM3 of Turek and Hron (2006): an undamped beam, so all its decay is numerical."""

    cells: int = 6  #: over the height
    seconds: float = 10.0
    particles_per_axis: int = PARTICLES_PER_AXIS

    BEAM = Beam(Solid(young=1.4e6, poisson=0.4, density=1000.0), length=0.35, height=0.02)
    GRAVITY = 2.0

    @property
    def cell_size(self) -> float:
        return self.BEAM.height / self.cells

    @property
    def truth(self) -> tuple[Swing, Swing]:
        """Steady swing of the tip along and up."""
        across, up = map(references.turek_hron_steady, references.turek_hron_beam())
        return measure_swing(across.times, across.values), measure_swing(up.times, up.values)

    def swing(self, settings: RunSettings) -> tuple[Record, Swing | None, Swing | None]:
        """The run, and the tip's swing along and up over its second half."""
        beam = Cantilever(self.BEAM, self.cells, self.GRAVITY, particles_per_axis=self.particles_per_axis)
        record = beam.let_go(settings, self.seconds)
        if not record.stable:
            return record, None, None
        late = record.times >= 0.5 * self.seconds
        along, up = (measure_swing(record.times[late], record.values[late, axis]) for axis in (0, 1))
        return record, along, up
