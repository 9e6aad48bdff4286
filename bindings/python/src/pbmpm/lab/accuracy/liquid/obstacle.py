"""The dam break against a box of Kleefsman et al. (2005): water heights at four gauges of a tank."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np

from ...scenes.scene import Scene
from ...simulation import Simulation
from ..case import Case, CurvePanel, ErrorMeasure, Measurement, Setting, settings_of
from ..measures import Curve
from ..trial import Trial
from .common import GRAVITY, PARTICLES_PER_AXIS, box_fill, explicit_settings, rest_energy, stiff_enough, water_scene

TANK = (3.22, 1.0, 1.0)  # length, height, width [m]
GATE = 1.992  # the water stands beyond
DEPTH = 0.55
BOX = ((0.6635, 0.0, 0.2985), (0.8245, 0.161, 0.7015))  # its corners
GAUGES = (0.496, 0.992, 1.488, 2.638)  # places along the tank, in its middle [m]
SECONDS = 7.3
FASTEST = math.sqrt(2.0 * GRAVITY * DEPTH)  # of a fall from the surface [m/s]
_SAMPLES_PER_SECOND = 60
_GAUGE_CELLS = 1.0  # half width of the water column that a gauge sees


@cache
def measured_heights() -> dict[float, Curve]:
    """Height [m] against time [s] at each gauge."""
    source = resources.files(__package__).joinpath("../../data/dam_break_kleefsman_heights.csv")
    rows = [line.split(",") for line in source.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    names, *numbers = rows
    columns = dict(zip(names, np.array(numbers, dtype=np.float64).T))
    return {place: Curve(columns["t_s"], columns[f"h_x{place:.3f}"]) for place in GAUGES}


@dataclass(frozen=True)
class ObstacleDamBreak(Case):
    """The tank at its own size."""

    depth: float = DEPTH

    name = "dam-break-obstacle"
    title = "Dam break against a box, Kleefsman et al."
    dimension = 3
    kind = "liquid"
    truth = (
        "experiment: heights [m] at x = 0.496, 0.992, 1.488 and 2.638 m at 36 instants up to 7.3 s (Kleefsman et al. 2005,"
        " J. Comput. Phys. 206)"
    )
    error_kinds = (
        ErrorMeasure("gauge_mae", "model", "%", "mean over gauges and instants of |h - h_exp| over the depth of 0.55 m", 0.12),
        ErrorMeasure("gauge_mae_own", "model", "%", "the same over the largest height of each gauge"),
        ErrorMeasure("first_second", "model", "%", "as the first, up to 1.1 s: before the wave is back from the wall"),
    )
    length_name = "depth of the water"
    notes = (
        "A gauge shows the volume of the water within a cell of it, over the area. 43,000 particles at 11 cells. The"
        " converged solution is left out: it would take longer than all the rest."
    )

    @property
    def length(self) -> float:  # type: ignore[override]
        return self.depth

    @property
    def panels(self) -> tuple[CurvePanel, ...]:  # type: ignore[override]
        return tuple(
            CurvePanel(f"x{place:.3f}", "t [s]", f"height at x = {place:g} m [m]", curve, "Kleefsman et al. 2005")
            for place, curve in measured_heights().items()
        )

    def sweep(self, quick: bool) -> list[Setting]:
        if quick:
            return settings_of(("paper", "dual"), (60,), (5, 10), (6,))
        coarse = settings_of(("paper", "dual", "dual-cells"), (30, 60), (1, 5), (8,))
        return coarse + settings_of(("dual",), (60,), (5,), (11,)) + explicit_settings(FASTEST, DEPTH / 8, 8, (5.0, 10.0))

    def converged(self, setting: Setting) -> Setting | None:
        return None

    def _room(self, setting: Setting, length: float) -> float:
        """Where the library lets a wall stand: on the last half cell. Water that was put in for the whole length would be squeezed, could but
        rise, and would gain energy."""
        half = 0.5 * self.cell_size(setting)
        return math.floor(length / half + 1e-6) * half

    def scene(self, setting: Setting) -> Scene:
        """The tank, the box and the water."""
        end, width = self._room(setting, TANK[0]), self._room(setting, TANK[2])
        lower, upper = (np.array(corner) + (0.0, 0.0, 0.5 * (width - TANK[2])) for corner in BOX)
        shape = {"kind": "box", "position": (0.5 * (lower + upper)).tolist(), "half_extents": (0.5 * (upper - lower)).tolist()}
        return water_scene(
            "dam_break_obstacle_3d",
            self.cell_size(setting),
            [box_fill((GATE - TANK[0] + end, 0.0, 0.0), (end, DEPTH, width))],
            domain=((0.0, 0.0, 0.0), (end, TANK[1], width)),
            water=stiff_enough(setting, FASTEST),
            colliders=[{"shape": {**shape, "rotation": [0.0, 0.0, 0.0, 1.0]}, "friction": "slip"}],
            dimension=3,
        )

    def measure(self, setting: Setting) -> Measurement:
        times: list[float] = []
        heights: list[list[float]] = []

        def observe(simulation: Simulation) -> None:
            times.append(simulation.time)
            heights.append(self._heights(simulation, setting))

        every = max(1, int(setting.rate_hz / _SAMPLES_PER_SECOND))
        run = Trial(self.scene(setting), setting, SECONDS, start_energy=rest_energy, observe=observe, every=every)
        columns = np.array(heights).T
        curves = {place: Curve(np.array(times), column) for place, column in zip(GAUGES, columns)}
        found = [(curves[place].at(truth.times) - truth.values, truth) for place, truth in measured_heights().items()]
        early = found[0][1].times <= 1.1
        return run.measurement(
            {
                "gauge_mae": float(np.mean([np.abs(error) for error, _ in found])) / DEPTH,
                "gauge_mae_own": float(np.mean([np.mean(np.abs(error)) / truth.values.max() for error, truth in found])),
                "first_second": float(np.mean([np.abs(error[early]) for error, _ in found])) / DEPTH,
            },
            curves={f"x{place:.3f}": curve for place, curve in curves.items()},
        )

    def _heights(self, simulation: Simulation, setting: Setting) -> list[float]:
        """What the gauges show [m]."""
        cell = self.cell_size(setting)
        places = simulation.world.positions.array()
        reach = _GAUGE_CELLS * cell
        along, across = places[:, 0], places[:, 2]
        near = along[np.abs(across - 0.5 * self._room(setting, TANK[2])) < reach]
        volume = (cell / PARTICLES_PER_AXIS) ** 3
        return [float(np.count_nonzero(np.abs(near - place) < reach)) * volume / (2.0 * reach) ** 2 for place in GAUGES]
