"""Width of text in DejaVu Sans, the font of figures, from its metrics."""

from __future__ import annotations

import json
import unicodedata
from functools import cache
from pathlib import Path

TABLE = Path(__file__).with_name("advances.json")  # which `make font` writes
ELLIPSIS = "…"
ASCENT, DESCENT = 0.928, 0.236  # extents of a line over the font size
TALL, DEEP = 0.76, 0.207  # extents of l and p over the font size
MIDDLE = 0.365  # height of the middle of digits over the font size
EM = 2048  # font units per em
ZERO_WIDTH = ("Mn", "Me", "Cf")  # categories of characters without width

Advances = dict[str, list[int]]  # by the code of the first of several consecutive characters


@cache
def _advances(weight: str) -> dict[int, int]:
    """Return the advance widths of characters by code, in font units."""
    table: dict[str, Advances] = json.loads(TABLE.read_text(encoding="utf-8"))
    return {int(first) + step: width for first, widths in table[weight].items() for step, width in enumerate(widths)}


def _advance(character: str, is_bold: bool) -> int:
    """Return the advance width of a character in font units; an unknown character is as wide as the font is high."""
    if unicodedata.category(character) in ZERO_WIDTH:
        return 0
    return _advances("bold" if is_bold else "regular").get(ord(character), EM)


def text_width(text: str, size: float, *, is_bold: bool = False) -> float:
    """Return the width of a line of text in the unit of ``size``."""
    return sum(_advance(character, is_bold) for character in text) * size / EM


def shorten(text: str, longest: int) -> str:
    """Shorten a text to at most ``longest`` characters by an ellipsis in the middle."""
    if len(text) <= longest:
        return text
    end = (longest - 1) // 2
    return f"{text[: longest - 1 - end]}{ELLIPSIS}{text[-end:]}"
