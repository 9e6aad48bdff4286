"""The quick stability map on Dask workers: in this process, on one, on two, and on two of which one is killed half way.

All rows have to be those of this process. Prints what each took. Arguments: cases; default: all, which takes 20 CPU minutes.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent / "python"))

from dask_cluster import DaskCluster

from pbmpm.lab.stability.plan import Run, Selection, cases_named, plan
from pbmpm.lab.stability.result import row_of
from pbmpm.lab.stability.sweep import sweep
from pbmpm.lab.workers.workers import Workers


def here(runs: list[Run]) -> list[dict[str, Any]]:
    """The rows of this process."""
    begin, cpu = time.monotonic(), time.process_time()
    rows = [row_of(outcome) for outcome in sweep(runs, Workers())]
    tell("this process", begin, time.process_time() - cpu)
    return rows


def on_workers(runs: list[Run], count: int, kill: bool) -> list[dict[str, Any]]:
    """Those of a cluster."""
    told = 0

    def note(_: object) -> None:
        nonlocal told
        told += 1
        if kill and told == len(runs) // 2:
            cluster.kill_one()

    with tempfile.TemporaryDirectory() as folder:
        cluster = DaskCluster(Path(folder), count)
        try:
            begin = time.monotonic()
            rows = [row_of(outcome) for outcome in sweep(runs, Workers(scheduler=cluster.address), note)]
            tell(f"{count} workers{', one killed half way' if kill else ''}", begin, cluster.cpu_seconds())
        finally:
            cluster.end()
    return rows


def tell(name: str, begin: float, cpu_seconds: float) -> None:
    print(f"{name}: {time.monotonic() - begin:.0f} s, {cpu_seconds:.0f} CPU s, load {os.getloadavg()[0]:.1f}", flush=True)


def without_times(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [{**row, "seconds": 0} for row in rows]


def main() -> int:
    runs = plan(Selection(cases=cases_named(sys.argv[1:]), quick=True))
    print(f"{len(runs)} runs", flush=True)
    wanted, wrong = without_times(here(runs)), 0
    for count, kill in ((2, True), (2, False), (1, False)):
        equal = without_times(on_workers(runs, count, kill)) == wanted
        print(f"  rows {'are equal' if equal else 'DIFFER'}", flush=True)
        wrong += not equal
    return wrong


if __name__ == "__main__":
    sys.exit(main())
