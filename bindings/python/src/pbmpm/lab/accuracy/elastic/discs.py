"""Two elastic discs that collide and part again (Sulsky, Chen and Schreyer 1994).

Known are the energy at the start, the time of contact by geometry, and that total momentum is 0 and energy never grows.
Bodies on a grid meet before their surfaces do, by up to 1.5 cells along each axis.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...simulation import RunSettings
from . import references
from .stage import Record, Stage, disc, run
from .theory import Solid

_CONTACT_LOSS = 0.02  # of the kinetic energy: what counts as the beginning of the contact
_SPEED_LIMIT = 10.0  # times the speed at the start


@dataclass(frozen=True)
class TwoDiscs:
    """The discs on cells of ``cell_size``; the literature's is 0.05 m."""

    cell_size: float = 0.05

    @cached_property
    def facts(self) -> dict[str, Any]:
        return references.two_discs()

    @property
    def solid(self) -> Solid:
        return Solid(self.facts["E"], self.facts["nu"], self.facts["rho"])

    @property
    def speed(self) -> float:
        """Of each disc [m/s]."""
        return math.hypot(*self.facts["velocities"][0])

    @property
    def earliest_contact(self) -> float:
        """When the grid can first make them meet [s]: 1.5 cells along the diagonal before they touch."""
        return self.facts["geometric_contact_time_s"] - 1.5 * self.cell_size * math.sqrt(2.0) / (2.0 * self.speed)

    def collide(self, settings: RunSettings) -> Record:
        """The observed values are kinetic and stored energy over the kinetic energy at the start, and the momentum of
        both along the first axis over that of one."""
        facts, volume = self.facts, math.pi * self.facts["R_m"] ** 2
        bodies = [disc(centre, facts["R_m"], self.cell_size) for centre in facts["centres"]]
        with Stage(self.solid, self.cell_size, settings, sum(map(len, bodies))) as stage:
            ids = np.concatenate(
                [
                    stage.add_body(points, volume, lambda places, v=velocity: np.broadcast_to(v, places.shape))
                    for points, velocity in zip(bodies, facts["velocities"])
                ]
            )
            start = stage.energy(ids)[0]
            one = facts["rho"] * volume * facts["velocities"][0][0]

            def observe() -> list[float]:
                moving, stored = stage.energy(ids)
                return [moving / start, stored / start, stage.world.stats.momentum[0] / one]

            every = max(1, round(settings.rate_hz / 60.0))
            return run(stage, facts["t_end_s"], observe, _SPEED_LIMIT * self.speed, every)

    def contact_time(self, record: Record) -> float | None:
        """When the kinetic energy has begun to fall [s], between two observations; None when they never met."""
        moving = record.values[:, 0]
        fallen = np.flatnonzero(moving < 1.0 - _CONTACT_LOSS)
        if len(fallen) == 0:
            return None
        index = int(fallen[0])
        share = (moving[index - 1] - 1.0 + _CONTACT_LOSS) / (moving[index - 1] - moving[index])
        return float(record.times[index - 1] + share * (record.times[index] - record.times[index - 1]))
