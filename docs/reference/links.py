"""Check for broken links, anchors and images of a built site."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit

from lxml import html


def broken_links(site: Path) -> Iterator[tuple[str, str]]:
    """Yield (page, target) for each local reference of a site's pages to a missing file or anchor.

    Resources from other hosts count as broken, since the site must be readable without a network.
    """
    pages = {path: html.parse(str(path)).getroot() for path in sorted(site.rglob("*.html"))}
    anchors = {path: set(root.xpath("//@id | //a/@name")) for path, root in pages.items()}
    for path, root in pages.items():
        if path.name == "404.html":  # its links start from the root of a server
            continue
        for element in root.iter("a", "img", "link", "script"):
            target = element.get("href") or element.get("src")
            if target is None:
                continue
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                if element.tag != "a":
                    yield path.relative_to(site).as_posix(), target
                continue
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            anchor = unquote(parts.fragment)
            if not file.is_file() or (anchor and file in anchors and anchor not in anchors[file]):
                yield path.relative_to(site).as_posix(), target
