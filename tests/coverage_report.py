"""Prints what gcovr counted: ``coverage_report.py COVERAGE.json REASONS``.

A line of REASONS is ``FILE | TEXT | REASON``: lines of FILE that contain TEXT need not run. ``*`` as FILE stands for all files. What did not
run is printed with its reason, or with none. Branches that were not taken are listed in branches.txt beside the first file.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

LEAST = 97.0  #: percent of lines


@dataclass
class Reason:
    file: str
    text: str
    why: str
    used: bool = False

    def fits(self, file: str, source: str) -> bool:
        return self.file in ("*", file) and self.text in source


def read_reasons(path: Path) -> list[Reason]:
    reasons = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            file, text, why = (part.strip() for part in line.split(" | ", 2))
            reasons.append(Reason(file, text, why))
    return reasons


def share(done: int, of: int) -> str:
    return f"{100 * done / of:6.1f} %" if of else "       -"


def main(counted: Path, reasons_file: Path) -> int:
    reasons = read_reasons(reasons_file)
    lines_run = lines_all = branches_run = branches_all = 0
    missed: list[str] = []
    not_taken: list[str] = []
    without = 0
    print(f"{'file':36}{'lines':>14}{'':8}{'branches':>14}")
    for entry in sorted(json.loads(counted.read_text(encoding="utf-8"))["files"], key=lambda it: it["file"]):
        path = entry["file"]
        source = Path(path).read_text(encoding="utf-8").splitlines()
        runs: dict[int, int] = {}
        branches: dict[int, list[int]] = {}
        for line in entry["lines"]:
            number = line["line_number"]
            runs[number] = max(runs.get(number, 0), line["count"])
            branches.setdefault(number, []).extend(branch["count"] for branch in line["branches"])
        run = sum(count > 0 for count in runs.values())
        taken = sum(count > 0 for counts in branches.values() for count in counts)
        of = sum(map(len, branches.values()))
        lines_run, lines_all = lines_run + run, lines_all + len(runs)
        branches_run, branches_all = branches_run + taken, branches_all + of
        name = path.removeprefix("src/")
        print(f"{name:36}{run:6}/{len(runs):<6}{share(run, len(runs)):>9}{taken:8}/{of:<6}{share(taken, of):>9}")
        for number, count in sorted(runs.items()):
            text = source[number - 1].strip()
            if count == 0:
                reason = next((it for it in reasons if it.fits(name, text)), None)
                without += reason is None
                missed.append(f"{path}:{number}: {text}\n        {reason.why if reason else 'NO REASON'}")
                if reason:
                    reason.used = True
            elif 0 in branches[number]:
                not_taken.append(f"{path}:{number}: {branches[number].count(0)} of {len(branches[number])}: {text}")
    counted.with_name("branches.txt").write_text("\n".join(not_taken) + "\n", encoding="utf-8")
    print("\nLines that did not run:\n")
    print("\n".join(missed) or "none")
    stale = [f"{it.file} | {it.text}" for it in reasons if not it.used]
    print(f"\n{without} of {len(missed)} without a reason. Branches that were not taken: {counted.with_name('branches.txt')}")
    for it in stale:
        print(f"not needed here, a reason for: {it}")
    print(f"lines {lines_run}/{lines_all}{share(lines_run, lines_all)}, branches {branches_run}/{branches_all}{share(branches_run, branches_all)}")
    return int(100 * lines_run < LEAST * lines_all)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
