#!/usr/bin/env python3
"""How often advice is right: hits and false alarms over the field cases.

    build/venv/bin/python tests/advice_hits.py PATH [CASE...] [--settings 60x5,240x5] [--json FILE]

PATH is a file of field cases, or tests/field for their variations: ordinary scenes, and checks of what a stranger would see. Each world is asked for advice before its first step and as
``pbmpm run`` does on the way. A check counts as warned of if a record of a code that speaks of what it measures came with a world since the check before it belonged to. Printed
are each check with the codes, hits (misses of the band that were warned of) and false alarms (checks inside their band that were); exit
status 1 if less than 90 % of the misses are warned of, or more than 10 % of the others are."""

from __future__ import annotations

import argparse
import importlib.util
import json
import re
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

from pbmpm.lab.advising import AdviceHistory

CODES = {
    "volume": {"POOL_TOO_DEEP", "VOLUME_LOST", "STRAIN_CLAMPED"},
    "leak": {"COLLIDER_TOO_COARSE", "COLLIDER_TOO_FAST", "STEP_TOO_LONG", "VOLUME_LOST", "POOL_TOO_DEEP"},
    "jet": {"NOT_SOLVED", "STEP_TOO_LONG"},
    "calm": {"POOL_STIRS", "POOL_TOO_DEEP", "COLLIDER_TOO_COARSE", "COLLIDER_TOO_THIN", "COLLIDER_TOO_FAST"},
    "energy": {"POOL_STIRS", "POOL_TOO_DEEP"},
    "grains": {"SAND_NOT_HELD", "STRAIN_CLAMPED", "VOLUME_LOST"},
    "heaps": set(),
    "grains at rest": {"SAND_NOT_HELD"},
    "flow": {"SAND_NOT_HELD"},
    "slope": set(),
    "start": set(),
    "on sand": set(),
    "rolling": {"ROLLING_BRAKED", "MODULUS_NOT_HELD"},
    "contact": {"MODULUS_NOT_HELD", "BODY_TOO_THIN", "STRAIN_CLAMPED"},
    "bounce": {"BOUNCE_DAMPED", "MODULUS_NOT_HELD"},
    "spin": set(),
    "contact time": {"MODULUS_NOT_HELD"},
    "modulus": {"MODULUS_NOT_HELD", "NOT_SOLVED"},
    "afloat": {"BODY_TOO_THIN", "VOLUME_LOST", "POOL_TOO_DEEP"},
}
"""Codes that speak of a subject."""

LIMITS = {
    "grains": "volume|sand in liquid does not settle",
    "heaps": "crushed",
    "grains at rest": "stirring",
    "start": "too steep",
    "contact": "tips|hangs on",
    "spin": "turns by itself",
    "on sand": "on sand",
    "calm": "goes on|go on",
    "afloat": "in a liquid|film",
    "bounce": "bounces",
    "modulus": "stays squeezed",
}
"""What the text of a KNOWN_LIMIT says if it speaks of a subject. That of SAND_NOT_HELD tells if it speaks of slopes or of what runs out."""

SUBJECTS = (
    (r"^far_away", "modulus"),
    (r"^hourglass.*as soon as half", "heaps"),
    (r"^(jelly|rigid)_on_sand.*(height of the cube|tilt|height, off)", "on sand"),
    (r"^jelly_on_sand.*rms speed|^tilted_tray.*up to 3 degrees below", "grains at rest"),
    (r"^(all_in_a_tank|jelly_in_a_glass).*level", "afloat"),
    (r"discharge", "jet"),
    (r"^(silo|hourglass).*(flow over|flow later|flow at|seconds)", "flow"),
    (r"^tilted_tray.*angle at which", "start"),
    (r"^(pile|tilted_tray|layer|column|funnel|heap|sand_column)[^:]*: .*(slope|steepness|angle at|angle of|run-out|way of its centre|front along)", "slope"),
    (r"^(silo|sand|bin|pile|layer|column|poured|falls|hourglass|funnel|tilted_tray)[^:]*: .*(rms speed|creep)", "grains at rest"),
    (r"^sand_in_water[^:]*: level", "volume"),
    (r"^falls_from", "contact"),
    (r"silo|sand|heap|^bin|^pile|^layer|^column|^poured|^falls|^hourglass|^funnel|^tilted_tray", "grains"),
    (r"^rolling", "rolling"),
    (r"contact time", "contact time"),
    (r"restitution", "bounce"),
    (r"\btip\b|modulus|stretch|strain", "modulus"),
    (r"^rigid_[^:]*: mean spin", "spin"),
    (r"share of the jelly|share below the level|^sinks|^in_a_narrow_glass|^rigid_(box|cube|ball)|lift over|place of the block|^wide_raft", "afloat"),
    (r"inside the jelly|below (a|the) floor|has left|behind the wall|pool's share", "leak"),
    (r"speed over true|way over|creep|spin|collision|^stack|^lies_on|^disc_on|^tall_block|^clay", "contact"),
    (r"energy", "energy"),
    (r"rms speed", "calm"),
    (r"", "volume"),
)
"""Of checks, by case and words."""


