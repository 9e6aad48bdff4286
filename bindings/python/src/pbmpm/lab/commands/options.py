"""What the commands have in common: exit codes, kinds of options, and where reports go."""

from __future__ import annotations

import contextlib
import math
import os
import re
import shlex
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import click

from ..errors import InputError
from ..hints import not_one_of
from ..names import IntegratorName, PressureName, SolverName

if TYPE_CHECKING:
    from ..scenes.scene import Scene
    from ..simulation import RunSettings
    from ..workers.workers import Workers

EXIT_CHECK_FAILED = 1
EXIT_USAGE = 2
EXIT_INTERRUPTED = 130

JSON_HELP = "Write the figures as JSON to this file, or to standard output with '-'."


def own_command() -> str:
    """The command line that is running, for reports."""
    return shlex.join(["pbmpm", *sys.argv[1:]])


def own_options(but: Sequence[str], arguments: Sequence[str]) -> str:
    """The options of the command line that is running, without some (each with its value) and without the arguments."""
    words, kept = iter(sys.argv[2:]), []
    for word in words:
        if word in but:
            next(words, None)
        elif word not in arguments:
            kept.append(word)
    return shlex.join(kept)


def emit_json(data: dict[str, Any], target: str | None) -> None:
    """Writes a report where ``--json`` says; nothing without the option."""
    from ..files import json_text, write_json

    if target == "-":
        print(json_text(data))
    elif target is not None:
        write_json(data, Path(target))


def ready_folder(folder: Path) -> None:
    """Makes a folder that is missing; InputError where files cannot be written to it. If the command leaves it empty, it goes again."""
    in_the_way = next((part for part in (folder, *folder.parents) if part.exists() and not part.is_dir()), None)
    if in_the_way is not None:
        raise InputError(f"{in_the_way}: is a file, not a folder")
    missing = [part for part in (folder, *folder.parents) if not part.exists()]
    context = click.get_current_context(silent=True)
    if context is not None and missing:
        context.find_root().call_on_close(lambda: remove_empty(missing))
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: cannot be made: {error.strerror}") from None
    if not os.access(folder, os.W_OK):
        raise InputError(f"{folder}: cannot be written to")


def remove_empty(folders: Sequence[Path]) -> None:
    """Takes away what no file was written to; inner folders come first."""
    with contextlib.suppress(OSError):
        for folder in folders:
            folder.rmdir()


def ready_file(path: Path) -> None:
    """The same for the folder of a file, which may not be a folder itself."""
    if path.is_dir():
        raise InputError(f"{path}: is a folder")
    ready_folder(path.parent)


class Number(click.FloatRange):
    """A number between bounds."""

    name = "number"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        number = super().convert(value, param, ctx)
        if math.isnan(number):
            self.fail(f"'{value}' is not a valid number.", param, ctx)
        return number


class WholeNumber(click.IntRange):
    """A whole number between bounds."""

    name = "whole number"


class TimeList(click.ParamType):
    """Times in seconds separated by commas."""

    name = "t1,t2,..."

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[float]:
        try:
            times = [float(part) for part in str(value).split(",") if part.strip()]
        except ValueError:
            self.fail(f"'{value}' is not a list of times like 0,0.5,1", param, ctx)
        if not all(0 <= time < float("inf") for time in times):
            self.fail("times must be finite and not negative", param, ctx)
        return times


class NumberList(click.ParamType):
    """Numbers above zero separated by commas."""

    name = "n1,n2,..."

    def __init__(self, kind: type, highest: float) -> None:
        self._kind, self._highest = kind, highest

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[Any]:
        try:
            numbers = [self._kind(part) for part in str(value).split(",")]
        except ValueError:
            self.fail(f"'{value}' is not a list of numbers like 30,60,120", param, ctx)
        if not all(0 < number <= self._highest for number in numbers):
            self.fail(f"numbers must be above 0 and at most {self._highest:g}", param, ctx)
        return sorted(set(numbers))


class NameList(click.ParamType):
    """Words out of a few, separated by commas; kept in the order of the few."""

    name = "w1,w2,..."

    def __init__(self, words: Sequence[str]) -> None:
        self._words = tuple(words)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        wanted = {part.strip() for part in str(value).split(",")}
        unknown = sorted(wanted - set(self._words))
        if unknown:
            self.fail(not_one_of(unknown[0], self._words), param, ctx)
        return tuple(word for word in self._words if word in wanted)


