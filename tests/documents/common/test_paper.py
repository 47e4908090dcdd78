"""Printed pages: number of sheets, and notes on omitted content.

Truth: the sheets printed by a browser, on letter paper and on A4.
"""

from dataclasses import replace

import pytest

from tests.support.pages.comparison_samples import write_sample
from tests.support.pages.paper import FORMATS, printed, words_of
from tests.support.pages.written import write_comparison_page

MOST_OF_A_COMPARISON, MOST_OF_A_STUDY = 5, 12
SIX = ("alpha", "beta", "gamma", "delta", "epsilon", "zeta")


@pytest.mark.slow
def test_a_comparison_of_six_variants_is_short(browser, tmp_path):
    page = tmp_path / "page.html"
    write_sample(tmp_path / "out", variants=SIX)
    write_comparison_page([tmp_path / "out"], page)
    for paper in FORMATS:
        sheets = printed(browser, page, tmp_path, paper)
        assert 2 < len(sheets.pages) <= MOST_OF_A_COMPARISON
        words = words_of(sheets)
        for heading in ("Commands and motion, each variant", "Metrics of the successful trials", "Provenance"):
            assert f"{heading}: on the screen, not on paper" in words
        assert "McNemar" not in words


@pytest.mark.slow
def test_what_was_opened_is_printed(browser, tmp_path, comparison):
    page = tmp_path / "page.html"
    text = (comparison / "page.html").read_text(encoding="utf-8")
    page.write_text(text.replace('<details class="fold">', '<details class="fold" open>'), encoding="utf-8")
    words = words_of(printed(browser, page, tmp_path, "A4"))
    assert "McNemar" in words
    assert "Provenance: on the screen" not in words


@pytest.mark.parametrize(
    ("times", "full"),
    [(1, True), pytest.param(9, False, marks=pytest.mark.slow)],
    ids=["two loops", "eighteen loops"],
)
def test_a_stability_study_is_short(browser, tmp_path, studies, times, full):
    """Eighteen loops are the two of the coupled pair nine times, with responses so large that none is another's."""
    page = tmp_path / "page.html"
    report = studies.pair
    loops = [larger(loop, 1.4**number, number) for number in range(times) for loop in report.loops]
    replace(report, loops=tuple(loops)).report(page)
    for paper in FORMATS:
        sheets = printed(browser, page, tmp_path, paper)
        assert 1 < len(sheets.pages) <= MOST_OF_A_STUDY
        words = words_of(sheets)
        assert "drag to zoom" not in words  # the toolbar of the screen
        assert ("On paper, of each loop: Bode, Nichols;" in words) != full
        assert words.count("Classical") == len(loops)  # a table of each
        assert (words.count("Controllable from the break point".lower()) == len(loops)) == full


def larger(loop, factor, number):
    """Return a loop whose response is larger by a factor."""
    curve = replace(loop.curve, value=factor * loop.curve.value)
    return replace(loop, curve=curve, name=f"{loop.name} {number}")
