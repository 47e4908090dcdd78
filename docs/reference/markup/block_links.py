"""Links from written pages to block pages, which exist only in the built site."""

from __future__ import annotations

import os
import re
from collections.abc import Collection

FENCED = re.compile(r"(^```.*?^```$|^#[^\n]*$)", re.MULTILINE | re.DOTALL)
NAME = re.compile(r"(?<![\[`])`(\w+)`(?![\]`])")


def link_blocks(page: str, path: str, blocks: Collection[str]) -> str:
    """Return a page with the first mention of each block, as code outside listings and headings, turned into a link.

    ``path`` is the page's path on the site, such as ``systems/lunar_landing.md``.
    """
    linked: set[str] = set()
    root = os.path.relpath("reference/blocks", os.path.dirname(path) or ".").replace(os.sep, "/")

    def link(match: re.Match[str]) -> str:
        name = match[1]
        if name not in blocks or name in linked:
            return match[0]
        linked.add(name)
        return f"[`{name}`]({root}/{name}.md)"

    sections = FENCED.split(page)
    return "".join(part if index % 2 else NAME.sub(link, part) for index, part in enumerate(sections))
