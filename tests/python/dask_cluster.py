"""A Dask scheduler and workers, each a process of this machine."""

from __future__ import annotations

import socket
import subprocess
import sys
from pathlib import Path

START_SECONDS = 120


class DaskCluster:
    """With so many workers, of one thread each and without a nanny: nobody starts them again."""

    def __init__(self, folder: Path, workers: int = 2) -> None:
        self._folder = folder
        self._processes: list[subprocess.Popen[bytes]] = []
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{port}"
        self._start("dask_scheduler", "--host", "127.0.0.1", "--port", port)
        options = ("--nthreads", 1, "--no-nanny", "--local-directory", folder)
        self._workers = [self._start("dask_worker", self.address, *options) for _ in range(workers)]
        self._lost_cpu_seconds = 0.0
        self._wait_for_workers()

    def _start(self, module: str, *options: object) -> subprocess.Popen[bytes]:
        line = [sys.executable, "-m", f"distributed.cli.{module}", *map(str, options), "--no-dashboard"]
        with (self._folder / f"{len(self._processes)}.log").open("wb") as log:
            self._processes.append(subprocess.Popen(line, stdout=log, stderr=log))
        return self._processes[-1]

    def _wait_for_workers(self) -> None:
        import distributed

        with distributed.Client(self.address, timeout=START_SECONDS, set_as_default=False) as client:
            client.wait_for_workers(len(self._workers), timeout=START_SECONDS)

    @property
    def working(self) -> int:
        """How many workers there are."""
        return len(self._alive())

    def kill_one(self) -> None:
        """As a machine is lost: without a word."""
        worker = self._alive()[0]
        self._lost_cpu_seconds += _cpu_seconds(worker)
        worker.kill()
        worker.wait()

    def cpu_seconds(self) -> float:
        """Processor time of the workers and their processes so far."""
        return self._lost_cpu_seconds + sum(map(_cpu_seconds, self._alive()))

    def end(self) -> None:
        """Ends them all."""
        for process in self._processes:
            process.kill()
            process.wait()

    def _alive(self) -> list[subprocess.Popen[bytes]]:
        return [worker for worker in self._workers if worker.poll() is None]


def _cpu_seconds(process: subprocess.Popen[bytes]) -> float:
    import psutil  # of Dask

    root = psutil.Process(process.pid)
    times = [part.cpu_times() for part in (root, *root.children(recursive=True))]
    return float(sum(part.user + part.system for part in times))
