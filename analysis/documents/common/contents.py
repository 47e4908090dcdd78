"""Headings of a page's sections with their anchors, for its table of contents."""

from __future__ import annotations

from typing import NamedTuple

from markupsafe import Markup

PREFIX = "section-"  # prefix of anchors; no identifier inside a figure begins with it


class ContentsEntry(NamedTuple):
    """The title of a section, and its anchor."""

    title: str
    anchor: str


class Contents:
    """The sections of one page in the order in which its template writes them."""

    def __init__(self) -> None:
        self.entries: list[ContentsEntry] = []

    def add(self, title: str) -> Markup:
        """Add a section and return its anchor."""
        slug = "-".join("".join(letter if letter.isalnum() else " " for letter in title.lower()).split())
        name = f"{PREFIX}{slug}"
        if any(entry.anchor == name for entry in self.entries):
            name += f"-{len(self.entries)}"
        self.entries.append(ContentsEntry(title, name))
        return Markup.escape(name)
