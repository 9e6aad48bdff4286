"""Self-contained pages: everything they need is in them, so they open without a network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from pbmpm._library import library_path

from ..files import replace_when_complete
from .build import compilers


def save_page(template: str, path: Path, report: dict[str, Any], **values: Any) -> None:
    """Renders a template with what every report says about its making; complete or not at all."""
    environment = Environment(
        loader=PackageLoader(__package__),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template(template).render(
        machine=report["machine"], versions=report["versions"], compilers=compilers(library_path()), **values
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    with replace_when_complete(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
