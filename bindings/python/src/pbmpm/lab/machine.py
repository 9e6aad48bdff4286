"""What a measurement has to say about where it was made."""

from __future__ import annotations

import datetime
import os
import platform
from pathlib import Path
from typing import Any


def machine_facts(isa: str, threads: int) -> dict[str, Any]:
    """CPU model, instruction set of the kernels, threads and date, for reports."""
    return {
        "cpu": cpu_model(),
        "cores": os.cpu_count(),
        "isa": isa,
        "threads": threads,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
    }


def cpu_model() -> str:
    """The CPU's name as the system tells it."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or "unknown"
