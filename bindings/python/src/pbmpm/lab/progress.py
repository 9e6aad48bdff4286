"""A progress bar on stderr, shown only on a terminal."""

from __future__ import annotations

import sys

from tqdm import tqdm


def progress_bar(total: float | None, unit: str, label: str) -> tqdm:
    """A tqdm bar with rate and time left, as far as the total is known; silent when stderr is not a terminal."""
    layout = "{desc}: {percentage:3.0f}% |{bar}| {n:.3g}/{total:.3g} {unit} [{rate_fmt}, {remaining} left{postfix}]"
    if total is None:
        layout = "{desc}: {n:.3g} {unit} [{elapsed}{postfix}]"
    return tqdm(
        total=total,
        unit=unit,
        desc=label,
        bar_format=layout,
        file=sys.stderr,
        disable=not sys.stderr.isatty(),
        mininterval=0.2,
        leave=False,
    )
