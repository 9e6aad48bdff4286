"""Reports that an earlier run of a command saved as JSON, to go on with."""

from __future__ import annotations

import json
from collections.abc import Set
from pathlib import Path
from typing import Any

from .errors import InputError


def read_report(path: Path, needed: Set[str], command: str) -> dict[str, Any]:
    """What a command's ``--json`` wrote, which holds the needed keys; InputError for anything else."""
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        raise InputError(f"{path}: not JSON: {problem}") from None
    if not isinstance(report, dict) or not needed <= report.keys():
        raise InputError(f"{path}: not what {command} --json writes")
    return report


def file_to_resume(json_target: str | None) -> Path:
    """Where ``--json`` of a command writes that is to go on; InputError when that is no file."""
    if json_target in (None, "-"):
        raise InputError("--resume needs a file of --json to go on with")
    return Path(str(json_target))
