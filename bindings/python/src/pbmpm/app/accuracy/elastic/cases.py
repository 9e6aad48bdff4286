"""The elastic reference cases as the accuracy command lists them."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import replace

import numpy as np

import pbmpm

from ...simulation import RunSettings
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from . import strain
from .bar import CLASSIC_BAR, STIFF_BAR, Bar
from .beam import Cantilever, TurekHronBeam, loaded_beam
from .block import Block
from .discs import TwoDiscs
from .floating import FloatingBlock
from .invariance import Invariance
from .prediction import EXACT_ITERATIONS, FACTOR, ROUNDING, Bodies, compare
from .signal import Swing
from .spin import SpinningDisc
from .theory import Integrator, Solid, discrete_frequency, rotation_kept

IMPLICIT = ("paper", "dual", "primal", "primal-bdf2")
_CONVERGED_ITERATIONS = 100
"""Of the primal solver, with which these cases do not change any more."""


def integrator_of(setting: Setting) -> Integrator:
    """What the time steps of a setting do, whatever the iterations leave."""
    return "explicit" if setting.solver == "explicit" else setting.integrator


def relative(value: float | None, truth: float) -> float | None:
    """Error as a share of the truth."""
    return None if value is None else abs(value / truth - 1.0)


class ElasticCase(Case):
    """What the cases of elastic bodies share: the converged solution is that of the primal solver.

    The dual solver has the same equations, but would need thousands of iterations for stiff bodies.
    """

    kind = "elastic"
    dimension = 2
    converged_iterations = _CONVERGED_ITERATIONS

    rates: tuple[float, ...] = (30.0, 60.0, 120.0, 240.0, 480.0)
    iterations: tuple[int, ...] = (2, 5, 10, 20, 50)
    cells: tuple[int, ...]
    """The first is the one at which rates and iterations are swept; the others show the grid's share."""
    grid_setting = ("primal-bdf2", 240.0, 20)
    """Variant, rate and iterations at which the other cell sizes are measured."""
    quick_rates: tuple[float, ...] = (60.0, 240.0)
    quick_iterations: tuple[int, ...] = (5, 20)
    variants: tuple[str, ...] = IMPLICIT

    def sweep(self, quick: bool) -> list[Setting]:
        rates, iterations = (self.quick_rates, self.quick_iterations) if quick else (self.rates, self.iterations)
        made = settings_of(self.variants, rates, iterations, self.cells[:1])
        made += settings_of(["explicit"], self.explicit_rates(quick), [1], self.cells[:1])
        if not quick:
            variant, rate, count = self.grid_setting
            made += settings_of([variant], [rate], [count], self.cells[1:])
        return made

    def explicit_rates(self, quick: bool) -> list[float]:
        """Rates around that at which sound travels a cell per step, rounded to 60 Hz."""
        limit = self.solid.pressure_wave_speed * self.cells[0] / self.length
        shares = (2.0,) if quick else (0.5, 1.0, 2.0, 4.0)
        return [60.0 * math.ceil(share * limit / 60.0) for share in shares]

    @property
    @abstractmethod
    def solid(self) -> Solid:
        """The material of the body."""

    def converged(self, setting: Setting) -> Setting | None:
        if setting.solver in ("explicit", "paper"):
            return None
        return replace(setting, solver="primal", iterations=self.converged_iterations)