def subject_of(case: str, check: str) -> str:
    return next(subject for pattern, subject in SUBJECTS if re.search(pattern, f"{case}: {check}"))


def speaks(subject: str, item: Any) -> bool:
    name = item.code.name
    if name == "SAND_NOT_HELD" and "too flat" in item.text:
        return subject == "slope"
    if name == "SAND_NOT_HELD" and "hole" in item.text:
        return subject == "flow"
    return name in CODES[subject] or (name == "KNOWN_LIMIT" and subject in LIMITS and re.search(LIMITS[subject], item.text) is not None)


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("field", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Watched:
    """A world that is asked for advice before its first step and on the way, as ``pbmpm run`` asks."""

    def __init__(self, world: Any, rate: float) -> None:
        self.first = world.advice(1 / rate)
        self._world, self._rate, self._steps = world, rate, 0
        self._every = max(1, round(rate / AdviceHistory.LOOKS))
        self._history = AdviceHistory(self.first)

    def step(self, dt: float) -> None:
        self._world.step(dt)
        self._steps += 1
        if self._steps % self._every == 0:
            self._look()

    def _look(self) -> None:
        self._history.look(self._world.advice(1 / self._rate), self._steps / self._rate)

    def told(self) -> list[Any]:
        if self._steps % self._every:
            self._look()
        return [item for item, _ in self._history.told()]

    def __getattr__(self, name: str) -> Any:
        return getattr(self._world, name)


def listening(run: type, name_of: Callable[[Any], str]) -> type:
    """The field cases' run, which asks for advice around the steps of a world."""

    class Run(run):  # type: ignore[misc,valid-type]
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)
            self.before: list[Any] = []
            self.after: list[Any] = []
            self.checked = False

        def world(self, *arguments: Any, **more: Any) -> Any:
            if self.checked:
                self.before, self.after, self.checked = [], [], False
            return super().world(*arguments, **more)

        def steps(self, world: Any, *arguments: Any, **more: Any) -> None:
            watched = Watched(world, self.rate)
            super().steps(watched, *arguments, **more)
            self.before += watched.first
            self.after = watched.told()

        def check(self, what: str, *arguments: Any, **more: Any) -> None:
            super().check(what, *arguments, **more)
            self.checked = True
            row = self.rows[-1]
            row["subject"] = subject_of(name_of(self), what)
            row["before"] = sorted({item.code.name for item in self.before})
            row["after"] = sorted({item.code.name for item in self.after})
            row["warned"] = sorted({item.code.name for item in self.before + self.after if speaks(row["subject"], item)})
            row["foreseen"] = sorted({item.code.name for item in self.before if speaks(row["subject"], item)})

    return Run


def runs_of(path: Path) -> dict[str, Callable[..., Any]]:
    """What runs each case at a rate, with so many iterations and a solver."""
    if path.is_dir():
        sys.path.insert(0, str(path))
        harness = importlib.import_module("harness")
        for room in ("water", "solids", "sand", "mixed"):
            importlib.import_module(room)
        variations = listening(harness.Run, lambda run: run.variant.name)
        return {variant.name: lambda *setting, variant=variant: variations(variant, *setting).go() for variant in harness.VARIANTS}
    field = load(path)
    cases = listening(field.Run, lambda run: run.name)

    def go(name: str, *setting: Any) -> Any:
        run = cases(name, *setting)
        field.CASES[name](run)
        return run

    return {name: partial(go, name) for name in field.CASES}


def show(row: dict[str, Any]) -> None:
    said = ", ".join(row["warned"]) or "-"
    print(f"{'ok  ' if row['passed'] else 'MISS'} {row['case']:19} {row['setting']:6} {row['what']}: {row['value']:.4g} [{row['low']:g}, {row['high']:g}]  {said}", flush=True)


def tell(rows: list[dict[str, Any]]) -> bool:
    misses, right = [row for row in rows if not row["passed"]], [row for row in rows if row["passed"]]
    hits, alarms = [row for row in misses if row["warned"]], [row for row in right if row["warned"]]
    foreseen = [row for row in misses if row["foreseen"]]
    print(f"\nhits: {len(hits)} of {len(misses)} misses were warned of, {len(foreseen)} of them before the first step")
    print(f"false alarms: {len(alarms)} of {len(right)} checks that are right")
    return len(hits) >= 0.9 * len(misses) and len(alarms) <= 0.1 * len(right)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("field", type=Path, help="the file of the field cases")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--settings", default="60x5,240x5")
    parser.add_argument("--solver", default="convergent")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    runs, rows = runs_of(options.field), []
    for name in options.cases or runs:
        for setting in options.settings.split(","):
            rate, iterations = setting.split("x")
            run = runs[name](float(rate), int(iterations), options.solver)
            for row in run.rows:
                show(row)
            rows += run.rows
            if options.json:
                options.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    return 0 if tell(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
