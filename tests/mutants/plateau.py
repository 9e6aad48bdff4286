"""Studies the constants that no theory gives: what the field tests and the hard cases say of half and of double of each.

    python3 tests/mutants/plateau.py build [--folder build/plateau]
    build/venv/bin/python tests/mutants/plateau.py judge [--folder build/plateau] [--jobs 2]
    python3 tests/mutants/plateau.py keep [--folder build/plateau]

`build` makes a library for each constant whose comment says "by trial", with half and with double of it, and one without a change. It leaves out what
plateaus.json beside this file tells already. `judge` runs with each the field tests at 60 Hz x 5 and the hard cases at their own settings, for minutes
of a core; it can be stopped and goes on. It needs nothing but the folder, this tree and Python, so a larger machine can do it. `keep` adds what it
found to plateaus.json, for constants.py.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from constants import by_trial
from faults import constants

ROOT = Path(__file__).resolve().parents[2]
KEPT = Path(__file__).with_name("plateaus.json")
FACTORS = {"halved": 0.5, "doubled": 2.0}
AS_IT_IS = "as it is"
SUITES = ("field", "hard")
LONGEST = 1800  # [s] of one suite with one library
HARD_CASES = ("-m", "pbmpm", "stability", "--quick", "--solvers", "paper,dual,primal", "--dims", "2", "--processes", "1", "--json")


def build(folder: Path) -> None:
    from mutate import Workplace

    place = Workplace(folder / "work", python=False)
    place.prepare()
    for old in folder.glob("libpbmpm_*"):
        old.unlink()
    index = [{"key": "", "change": AS_IT_IS, "library": save(place.build, folder, 0)}]
    known = kept_so_far()
    for constant in by_trial(constants(place.tree)):
        path = place.tree / constant.file
        sound = path.read_text(encoding="utf-8")
        for change, factor in FACTORS.items():
            if len(known.get(constant.key, {}).get(change, {})) == len(SUITES):
                continue
            lines = sound.split("\n")
            lines[constant.line - 1] = constant.fault(lines[constant.line - 1], factor).after
            path.write_text("\n".join(lines), encoding="utf-8")
            if place.make("pbmpm"):
                index.append({"key": constant.key, "change": change, "library": save(place.build, folder, len(index))})
            print(f"{len(index)}: {constant.name} {change}", flush=True)
        path.write_text(sound, encoding="utf-8")
    (folder / "index.json").write_text(json.dumps(index, indent=1), encoding="utf-8")


def save(built: Path, folder: Path, number: int) -> str:
    """A copy of the library, without names that nobody needs here."""
    name = f"libpbmpm_{number}.so"
    subprocess.run(["strip", "-x", "-o", folder / name, built / "lib/libpbmpm.so"], check=True)
    return name


def studied_keys() -> set[str]:
    """Of the constants by trial, as they are now, and of the library as it is."""
    return {"", *(constant.key for constant in by_trial(constants(ROOT)))}


def kept_so_far() -> dict[str, dict[str, dict[str, dict[str, object]]]]:
    kept = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.is_file() else {}
    return {key: found for key, found in kept.items() if key in studied_keys()}


def judge(folder: Path, jobs: int, suites: list[str]) -> None:
    """Suite by suite, so that a study that is stopped tells the same of all."""
    index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    for suite in suites:
        todo = [it for it in index if not result_of(folder, it, suite).is_file()]
        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda it: look_at(folder, it, suite), todo))


def result_of(folder: Path, entry: dict[str, str], suite: str) -> Path:
    return folder / entry["library"].replace(".so", f".{suite}.json")


def look_at(folder: Path, entry: dict[str, str], suite: str) -> None:
    """What a suite says of one library: by check or run, whether it passed."""
    begin = time.monotonic()
    environment = os.environ | {"PBMPM_LIBRARY": str((folder / entry["library"]).resolve()), "PBMPM_ISA": "sse4"}
    rows_file = result_of(folder, entry, suite).with_suffix(".rows")
    command = [str(ROOT / "tests/field/run.py"), "--settings", "60x5", "--json"] if suite == "field" else [*HARD_CASES]
    rows_file.write_text("[]" if suite == "field" else '{"rows": []}', encoding="utf-8")  # what is left of a library that crashes or never ends
    try:
        subprocess.run([sys.executable, *command, str(rows_file)], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        print(f"{entry['library']} did not end in {LONGEST} s", flush=True)
    rows = json.loads(rows_file.read_text(encoding="utf-8"))
    rows_file.unlink()
    found = {name_of(row): bool(row["passed"]) for row in (rows if suite == "field" else rows["rows"])}
    result_of(folder, entry, suite).write_text(json.dumps(found), encoding="utf-8")
    print(f"{entry['library']} {entry['key']} {entry['change']}, {suite}: {sum(found.values())} of {len(found)} in {time.monotonic() - begin:.0f} s", flush=True)


def name_of(row: dict[str, object]) -> str:
    return " ".join(str(row[part]) for part in ("case", "variant", "what", "solver", "material", "dims") if part in row)


def keep(folder: Path) -> None:
    """Counts of what passed, and what changed sides against the library as it is, of what was judged so far."""
    index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    kept = kept_so_far()
    for suite in SUITES:
        results = [json.loads(it.read_text(encoding="utf-8")) if it.is_file() else None for it in (result_of(folder, entry, suite) for entry in index)]
        base = results[0] or {}
        for entry, result in zip(index, results, strict=True):
            if result is None or entry["key"] not in studied_keys():
                continue
            kept.setdefault(entry["key"], {}).setdefault(entry["change"], {})[suite] = {
                "passed": sum(result.values()),
                "of": len(result),
                "lost": sorted(name for name, passed in base.items() if passed and not result.get(name, False)),
                "won": sorted(name for name, passed in base.items() if not passed and result.get(name, False)),
            }
    KEPT.write_text(json.dumps(kept, indent=0) + "\n", encoding="utf-8")


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("part", choices=("build", "judge", "keep"))
    arguments.add_argument("--folder", type=Path, default=ROOT / "build/plateau")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--suites", nargs="+", choices=SUITES, default=SUITES)
    options = arguments.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.part == "build":
        build(options.folder)
    elif options.part == "judge":
        judge(options.folder, options.jobs, options.suites)
    else:
        keep(options.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
