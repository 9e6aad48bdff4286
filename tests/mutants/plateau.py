"""Studies the constants that no theory gives: what the field tests and the hard cases say of half and of double of each.

    python3 tests/mutants/plateau.py build [--folder build/plateau]
    build/venv/bin/python tests/mutants/plateau.py trace [--folder build/plateau] [--jobs 2]
    build/venv/bin/python tests/mutants/plateau.py judge [--folder build/plateau] [--jobs 2]
    python3 tests/mutants/plateau.py keep [--folder build/plateau]

`build` makes a library for each constant whose comment says "by trial", with half and with double of it, one without a change, and one that notes where
a constant acts (traced.py). `trace` runs the field tests at 60 Hz x 5 and the hard cases at their own settings with the latter and with the library as
it is; their results must be equal. `judge` runs with each changed library those scenes that its constant acts in: elsewhere nothing can change. Both
can be stopped and go on. They need nothing but the folder, this tree and Python, so a larger machine can do it. `keep` writes what was found to
plateaus.json beside this file, for constants.py.
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

from constants import ADVICE, AS_IT_IS, FACTORS, PLATEAUS, ROUNDED, SUITES, by_trial
from faults import constants
from traced import Traced, noted

ROOT = Path(__file__).resolve().parents[2]
LONGEST = 1800  # [s] of one suite with one library
LONGEST_SCENE = {"field": 0.5, ADVICE: 0.5, "hard": 2.0}
"""[s] of the processor. Two thirds of the field tests and half of the hard cases are shorter: 17 and 6 % of the time of all. The others are left out, but for the
shortest where a constant acts in none else. With more here `judge` runs what is missing."""
HARD_CASES = ("-m", "pbmpm", "stability", "--quick", "--solvers", "paper,dual,primal", "--dims", "2", "--processes", "1", "--json")
Rows = dict[str, dict[str, object]]
"""By check or run: whether it passed, and its figure."""


def build_traced(folder: Path) -> None:
    from mutate import Workplace

    place = Workplace(folder / "traced", python=False)
    place.prepare("-O2", "pbmpm")
    traced = Traced(place.tree, by_trial(constants(place.tree)))
    traced.plant()
    options = [f"-DCMAKE_C_FLAGS=-include {place.tree / 'tried.h'} -Wno-shadow", "-DPBMPM_WARNINGS_AS_ERRORS=OFF"]
    subprocess.run(["cmake", *options, place.build], check=True, stdout=subprocess.DEVNULL)
    traced.build(lambda: "" if place.make("-k0", "pbmpm") else (place.build / "make.log").read_text(encoding="utf-8"))
    save(place.build, folder, "traced")
    always = [traced.studied[number].key for number in sorted(traced.always)]
    (folder / "traced.json").write_text(json.dumps({"keys": [it.key for it in traced.studied], "always": always}, indent=1), encoding="utf-8")


def build_changed(folder: Path) -> None:
    from mutate import Workplace

    place = Workplace(folder / "work", python=False)
    place.prepare("-O2", "pbmpm")
    index = [{"key": "", "change": AS_IT_IS, "library": save(place.build, folder, 0)}]
    for constant in sorted(by_trial(constants(place.tree)), key=lambda it: (it.file.startswith("ispc"), it.file.endswith(".h"))):
        path = place.tree / constant.file
        sound = path.read_text(encoding="utf-8")
        for change, factor in FACTORS.items():
            lines = sound.split("\n")
            lines[constant.line - 1] = constant.fault(lines[constant.line - 1], factor).after
            path.write_text("\n".join(lines), encoding="utf-8")
            if place.make("pbmpm"):
                index.append({"key": constant.key, "change": change, "library": save(place.build, folder, len(index))})
            print(f"{len(index)}: {constant.name} {change}", flush=True)
        path.write_text(sound, encoding="utf-8")
    subprocess.run(["cmake", "-DPBMPM_ONE_ISA=OFF", place.build], check=True, stdout=subprocess.DEVNULL)
    place.make("pbmpm")
    index.append({"key": "", "change": ROUNDED, "library": save(place.build, folder, len(index))})
    (folder / "index.json").write_text(json.dumps(index, indent=1), encoding="utf-8")


def save(built: Path, folder: Path, name: object) -> str:
    """A copy of the library, without names that nobody needs here."""
    file = f"libpbmpm_{name}.so"
    subprocess.run(["strip", "-x", "-o", folder / file, built / "lib/libpbmpm.so"], check=True)
    return file


def scenes(folder: Path, suite: str) -> list[str]:
    """What can be run by itself."""
    if suite == ADVICE:
        return [str(it["scene"]) for it in acts_in(folder, {"key": ""}, "field")]
    if suite == "field":
        sys.path.insert(0, str(ROOT / "tests/field"))
        from run import chosen

        return [variant.name for variant in chosen([])]
    from pbmpm.lab.stability.cases.catalogue import CASES

    return sorted({case.id for case in CASES})


def rows_of(library: Path, suite: str, names: list[str], rows_file: Path, **environment: str) -> Rows:
    """What a suite says of one library."""
    command = {
        "field": [str(ROOT / "tests/field/run.py"), *names, "--settings", "60x5", "--json"],
        "hard": [*HARD_CASES[:3], *names, *HARD_CASES[3:]],
        ADVICE: [str(ROOT / "tests/advice_hits.py"), str(ROOT / "tests/field"), *names, "--settings", "60x5", "--json"],
    }[suite]
    rows_file.write_text('{"rows": []}' if suite == "hard" else "[]", encoding="utf-8")  # what is left of a library that crashes or never ends
    known = os.environ | {"PBMPM_LIBRARY": str(library.resolve()), "PBMPM_ISA": "sse4"} | environment
    try:
        subprocess.run([sys.executable, *command, str(rows_file)], env=known, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        print(f"{library.name} did not end in {LONGEST} s", flush=True)
    rows = json.loads(rows_file.read_text(encoding="utf-8"))
    rows_file.unlink()
    return {name_of(row): {"passed": is_right(row), "figure": row.get("value"), "seconds": row.get("cpu_s", row.get("seconds", 0.0))} for row in (rows["rows"] if suite == "hard" else rows)}


def is_right(row: dict[str, object]) -> bool:
    """That a check holds; or of advice, that it warned of one that does not, and of no other."""
    return bool(row["warned"]) != bool(row["passed"]) if "warned" in row else bool(row["passed"])


def name_of(row: dict[str, object]) -> str:
    return " ".join(str(row[part]) for part in ("case", "variant", "what", "solver", "material", "dims") if part in row)


def figures(rows: Rows) -> list[str]:
    return [f"{name}: {row['passed']} {row['figure']}" for name, row in rows.items()]


def trace(folder: Path, jobs: int, suites: list[str]) -> None:
    """Scene by scene: its rows with the library as it is, and the constants that act in it."""
    keys, always = (json.loads((folder / "traced.json").read_text(encoding="utf-8"))[part] for part in ("keys", "always"))
    for suite in suites:
        file = folder / f"acts.{suite}.jsonl"
        done = {json.loads(line)["scene"] for line in file.read_text(encoding="utf-8").splitlines()} if file.is_file() else set()

        def look(scene: str, suite: str = suite, file: Path = file) -> None:
            mark = folder / "".join(it if it.isalnum() else "_" for it in f"{suite}_{scene}")
            plain = rows_of(folder / "libpbmpm_0.so", suite, [scene], mark.with_suffix(".rows"))
            rows = rows_of(folder / "libpbmpm_traced.so", suite, [scene], mark.with_suffix(".rows"), PBMPM_TRACE=str(mark))
            if figures(rows) != figures(plain):
                print(f"{scene}: the library that notes gives other results", flush=True)
            notes = noted(mark)
            acts = {key: [key in always or notes.get(number, (False, False))[i] for i in range(2)] for number, key in enumerate(keys)}
            with file.open("a", encoding="utf-8") as out:
                seconds = [row["seconds"] for row in plain.values()]
                took = sum(seconds) if suite == "hard" else max(seconds, default=0.0)  # rows of a case are runs, those of a field test checks of one run
                out.write(json.dumps({"scene": scene, "seconds": took, "rows": plain, "acts": {key: it for key, it in acts.items() if any(it)}}) + "\n")

        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(look, [scene for scene in scenes(folder, suite) if scene not in done]))


def traces(folder: Path, suite: str) -> list[dict[str, object]]:
    file = folder / f"acts.{suite}.jsonl"
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.is_file() else []


def acts_in(folder: Path, entry: dict[str, str], suite: str) -> list[dict[str, object]]:
    """The scenes where a change can change anything: of those the short ones, or the shortest if none is short."""
    found = traces(folder, suite)
    if entry["key"]:
        side = list(FACTORS).index(entry["change"])
        found = [it for it in found if it["acts"].get(entry["key"], (False, False))[side]]
    return [it for it in found if it["seconds"] <= LONGEST_SCENE[suite]] or sorted(found, key=lambda it: it["seconds"])[:1]


def judge(folder: Path, jobs: int, suites: list[str]) -> None:
    """Suite by suite, so that a study that is stopped tells the same of all; what takes least comes first."""
    index = [it for it in json.loads((folder / "index.json").read_text(encoding="utf-8")) if it["change"] != AS_IT_IS]
    for suite in suites:
        todo = [it for it in index if suite != ADVICE or is_of_advice(it)]
        todo.sort(key=lambda it: len(acts_in(folder, it, suite)))
        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda it: look_at(folder, it, suite), todo))


def is_of_advice(entry: dict[str, str]) -> bool:
    return "/advi" in entry["key"]


def result_of(folder: Path, entry: dict[str, str], suite: str) -> Path:
    return folder / entry["library"].replace(".so", f".{suite}.json")


def look_at(folder: Path, entry: dict[str, str], suite: str) -> None:
    begin = time.monotonic()
    file = result_of(folder, entry, suite)
    known: Rows = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    names = [str(it["scene"]) for it in acts_in(folder, entry, suite) if not known.keys() >= it["rows"].keys()]
    if names:
        known |= rows_of(folder / entry["library"], suite, names, file.with_suffix(".rows"), PBMPM_ISA="avx2" if entry["change"] == ROUNDED else "sse4")
        passed = sum(bool(row["passed"]) for row in known.values())
        print(f"{entry['library']} {entry['key']} {entry['change']}, {suite}: {len(names)} scenes, {passed} of {len(known)} in {time.monotonic() - begin:.0f} s", flush=True)
    file.write_text(json.dumps(known), encoding="utf-8")


def keep(folder: Path) -> None:
    """Counts of what passed, and what changed sides against the library as it is, of what was judged so far."""
    index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    kept: dict[str, dict[str, dict[str, object]]] = {}
    for suite in (*SUITES, ADVICE):
        for entry in index:
            file = result_of(folder, entry, suite)
            as_it_is = entry["change"] == AS_IT_IS
            if not as_it_is and not file.is_file():
                continue
            seen = acts_in(folder, entry, suite)
            base: Rows = {name: row for it in seen for name, row in it["rows"].items()}
            changed: Rows = base if as_it_is else json.loads(file.read_text(encoding="utf-8"))
            now = {name: bool(changed[name]["passed"]) if name in changed else False for name in base}
            kept.setdefault(entry["key"], {}).setdefault(entry["change"], {})[suite] = {
                "scenes": len(seen),
                "passed": sum(now.values()),
                "of": len(base),
                "lost": sorted(name for name, row in base.items() if row["passed"] and not now[name]),
                "won": sorted(name for name, row in base.items() if not row["passed"] and now[name]),
            }
    PLATEAUS.write_text(json.dumps(kept, indent=0) + "\n", encoding="utf-8")


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("part", choices=("build", "trace", "judge", "keep"))
    arguments.add_argument("--folder", type=Path, default=ROOT / "build/plateau")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--suites", nargs="+", choices=(*SUITES, ADVICE), default=(*SUITES, ADVICE))
    options = arguments.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.part == "build":
        build_traced(options.folder)
        build_changed(options.folder)
    elif options.part == "trace":
        trace(options.folder, options.jobs, options.suites)
    elif options.part == "judge":
        judge(options.folder, options.jobs, options.suites)
    else:
        keep(options.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
