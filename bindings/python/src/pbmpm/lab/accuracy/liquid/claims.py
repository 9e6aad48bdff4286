"""What the paper claims about its liquids, as cases: printed whether they hold or not.

C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks: stable at large time steps with few iterations where
explicit MLS-MPM has to take small ones; stiffness grows with the iterations; the volume that the grid measures keeps
liquids from losing theirs; volume that was lost wholly comes back.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

import pbmpm

from ...scenes.scene import Scene
from ...simulation import Simulation
from .. import laws
from ..case import Case, ErrorMeasure, Measurement, Setting, settings_of
from ..measures import occupied_area
from ..trial import Trial
from .column import Column
from .common import DEFAULT_FEEDBACK, DENSITY, GRAVITY, box_fill, paper_modulus_over_density, rest_energy, water_scene
from .dam_break import HEIGHT_RATIO, SHORT_TANK, TANK_HEIGHT

_VOLUME_SAMPLES = 15  # in the last second


class _Tank(Case):
    """A dam break that ends as a pool, four times as wide as its column was."""

    dimension = 2
    kind = "liquid"
    searched = False
    length = 1.0
    length_name = "width of the column"
    seconds = 20.0
    modulus = 0.0
    """Of solvers that take one [Pa]; 0: incompressible."""

    def scene(self, setting: Setting, volume_feedback: float = DEFAULT_FEEDBACK) -> Scene:
        """The column in its tank."""
        return water_scene(
            self.name.replace("-", "_"),
            self.cell_size(setting),
            [box_fill((0.0, 0.0), (self.length, HEIGHT_RATIO * self.length))],
            domain=((0.0, 0.0), (SHORT_TANK * self.length, TANK_HEIGHT * self.length)),
            water={"volume_feedback": volume_feedback, "bulk_modulus": self.modulus},
        )

    def converged(self, setting: Setting) -> Setting | None:
        return None  # a claim is about the setting itself

    @property
    def depth(self) -> float:
        """Of the pool [m]."""
        return HEIGHT_RATIO * self.length / SHORT_TANK

    @abstractmethod
    def before_step(self, simulation: Simulation) -> None:
        """What the case does to the water on the way; called before the first step and after each."""

    def settle(self, setting: Setting, volume_feedback: float = DEFAULT_FEEDBACK, judged: bool = True) -> tuple[Trial, float]:
        """The run, and the volume that the water takes in the last second over its rest volume (NaN when it broke)."""
        cell, volumes = self.cell_size(setting), []
        every = max(1, int(setting.rate_hz / _VOLUME_SAMPLES))

        def observe(simulation: Simulation) -> None:
            if simulation.time > self.seconds - 1.0 and simulation.steps % every == 0:
                volumes.append(occupied_area(simulation.world.positions.array(), cell))
            self.before_step(simulation)

        scene = self.scene(setting, volume_feedback)
        run = Trial(scene, setting, self.seconds, start_energy=rest_energy if judged else None, observe=observe)
        if run.judge.broken or not volumes:
            return run, float("nan")
        return run, float(np.mean(volumes)) / (HEIGHT_RATIO * self.length**2)


class StabilityClaim(_Tank):
    """Rates at which the paper's solver and the explicit one survive a dam break."""

    name = "claim-stability"
    title = "Claim: stable at 30 Hz x 1, where the explicit solver needs 240 Hz"
    truth = "the rest volume [m^2]; the failure map is in the column 'stable'"
    error_kinds = (ErrorMeasure("volume_lost", "discretisation", "%", "|settled volume - rest volume| / rest volume after 20 s"),)
    notes = "The explicit solver has the modulus with which the pool should lose a tenth of its volume: 24.5 kPa."
    modulus = DENSITY * GRAVITY * (HEIGHT_RATIO / SHORT_TANK) / (2.0 * 0.1)  # a mean compression of rho g h / (2 K)

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper",), (30,), (1,), (16,)) + settings_of(("explicit",), (30, 120, 240, 480), (1,), (16,))
        paper = settings_of(("paper",), (15, 30, 60, 120, 240, 480), (1, 2, 5, 10), (16,), most_work=480 * 4)
        return paper + settings_of(("explicit",), (15, 30, 60, 120, 240, 480, 960), (1,), (16,))

    def before_step(self, simulation: Simulation) -> None:
        pass

    def measure(self, setting: Setting) -> Measurement:
        run, ratio = self.settle(setting)
        modulus = paper_modulus_over_density(self.scene(setting), setting.run_settings())
        if not run.judge.broken:
            predicted = laws.apparent_height_ratio(laws.column_profile(self.depth, GRAVITY, modulus))
            run.judge.settle(ratio, predicted if setting.solver == "paper" else 0.9)
        return run.measurement({"volume_lost": abs(1.0 - ratio)}, extra={"settled_volume": ratio})


