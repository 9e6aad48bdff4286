"""The ``pbmpm`` command, also as ``python -m pbmpm``. It lives in ``pbmpm.lab``, whose packages an install of the binding alone leaves out."""

from __future__ import annotations

import sys


def main() -> None:
    """Entry point of the console script."""
    try:
        from .lab.commands.cli import main as run
    except ModuleNotFoundError as error:
        sys.exit(f"pbmpm: the command needs more packages ({error.name} is missing): pip install 'pbmpm[lab]'")
    run()


if __name__ == "__main__":
    main()
