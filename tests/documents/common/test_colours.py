"""Colours of pages are declared once, and coloured texts have sufficient contrast in light and dark mode.

Truth: relative luminance and contrast of WCAG 2.2, section 1.4.3, whose least ratio for text is 4.5.
"""

import re
from functools import cache
from pathlib import Path

import pytest

from perilune.analysis.documents.common.colours import HUES, SHADES, colour_properties
from perilune.common.paths import ROOT

TEXTS = ("ink", "note", "link", "muted", "pass", "fail", "withheld")
SHEETS = [*(ROOT / "analysis" / "documents").rglob("*.css"), *(ROOT / "analysis" / "show").glob("*.css")]
SCRIPTS = [path for path in (ROOT / "web").rglob("*.ts") if path.parent.name != "generated"]


@cache
def read(path: Path):
    return path.read_text(encoding="utf-8")


def luminance(colour):
    digits = colour.removeprefix("#")
    digits = digits if len(digits) == 6 else "".join(2 * digit for digit in digits)
    channels = [int(digits[start : start + 2], 16) / 255.0 for start in (0, 2, 4)]
    linear = [each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", TEXTS)
def test_texts_can_be_read_on_the_page(name, theme):
    low, high = sorted(luminance(getattr(SHADES[each], theme)) for each in (name, "paper"))
    assert (high + 0.05) / (low + 0.05) >= 4.5


def test_properties_in_style_sheets_are_those_declared():
    declared = set(re.findall(r"(--[\w-]+):", colour_properties()))
    assert len(declared) == len(SHADES) + len(HUES)
    texts = [read(path) for path in (*SHEETS, ROOT / "web" / "scene" / "sheet.ts")]
    in_sheets = {name for text in texts for name in re.findall(r"(--[\w-]+):", text)} | {"--wide", "--scene-gap"}
    used = {name for text in texts for name in re.findall(r"var\((--[\w-]+)", text)}
    assert not in_sheets & declared
    assert used <= in_sheets | declared
    assert not any("light-dark(" in text for text in texts)


def test_each_shade_is_used():
    text = "".join(map(read, (*SHEETS, *SCRIPTS)))
    unused = [
        name
        for name in SHADES
        if f"var(--{name.replace('_', '-')})" not in text
        and f"SHADES.{name}[" not in text
        and not re.search(rf'\b(colour|line)\([^\n]*"{name}"\)', text)
    ]
    assert unused == []
