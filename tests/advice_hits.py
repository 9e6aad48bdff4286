#!/usr/bin/env python3
"""How often advice is right: hits and false alarms over the field cases.

    build/venv/bin/python tests/advice_hits.py PATH/field.py [CASE...] [--settings 60x5,240x5] [--json FILE]

PATH/field.py makes ordinary scenes and checks what a stranger would see. Each world is asked for advice before its first step and after its last. A
check counts as warned of if a record of a code that speaks of what it measures came with a world since the check before it belonged to. Printed
are each check with the codes, hits (misses of the band that were warned of) and false alarms (checks inside their band that were); exit
status 1 if less than 90 % of the misses are warned of, or more than 10 % of the others are."""

from __future__ import annotations

import argparse
import importlib.util
import json
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

CODES = {
    "volume": {"POOL_TOO_DEEP", "VOLUME_LOST", "COLLIDER_TOO_THIN", "STRAIN_CLAMPED"},
    "leak": {"COLLIDER_TOO_THIN", "COLLIDER_TOO_FAST", "STEP_TOO_LONG", "VOLUME_LOST", "POOL_TOO_DEEP"},
    "calm": {"POOL_STIRS", "POOL_TOO_DEEP", "COLLIDER_TOO_THIN", "COLLIDER_TOO_FAST"},
    "grains": {"SAND_NOT_HELD", "STRAIN_CLAMPED", "VOLUME_LOST"},
    "contact": {"MODULUS_NOT_HELD", "BODY_TOO_THIN", "ROLLING_BRAKED", "STRAIN_CLAMPED"},
    "bounce": {"BOUNCE_DAMPED", "MODULUS_NOT_HELD"},
    "modulus": {"MODULUS_NOT_HELD", "NOT_SOLVED"},
    "afloat": {"BODY_TOO_THIN", "VOLUME_LOST", "POOL_TOO_DEEP"},
}
"""Codes that speak of a subject."""

SUBJECTS = (
    (r"silo|sand|heap", "grains"),
    (r"restitution|contact time", "bounce"),
    (r"tip|modulus", "modulus"),
    (r"share of the jelly", "afloat"),
    (r"below a floor", "leak"),
    (r"speed over true", "contact"),
    (r"rms speed|kinetic energy", "calm"),
    (r"level|centre of mass|discharge", "volume"),
)
"""Of checks, by case and words."""


def subject_of(case: str, check: str) -> str:
    return next(subject for pattern, subject in SUBJECTS if re.search(pattern, f"{case}: {check}"))


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("field", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def listening(field: Any) -> type:
    """The field cases' run, which asks for advice around the steps of a world."""

    class Run(field.Run):  # type: ignore[misc]
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)
            self.before: list[Any] = []
            self.after: list[Any] = []
            self.checked = False

        def world(self, *arguments: Any, **more: Any) -> Any:
            if self.checked:
                self.before, self.after, self.checked = [], [], False
            return super().world(*arguments, **more)

        def steps(self, world: Any, seconds: float, each: Any = None) -> None:
            self.before += world.advice(1 / self.rate)
            super().steps(world, seconds, each)
            self.after = world.advice(1 / self.rate)

        def check(self, what: str, *arguments: Any) -> None:
            super().check(what, *arguments)
            self.checked = True
            row = self.rows[-1]
            row["subject"] = subject_of(self.name, what)
            row["before"] = sorted({item.code.name for item in self.before})
            row["after"] = sorted({item.code.name for item in self.after})
            row["warned"] = sorted(CODES[row["subject"]] & {*row["before"], *row["after"]})
            row["foreseen"] = sorted(CODES[row["subject"]] & {*row["before"]})

    return Run


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
    field = load(options.field)
    run_type, rows = listening(field), []
    for name in options.cases or field.CASES:
        for setting in options.settings.split(","):
            rate, iterations = setting.split("x")
            run = run_type(name, float(rate), int(iterations), options.solver)
            field.CASES[name](run)
            for row in run.rows:
                show(row)
            rows += run.rows
            if options.json:
                options.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    return 0 if tell(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
