"""Runs a scene: steps, progress, files, pictures, and the figures of the report."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .advising import AdviceHistory, AdviceWatch, advice_lines, advice_rows
from .effects.catalogue import effects_on, remarks
from .frame import Frame
from .machine import machine_facts
from .meter import Meter
from .output import Sequence
from .pictures.drawing import draw_picture
from .pictures.look import Look, look_of, material_colours, save_png
from .pictures.video import Video
from .progress import progress_bar
from .scenes.scene import Scene
from .simulation import RunSettings, Simulation, solved_with, versions

_POSTFIX_EVERY_SECONDS = 0.5
_TIME_TOLERANCE = 1e-9


@dataclass(frozen=True)
class OutputOptions:
    """What a run writes besides its report."""

    folder: Path | None = None
    ply: bool = False
    vtk: bool = False
    mesh: str | None = None
    """Format of files of surfaces, see `meshes.MESH_FORMATS`."""
    every: int = 1
    """Steps between files of particles and surfaces."""
    picture_times: list[float] = field(default_factory=list)
    video: Path | None = None
    """File for an animation."""


@dataclass(frozen=True)
class RunResult:
    """How a run ended."""

    report: dict[str, Any]
    interrupted: bool
    problems: list[str]
    """Checks that failed; empty when all is well."""


class Interrupt:
    """Becomes true at Ctrl-C, so that the run stops between two steps. A second Ctrl-C stops at once."""

    def __init__(self) -> None:
        self.requested = False

    def __bool__(self) -> bool:
        return self.requested

    def _handle(self, _signal: int, _frame: Any) -> None:
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True

    @contextmanager
    def watching(self) -> Iterator[Interrupt]:
        """Listens for Ctrl-C inside the block (only possible on the main thread)."""
        if threading.current_thread() is not threading.main_thread():
            yield self
            return
        previous = signal.signal(signal.SIGINT, self._handle)
        try:
            yield self
        finally:
            signal.signal(signal.SIGINT, previous)


def run_scene(
    scene: Scene,
    settings: RunSettings,
    seconds: float,
    output: OutputOptions,
    warmup_steps: int = 0,
    tell: Callable[[str], None] | None = None,
) -> RunResult:
    """Simulates ``seconds`` of a scene. Timing leaves out the first ``warmup_steps`` steps. ``tell`` gets a line for each advice, before the
    first step, and after the last for what the run added: the worst of each, and when it came true."""
    steps = max(1, math.ceil(seconds * settings.rate_hz - _TIME_TOLERANCE))
    with Simulation(scene, settings) as simulation, Interrupt().watching() as interrupt:
        foreseen = simulation.advice()
        for line in advice_lines(simulation, foreseen) if tell else []:
            tell(f"advice: {line}")
        recorder = _Recorder(scene, settings, output, simulation)
        meter, watch = Meter(warmup_steps), AdviceWatch(simulation, foreseen)
        try:
            _loop(simulation, steps, recorder, meter, watch, interrupt)
        except BaseException:
            recorder.finish("failed", {})
            raise
        problems = simulation.problems()
        advice = {"advice": advice_rows(simulation, foreseen), "advice_after": watch.rows()}
        report = {**_report(scene, settings, simulation, meter, bool(interrupt), problems), **advice}
        for line in watch.lines() if tell else []:
            tell(line)
        recorder.finish("interrupted" if interrupt else "failed" if problems else "complete", report)
    return RunResult(report, bool(interrupt), problems)


def _loop(simulation: Simulation, steps: int, recorder: _Recorder, meter: Meter, watch: AdviceWatch, interrupt: Interrupt) -> None:
    shown, every = 0.0, max(1, round(simulation.settings.rate_hz / AdviceHistory.LOOKS))
    with progress_bar(steps, "step", simulation.scene.name) as bar:
        recorder.after_step(simulation)
        for step in range(steps):
            if interrupt:
                return
            start, cpu_start = time.perf_counter(), time.process_time()
            simulation.step()
            now, cpu_now = time.perf_counter(), time.process_time()
            stats = simulation.stats()
            meter.add(stats, now - start, cpu_now - cpu_start)
            recorder.after_step(simulation)
            if (step + 1) % every == 0 or step + 1 == steps:
                watch.look()
            bar.update()
            if now - shown > _POSTFIX_EVERY_SECONDS and not bar.disable:
                bar.set_postfix_str(f"volume error {100 * stats.volume_error_rms:.1f} %", refresh=False)
                shown = now


class _Recorder:
    """Takes frames and pictures when their time has come."""

    def __init__(self, scene: Scene, settings: RunSettings, output: OutputOptions, simulation: Simulation) -> None:
        self._output = output
        self._pictures = sorted(output.picture_times)
        self._look: Look = look_of(scene, settings.text())
        self._video = Video(output.video) if output.video is not None else None
        self._sequence: Sequence | None = None
        if output.folder is not None:
            facts = _sidecar_facts(scene, settings, simulation)
            self._sequence = Sequence(output.folder, scene.name, facts, output.ply, output.vtk, material_colours(scene), output.mesh or "ply")

    def after_step(self, simulation: Simulation) -> None:
        """To be called before the first step and after each."""
        frame: Frame | None = None
        if self._video is not None and self._video.due(simulation.time):
            frame = simulation.frame()
            self._video.add(draw_picture(frame, self._look))
        if self._sequence is None:
            return
        if (self._output.ply or self._output.vtk or self._output.mesh) and simulation.steps % self._output.every == 0:
            frame = frame or simulation.frame()
            self._sequence.add_frame(frame, simulation.surfaces() if self._output.mesh else None)
        while self._pictures and self._pictures[0] <= simulation.time + _TIME_TOLERANCE:
            frame = frame or simulation.frame()
            self._take_picture(frame, self._pictures.pop(0))

    def _take_picture(self, frame: Frame, wanted: float) -> None:
        assert self._sequence is not None and self._output.folder is not None
        name = f"{self._sequence.name}_t{wanted:07.3f}.png"
        save_png(draw_picture(frame, self._look), self._output.folder / name)
        self._sequence.add_picture(frame.time, name)

    def finish(self, status: str, report: dict[str, Any]) -> None:
        if self._video is not None:
            self._video.save()
        if self._sequence is not None:
            self._sequence.finish(status, report)


def _sidecar_facts(scene: Scene, settings: RunSettings, simulation: Simulation) -> dict[str, Any]:
    return {
        "scene": scene.model_dump(mode="json"),
        "axes": "as in the scene: gravity is a vector; in 2D files the third component is 0",
        "positions_relative_to": list(scene.origin or [0.0] * scene.dimension),
        "seeds": [source.seed for source in scene.sources],
        "materials": list(scene.materials),
        "settings": settings.as_dict(),
        "versions": versions(),
        "machine": machine_facts(simulation.isa, simulation.thread_count),
    }


def _report(
    scene: Scene, settings: RunSettings, simulation: Simulation, meter: Meter, interrupted: bool, problems: list[str]
) -> dict[str, Any]:
    solved = solved_with(scene, settings)
    return {
        "scene": scene.name,
        "dimension": scene.dimension,
        "cell_size": scene.cell_size,
        "notes": scene.notes,
        "effects": effects_on(solved),
        "effect_remarks": remarks(solved),
        **settings.as_dict(),
        **simulation.figures(),
        **meter.figures(settings.dt),
        "interrupted": interrupted,
        "problems": problems,
        "versions": versions(),
        "machine": machine_facts(simulation.isa, simulation.thread_count),
    }
