"""Positions of the elements of a figure of variable width, computed at one width."""

from __future__ import annotations

import re
from typing import Any

TRANSLATE = re.compile(r"translate\(([-\d.]+)(?: ([-\d.]+))?\)")


def position(element: Any, area: tuple[float, float]) -> tuple[float, float]:
    """Return the position (px) of a text or a mark in axes with this area (px), from its upper left corner."""
    x = y = 0.0
    while element.getparent() is not None:
        shift = TRANSLATE.search(element.get("transform", ""))
        for each, size, add in zip(("x", "y"), area, (1, 2), strict=True):
            offset = _px(element.get(f"c{each}", element.get(each, "0")), size)
            offset += float(shift[add] or 0.0) if shift else 0.0
            x, y = (x + offset, y) if each == "x" else (x, y + offset)
        element = element.getparent()
    return x, y


def _px(attribute: str, size: float) -> float:
    return float(attribute.removesuffix("%")) * (size / 100.0 if attribute.endswith("%") else 1.0)
