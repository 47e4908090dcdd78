"""Pages about keys of files and annotations: the tables of docs/reference/formats, one file per page."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from perilune.analysis.design.synthesis.search_settings import SearchSettings
from perilune.analysis.design.synthesis.synthesis_file import LIMITS
from perilune.common.bounds import BOUNDS
from perilune.fmus_src.roles import ROLES

from ..markdown import table

FORMATS = Path(__file__).parent
FOLDERS = Path(__file__).parents[3] / "tests" / "folders.toml"
ROLE_HEAD = ("variable", "declared as", "effect")


def format_pages() -> dict[str, str]:
    """Return the Markdown pages by file name, for reference/formats."""
    pages = {f"{name}.md": _page(content) for name, content in _catalogues().items()}
    return pages | {"bounds.md": bounds_page(), "folders.md": folders_page()}


def format_navigation() -> list[dict[str, str]]:
    """Return titles and pages, ordered by name."""
    titles = {name: content["title"] for name, content in _catalogues().items()} | {
        "bounds": "Bounds",
        "folders": "Folders",
    }
    return [{title: f"reference/formats/{name}.md"} for name, title in sorted(titles.items())]


def bounds_page() -> str:
    """Return the page of the bounds in `common/bounds.py`."""
    rows = [[f"`{bound.variable}`", f"{bound.default:g} {bound.unit}", bound.subject] for bound in BOUNDS]
    text = (
        "Files and options are checked before memory is allocated for them. An environment variable changes a bound. "
        "Other limits cannot be changed: XML is at most 256 elements deep (libxml2's limit), names in TOML consist of "
        "at most 100 parts, integers have 64 bits, and numbers are finite doubles. Pipes, devices and folders in place "
        "of a regular file are not opened."
    )
    return "\n\n".join(["# Bounds", text, table(["variable", "at most", "bounded quantity"], rows)]) + "\n"


def folders_page() -> str:
    """Return the page of the source folders, from the list that import checks use."""
    folders = tomllib.loads(FOLDERS.read_text(encoding="utf-8"))
    rows = [[f"`{folder}`", contents] for folder, contents in folders.items()]
    text = (
        "A file imports from its own folder and from those below it; [architecture](../../architecture.md) shows how."
    )
    return "\n\n".join(["# Folders", text, table(["folder", "contents"], rows)]) + "\n"


def _catalogues() -> dict[str, Any]:
    return {path.stem: tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(FORMATS.glob("*.toml"))}


def _page(content: Mapping[str, Any]) -> str:
    parts = [f"# {content['title']}", content["text"].strip()]
    for section in content["section"]:
        parts += [f"## {section['title']}", *_section(section)]
    return "\n\n".join(parts) + "\n"


def _section(section: Mapping[str, Any]) -> Iterator[str]:
    if "text" in section:
        yield section["text"].strip()
    match section.get("derived"):
        case "roles":
            yield table(ROLE_HEAD, [[f"`{role.name}`", role.declared, role.effect] for role in ROLES])
        case "search":
            yield table(section["columns"], [[*row, *_searched(row[0])] for row in section["rows"]])
        case None if "rows" in section:
            yield table(section["columns"], section["rows"])
    if "table" in section:
        yield section["table"].strip()
    if "notes" in section:
        yield section["notes"].strip()


def _searched(key: str) -> list[str]:
    """Return default and range of a key of a search, from its declaration."""
    name = key.strip("`")
    low, high = LIMITS.get(name, (None, None))
    limits = "true or false" if low is None else f"{low:g} to {high:g}"
    return [str(getattr(SearchSettings(), name)).lower(), limits]
