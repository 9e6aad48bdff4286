"""Writes docs/constants.md: every named number of the library, what it is, and which test turns red when it is halved or doubled.

    python3 tests/mutants/constants.py [--verdicts build/constants/verdicts.jsonl] [--check]

Names, values and words come from the sources, verdicts from constants.json beside this file, which --verdicts brings up to date from what
`sh tests/mutants.sh --constants --folder build/constants` found. A verdict counts as long as file, name and value are what they were.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path

from faults import Constant, constants

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/constants.md"
VERDICTS = Path(__file__).with_name("constants.json")
HEAD = """# Constants

Every number with a name in `src` and `ispc` that somebody chose, folder by folder. Each line gives the value and what it is for. It names the test that turns red
when the number is halved, and when it is doubled. "none" means that no test that ran turned red. Only C tests that take less than two seconds ran, for eight seconds per change
(`mutate.py --constants --slowest 2 --patience 8`); slower ones and those of Python may turn red. A dash means that nobody has tried yet. The full reason stands beside each constant in its file.
The last table lists again those that no theory gives: their comment says "by trial", and what was tried.

This page is written by `python3 tests/mutants/constants.py`; `sh tests/mutants.sh --constants --folder build/constants` tries the numbers, for hours.
"""
PLATEAUS = Path(__file__).with_name("plateaus.json")
AS_IT_IS, ROUNDED = "as it is", "other rounding"
FACTORS = {"halved": 0.5, "doubled": 2.0}
SUITES = ("field", "hard")
ADVICE = "advice"
"""The suite of constants that act on advice alone."""
BY_TRIAL = """No theory gives these. Each is halved and doubled. "Acts in" counts the scenes in which that can change anything at all: field tests at 60 Hz x 5, and
hard cases in 2D with paper, dual and primal. Scenes that take long are left out (`LONGEST_SCENE` in `tests/mutants/plateau.py`). The other columns count the checks that a change
loses and wins. The second row tells what another rounding does (AVX2 for SSE4). What loses no more checks than that swaps lies on a plateau: half and double do as well.
`tests/mutants/plateau.py` fills the table, for hours, and plateaus.json beside it names the checks. A dash means that nobody has tried yet."""
WORDS = 22
"""Of what a line says about a constant."""


ABOUT_ADVICE = """Some change advice alone. It is right of a check of the field tests if it warns where the check misses, and nowhere else. The table counts how many
advice loses and wins (`tests/advice_hits.py`)."""


def known_verdicts() -> dict[str, dict[str, str]]:
    return json.loads(VERDICTS.read_text(encoding="utf-8")) if VERDICTS.is_file() else {}


def gathered(found: list[Constant], campaign: Path) -> dict[str, dict[str, str]]:
    """What is known, brought up to date: by constant, the test for "halved" and "doubled"; "none" where none noticed."""
    known = {key: verdict for key, verdict in known_verdicts().items() if key in [constant.key for constant in found]}
    judged = [json.loads(line) for line in campaign.read_text(encoding="utf-8").splitlines()]
    for constant in found:
        as_it_is = re.compile(rf"\b{constant.name} (?:= )?{re.escape(constant.value)}(?![\w.]| \*)")
        for verdict in judged:
            if verdict["file"] == constant.file and as_it_is.search(verdict["before"]) and not as_it_is.search(verdict["after"]):
                found_by = {"found": verdict["by"], "survived": "none", "does not build": "the compiler"}[verdict["verdict"]]
                known.setdefault(constant.key, {})[verdict["kind"]] = str(found_by)
    return dict(sorted(known.items()))


def by_trial(found: list[Constant]) -> list[Constant]:
    return [constant for constant in found if "by trial" in constant.about.lower()]


def sentence(about: str) -> str:
    """The first words of a comment, as one cell of a table."""
    first = re.split(r"(?<=\.) ", about.replace("|", "\\|"))[0]
    words = first.split()
    return first if len(words) <= WORDS else " ".join(words[:WORDS]) + " …"


def studied(tried_out: list[Constant]) -> list[str]:
    """The table of what plateau.py found, and what is not on a plateau."""
    kept = json.loads(PLATEAUS.read_text(encoding="utf-8")) if PLATEAUS.is_file() else {}
    base, rounded = (kept.get("", {}).get(change, {}) for change in (AS_IT_IS, ROUNDED))
    lines = ["| Name | Value | Acts in: field | hard | Halved: field | hard | Doubled: field | hard |", "|---|---|---|---|---|---|---|---|"]
    if base:
        passed = [f"{base[suite]['passed']} of {base[suite]['of']}" if suite in base else "-" for suite in SUITES]
        lines.append(f"| as they are: scenes, checks that hold | | {' | '.join([*scenes(kept, ''), *passed])} | | |")
        lines.append(f"| another rounding | | | | {' | '.join(swapped(rounded.get(suite)) for suite in SUITES)} | | |")
    steep = []
    for constant in tried_out:
        own = kept.get(constant.key, {})
        cells = [swapped(own.get(change, {}).get(suite)) for change in FACTORS for suite in SUITES]
        lines.append(f"| `{constant.name}` ({Path(constant.file).name}) | `{constant.value}` | {' | '.join([*scenes(kept, constant.key), *cells])} |")
        sides = [change for change in FACTORS if any(is_steep(own.get(change, {}).get(suite), rounded.get(suite)) for suite in (*SUITES, ADVICE))]
        if sides:
            steep.append(f"`{constant.name}` ({' and '.join(sides)})")
    told = [constant for constant in tried_out if any(ADVICE in found for found in kept.get(constant.key, {}).values())]
    if told:
        lines += ["", ABOUT_ADVICE, "", "| Name | Value | Acts in | Halved | Doubled |", "|---|---|---|---|---|"]
        for constant in told:
            own = kept[constant.key]
            cells = [swapped(own.get(change, {}).get(ADVICE)) for change in FACTORS]
            lines.append(f"| `{constant.name}` ({Path(constant.file).name}) | `{constant.value}` | {scenes(kept, constant.key, (ADVICE,))[0]} | {' | '.join(cells)} |")
    if rounded:
        lines += ["", "These have no plateau on the side in brackets, so a law for them is missing:", "", *(f"- {it}" for it in steep or ["none"])]
    return lines


def scenes(kept: dict, key: str, suites: tuple[str, ...] = SUITES) -> list[str]:
    """In how many scenes a constant acts, by suite: where half or where double of it can change anything."""
    own = kept.get(key, {}).values()
    counts = [[change[suite]["scenes"] for change in own if suite in change] for suite in suites]
    return [str(max(found)) if found else "-" for found in counts]


def is_steep(found: dict[str, list[str]] | None, rounded: dict[str, list[str]] | None) -> bool:
    """Whether a change loses more than another rounding swaps."""
    return found is not None and len(found["lost"]) > (len(rounded["lost"]) + len(rounded["won"]) if rounded else 0)


def swapped(found: dict[str, list[str]] | None) -> str:
    """How many checks a change lost and won."""
    if found is None:
        return "-"
    return f"-{len(found['lost'])} +{len(found['won'])}" if found["lost"] or found["won"] else "same"


def page(found: list[Constant], verdicts: dict[str, dict[str, str]]) -> str:
    rooms: dict[str, list[Constant]] = {}
    for constant in found:
        rooms.setdefault(str(Path(constant.file).parent), []).append(constant)
    tried = sum(len(verdicts.get(constant.key, {})) for constant in found)
    quiet = [constant for constant in found if "none" in verdicts.get(constant.key, {}).values()]
    tried_out = by_trial(found)
    lines = [HEAD, f"{len(found)} constants, {len(tried_out)} of them by trial; {tried} of {2 * len(found)} changes tried. For {len(quiet)} constants at least one change turned no test red."]
    for room, own in rooms.items():
        lines += ["", f"## {room}", "", "| Name | Value | What it is for | Halved | Doubled |", "|---|---|---|---|---|"]
        for constant in own:
            verdict = verdicts.get(constant.key, {})
            cells = [f"`{constant.name}` ({Path(constant.file).name})", f"`{constant.value}`", sentence(constant.about) or "see its file"]
            lines.append(f"| {' | '.join([*cells, verdict.get('halved', '-'), verdict.get('doubled', '-')])} |")
    lines += ["", "## By trial", "", BY_TRIAL, "", *studied(tried_out)]
    return "\n".join(lines) + "\n"


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--verdicts", type=Path, help="of a campaign, to take up")
    arguments.add_argument("--check", action="store_true", help="only say whether the page is current")
    options = arguments.parse_args()
    found = constants(ROOT)
    if options.verdicts:
        verdicts = gathered(found, options.verdicts)
        VERDICTS.write_text(json.dumps(verdicts, indent=0) + "\n", encoding="utf-8")
    text = page(found, known_verdicts())
    if options.check:
        return int(PAGE.read_text(encoding="utf-8") != text)
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
