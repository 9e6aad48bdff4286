"""A map that is kept in a file while it is made, so that hours of it can be run in parts."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import write_json
from .cases import Check, Kind, Outcome, Setting, find_case
from ..saved import read_report
from .result import report_of

_NEEDED = {"rows", "wall_seconds", "versions", "machine"}
SAVE_SECONDS = 30.0


def outcome_of(row: dict[str, Any]) -> Outcome:
    """The outcome of a row, with the check that said most and the goals that were missed. Whether a failure is known and whether
    goals count is what the catalogue says now."""
    setting = Setting(
        row["material"],
        row["dims"],
        row["variant"],
        row["rate_hz"],
        row["iterations"],
        solver=row["solver"],
        seed=row["seed"],
    )
    checks = dict.fromkeys(check_of(entry) for entry in (row, *row["goals_missed"]))
    return find_case(row["case"]).outcome(setting, checks, row["seconds"])


def check_of(entry: dict[str, Any]) -> Check:
    """The check of a row, or of a goal in it."""
    figure, limit = (math.nan if entry[name] is None else entry[name] for name in ("figure", "limit"))
    return Check(entry["check"], figure, limit, entry["limit_is_lowest"], Kind(entry["kind"]))


class Record:
    """What is known of a map, and the file (None: no file) that holds it."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._saved = self._began = time.perf_counter()
        self._earlier = 0.0
        self.outcomes: list[Outcome] = []

    def go_on(self) -> None:
        """Takes over what the file holds, if there is one; InputError when it is no map, or one of another library."""
        if self._path is None or not self._path.exists():
            return
        report = read_report(self._path, _NEEDED, "pbmpm stability")
        try:
            self.outcomes = [outcome_of(row) for row in report["rows"]]
        except (KeyError, TypeError, ValueError) as problem:
            raise InputError(f"{self._path}: not a map of this catalogue: {problem}") from None
        own = self.report()
        for facts in ("versions", "machine"):
            theirs, ours = (({**found[facts], "date": None}) for found in (report, own))
            if theirs != ours:
                raise InputError(f"{self._path} was made with another library or on another machine, so it cannot be gone on with")
        self._earlier = report["wall_seconds"]

    def add(self, outcome: Outcome) -> None:
        """Takes an outcome in, and saves all of them from time to time."""
        self.outcomes.append(outcome)
        if time.perf_counter() - self._saved > SAVE_SECONDS:
            self.save()

    def report(self) -> dict[str, Any]:
        """As it goes into the file."""
        return report_of(self.outcomes, self._earlier + time.perf_counter() - self._began)

    def save(self) -> None:
        """Writes the file."""
        if self._path is not None:
            write_json(self.report(), self._path)
        self._saved = time.perf_counter()
