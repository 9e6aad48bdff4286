"""One timed run of a scene at a setting."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from ..meter import Meter, stepping_clock
from ..scenes.scene import Scene
from ..simulation import Simulation
from .case import Measurement, Setting
from ..stability.judge import StabilityJudge

Observer = Callable[[Simulation], None]


class Trial:
    """A run: what it cost, whether it was stable.

    ``prepare`` may change the particles before the first step. ``observe`` is called before the first step and after
    each ``every``-th and the last one; its time does not count. The run ends early when it breaks. ``judge`` goes on with
    the verdict of a run before.
    """

    def __init__(
        self,
        scene: Scene,
        setting: Setting,
        seconds: float,
        *,
        start_energy: Callable[[Simulation], float] | None = None,
        prepare: Observer | None = None,
        observe: Observer | None = None,
        every: int = 1,
        judge: StabilityJudge | None = None,
    ) -> None:
        self.setting = setting
        self.meter, self.judge = Meter(), judge or StabilityJudge()
        self._clock = stepping_clock(setting.threads)
        self.steps = max(1, math.ceil(seconds * setting.rate_hz - 1e-9))
        with Simulation(scene, setting.run_settings()) as simulation:
            if prepare is not None:
                prepare(simulation)
            if start_energy is not None:
                self.judge.begin(start_energy(simulation))
            if observe is not None:
                observe(simulation)
            for step in range(1, self.steps + 1):
                self._step(simulation)
                if self.judge.broken:
                    break
                if observe is not None and (step % every == 0 or step == self.steps):
                    observe(simulation)

    def _step(self, simulation: Simulation) -> None:
        start = self._clock()
        simulation.step()
        seconds = self._clock() - start
        stats = simulation.world.stats
        self.meter.add(stats, seconds)
        self.judge.watch(stats)

    def measurement(self, errors: Mapping[str, float | None], **more: Any) -> Measurement:
        """The measurement of a case that consists of this run alone. Errors of a run that broke are dropped."""
        broken = self.judge.broken
        figures = {
            "volume_error_rms": self.meter.volume_error_rms,
            "energy_peak": self.judge.energy_peak,
            "stops": dict(self.meter.stops),
        }
        return Measurement(
            errors=dict.fromkeys(errors) if broken else dict(errors),
            ms_per_simulated_second=self.meter.ms_per_simulated_second(self.setting.dt),
            iterations_used=self.meter.mean_iterations_used,
            predicted_error=self.meter.mean_predicted_error,
            stable=not self.judge.reasons,
            reasons=self.judge.reasons,
            extra={**figures, **more.pop("extra", {})},
            **({} if broken else more),
        )
