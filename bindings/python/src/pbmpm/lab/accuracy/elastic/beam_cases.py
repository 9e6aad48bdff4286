"""Bars and beams as the accuracy command lists them."""

from __future__ import annotations

import math
from dataclasses import replace


import pbmpm

from ...simulation import RunSettings
from ..case import ErrorMeasure, Measurement, Setting
from .bar import CLASSIC_BAR, STIFF_BAR, Bar
from .beam import Cantilever, TurekHronBeam, loaded_beam
from .case import ElasticCase, integrator_of, relative
from .prediction import ERROR_KINDS, EXACT_ITERATIONS, ROUNDING, Bodies, compare
from .signal import Swing
from .theory import Solid, discrete_frequency


class AxialBar(ElasticCase):
    """Axial vibration of a bar that is fixed at one end."""

    name = "axial-bar"
    title = "Axial vibration of a bar"
    length_name = "bar"
    cells = (64, 32, 16)
    finer = {640: 4.0}
    bar: Bar = STIFF_BAR
    error_kinds = (
        ErrorMeasure("frequency", "discretisation", "%", "frequency against that of the exact motion", 0.02),
        ErrorMeasure(
            "of_theory",
            "discretisation",
            "%",
            "frequency against what the integrator makes of the exact motion: without the time step's error",
            0.015,
        ),
    )

    def __init__(self) -> None:
        solid = self.bar.solid
        self.length = self.bar.length
        self.truth = (
            f"omega = pi / (2 L) sqrt(E / rho) with E = {solid.young:g} Pa, rho = {solid.density:g} kg/m^3,"
            f" L = {self.length:g} m: {self.bar.frequency:.4g} Hz"
        )

    @property
    def solid(self) -> Solid:
        return self.bar.solid

    def measure(self, setting: Setting) -> Measurement:
        bar = replace(self.bar, cells=setting.cells)
        record, found = bar.swing(setting.run_settings())
        frequency = None if found is None else found.frequency
        theory = discrete_frequency(integrator_of(setting), bar.frequency, setting.dt / setting.substeps)
        errors = {"frequency": relative(frequency, bar.frequency), "of_theory": relative(frequency, theory)}
        return record.measurement(
            errors,
            None if frequency is None else (frequency / bar.frequency,),
            frequency_hz=frequency,
            theory_hz=theory,
            decay_per_s=None if found is None else found.decay,
        )


class ClassicAxialBar(AxialBar):
    """The same for the soft bar of the literature."""

    name = "axial-bar-soft"
    title = "Axial vibration of the soft bar of the literature"
    cells = (50, 25)
    finer = {640: 6.0}
    bar = CLASSIC_BAR
    rates = (2.0, 10.0)
    slowest_hz = 1.0
    quick_rates = (5.0,)
    grid_setting = ("primal-bdf2", 10.0, 20)


class AxialBar3DCase(AxialBar):
    """The stiff bar in 3D, a few settings."""

    name = "axial-bar-3d"
    title = "Axial vibration of a bar in 3D"
    dimension = 3
    cells = (32,)
    finer = {}
    bar = replace(STIFF_BAR, solid=replace(STIFF_BAR.solid, dimension=3))
    rates = (60.0, 240.0)
    iterations = (5, 20)


class CantileverCase(ElasticCase):
    """A beam under its own weight: where it hangs and how fast it swings."""

    name = "cantilever"
    title = "Cantilever under its own weight"
    length_name = "height of the beam"
    cells = (12, 8, 4)
    finer = {16: 2.0}
    load, slenderness = 0.4285, 4.0
    error_kinds = (
        ErrorMeasure(
            "tip", "discretisation", "%", "deflection of the tip at rest against the elastica and shear", 0.05
        ),
        ErrorMeasure("frequency", "discretisation", "%", "frequency of the swing against that of small swings"),
        ErrorMeasure(
            "of_theory", "discretisation", "%", "frequency against what the integrator makes of that of small swings"
        ),
        ErrorMeasure(
            "middle", "discretisation", "%", "middle of the swing against the elastica and shear: creep by swinging"
        ),
    )
    notes = (
        "One run brakes the beam and gives the tip at rest; another swings"
        " freely for 4 periods and gives the middle of the swing and its frequency, by a fitted oscillation."
        " The cost is that of the"
        " second. Swinging beams creep: they come to hang lower than those at rest."
    )

    def __init__(self) -> None:
        self.cantilever = Cantilever(loaded_beam(self.load, self.slenderness, dimension=self.dimension))
        beam = self.cantilever.beam
        self.length = beam.height
        self.truth = (
            f"elastica under its own weight, q L^3 / (E* I) = {self.load:g}, with shear:"
            f" {self.cantilever.tip_deflection:.4f} m; L = {beam.length:g} m, h = {beam.height:g} m,"
            f" E = {beam.solid.young:.4g} Pa, nu = {beam.solid.poisson:g}; {self.cantilever.frequency:.4g} Hz"
        )

    @property
    def solid(self) -> Solid:
        return self.cantilever.beam.solid

    def measure(self, setting: Setting) -> Measurement:
        cantilever = replace(self.cantilever, cells=setting.cells)
        resting, tip = cantilever.hang(setting.run_settings())
        record, found = cantilever.swing(setting.run_settings())
        frequency, middle = (None, None) if found is None else (found.frequency, -found.offset)
        theory = discrete_frequency(integrator_of(setting), cantilever.frequency, setting.dt / setting.substeps)
        errors = {
            "tip": relative(tip, cantilever.tip_deflection),
            "frequency": relative(frequency, cantilever.frequency),
            "of_theory": relative(frequency, theory),
            "middle": relative(middle, cantilever.tip_deflection),
        }
        record.reasons = list(dict.fromkeys(resting.reasons + record.reasons))
        return record.measurement(
            errors, self._observed(tip), tip_m=tip, middle_m=middle, frequency_hz=frequency, theory_hz=theory
        )

    def converged(self, setting: Setting) -> Setting | None:
        """One for both integrators: how the beam hangs at rest is always measured with backward Euler."""
        target = super().converged(setting)
        return None if target is None else replace(target, integrator="euler")

    def solve(self, setting: Setting) -> Measurement:
        """The tip at rest alone."""
        resting, tip = replace(self.cantilever, cells=setting.cells).hang(setting.run_settings())
        return resting.measurement({"tip": relative(tip, self.cantilever.tip_deflection)}, self._observed(tip), tip_m=tip)

    def _observed(self, tip: float | None) -> tuple[float, ...] | None:
        return None if tip is None else (tip / self.cantilever.tip_deflection,)