class VolumeClaim(_Tank):
    """Sloshing without end: what the volume measured on the grid is good for."""

    name = "claim-volume"
    title = "Claim: the volume measured on the grid keeps a sloshing liquid from losing its own"
    truth = "the rest volume [m^2]"
    error_kinds = (
        ErrorMeasure("volume_lost", "discretisation", "%", "|volume - rest volume| / rest volume after 20 s of kicks"),
        ErrorMeasure("lost_without_measure", "discretisation", "%", "the same without volume feedback"),
    )
    notes = "Every two seconds all water gets 1 m/s sideways, to and fro."
    kick_seconds = 2.0
    kick_speed = 1.0

    def sweep(self, quick: bool) -> list[Setting]:
        variants = ("paper", "dual")
        return settings_of(variants, (60,), (20,), (16,)) if quick else settings_of(variants, (60, 120), (5, 20), (16,))

    def before_step(self, simulation: Simulation) -> None:
        kicks = simulation.time / self.kick_seconds
        if simulation.steps and abs(kicks - round(kicks)) < 0.5 * simulation.settings.dt / self.kick_seconds:
            push = self.kick_speed * (1.0 if round(kicks) % 2 else -1.0)
            simulation.world.velocities = simulation.world.velocities.array() + np.array([push, 0.0])

    def measure(self, setting: Setting) -> Measurement:
        run, ratio = self.settle(setting, judged=False)
        _, without = self.settle(setting, volume_feedback=0.0, judged=False)
        return run.measurement({"volume_lost": abs(1.0 - ratio), "lost_without_measure": abs(1.0 - without)})


class RecoveryClaim(_Tank):
    """A pool that was pressed onto the floor."""

    name = "claim-recovery"
    title = "Claim: liquid that lost all its volume gets it back"
    truth = "the rest volume [m^2]"
    error_kinds = (
        ErrorMeasure("volume_lost", "discretisation", "%", "|volume - rest volume| / rest volume 5 s after", 0.1),
        ErrorMeasure("highest_speed", "discretisation", "m/s", "largest speed on the way: how violently it comes back"),
    )
    notes = "All particles of the column are put a thousandth of their height above the floor, with J = 0.05, its lowest."
    seconds = 5.0

    def sweep(self, quick: bool) -> list[Setting]:
        variants = ("paper", "dual")
        return settings_of(variants, (60,), (10,), (16,)) if quick else settings_of(variants, (30, 60, 240), (1, 5, 20), (16,))

    def before_step(self, simulation: Simulation) -> None:
        if simulation.steps == 0:
            places = simulation.world.positions.array() * np.array([1.0, 1e-3])
            simulation.world.positions = places
            simulation.world.set(pbmpm.Field.VOLUME_RATIO, np.full(len(places), 0.05))

    def measure(self, setting: Setting) -> Measurement:
        run, ratio = self.settle(setting, judged=False)
        return run.measurement({"volume_lost": abs(1.0 - ratio), "highest_speed": run.meter.max_speed})


@dataclass(frozen=True)
class StiffnessClaim(Column):
    """How the stiffness of the paper's solver grows with rate and iterations."""

    name = "claim-stiffness"
    searched = False
    title = "Claim: stiffness grows with the iterations; by law with N / dt^2"
    truth = "law of the paper's solver: K = rho w N dx^2 / (4 d dt^2) [Pa]; mean compression of a column of 1 m"
    error_kinds = (  # type: ignore[assignment]
        ErrorMeasure("law_error", "discretisation", "%", "|compression - law| / law, without volume feedback"),
        ErrorMeasure("compression", "discretisation", "%", "mean compression of the column"),
    )
    notes = "Compression against iterations and rate is the claim; the law says how much."

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper",), (120,), (2, 10), (16,))
        return settings_of(("paper",), (60, 120, 240), (1, 2, 5, 10, 20, 50), (32,), most_work=240 * 13)

    def converged(self, setting: Setting) -> Setting | None:
        return None  # there is none: the stiffness grows without end

    def measure(self, setting: Setting) -> Measurement:
        rest = self._rest(setting, 0.0)
        modulus = paper_modulus_over_density(self.scene(setting), setting.run_settings())
        law = laws.mean_compression(self.height, GRAVITY, modulus)
        if rest.sinking is None:
            return rest.run.measurement({"law_error": None, "compression": None})
        errors = {"law_error": abs(rest.sinking / law - 1.0), "compression": rest.sinking}
        return rest.run.measurement(errors, extra={"law": law, "modulus": DENSITY * modulus})
