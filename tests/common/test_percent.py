"""perilune.common.percent, and the absence of other formats of fractions, which could print powers of ten.

Truth: decimal arithmetic, and the sources.
"""

import re
from decimal import ROUND_HALF_EVEN, Decimal

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from perilune.common.paths import ROOT
from perilune.common.percent import percent, short_percent


@given(st.floats(0.0, 1.0), st.integers(0, 6))
@example(0.996, 0)
@example(1.0 - 1e-9, 2)
@example(5e-324, 2)
def test_plain_digits_and_no_all_or_nothing_that_is_not(fraction, decimals):
    text = percent(fraction, decimals)
    assert re.fullmatch(r"[<>]? ?\d+(\.\d+)?", text)
    if fraction in (0.0, 1.0):
        assert float(text) == 100.0 * fraction
    elif text[0] in "<>":
        limit = float(text[2:])
        assert 100.0 * fraction < limit if text[0] == "<" else 100.0 * fraction > limit
    else:
        assert float(text) not in (0.0, 100.0)
        exact = Decimal(100.0 * fraction).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_EVEN)
        assert Decimal(text) == exact


@pytest.mark.parametrize(
    ("fraction", "text"),
    [(0.996, "99.6"), (1.0, "100"), (0.0, "0"), (0.5, "50"), (0.00751, "0.75"), (0.99999, "> 99.99"), (1e-9, "< 0.01")],
)
def test_in_texts_without_zeros_at_the_end(fraction, text):
    assert short_percent(fraction) == text


def test_no_percentage_is_printed_with_few_significant_digits():
    """``{100 * share:.2g} %`` of 0.996 is ``1e+02 %``."""
    sources = [*(ROOT / "analysis").rglob("*.py"), *(ROOT / "common").rglob("*.py")]
    few = re.compile(r"\{100(\.0)? ?\* ?[^}]*:\.[1-6]g\}")
    assert [str(file) for file in sources if few.search(file.read_text(encoding="utf-8"))] == []
