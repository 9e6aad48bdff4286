"""What one core can do at most: floating-point operations and bytes per second.

Both come from NumPy, in a process of its own: `python -m pbmpm.lab.bench.peak BYTES` prints them. The operations are those of a product of matrices by its BLAS, with the
instructions that the kernels use where that is OpenBLAS. The bytes are those of a sum of arrays of BYTES in all, so that they come from where a world of that size lies. As in the
counts of phases, a line that is written counts twice: it is fetched, and goes back.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

OPENBLAS_CORES = {"SSE4": "Nehalem", "AVX2": "Haswell", "AVX-512": "SkylakeX"}
"""Per instruction set the core that has no more than it, by OpenBLAS' name."""

MATRIX_ROWS = 1024
REPEATS = 12
"""Times that each is measured; the best counts, which others disturbed least."""


@dataclass
class Peak:
    """Of one core."""

    peak_gflops: float
    peak_gb_per_second: float
    bandwidth_bytes: int
    """Of the arrays that the bandwidth was measured with."""
    blas: str
    """Whose product of matrices it was."""


def measure_peak(isa: str, working_bytes: int) -> Peak:
    """With the instructions of a set, as `pbmpm.isa()` names it, and with arrays of ``working_bytes`` in all."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "VECLIB_MAXIMUM_THREADS": "1"}
    if isa in OPENBLAS_CORES:
        environment["OPENBLAS_CORETYPE"] = OPENBLAS_CORES[isa]
    command = [sys.executable, "-m", "pbmpm.lab.bench.peak", str(working_bytes)]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return Peak(**json.loads(result.stdout))


def _best_seconds(work: Callable[[], Any]) -> float:
    work()
    times = []
    for _ in range(REPEATS):
        begin = time.thread_time()
        work()
        times.append(time.thread_time() - begin)
    return min(times)


def _measure_here(working_bytes: int) -> Peak:
    import numpy as np

    left, right, product = (np.full((MATRIX_ROWS, MATRIX_ROWS), 0.5, np.float32) for _ in range(3))
    one, two, total = (np.full(working_bytes // (3 * 4), 0.5, np.float32) for _ in range(3))
    return Peak(
        2e-9 * MATRIX_ROWS**3 / _best_seconds(lambda: np.matmul(left, right, out=product)),
        4e-9 * total.nbytes / _best_seconds(lambda: np.add(one, two, out=total)),
        working_bytes,
        _blas_name(np),
    )


def _blas_name(numpy: Any) -> str:
    try:
        return str(numpy.show_config(mode="dicts")["Build Dependencies"]["blas"]["name"])
    except (KeyError, TypeError):
        return "unknown"  # NumPy before 1.26


if __name__ == "__main__":
    print(json.dumps(asdict(_measure_here(int(sys.argv[1])))))
