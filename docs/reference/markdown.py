"""Pieces of Markdown: tables, docstrings as prose, links to the pages of docs/."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Sequence

LABEL = re.compile(r"^(?=(?:Sources?|Frames?|Equations|Limits|Kinds|Phases|Assumes|(?:method|law) \d)\b)", re.MULTILINE)
PAGE = re.compile(r"docs/((?:\w+/)*(?:\w|\\_)+)\.md")
CODE = re.compile(r"(``[^`]+``|`[^`]+`)")


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table of cells that are Markdown already."""
    lines = [list(head), ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("\n", " ") for cell in line) + " |" for line in lines)


def escaped(text: str) -> str:
    """Escape words for a table too: no tag, no link, no end of a cell, no emphasis but that of two asterisks."""
    parts = CODE.split(text)
    return "".join(
        part if index % 2 else re.sub(r"((?<!\*)\*(?!\*)|[_\[\]|\\])", r"\\\1", part).replace("<", "&lt;")
        for index, part in enumerate(parts)
    )


def prose(docstring: str | None, root: str) -> str:
    """Return a docstring as Markdown: indented equations stay, sources and frames get a paragraph, pages of docs a
    link.

    ``root`` leads from the page to the site's own, such as ``../``.
    """
    text = inspect.cleandoc(docstring or "")
    blocks = re.split(r"(\n(?:\n    .*(?:\n(?: {4}.*)?)*)+)", text)
    matches = []
    for index, block in enumerate(blocks):
        if index % 2:
            matches.append("\n\n" + block.strip("\n") + "\n\n")
        else:
            matches.append(linked(escaped(LABEL.sub("\n", block)), root))
    return "".join(matches).strip()


def linked(text: str, root: str) -> str:
    """Return the text with names of pages, such as docs/stability.md, as links; underscores may have been escaped."""

    def link(match: re.Match[str]) -> str:
        name = match.group(1).replace("\\", "")
        return f"[{match.group(1).rpartition('/')[2]}]({root}{name}.md)"

    return PAGE.sub(link, text)
