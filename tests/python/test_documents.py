"""The documents and public headers: what they point to exists, the README stays short, sentences stay short."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "bindings").glob("*/README.md"), ROOT / "samples" / "scenes" / "README.md", ROOT / "packaging" / "ARCHIVE.md"])
NAMES = [str(path.relative_to(ROOT)) for path in DOCUMENTS]
HEADERS = sorted([*(ROOT / "include" / "pbmpm").glob("*.h"), *(ROOT / "bindings" / "engine").rglob("*.hpp")])
LONGEST = 20
"""Words of a sentence that a reader takes in at once."""


def prose(text: str) -> str:
    """Without code, tables, headings and lists' marks."""
    text = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    lines = [line for line in text.splitlines() if not line.startswith(("|", "#", "    "))]
    return "\n".join(re.sub(r"^\s*(-|\d+\.)\s", "\n", line) for line in lines)


def comments(code: str) -> str:
    """Those of a header, each a paragraph."""
    return "\n\n".join(re.sub(r"\n\s*\*? ?", "\n", comment) for comment in re.findall(r"/\*\*?<?(.*?)\*/", code, re.DOTALL))


def sentences(text: str) -> list[str]:
    """A paragraph ends one; so do a colon and a semicolon, which a reader takes as a stop. A piece of code is a word."""
    plain = re.sub(r"`[^`]*`", "code", re.sub(r"\]\([^)]*\)", "]", prose(text)))
    return [" ".join(part.split()) for part in re.split(r"(?<=[.!?:;])[)*_]*\s+|\n\s*\n", plain) if words(part)]


def words(sentence: str) -> int:
    return len(re.findall(r"\w[\w'/.+-]*", sentence))


def percentile(counts: list[int], share: float) -> int:
    return sorted(counts)[min(len(counts) - 1, int(share * len(counts)))]


def anchor(heading: str) -> str:
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


@pytest.mark.parametrize("path", DOCUMENTS, ids=NAMES)
def test_links_lead_somewhere(path: Path) -> None:
    lost = []
    for target in re.findall(r"\]\((?!https?:)([^)\s]+)\)", path.read_text(encoding="utf-8")):
        name, _, part = target.partition("#")
        there = (path.parent / name).resolve() if name else path
        headings = re.findall(r"^#+ (.*)$", there.read_text(encoding="utf-8"), re.MULTILINE) if there.suffix == ".md" and there.exists() else []
        if not there.exists() or (part and part not in map(anchor, headings)):
            lost.append(target)
    assert lost == []


@pytest.mark.parametrize("path", DOCUMENTS, ids=NAMES)
def test_files_that_are_named_exist(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    named = set(re.findall(r"[`\s]((?:samples|tests|bindings|include|src|ispc|docs)/[\w./-]*\w)", text))
    assert sorted(name for name in named if not (ROOT / name).exists() and not (path.parent / name).exists() and not re.search(r"[A-Z]{4}", name)) == []  # VERSION stands for any


def test_the_readme_is_short() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 160
    assert len(text.split()) <= 1600
    assert len((ROOT / "docs" / "glossary.md").read_text(encoding="utf-8").splitlines()) <= 40


@pytest.mark.parametrize("path", [*DOCUMENTS, *HEADERS], ids=[*NAMES, *(path.name for path in HEADERS)])
def test_sentences_are_short(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    found = sentences(comments(text) if path in HEADERS else text)
    counts = [words(sentence) for sentence in found]
    middle, long = percentile(counts, 0.5), percentile(counts, 0.95)
    print(f"{path.name}: {len(counts)} sentences, median {middle} words, 95 % at most {long}, longest {max(counts)}")
    assert middle <= 12
    assert [sentence for sentence in found if words(sentence) > LONGEST] == []


def test_the_page_of_constants_is_current() -> None:
    done = subprocess.run([sys.executable, str(ROOT / "tests" / "mutants" / "constants.py"), "--check"], check=False)
    assert done.returncode == 0, "run: python3 tests/mutants/constants.py"


def named_after(command: str, text: str) -> set[str]:
    """The names that follow a command wherever it stands in code, up to its options."""
    found = [re.match(rf"[\w./ ]*{command}((?: \w[\w-]*)*)", " ".join(code.split())) for code in re.findall(r"`([^`]*)`", text)]
    return {name for match in found if match for name in match[1].split()}


@pytest.mark.parametrize("path", DOCUMENTS, ids=NAMES)
def test_cases_that_commands_name_exist(path: Path) -> None:
    from pbmpm.lab.accuracy.registry import all_cases
    from pbmpm.lab.stability.cases import CASES

    text = path.read_text(encoding="utf-8")
    rooms = {room: (ROOT / "tests" / "field" / f"{room}.py").read_text(encoding="utf-8") for room in ("water", "solids", "sand", "mixed")}
    field = {*rooms, *(name for room in rooms.values() for name in re.findall(r"^def ([a-z]\w*)", room, re.MULTILINE))}
    known = {r"tests/field/run\.py": field, "accuracy": {case.name for case in all_cases()}, "stability": {case.id for case in CASES}}
    for command, names in known.items():
        assert sorted(name for name in named_after(command, text) - names if not name.isupper() or name[0] == "H") == []  # CASE stands for any


def test_names_after_a_command() -> None:
    """The test above sees names over line ends, with and without a path, and stops at options."""
    text = "`build/venv/bin/python tests/field/run.py\n  still_pool trough --settings 60x5` and `pbmpm stability H03 H08 --dims 2`"
    assert named_after(r"tests/field/run\.py", text) == {"still_pool", "trough"}
    assert named_after("stability", text) == {"H03", "H08"}
    assert named_after("accuracy", text) == set()
