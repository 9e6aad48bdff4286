"""The ``pbmpm`` command.

Exit codes: 0 all is well; 1 a check failed; 2 the command line or a file cannot be used; 130 interrupted.
"""

from __future__ import annotations

import sys

import click

from ..errors import InputError
from .accuracy import accuracy
from .advice import advice
from .bench import bench
from .effects import effects
from .options import EXIT_INTERRUPTED, EXIT_USAGE
from .run import run
from .stability import stability
from .tune import tune


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="pbmpm", message="pbmpm %(version)s")
def cli() -> None:
    """Simulate liquids, elastic bodies, sand and yielding matter with the Position Based Material Point Method, and measure the result."""


for command in (accuracy, advice, bench, effects, run, stability, tune):
    cli.add_command(command)


def main() -> None:
    """Entry point of the console script."""
    import pbmpm

    try:
        cli.main(prog_name="pbmpm", standalone_mode=False)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except (InputError, pbmpm.PbmpmError) as error:
        print(f"pbmpm: {error}", file=sys.stderr)
        sys.exit(EXIT_USAGE)
    except OSError as error:
        print(f"pbmpm: {error.filename or 'a file'}: {error.strerror or error}", file=sys.stderr)
        sys.exit(EXIT_USAGE)
    except (click.Abort, KeyboardInterrupt):
        sys.exit(EXIT_INTERRUPTED)
