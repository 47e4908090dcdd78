"""Elements of Markdown: tables, docstrings as prose, links to pages of docs/."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Sequence

LABEL = re.compile(r"^(?=(?:Sources?|Frames?|Equations|Limits|Kinds|Phases|Assumes|(?:method|law) \d)\b)", re.MULTILINE)
PAGE = re.compile(r"docs/((?:\w+/)*(?:\w|\\_)+)\.md")
CODE = re.compile(r"(``[^`]+``|`[^`]+`)")


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table; the cells are Markdown."""
    lines = [list(head), ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("\n", " ") for cell in line) + " |" for line in lines)


def escaped(text: str) -> str:
    """Return text escaped for a table cell: no tags, links, cell separators, or emphasis except double asterisks."""
    parts = CODE.split(text)
    return "".join(
        part if index % 2 else re.sub(r"((?<!\*)\*(?!\*)|[_\[\]|\\])", r"\\\1", part).replace("<", "&lt;")
        for index, part in enumerate(parts)
    )


def prose(docstring: str | None, root: str) -> str:
    """Return a docstring as Markdown: equations unchanged, sources and frames as paragraphs, page names as links.

    ``root`` is the relative path from the page to the site's root, such as ``../``.
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
    """Return the text with names of pages, such as docs/stability.md, as links; underscores may be escaped."""

    def link(match: re.Match[str]) -> str:
        name = match.group(1).replace("\\", "")
        return f"[{match.group(1).rpartition('/')[2]}]({root}{name}.md)"

    return PAGE.sub(link, text)
