"""How wide text is: DejaVu Sans by its own metrics, as the figures of a page have it."""

from __future__ import annotations

import unicodedata
from functools import cache
from pathlib import Path

import matplotlib
from matplotlib.ft2font import FT2Font, LoadFlags

ELLIPSIS = "…"
ASCENT, DESCENT = 0.928, 0.236  # of a line, of its size
TALL, DEEP = 0.76, 0.207  # of l and p, of its size
MIDDLE = 0.365  # of its size, from the base line to the middle of digits
EM = 2048  # units of the font
ZERO_WIDTH = ("Mn", "Me", "Cf")  # categories of characters that take no room


@cache
def _font(is_bold: bool) -> FT2Font:
    name = "DejaVuSans-Bold.ttf" if is_bold else "DejaVuSans.ttf"
    return FT2Font(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / name))


@cache
def _advance(character: str, is_bold: bool) -> int:
    """In units of the font; a character that it lacks is as wide as it is high."""
    if unicodedata.category(character) in ZERO_WIDTH:
        return 0
    font = _font(is_bold)
    if font.get_char_index(ord(character)) == 0:
        return EM
    return int(font.load_char(ord(character), flags=LoadFlags.NO_SCALE | LoadFlags.NO_HINTING).horiAdvance)


def text_width(text: str, size: float, *, is_bold: bool = False) -> float:
    """The width of a line in the unit of ``size``."""
    return sum(_advance(character, is_bold) for character in text) * size / EM


def shorten(text: str, longest: int) -> str:
    """At most so many characters, with an ellipsis for those in the middle."""
    if len(text) <= longest:
        return text
    end = (longest - 1) // 2
    return f"{text[: longest - 1 - end]}{ELLIPSIS}{text[-end:]}"
