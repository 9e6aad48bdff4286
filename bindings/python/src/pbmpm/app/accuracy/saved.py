"""Reports that were saved as JSON, put together: a long sweep can be run in parts."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError

_NEEDED = {"rows", "cases", "stable_means", "versions", "machine"}


def merged(paths: Sequence[Path], names: Sequence[str]) -> dict[str, Any]:
    """One report with the named cases, in that order; of a case that several files hold, the last one counts.

    Costs are of one machine: InputError when the files are from different ones, or when a file is no report.
    """
    reports = [_read(path) for path in paths]
    places = {(report["machine"].get("cpu"), report["machine"].get("isa")) for report in reports}
    if len(places) > 1:
        raise InputError(f"the files are from different machines: {', '.join(sorted(map(str, places)))}")
    latest = {facts["case"]: (facts, report) for report in reports for facts in report["cases"]}
    kept = [latest[name] for name in names if name in latest]
    if not kept:
        raise InputError("the files hold none of these cases")
    return {
        **reports[-1],
        "cases": [facts for facts, _ in kept],
        "rows": [row for facts, report in kept for row in report["rows"] if row["case"] == facts["case"]],
    }


def _read(path: Path) -> dict[str, Any]:
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        raise InputError(f"{path}: not JSON: {problem}") from None
    if not isinstance(report, dict) or not _NEEDED <= report.keys():
        raise InputError(f"{path}: not what pbmpm accuracy --json writes")
    return report
