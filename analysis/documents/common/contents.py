"""The headings of a page's sections with their anchors, from which its list of contents is."""

from __future__ import annotations

from typing import NamedTuple

from markupsafe import Markup

PREFIX = "section-"  # of anchors, which no identifier inside a figure has


class ContentsEntry(NamedTuple):
    """The title of a section and the anchor at which it begins."""

    title: str
    anchor: str


class Contents:
    """The sections of one page in their order, as its template writes them."""

    def __init__(self) -> None:
        self.entries: list[ContentsEntry] = []

    def add(self, title: str) -> Markup:
        """Return the anchor of a further section."""
        slug = "-".join("".join(letter if letter.isalnum() else " " for letter in title.lower()).split())
        name = f"{PREFIX}{slug}"
        if any(entry.anchor == name for entry in self.entries):
            name += f"-{len(self.entries)}"
        self.entries.append(ContentsEntry(title, name))
        return Markup.escape(name)
