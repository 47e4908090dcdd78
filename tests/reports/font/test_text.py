"""Widths of text in DejaVu Sans.

Truth: Pillow's own layout of the same font, without kerning.
"""

from pathlib import Path

import matplotlib
import pytest
from PIL import ImageFont

from perilune.analysis.reports.font.text import text_width

FONTS = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
LARGE = 2048  # px, at which hinting moves nothing


@pytest.mark.parametrize("text", ["plant", "measured_angular_velocity[3]", "WAVE, Tj", "· 2 → m²"])
@pytest.mark.parametrize("is_bold", [False, True])
def test_widths(text, is_bold):
    font = ImageFont.truetype(
        str(FONTS / f"DejaVuSans{'-Bold' if is_bold else ''}.ttf"), LARGE, layout_engine=ImageFont.Layout.BASIC
    )
    expected = sum(font.getlength(character) for character in text) * 9.0 / LARGE
    assert text_width(text, 9.0, is_bold=is_bold) == pytest.approx(expected, rel=2e-3)


def test_characters_that_the_font_lacks():
    assert text_width("漢", 10.0) == 10.0
    assert text_width("e\u0301", 10.0) == text_width("e", 10.0)
