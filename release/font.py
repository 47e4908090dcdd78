"""Writes the widths of characters of DejaVu Sans, from matplotlib, to analysis/documents/font/advances.json."""

from __future__ import annotations

import json
from pathlib import Path

import matplotlib
from matplotlib.ft2font import FT2Font, LoadFlags

from perilune.analysis.documents.font.text import TABLE, Advances

FONTS = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
FILES = {"regular": "DejaVuSans.ttf", "bold": "DejaVuSans-Bold.ttf"}
CHARACTERS = range(0x20, 0x2C00)  # from Latin letters to arrows and mathematical signs


def advances(file: Path) -> Advances:
    """Return the widths in units of the font, by the first character of each row of consecutive ones."""
    font = FT2Font(str(file))
    rows: Advances = {}
    last = first = -1
    for code in CHARACTERS:
        if font.get_char_index(code) == 0:
            continue
        if code != last + 1:
            first = code
        width = font.load_char(code, flags=LoadFlags.NO_SCALE | LoadFlags.NO_HINTING).horiAdvance
        rows.setdefault(str(first), []).append(int(width))
        last = code
    return rows


def main() -> None:
    table = {name: advances(FONTS / file) for name, file in FILES.items()}
    TABLE.write_text(json.dumps(table, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
