"""A headless browser for the tests of pages."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
#: Messages of a page's own script, as the browser logs them.
_SCRIPT_MESSAGE = ":CONSOLE"


def browser() -> str | None:
    """The browser's program; None when there is none."""
    return next((found for name in _NAMES if (found := shutil.which(name))), None)


def open_page(page: Path, picture: Path, height: int = 2000) -> tuple[str, list[str]]:
    """Loads a page without a network: the document after its scripts have run, and the errors that they did not catch."""
    program = browser()
    assert program is not None
    common = [program, "--headless=new", "--disable-gpu", "--hide-scrollbars", f"--window-size=1300,{height}"]
    common += ["--virtual-time-budget=10000", "--enable-logging=stderr", "--host-resolver-rules=MAP * ~NOTFOUND"]
    common += ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    address = page.resolve().as_uri()
    dom = subprocess.run([*common, "--dump-dom", address], capture_output=True, text=True, timeout=180, check=True)
    subprocess.run([*common, f"--screenshot={picture}", address], capture_output=True, timeout=180, check=True)
    return dom.stdout, [line for line in dom.stderr.splitlines() if _SCRIPT_MESSAGE in line]
