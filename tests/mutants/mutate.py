"""Plants faults in the sources, one at a time, and asks which of them the tests find.

Each worker has a copy of the tree with a build of its own. A fault is found when a test fails or takes far longer than it should; what does not
compile does not count, nor what equivalent.txt says cannot be found. Tests run one after another, those first that speak of the file, found most and
take least, until their time is spent. Verdicts are kept in a file, so a run that was stopped goes on where it was, and the last one can be looked at
again. Times are those of the processor, so other work on the machine changes no verdict. The exit status is 1 when less than 90 % were found.
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from constants import known_verdicts
from faults import Fault, choose, constant_faults, equivalents

ROOT = Path(__file__).resolve().parents[2]
LEAST = 0.9
#: Neither fast nor about a fault in src or ispc.
LEFT_OUT = ("csharp", "consumer", "materials", "cost", "abi", "samples", "fuzz", "strict", "rooms")
PYTHON_TESTS = ("physics", "primal", "islands", "joint", "contact", "impact", "granular", "forces", "flow", "queries", "sleep", "predicted_error", "deep_solids", "mixed")


@dataclass
class Test:
    name: str
    command: list[str]
    environment: dict[str, str] = field(default_factory=dict)
    seconds: float = 0.0
    text: str = ""  #: its source

    def limit(self) -> float:
        return 10.0 + 8.0 * self.seconds

    def cost(self, fault: Fault, found: int) -> float:
        """What finding a fault takes, about; a test that found none yet is given the benefit of half of one."""
        words = re.split(r"[_.]", Path(fault.file).stem)
        lines = len(re.findall("|".join(rf"\b[a-z_]*{word.removesuffix('s')}" for word in words), self.text))
        return (self.seconds + 0.05) / (found + 0.5) / (1 + lines)

    def run(self, folder: Path, limit: float) -> tuple[str, float]:
        """Nothing if it passes, else what it says; and the seconds that it took of the processor, `limit` at most."""

        def bound() -> None:
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit) + 1, int(limit) + 2))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with tempfile.TemporaryFile("w+", errors="replace") as output:
            process = subprocess.Popen(
                self.command, cwd=folder, env=os.environ | self.environment, stdout=output, stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=bound
            )
            hangs = threading.Timer(60.0 + 20.0 * limit, lambda: os.killpg(process.pid, signal.SIGKILL))
            hangs.start()
            _, status, used = os.wait4(process.pid, 0)
            hangs.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            lines = [line for line in output.read().splitlines() if ":FAIL" in line or line.startswith("FAILED")]
        seconds = used.ru_utime + used.ru_stime
        if process.returncode in (0, 77):
            return "", seconds
        if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return f"no end after {seconds:.0f} s", seconds
        return (lines or [f"exit status {process.returncode}"])[0].strip()[:300], seconds


class Workplace:
    """A copy of the tree, built."""

    def __init__(self, folder: Path, python: bool) -> None:
        self.tree = folder / "tree"
        self.build = folder / "build"
        self.python = python

    def prepare(self, optimized: str = "-O1", target: str = "all") -> None:
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True, capture_output=True, text=True)
        for name in filter(None, files.stdout.split("\0")):
            source, copy = ROOT / name, self.tree / name
            if not source.is_file():
                continue
            if not copy.is_file() or copy.read_bytes() != source.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_bytes(source.read_bytes())
        options = ["CMAKE_BUILD_TYPE=Release", f"CMAKE_C_FLAGS_RELEASE={optimized}", "PBMPM_ONE_ISA=ON", "PBMPM_SAMPLES=OFF", "PBMPM_INSTALL=OFF", "PBMPM_MCS=OFF"]
        options += ["CMAKE_LINK_DEPENDS_NO_SHARED=ON"]  # a fault in a library is linked once
        subprocess.run(["cmake", "-G", "Ninja", "-S", self.tree, "-B", self.build, *[f"-D{it}" for it in options]], check=True, stdout=subprocess.DEVNULL)
        if not self.make(target):
            raise SystemExit(f"the sources as they are do not build: {self.build}")
        self.rules = (self.build / "build.ninja").read_text(encoding="utf-8")

    def make(self, *targets: str, limit: float = 36000.0) -> bool:
        try:
            done = subprocess.run(["ninja", "-C", self.build, "-j1", *targets], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit)
        except subprocess.TimeoutExpired:
            return False
        (self.build / "make.log").write_bytes(done.stdout)
        return done.returncode == 0

    def holds_sources(self, test: Test) -> bool:
        """Whether a test is made of objects besides its own and the libraries: of sources of the library, or of kernels."""
        if re.search(r'#include "[^"]*/src/[\w/]+\.c"', test.text):
            return True
        target = Path(test.command[0]).name
        rule = re.search(rf"^build \S*/{target}: \w+ ([^|]*)", self.rules, re.MULTILINE)
        return rule is not None and any(f"/{target}.dir/" not in it or "/src/" in it for it in rule[1].split())

    def tests(self) -> list[Test]:
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, check=True, capture_output=True, text=True)
        tests = []
        for entry in json.loads(listed.stdout)["tests"]:
            values = {item["name"]: item["value"] for item in entry["properties"]}
            environment = dict(line.split("=", 1) for line in values.get("ENVIRONMENT", []))
            if not entry["name"].startswith(LEFT_OUT) and environment.get("PBMPM_ISA", "sse4") == "sse4":
                tests.append(Test(entry["name"], entry["command"], environment, text=self._source(entry["name"])))
        if self.python:
            library = {"PBMPM_LIBRARY": str(self.build / "lib" / "libpbmpm.so")}
            command = [str(ROOT / "build/venv/bin/python"), "-m", "pytest", "-q", "-x"]
            for name in PYTHON_TESTS:
                file = self.tree / f"tests/python/test_{name}.py"
                tests.append(Test(f"python {name}", [*command, str(file)], library, text=file.read_text(encoding="utf-8")))
        return tests

    def _source(self, test: str) -> str:
        folder, _, subject = test.partition("_")
        file = self.tree / f"tests/{folder}/test_{subject.partition('.')[0]}.c"
        return file.read_text(encoding="utf-8") if file.is_file() else ""


class Campaign:
    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.folder: Path = options.folder.resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.file = self.folder / "verdicts.jsonl"
        self.verdicts: dict[str, dict[str, object]] = {}
        if self.file.is_file():
            for line in self.file.read_text(encoding="utf-8").splitlines():
                verdict = json.loads(line)
                self.verdicts[verdict["name"]] = verdict
        self.equivalent = equivalents(ROOT / "tests/mutants/equivalent.txt")
        self.lock = threading.Lock()
        self.found: dict[str, int] = {}
        for verdict in self.verdicts.values():
            if verdict["verdict"] == "found":
                self.found[str(verdict["by"])] = self.found.get(str(verdict["by"]), 0) + 1

    def baseline(self, place: Workplace) -> list[Test]:
        """The tests that pass without a fault, with the time that they take. Known of before: that, or none of what fails, or less than the negative."""
        known_file = self.folder / "times.json"
        known = json.loads(known_file.read_text(encoding="utf-8")) if known_file.is_file() else {}
        tests = []
        for test in place.tests():
            if test.name not in known or (known[test.name] or 0.0) < 0.0 and -known[test.name] < self.options.slowest:
                problem, seconds = test.run(place.tree, self.options.slowest)
                slow = problem.startswith("no end")
                known[test.name] = -self.options.slowest if slow else None if problem else seconds
                print(f"{test.name}: {problem or f'{seconds:.1f} s'}", flush=True)
                known_file.write_text(json.dumps(known), encoding="utf-8")
            if known[test.name] is None or not 0.0 <= known[test.name] <= self.options.slowest:
                print(f"left out: {test.name}, which {'fails' if known[test.name] is None else 'is slow'} without a fault", flush=True)
                continue
            test.seconds = known[test.name]
            tests.append(test)
        return tests

    def judge(self, place: Workplace, tests: list[Test], fault: Fault) -> dict[str, object]:
        begin = time.monotonic()
        path = place.tree / fault.file
        sound = path.read_bytes()
        lines = sound.decode("utf-8").split("\n")
        lines[fault.line - 1] = fault.after
        verdict: dict[str, object] = {"name": fault.name, **asdict(fault), "verdict": "survived", "by": "", "says": ""}
        try:
            path.write_text("\n".join(lines), encoding="utf-8")
            if not (place.make("pbmpm", "pbmpm_internal")):
                verdict["verdict"] = "does not build"
            else:
                with self.lock:
                    order = sorted(tests, key=lambda it: it.cost(fault, self.found.get(it.name, 0)))
                self._try(place, order, verdict)
        finally:
            path.write_bytes(sound)
        verdict["seconds"] = round(time.monotonic() - begin, 1)
        return verdict

    def _try(self, place: Workplace, order: list[Test], verdict: dict[str, object]) -> None:
        """Runs tests until one fails or their time is spent."""
        spent = 0.0
        for number, test in enumerate(order):
            if spent + test.seconds > self.options.patience:
                verdict["says"] = f"{len(order) - number} tests were not asked"
                break
            if place.holds_sources(test) and not place.make(Path(test.command[0]).name):
                continue
            says, seconds = test.run(place.tree, test.limit())
            spent += seconds
            if says:
                verdict |= {"verdict": "found", "by": test.name, "says": says}
                break

    def note(self, verdict: dict[str, object], done: int, of: int) -> None:
        with self.lock:
            self.verdicts[str(verdict["name"])] = verdict
            with self.file.open("a", encoding="utf-8") as out:
                out.write(json.dumps(verdict) + "\n")
            if verdict["verdict"] == "found":
                self.found[str(verdict["by"])] = self.found.get(str(verdict["by"]), 0) + 1
        by = f" by {verdict['by']}" if verdict["by"] else ""
        print(f"{done}/{of} {verdict['verdict']}{by} in {verdict['seconds']} s: {_fault(verdict).diff()}", flush=True)

    def run(self) -> int:
        options = self.options
        places = [Workplace(self.folder / f"job{i}", options.python) for i in range(options.jobs)]
        for place in places:
            place.prepare()
        tests = self.baseline(places[0])
        of_place = [tests] + [[it for it in place.tests() if it.name in {test.name for test in tests}] for place in places[1:]]
        seconds = {test.name: test.seconds for test in tests}
        for others in of_place[1:]:
            for test in others:
                test.seconds = seconds[test.name]
        if options.again:
            todo = [_fault(it) for it in self.verdicts.values() if it["verdict"] == "survived"]
            planned, count = iter([it for it in todo if _is_there(it)]), len(todo)
        elif options.constants:
            wanted = {path for pattern in options.files for path in places[0].tree.glob(pattern)}
            todo = [it for it in constant_faults(places[0].tree, known_verdicts()) if places[0].tree / it.file in wanted]
            planned, count = iter(todo), len(todo)
        else:
            copy = places[0].tree  # whatever becomes of the sources meanwhile
            files = [str(path.relative_to(copy)) for pattern in options.files for path in copy.glob(pattern)]
            planned, count = choose(copy, files, options.seed), options.count
        planned = (it for it in planned if it.key not in self.equivalent)
        chosen: list[str] = []
        asked: queue.Queue[None] = queue.Queue()

        def following() -> Fault | None:
            with self.lock:
                judged = [name for name in chosen if self.verdicts.get(name, {}).get("verdict") != "does not build"]
                if len(judged) >= count:
                    return None
                fault = next(planned, None)
                if fault:
                    chosen.append(fault.name)
                return fault

        def work(place: Workplace, own: list[Test]) -> None:
            while fault := following():
                if options.again or fault.name not in self.verdicts:
                    self.note(self.judge(place, own, fault), len(chosen), count)
            asked.put(None)

        threads = [threading.Thread(target=work, args=pair, daemon=True) for pair in zip(places, of_place, strict=True)]
        for thread in threads:
            thread.start()
        for _ in threads:
            asked.get()
        return self.report(chosen)

    def report(self, chosen: list[str]) -> int:
        verdicts = [self.verdicts[name] for name in chosen if name in self.verdicts]
        found = [it for it in verdicts if it["verdict"] == "found"]
        survived = [it for it in verdicts if it["verdict"] == "survived"]
        print("\nWhich tests found how many:")
        by = [str(it["by"]) for it in found]
        for name in sorted(set(by), key=lambda it: -by.count(it)):
            print(f"{by.count(name):5}  {name}")
        print("\nSurvivors:" if survived else "\nNo survivors.")
        for verdict in survived:
            print(_fault(verdict).diff())
        total = len(found) + len(survived)
        print(f"\n{len(self.equivalent)} cannot be found, says equivalent.txt")
        print(f"{len(found)} of {total} faults found{f', {100 * len(found) / total:.1f} %' if total else ''}")
        return int(len(found) < LEAST * total)


def _fault(verdict: dict[str, object]) -> Fault:
    return Fault(str(verdict["file"]), int(str(verdict["line"])), str(verdict["kind"]), str(verdict["before"]), str(verdict["after"]))


def _is_there(fault: Fault) -> bool:
    """Whether the line is still what it was."""
    lines = (ROOT / fault.file).read_text(encoding="utf-8").split("\n")
    return fault.line <= len(lines) and lines[fault.line - 1] == fault.before


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--count", type=int, default=100, help="faults, those that do not compile not counted")
    arguments.add_argument("--seed", type=int, default=1, help="which ones")
    arguments.add_argument("--jobs", type=int, default=1, help="copies of the tree that work at once")
    arguments.add_argument("--files", nargs="+", help="where to plant them; default all but headers, which constants may be in")
    arguments.add_argument("--slowest", type=float, default=60.0, help="tests that take longer [s] are left out")
    arguments.add_argument("--patience", type=float, default=120.0, help="of the tests with one fault [s]")
    arguments.add_argument("--python", action="store_true", help="run the quicker physics tests of Python, too (needs build/venv)")
    arguments.add_argument("--again", action="store_true", help="try the survivors of before once more")
    arguments.add_argument("--constants", action="store_true", help="halve and double each named constant instead, but for those of which constants.json tells; see constants.py")
    arguments.add_argument("--list", action="store_true", help="print the faults and plant none")
    arguments.add_argument("--folder", type=Path, default=ROOT / "build/mutants", help="where to work and keep verdicts")
    options = arguments.parse_args()
    options.files = options.files or ["src/**/*.c", "ispc/*.isph", *(["src/**/*.h", "ispc/*.h"] if options.constants else [])]
    if options.list:
        files = [str(path.relative_to(ROOT)) for pattern in options.files for path in ROOT.glob(pattern)]
        for _, fault in zip(range(options.count), choose(ROOT, files, options.seed)):
            print(fault.diff())
        return 0
    return Campaign(options).run()


if __name__ == "__main__":
    sys.exit(main())
