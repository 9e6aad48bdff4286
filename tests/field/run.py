#!/usr/bin/env python3
"""Runs the field tests: ordinary scenes at the pace of a game, against truth.

    python tests/field/run.py [CASE...] [--settings 60x5,240x5] [--solver convergent] [--json FILE] [--known] [--list]

CASE is the name of a room (water), of a case (still_pool) or of a variant (still_pool[turned_10_boxes]). Prints one row per
check: case, setting, figure, band, CPU milliseconds per simulated second (one thread). Exit status 1 if a check misses.
--known writes known_misses.json, what test_field.py expects to fail. Run it with an environment that has pbmpm installed (build/venv/bin/python).
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import mixed  # noqa: F401 - the rooms register their cases
import sand  # noqa: F401
import solids  # noqa: F401
import water  # noqa: F401
from harness import VARIANTS, Run, Variant, settings


def chosen(names: list[str]) -> list[Variant]:
    """The variants that the names stand for; all without names."""
    known = {word for variant in VARIANTS for word in (variant.room, variant.case, variant.name)}
    strange = [name for name in names if name not in known]
    if strange:
        sys.exit(f"run.py: there is no room, case or variant called {', '.join(strange)}; see --list")
    wanted = set(names)
    return [v for v in VARIANTS if not wanted or wanted & {v.room, v.case, v.name}]


def line(row: dict) -> str:
    """One check for people."""
    mark = "ok  " if row["passed"] else "MISS"
    name = f"{row['case']}[{row['variant']}]"
    band = f"[{row['low']:.4g}, {row['high']:.4g}]"
    return f"{mark} {name:38} {row['setting']:6} {row['what']}: {row['value']:.4g} {row['unit']} {band}  {row['cpu_ms_per_simulated_second']} ms/s"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--settings", default="60x5,240x5")
    parser.add_argument("--solver", default="convergent")
    parser.add_argument("--json")
    parser.add_argument("--known", action="store_true", help="write known_misses.json")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    if options.known and (options.cases or options.settings != "60x5" or options.solver != "convergent"):
        parser.error("--known writes what all cases miss at --settings 60x5 with the default solver, which is what test_field.py runs")
    variants = chosen(options.cases)
    if options.list:
        for variant in variants:
            print(f"{variant.room:8}{variant.name:40}{(variant.function.__doc__ or '').splitlines()[0]}")
        return 0
    rows = []
    for variant in variants:
        for rate, iterations in settings(options.settings):
            run = Run(variant, rate, iterations, options.solver).go()
            for row in run.rows:
                row["cpu_ms_per_simulated_second"] = round(1e3 * run.cpu / max(run.simulated, 1e-9), 1)
                row["cpu_s"] = round(run.cpu, 3)
                print(line(row), flush=True)
            rows += run.rows
    missed = sum(not row["passed"] for row in rows)
    print(f"{len(rows) - missed} of {len(rows)} checks inside their bands")
    if options.known:
        misses: dict[str, list[str]] = {}
        for row in rows:
            if not row["passed"]:
                misses.setdefault(f"{row['case']}[{row['variant']}]", []).append(row["what"])
        (Path(__file__).parent / "known_misses.json").write_text(json.dumps(misses, indent=1) + "\n", encoding="utf-8")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
