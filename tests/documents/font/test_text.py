"""Widths of text in DejaVu Sans.

Truth: Pillow's layout of the same font, without kerning.
"""

import json
import subprocess
import sys

import pytest
from PIL import ImageFont

from perilune.analysis.documents.font.text import TABLE, text_width
from release.font import FILES, FONTS, advances

LARGE = 2048  # px, at which hinting moves nothing


@pytest.mark.parametrize("text", ["plant", "measured_angular_velocity[3]", "WAVE, Tj", "· 2 → m²"])
@pytest.mark.parametrize("is_bold", [False, True])
def test_widths(text, is_bold):
    font = ImageFont.truetype(
        str(FONTS / f"DejaVuSans{'-Bold' if is_bold else ''}.ttf"), LARGE, layout_engine=ImageFont.Layout.BASIC
    )
    expected = sum(font.getlength(character) for character in text) * 9.0 / LARGE
    assert text_width(text, 9.0, is_bold=is_bold) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("weight", FILES)
def test_the_table_is_that_of_the_font(weight):
    expected = advances(FONTS / FILES[weight])
    assert json.loads(TABLE.read_text(encoding="utf-8"))[weight] == expected
    assert sum(map(len, expected.values())) > 4000


def test_pictures_of_charts_need_no_matplotlib():
    code = (
        "import sys\n"
        "from perilune.analysis.documents.chart import axes, equal, layout, marks, symbols, write_svg\n"
        "sys.exit('matplotlib' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_characters_that_the_font_lacks():
    assert text_width("漢", 10.0) == 10.0
    assert text_width("e\u0301", 10.0) == text_width("e", 10.0)
