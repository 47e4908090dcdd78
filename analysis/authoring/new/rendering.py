"""The templates that what is new is made from: data beside this file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

FOLDER = Path(__file__).parent / "templates"
SUFFIX = ".jinja"


def template_names(folder: str) -> list[str]:
    """The files that the templates below a folder make, by their names in it."""
    root = FOLDER / folder
    return sorted(path.relative_to(root).as_posix().removesuffix(SUFFIX) for path in root.rglob(f"*{SUFFIX}"))


def render(template: str, **content: Any) -> str:
    """The text of a file; a value that its template needs and does not get is an error."""
    environment = Environment(
        loader=FileSystemLoader(FOLDER),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # names are checked and units are ours: there is nothing to escape
    return environment.get_template(f"{template}{SUFFIX}").render(**content)
