"""Reports that were saved as JSON, put together: a long sweep can be run in parts, and go on where it ended."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..saved import read_report

_NEEDED = {"rows", "cases", "stable_means", "versions", "machine"}
_COMMAND = "pbmpm accuracy"


def merged(paths: Sequence[Path], names: Sequence[str]) -> dict[str, Any]:
    """One report with the named cases of files, in that order; of a case that several files hold, the last one counts."""
    return together([read_report(path, _NEEDED, _COMMAND) for path in paths], names)


def together(reports: Sequence[dict[str, Any]], names: Sequence[str]) -> dict[str, Any]:
    """One report with the named cases, in that order; of a case that several reports hold, the last one counts.

    Costs are of one machine: InputError when the reports are from different ones, or when they hold none of the cases.
    """
    places = {(report["machine"].get("cpu"), report["machine"].get("isa")) for report in reports}
    if len(places) > 1:
        raise InputError(f"the reports are from different machines: {', '.join(sorted(map(str, places)))}")
    latest = {facts["case"]: (facts, report) for report in reports for facts in report["cases"]}
    kept = [latest[name] for name in names if name in latest]
    if not kept:
        raise InputError("the reports hold none of these cases")
    return {
        **reports[-1],
        "cases": [facts for facts, _ in kept],
        "rows": [row for facts, report in kept for row in report["rows"] if row["case"] == facts["case"]],
    }


def begun(path: Path, asked: dict[str, Any]) -> dict[str, Any] | None:
    """What a sweep with the same options had measured before it was interrupted; None when there is nothing.

    InputError when the file is from a sweep with other options.
    """
    if not path.exists():
        return None
    report = read_report(path, _NEEDED, _COMMAND)
    if report.get("asked") != asked:
        raise InputError(f"{path} was measured with other options, so it cannot be gone on with: {report.get('asked')}")
    return report