class LargeCantileverCase(CantileverCase):
    """A more slender beam that bends far."""

    name = "cantilever-large"
    title = "Slender cantilever, large deflection"
    finer = {}
    load, slenderness = 1.0, 8.0
    patience = 3.0


class Cantilever3DCase(CantileverCase):
    """The thick beam in 3D, as wide as high; few settings, for the price."""

    name = "cantilever-3d"
    title = "Cantilever under its own weight in 3D"
    dimension = 3
    cells = (6,)
    finer = {8: 2.0}
    rates = (30.0,)
    quick_rates = (60.0,)
    iterations = (5, 20)
    quick_iterations = (20,)
    patience = 3.0

    def explicit_rates(self, quick: bool) -> list[float]:
        return [] if quick else super().explicit_rates(False)


class PredictionCase(CantileverCase):
    """Whether the predicted error of a step is its true one."""

    name = "predicted-error-cantilever"
    searched = False
    title = "Predicted and true error of the steps of a cantilever"
    kind = "elastic"
    cells = (8,)
    rates = (60.0, 120.0, 240.0)
    iterations = (2, 5, 10, 20)
    variants = ("dual", "primal")
    steps = 60
    error_kinds = ERROR_KINDS
    notes = f"Steps whose true and predicted error are below {ROUNDING:g} cells are not judged: that is rounding."

    def __init__(self) -> None:
        super().__init__()
        self.truth = f"the same step from the same state with {EXACT_ITERATIONS} iterations"

    def explicit_rates(self, quick: bool) -> list[float]:
        return []

    def converged(self, setting: Setting) -> Setting | None:
        return None

    def measure(self, setting: Setting) -> Measurement:
        cantilever = replace(self.cantilever, cells=setting.cells)

        def make(settings: RunSettings) -> tuple[pbmpm.World, Bodies]:
            stage, ids, _ = cantilever.build(settings)
            return stage.world, [(stage.material, ids)]

        return compare(make, setting.run_settings(), self.steps).measurement()


class TurekHronCase(ElasticCase):
    """The undamped beam CSM3 of Turek and Hron."""

    name = "turek-hron"
    title = "Swinging beam of Turek and Hron (CSM3)"
    length_name = "height of the beam"
    length = TurekHronBeam.BEAM.height
    cells = (6, 4, 8)
    rates = (60.0, 120.0)
    iterations = (30, 60)
    variants = ("paper", "primal", "primal-bdf2")  # the dual would need thousands of iterations
    patience = 8.0
    quick_rates = (120.0,)
    quick_iterations = (30,)
    grid_setting = ("primal-bdf2", 120.0, 60)
    particles_per_axis = 4
    error_kinds = (
        ErrorMeasure("amplitude", "discretisation", "%", "of the tip's height over 5 to 10 s", 0.05),
        ErrorMeasure("mean", "discretisation", "%", "of the tip's height, over the amplitude", 0.05),
        ErrorMeasure("frequency", "discretisation", "%", "of the tip's height", 0.05),
    )
    notes = (
        f"The beam is not damped: every loss of amplitude is the solver's. {particles_per_axis} particles per cell and"
        " axis: the tip moves 40 cells up and down, and with 2 the swing is lost to what the grid does not see."
        " Within 5 % at primal-bdf2, 120 Hz, 60 iterations, 6 cells over the height."
    )

    def __init__(self) -> None:
        up = TurekHronBeam().truth[1]
        self.truth = (
            f"finite elements (Turek and Hron 2006, CSM3): tip at {1e3 * up.mean:.2f} +- {1e3 * up.amplitude:.2f} mm,"
            f" {up.frequency:.4g} Hz"
        )

    @property
    def solid(self) -> Solid:
        return TurekHronBeam.BEAM.solid

    def explicit_rates(self, quick: bool) -> list[float]:
        """The largest, and one between it and the next, which is not stable: 200,000 steps, so minutes for each."""
        next_rate, safe = super().explicit_rates(False)[-2:]
        return [] if quick else [float(round(math.sqrt(next_rate * safe))), safe]

    def measure(self, setting: Setting) -> Measurement:
        beam = TurekHronBeam(setting.cells, particles_per_axis=self.particles_per_axis)
        record, _, up = beam.swing(setting.run_settings())
        truth, found = beam.truth[1], up or Swing(math.nan, math.nan, None)
        errors = {
            "amplitude": relative(found.amplitude, truth.amplitude),
            "mean": abs(found.mean - truth.mean) / truth.amplitude,
            "frequency": relative(found.frequency, truth.frequency),
        }
        observed = (found.amplitude / truth.amplitude,)
        return record.measurement(
            errors, observed, tip_mean_m=found.mean, tip_amplitude_m=found.amplitude, frequency_hz=found.frequency
        )
