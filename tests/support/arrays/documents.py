"""Descriptions and parameter sets of SSP 2.0, in short form as in `builders`."""

from __future__ import annotations

import re

ARRAY = re.compile(r'name="(?P<name>[^"(]*)\((?P<size>[^"]*)\)"(?P<rest>[^>]*>)(?P<type><(?:ssc|ssv):\w+[^>]*/>)')


def in_version_2(text: str) -> str:
    """Return a document of `builders` as SSP 2.0: a connector or parameter ``x(2,3)`` has dimensions of these sizes.

    A size that is no number names the connector that gives it, `?` leaves it open; parameters have their values with
    commas between.
    """

    def with_dimensions(match: re.Match[str]) -> str:
        dimensions = "".join(f"<ssc:Dimension{_size(size)}/>" for size in match["size"].split(","))
        return f'name="{match["name"]}"{match["rest"]}{match["type"].replace(",", " ")}{dimensions}'

    return ARRAY.sub(with_dimensions, text.replace('version="1.0"', 'version="2.0"'))


def _size(size: str) -> str:
    if size == "?":
        return ""
    return f' size="{size}"' if size.isdigit() else f' sizeConnector="{size}"'