def pace_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options that say how often the equations are solved; None where the scene decides."""
    options = (
        click.option("--rate", type=Number(0.1, 1e6), help="Steps per simulated second.  [default: the scene's]"),
        click.option("--iterations", type=WholeNumber(1, 1000), help="Iterations per substep.  [default: the scene's]"),
        click.option("--substeps", type=WholeNumber(1, 256), help="Substeps per step.  [default: the scene's]"),
    )
    return _with_options(command, options)


def _with_options(command: Callable[..., Any], options: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    for option in reversed(options):
        command = option(command)
    return command


def solver_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options that say how the equations are solved; None where the scene decides."""
    options = (
        click.option(
            "--solver", type=choice_of(SolverName), help="How the equations are solved.  [default: the scene's]"
        ),
        click.option(
            "--pressure", type=choice_of(PressureName), help="Dual solver: calm (particles) or lively (cells)."
        ),
        click.option("--integrator", type=choice_of(IntegratorName), help="Primal solver: order in time."),
        click.option("--flip", type=Number(0, 1), help="Share of the finest motion that liquids keep."),
        click.option(
            "--target-error", type=Number(0, 1), help="Iterate to this predicted error [cells]; 0: off."
        ),
        click.option(
            "--time-budget-ms",
            type=Number(0, 1e6),
            help="Iterate for this wall time per step [ms]; 0: off. Not deterministic.",
        ),
    )
    return _with_options(command, options)


def preset_option(command: Callable[..., Any]) -> Callable[..., Any]:
    """The option that names a file with settings."""
    text = "Settings from a file that 'pbmpm tune' wrote; other options go before it."
    return click.option("--preset", type=click.Path(path_type=Path), metavar="FILE", help=text)(command)


class Address(click.ParamType):
    """Where a Dask scheduler listens."""

    name = "address"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        if not re.fullmatch(r"(tcp|tls)://[^\s/]+:\d+", str(value)):
            self.fail(f"'{value}' is not an address like tcp://HOST:8786", param, ctx)
        return str(value)


def worker_options(default: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """The options that say who carries out runs; ``default`` tells how many processes there are without them."""

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        command = click.option(
            "--scheduler", type=Address(), help="Of a Dask cluster, whose workers carry out the runs: tcp://HOST:8786."
        )(command)
        return click.option(
            "--processes", type=WholeNumber(1, 256), help=f"Runs at the same time on this machine.  [default: {default}]"
        )(command)

    return decorate


def chosen_workers(processes: int | None, scheduler: str | None, default: int) -> Workers:
    """What `worker_options` chose."""
    from ..workers.workers import Workers

    if processes is not None and scheduler is not None:
        raise click.UsageError("--processes are of this machine: they do not go with --scheduler")
    return Workers(processes or default, scheduler)


def chosen_timed_workers(processes: int | None, scheduler: str | None, threads: int) -> Workers:
    """The same for runs whose times count: one after the other where nothing is said."""
    workers = replace(chosen_workers(processes, scheduler, 1), timed=True)
    if workers.several and threads != 1:
        raise click.UsageError("runs at the same time have a core each: they need --threads 1")
    return workers


class Word(click.Choice):
    """One word out of a few."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value not in self.choices:
            self.fail(not_one_of(value, self.choices), param, ctx)
        return super().convert(value, param, ctx)


def choice_of(names: Any) -> click.Choice:
    """The members of a Literal as a choice."""
    return Word(get_args(names))


class OutputFile(click.ParamType):
    """A file that a command will write: its folder is made and tried before any work. A Path; with ``dash`` a word, which may be "-".
    ``suffix``: what its name has to end in."""

    name = "file"

    def __init__(self, dash: bool = False, suffix: str = "") -> None:
        self._dash, self._suffix = dash, suffix

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str | Path:
        if not str(value).lower().endswith(self._suffix):
            self.fail(f"{value}: its name has to end in {self._suffix}", param, ctx)
        if not (self._dash and value == "-"):
            try:
                ready_file(Path(value))
            except InputError as problem:
                self.fail(str(problem), param, ctx)
        return str(value) if self._dash else Path(value)


class OutputFolder(click.ParamType):
    """A folder that a command will fill: it is made and tried before any work."""

    name = "directory"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Path:
        try:
            ready_folder(Path(value))
        except InputError as problem:
            self.fail(str(problem), param, ctx)
        return Path(value)


_SETTINGS = {"rate": "rate_hz"} | {
    name: name
    for name in ("substeps", "iterations", "solver", "pressure", "integrator", "flip", "target_error", "time_budget_ms")
}
"""Options and the fields of `RunSettings` that they set."""


def run_settings(scene: Scene, options: dict[str, Any]) -> RunSettings:
    """What a scene asks for, but for a preset's settings and, before these, for what the options of a command say."""
    from ..scenes.preset import load_preset
    from ..simulation import RunSettings

    preset = load_preset(options["preset"]).settings.changes() if options.get("preset") else {}
    given = {field: options[name] for name, field in _SETTINGS.items() if options.get(name) is not None}
    return RunSettings.of(scene, options["threads"], **{**preset, **given})
