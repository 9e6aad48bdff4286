"""What has to be the same on all workers so that their rows are those of one machine."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import numpy as np

import pbmpm
from pbmpm._library import library_path

from ..machine import cpu_model


@cache
def own_facts() -> dict[str, str]:
    """Of this process. The CPU matters to times alone."""
    package = Path(pbmpm.__file__).parent
    return {
        "pbmpm": pbmpm.__version__,
        "ISA": pbmpm.isa(),
        "library": _hash([library_path()]),
        "Python code": _hash(sorted(package.rglob("*.py"))),
        "numpy": np.__version__,
        "CPU": cpu_model(),
    }


def _hash(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in paths:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def differences(found: Mapping[str, str], wanted: Mapping[str, str]) -> str:
    """In words, what is not as wanted; empty when all of that is."""
    return "; ".join(f"{name} is {found.get(name)}, not {value}" for name, value in wanted.items() if found.get(name) != value)
