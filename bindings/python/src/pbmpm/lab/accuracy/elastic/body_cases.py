"""Blocks and discs as the accuracy command lists them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..case import ErrorMeasure, Measurement, Setting
from . import strain
from .block import Block
from .case import ElasticCase, relative
from .discs import TwoDiscs
from .floating import FloatingBlock
from .invariance import Invariance
from .spin import SpinningDisc
from .theory import Solid, rotation_kept


class BlockCase(ElasticCase):
    """Stretch of a block under a known stress, hanging and standing."""

    name = "uniaxial-block"
    title = "Stress and stretch of a block, fixed corotated"
    length_name = "height of the block"
    length = 1.0
    cells = (32, 16, 48)
    finer = {64: 3.0}
    model = strain.FIXED_COROTATED
    particles_per_axis = Block.particles_per_axis
    seconds = 3.0
    rates = (15.0, 60.0)
    iterations = (5, 20)
    variants = ("paper", "dual", "primal")
    patience = 2.0
    grid_setting = ("primal", 60.0, 20)
    hanging_load, standing_load = 0.5, -0.25
    error_kinds = (
        ErrorMeasure("stretch", "discretisation", "%", "the larger of the two that follow", 0.02),
        ErrorMeasure(
            "pulled", "discretisation", "%", "stretch of the layers of the hanging block, over the largest", 0.02
        ),
        ErrorMeasure(
            "pressed", "discretisation", "%", "stretch of the layers of the standing block, over the largest", 0.02
        ),
    )
    notes = (
        "Each layer carries the weight beyond it. Layers within the block's width of the upper hold, 2 cells of the"
        " free end and 2 of the floor are left out. The block is braked until it rests."
        " The paper's solver has no modulus of its own but for that of its law, at the rate that fits."
    )

    def __init__(self) -> None:
        model = "neo-Hookean" if self.model == strain.NEO_HOOKEAN else "fixed corotated"
        self.truth = (
            f"uniaxial stress of the {model} law in {self.dimension}D, nu = 0.3, up to 0.37 E and down to -0.23 E"
        )

    @property
    def solid(self) -> Solid:
        return self._hanging(self.cells[0]).solid

    def _block(self, load: float, cells: int, width: int) -> Block:
        return Block(self.model, load, 0.3, self.dimension, self.length, cells, width, self.particles_per_axis)

    def _hanging(self, cells: int) -> Block:
        return self._block(self.hanging_load, cells, max(4, cells // 4))

    def _standing(self, cells: int) -> Block:
        return self._block(self.standing_load, cells, cells)

    def measure(self, setting: Setting) -> Measurement:
        blocks = {"pulled": self._hanging(setting.cells), "pressed": self._standing(setting.cells)}
        runs = {name: block.settle(setting.run_settings(), self.seconds) for name, block in blocks.items()}
        records = [record for record, _ in runs.values()]
        each = {name: None if profile is None else profile.error for name, (_, profile) in runs.items()}
        known = [error for error in each.values() if error is not None]
        errors = {"stretch": max(known) if len(known) == len(each) else None, **each}
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


class Block3DCase(BlockCase):
    """The same in 3D; smaller, for the price."""

    name = "uniaxial-block-3d"
    title = "Stress and stretch of a block in 3D, fixed corotated"
    dimension = 3
    cells = (16,)
    finer = {}
    particles_per_axis = 2
    rates = (15.0, 60.0)
    patience = 4.0
    quick_rates = (60.0,)
    quick_iterations = (10,)

    def explicit_rates(self, quick: bool) -> list[float]:
        return [] if quick else super().explicit_rates(False)


class TwoDiscsCase(ElasticCase):
    """Two discs that collide and part."""

    name = "two-discs"
    title = "Two colliding discs"
    length_name = "radius of a disc"
    length = 0.2
    cells = (4, 8, 16)
    rates = (60.0, 240.0)
    iterations = (5, 20)
    grid_setting = ("primal-bdf2", 240.0, 10)
    error_kinds = (
        ErrorMeasure("energy_lost", "discretisation", "%", "of the energy at the start, kinetic and stored, at 3.5 s"),
        ErrorMeasure("energy_gained", "discretisation", "%", "most above the start at any time", 0.001),
        ErrorMeasure(
            "gap_at_contact",
            "discretisation",
            "cells",
            "how far along an axis the discs are apart when they first brake",
        ),
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

    def measure(self, setting: Setting) -> Measurement:
        discs = TwoDiscs(self.cell_size(setting))
        record = discs.collide(setting.run_settings())
        total = record.values[:, 0] + record.values[:, 1]
        contact = discs.contact_time(record)
        closing = 2.0 * discs.speed / math.sqrt(2.0) / discs.cell_size  # cells per second and axis
        early = None if contact is None else (discs.facts["geometric_contact_time_s"] - contact) * closing
        errors = {
            "energy_lost": max(0.0, 1.0 - float(total[-1])),
            "energy_gained": max(0.0, float(total.max()) - 1.0),
            "gap_at_contact": early,
            "momentum": float(np.abs(record.values[:, 2]).max()),
        }
        return record.measurement(
            errors, (float(total[-1]),), contact_s=contact, kinetic_end=float(record.values[-1, 0])
        )


class SpinningDiscCase(ElasticCase):
    """A disc that spins without being braked by anything."""

    name = "spinning-disc"
    title = "Spinning disc"
    length_name = "radius of the disc"
    length = SpinningDisc().radius
    cells = (10, 20)
    finer = {40: 2.0}
    error_kinds = (
        ErrorMeasure(
            "displaced",
            "discretisation",
            "%",
            "largest root mean square distance of the particles from where a rigid disc carries them, over the radius",
        ),
        ErrorMeasure("lost", "discretisation", "%", "of the angular momentum, in one revolution"),
        ErrorMeasure(
            "of_theory",
            "discretisation",
            "%",
            "angular momentum against what the integrator leaves to a rigid ring",
            0.02,
        ),
        ErrorMeasure("grown", "discretisation", "%", "of the radius"),
    )
    notes = (
        "Backward Euler loses 2 pi omega dt per revolution at the start: d omega / dt = -omega^3 dt. "
        "The primal solver gives it back to whole bodies."
    )

    def __init__(self) -> None:
        disc = SpinningDisc()
        self.truth = f"angular momentum is kept; R = {disc.radius:g} m, one revolution in {disc.period:g} s"

    @property
    def solid(self) -> Solid:
        return SpinningDisc().solid

    def measure(self, setting: Setting) -> Measurement:
        disc = SpinningDisc(cells=setting.cells)
        record = disc.spin(setting.run_settings())
        kept, moving, stored, reach, _ = (float(value) for value in record.values[-1])
        errors: dict[str, float | None] = {
            "displaced": float(record.values[:, 4].max()),
            "lost": abs(1.0 - kept),
            "of_theory": None,
            "grown": abs(reach - 1.0),
        }
        if setting.solver != "explicit":
            steps = round(disc.period / setting.dt) * setting.substeps
            dt = setting.dt / setting.substeps
            given_back = setting.solver == "primal" and setting.integrator == "euler"  # what chords take, see src/solvers/primal/primal_spin.c
            theory = 1.0 if given_back else rotation_kept(setting.integrator, disc.angular_velocity, dt, steps)
            errors["of_theory"] = relative(kept, theory)
        return record.measurement(errors, (errors["displaced"],), kinetic_kept=moving, stored=stored)


class InvarianceCase(ElasticCase):
    """What must not change with drift and turn."""

    name = "elastic-invariance"
    searched = False
    title = "Drift, turn and a turned body at rest"
    length_name = "metre"
    length = 1.0
    cells = (32,)
    rates = (60.0, 240.0)
    iterations = (5, 20)
    error_kinds = (
        ErrorMeasure(
            "drift_by_cells", "discretisation", "cells", "change of places by a drift of 2 cells per step", 2.1e-4
        ),
        ErrorMeasure("drift", "discretisation", "cells", "change of places by a drift of 0.37 cells per step", 0.02),
        ErrorMeasure("turned_90", "discretisation", "cells", "change of places by a set-up turned by 90 degrees", 1e-3),
        ErrorMeasure("turned_45", "discretisation", "cells", "change of places by a set-up turned by 45 degrees"),
        ErrorMeasure(
            "at_rest", "discretisation", "cells", "motion in a step of a body at rest whose F is a rotation", 1e-5
        ),
    )
    truth = (
        "the motion is the same: exactly but for rounding; to the grid's order for fractions of a cell and 45 degrees"
    )
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
    rates = (60.0, 120.0)
    iterations = (5, 20)
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
            f"Archimedes: a block of {block.block_cells[0]} x {block.block_cells[1]} cells, {block.density:g} kg/m^3,"
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