class AxialBar(ElasticCase):
    """Axial vibration of a bar that is fixed at one end."""

    name = "axial-bar"
    title = "Axial vibration of a bar"
    length_name = "bar"
    cells = (32, 16, 64)
    bar: Bar = STIFF_BAR
    error_kinds = (
        ErrorMeasure("frequency", "discretisation", "%", "frequency against that of the exact motion", 0.02),
        ErrorMeasure(
            "of theory",
            "discretisation",
            "%",
            "frequency against what the integrator with exact steps makes of the exact motion: without the error of the time step",
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
        errors = {"frequency": relative(frequency, bar.frequency), "of theory": relative(frequency, theory)}
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
    bar = CLASSIC_BAR
    rates = (2.0, 5.0, 10.0, 20.0)
    quick_rates = (5.0,)
    grid_setting = ("primal-bdf2", 10.0, 20)

    def explicit_rates(self, quick: bool) -> list[float]:
        return [40.0] if quick else [10.0, 20.0, 40.0, 80.0]


class AxialBar3DCase(AxialBar):
    """The stiff bar in 3D, a few settings."""

    name = "axial-bar-3d"
    title = "Axial vibration of a bar in 3D"
    dimension = 3
    cells = (32,)
    bar = replace(STIFF_BAR, solid=replace(STIFF_BAR.solid, dimension=3))
    rates = (60.0, 240.0)
    iterations = (5, 20)


class CantileverCase(ElasticCase):
    """A beam under its own weight: where it hangs and how fast it swings."""

    name = "cantilever"
    title = "Cantilever under its own weight"
    length_name = "height of the beam"
    cells = (8, 4, 12)
    load, slenderness = 0.4285, 4.0
    rates = (60.0, 120.0, 240.0)
    error_kinds = (
        ErrorMeasure("tip", "discretisation", "%", "deflection of the tip at rest against the elastica and shear", 0.05),
        ErrorMeasure("frequency", "discretisation", "%", "frequency of the swing against that of small swings"),
        ErrorMeasure("of theory", "discretisation", "%", "frequency against what the integrator makes of that of small swings"),
        ErrorMeasure("middle", "discretisation", "%", "middle of the swing against the elastica and shear: creep by swinging"),
    )
    notes = (
        "One run stops the motion at each maximum of the kinetic energy and gives the tip at rest; another swings freely for"
        " 4 periods and gives the middle of the swing and its frequency, by a fitted oscillation. The cost is that of the"
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
            "of theory": relative(frequency, theory),
            "middle": relative(middle, cantilever.tip_deflection),
        }
        record.reasons = list(dict.fromkeys(resting.reasons + record.reasons))
        observed = None if tip is None else (tip / cantilever.tip_deflection,)
        return record.measurement(errors, observed, tip_m=tip, middle_m=middle, frequency_hz=frequency, theory_hz=theory)


class LargeCantileverCase(CantileverCase):
    """A more slender beam that bends far."""

    name = "cantilever-large"
    title = "Slender cantilever, large deflection"
    load, slenderness = 1.0, 8.0


class Cantilever3DCase(CantileverCase):
    """The thick beam in 3D, as wide as high; few settings, for the price."""

    name = "cantilever-3d"
    title = "Cantilever under its own weight in 3D"
    dimension = 3
    cells = (6,)
    rates = (60.0, 240.0)
    quick_rates = (60.0,)
    iterations = (10, 20)
    quick_iterations = (20,)
    variants = ("dual", "primal", "primal-bdf2")

    def explicit_rates(self, quick: bool) -> list[float]:
        return [] if quick else super().explicit_rates(True)


class PredictionCase(CantileverCase):
    """Whether the predicted error of a step is its true one."""

    name = "predicted-error-cantilever"
    title = "Predicted and true error of the steps of a cantilever"
    kind = "elastic"
    cells = (8,)
    iterations = (2, 5, 10, 20)
    variants = ("dual", "primal")
    steps = 60
    error_kinds = (
        ErrorMeasure("wrong", "solver", "%", f"share of the steps predicted wrong by more than {FACTOR:g} times", 0.2),
        ErrorMeasure("true error", "solver", "cells", "median of the steps: distance from the same step solved to the end"),
    )
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

        found = compare(make, setting.run_settings(), self.steps)
        wrong = None if found.share is None else 1.0 - found.share
        return Measurement(
            errors={"wrong": wrong, "true error": float(np.median(found.true))},
            ms_per_simulated_second=found.ms_per_simulated_second,
            iterations_used=found.iterations_used,
            predicted_error=float(found.predicted.mean()),
            stable=True,
            extra={"median_ratio": found.median_ratio, "steps": self.steps},
        )


class TurekHronCase(ElasticCase):
    """The undamped beam CSM3 of Turek and Hron."""

    name = "turek-hron"
    title = "Swinging beam of Turek and Hron (CSM3)"
    length_name = "height of the beam"
    length = TurekHronBeam.BEAM.height
    cells = (6, 4, 8)
    rates = (60.0, 120.0, 240.0)
    iterations = (5, 10, 20)
    grid_setting = ("primal-bdf2", 240.0, 10)
    error_kinds = (
        ErrorMeasure("amplitude", "discretisation", "%", "of the tip's height over 5 to 10 s", 0.05),
        ErrorMeasure("mean", "discretisation", "%", "of the tip's height, over the amplitude", 0.05),
        ErrorMeasure("frequency", "discretisation", "%", "of the tip's height", 0.05),
    )
    notes = "The beam is not damped: every loss of amplitude is the solver's."

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
        return super().explicit_rates(True)

    def measure(self, setting: Setting) -> Measurement:
        beam = TurekHronBeam(setting.cells)
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


class BlockCase(ElasticCase):
    """Stretch of a block under a known stress, hanging and standing."""

    name = "uniaxial-block"
    title = "Stress and stretch of a block, fixed corotated"
    length_name = "height of the block"
    length = 1.0
    cells = (32, 16, 48)
    model = strain.FIXED_COROTATED
    seconds = 3.0
    rates = (60.0, 240.0)
    iterations = (5, 20, 50)
    variants = ("dual", "primal")
    grid_setting = ("primal", 60.0, 20)
    hanging_load, standing_load = 0.5, -0.25
    error_kinds = (
        ErrorMeasure("pulled", "discretisation", "%", "stretch of the layers of the hanging block, over the largest", 0.02),
        ErrorMeasure("pressed", "discretisation", "%", "stretch of the layers of the standing block, over the largest", 0.02),
    )
    notes = (
        "Each layer carries the weight beyond it. Layers within the block's width of the upper hold, 2 cells of the free end"
        " and 2 of the floor are left out. Motion is stopped at each maximum of the kinetic energy, so the state is at rest."
        " The paper's solver has no modulus of its own and is left out."
    )

    def __init__(self) -> None:
        model = "neo-Hookean" if self.model == strain.NEO_HOOKEAN else "fixed corotated"
        self.truth = f"uniaxial stress of the {model} law in {self.dimension}D, nu = 0.3, up to 0.37 E and down to -0.23 E"

    @property
    def solid(self) -> Solid:
        return self._hanging(self.cells[0]).solid

    def _hanging(self, cells: int) -> Block:
        return Block(self.model, self.hanging_load, 0.3, self.dimension, self.length, cells, max(4, cells // 4))

    def _standing(self, cells: int) -> Block:
        return Block(self.model, self.standing_load, 0.3, self.dimension, self.length, cells, cells)

    def measure(self, setting: Setting) -> Measurement:
        blocks = {"pulled": self._hanging(setting.cells), "pressed": self._standing(setting.cells)}
        runs = {name: block.settle(setting.run_settings(), self.seconds) for name, block in blocks.items()}
        records = [record for record, _ in runs.values()]
        errors = {name: None if profile is None else profile.error for name, (_, profile) in runs.items()}
        pulled = runs["pulled"][1]
        change = 1.0 if pulled is None else float(np.abs(pulled.truths - 1.0).max())
        made = records[0].measurement(errors, None if pulled is None else tuple(pulled.stretches / change))
        reasons = [f"{name}: {reason}" for name, (record, _) in runs.items() for reason in record.reasons]
        cost = sum(record.ms_per_simulated_second for record in records)
        return replace(made, errors=errors, stable=not reasons, reasons=reasons, ms_per_simulated_second=cost)


class NeoHookeanBlockCase(BlockCase):
    """The same for the other law."""

    name = "uniaxial-block-neo-hookean"
    title = "Stress and stretch of a block, neo-Hookean"
    model = strain.NEO_HOOKEAN
    variants = ("primal",)


class Block3DCase(BlockCase):
    """The same in 3D; smaller, for the price."""

    name = "uniaxial-block-3d"
    title = "Stress and stretch of a block in 3D, fixed corotated"
    dimension = 3
    cells = (16,)
    rates = (60.0,)
    quick_rates = (60.0,)
    iterations = (10, 20)
    quick_iterations = (10,)
    variants = ("primal",)

    def explicit_rates(self, quick: bool) -> list[float]:
        return [] if quick else super().explicit_rates(True)


class TwoDiscsCase(ElasticCase):
    """Two discs that collide and part."""

    name = "two-discs"
    title = "Two colliding discs"
    length_name = "radius of a disc"
    length = 0.2
    cells = (4, 8, 16)
    rates = (60.0, 120.0, 240.0, 1000.0)
    iterations = (2, 5, 10, 20)
    quick_rates = (60.0, 240.0)
    grid_setting = ("primal-bdf2", 240.0, 10)
    error_kinds = (
        ErrorMeasure("energy lost", "discretisation", "%", "of the energy at the start, kinetic and stored, at 3.5 s"),
        ErrorMeasure("energy gained", "discretisation", "%", "most above the start at any time", 0.001),
        ErrorMeasure("gap at contact", "discretisation", "cells", "how far along an axis the discs are apart when they first brake"),
        ErrorMeasure("momentum", "discretisation", "%", "largest momentum of both over that of one; exactly 0", 1e-5),
    )

    def __init__(self) -> None:
        facts = TwoDiscs().facts
        self.truth = (
            f"Sulsky, Chen and Schreyer 1994: energy {facts['K0_J_per_m']:.4g} J/m is kept, contact by geometry at"
            f" {facts['geometric_contact_time_s']:.4g} s"
        )

    @property
    def solid(self) -> Solid:
        return TwoDiscs().solid

    def explicit_rates(self, quick: bool) -> list[float]:
        return [60.0, 240.0, 1000.0]

    def measure(self, setting: Setting) -> Measurement:
        discs = TwoDiscs(self.cell_size(setting))
        record = discs.collide(setting.run_settings())
        total = record.values[:, 0] + record.values[:, 1]
        contact = discs.contact_time(record)
        closing = 2.0 * discs.speed / math.sqrt(2.0) / discs.cell_size  # cells per second and axis
        early = None if contact is None else (discs.facts["geometric_contact_time_s"] - contact) * closing
        errors = {
            "energy lost": max(0.0, 1.0 - float(total[-1])),
            "energy gained": max(0.0, float(total.max()) - 1.0),
            "gap at contact": early,
            "momentum": float(np.abs(record.values[:, 2]).max()),
        }
        return record.measurement(errors, (float(total[-1]),), contact_s=contact, kinetic_end=float(record.values[-1, 0]))


class SpinningDiscCase(ElasticCase):
    """A disc that spins without being braked by anything."""

    name = "spinning-disc"
    title = "Spinning disc"
    length_name = "radius of the disc"
    length = SpinningDisc().radius
    cells = (10, 20)
    iterations = (2, 5, 10, 20)
    error_kinds = (
        ErrorMeasure("lost", "discretisation", "%", "of the angular momentum, in one revolution"),
        ErrorMeasure("of theory", "discretisation", "%", "angular momentum against what the integrator leaves to a rigid ring", 0.02),
        ErrorMeasure("grown", "discretisation", "%", "of the radius"),
    )
    notes = "Backward Euler loses 2 pi omega dt per revolution at the start: d omega / dt = -omega^3 dt."

    def __init__(self) -> None:
        disc = SpinningDisc()
        self.truth = f"angular momentum is kept; R = {disc.radius:g} m, one revolution in {disc.period:g} s"

    @property
    def solid(self) -> Solid:
        return SpinningDisc().solid

    def measure(self, setting: Setting) -> Measurement:
        disc = SpinningDisc(cells=setting.cells)
        record = disc.spin(setting.run_settings())
        kept, moving, stored, reach = (float(value) for value in record.values[-1])
        errors: dict[str, float | None] = {"lost": abs(1.0 - kept), "of theory": None, "grown": abs(reach - 1.0)}
        if setting.solver != "explicit":
            steps = round(disc.period / setting.dt) * setting.substeps
            dt = setting.dt / setting.substeps
            errors["of theory"] = relative(kept, rotation_kept(setting.integrator, disc.angular_velocity, dt, steps))
        return record.measurement(errors, (kept,), kinetic_kept=moving, stored=stored)


class InvarianceCase(ElasticCase):
    """What must not change with drift and turn."""

    name = "elastic-invariance"
    title = "Drift, turn and a turned body at rest"
    length_name = "metre"
    length = 1.0
    cells = (32,)
    rates = (60.0, 240.0)
    iterations = (5, 20)
    error_kinds = (
        ErrorMeasure("drift by cells", "discretisation", "cells", "change of places by a drift of 2 cells per step", 2.1e-4),
        ErrorMeasure("drift", "discretisation", "cells", "change of places by a drift of 0.37 cells per step", 0.02),
        ErrorMeasure("turned 90", "discretisation", "cells", "change of places by a set-up turned by 90 degrees", 1e-3),
        ErrorMeasure("turned 45", "discretisation", "cells", "change of places by a set-up turned by 45 degrees"),
        ErrorMeasure("at rest", "discretisation", "cells", "motion in a step of a body at rest whose F is a rotation", 1e-5),
    )
    truth = "the motion is the same: exactly but for rounding; to the grid's order for fractions of a cell and 45 degrees"
    notes = "A vibrating block of 12 x 8 cells, after 100 steps."

    @property
    def solid(self) -> Solid:
        return Invariance().solid

    def measure(self, setting: Setting) -> Measurement:
        checks, records = Invariance(cell_size=self.cell_size(setting)).checks(setting.run_settings())
        errors = {measure.name: check.figure for measure, check in zip(self.error_kinds, checks)}
        reasons = list(dict.fromkeys(reason for record in records for reason in record.reasons))
        made = records[0].measurement(errors, None)
        failed = [check.name for check in checks if not check.passed]
        extra = {**made.extra, "checks_failed": failed}
        return replace(made, errors=errors, reasons=reasons, stable=not reasons, extra=extra)

    def converged(self, setting: Setting) -> Setting | None:
        return None


class FloatingBlockCase(ElasticCase):
    """A light elastic block floats."""

    name = "floating-block"
    title = "Floating elastic block"
    kind = "mixed"
    length_name = "metre"
    length = 1.0
    cells = (32, 48)
    rates = (60.0, 120.0, 240.0)
    iterations = (10, 20, 30)
    quick_iterations = (20,)
    variants = ("paper", "dual")
    grid_setting = ("dual", 120.0, 30)
    error_kinds = (
        ErrorMeasure("depth", "discretisation", "%", "of the block's lower face below the water", 0.3),
        ErrorMeasure("water", "discretisation", "%", "height of the water beside the block", 0.03),
    )
    notes = (
        "The row's effective_young says how stiff a body the iterations can hold, strain how far the block gives."
        " Liquid and block keep about half a cell apart, which makes the block wider and its draught smaller."
    )

    def __init__(self) -> None:
        block = FloatingBlock()
        self.truth = (
            f"Archimedes: a block of {block.block_cells[0]} x {block.block_cells[1]} cells and {block.density:g} kg/m^3,"
            f" E = {block.young:g} Pa, displaces its own weight"
        )

    @property
    def solid(self) -> Solid:
        block = FloatingBlock()
        return Solid(block.young, block.poisson, block.density)

    def explicit_rates(self, quick: bool) -> list[float]:
        return []

    def measure(self, setting: Setting) -> Measurement:
        found = FloatingBlock.at_resolution(setting.cells).float_up(setting.run_settings())
        height = None if found.water_height is None else abs(found.water_height / found.water_truth - 1.0)
        return Measurement(
            errors={"depth": found.error, "water": height},
            ms_per_simulated_second=found.ms_per_simulated_second,
            iterations_used=float(setting.iterations),
            predicted_error=found.predicted_error,
            stable=not found.reasons,
            reasons=found.reasons,
            extra={"effective_young": found.effective_young, "strain": found.strain, "depth_m": found.depth},
            observed=None if found.depth is None else (found.depth / found.truth,),
        )

    def converged(self, setting: Setting) -> Setting | None:
        return None if setting.solver == "paper" else replace(setting, iterations=200)


ELASTIC_CASES = (
    AxialBar,
    ClassicAxialBar,
    AxialBar3DCase,
    CantileverCase,
    LargeCantileverCase,
    Cantilever3DCase,
    PredictionCase,
    TurekHronCase,
    BlockCase,
    NeoHookeanBlockCase,
    Block3DCase,
    TwoDiscsCase,
    SpinningDiscCase,
    InvarianceCase,
    FloatingBlockCase,
)
