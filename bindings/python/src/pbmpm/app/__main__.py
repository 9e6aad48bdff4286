"""``python -m pbmpm.app`` is the ``pbmpm`` command."""

from .cli import main

main()
