"""Figures of variable width in a real browser, on a phone and on a wide screen.

Truth: the layout of the browser; texts and axes area of the picture over which the script draws.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

from perilune.analysis.documents.figures.declared import CurveFigure
from tests.support.documents.run_page import write_run_report
from tests.support.lengths import either
from tests.support.pages.driven import driven, scroll_to_plot
from tests.support.pages.own_samples import TIME, flown, scalar

MEASURE = """
const picture = arguments[0], style = getComputedStyle(picture);
const plain = ({left, top, right, bottom}) => [left, top, right, bottom];
const [left, top, right, bottom] = plain(picture.getBoundingClientRect());
const padding = ["Left", "Top", "Right", "Bottom"].map((side) => parseFloat(style["padding" + side]));
const texts = [...picture.querySelectorAll("text")].filter((text) => text.getClientRects().length);
return {
  figure: [left, top, right, bottom],
  axes: [left + padding[0], top + padding[1], right - padding[2], bottom - padding[3]],
  live: plain(picture.parentElement.querySelector(".chart > .area").getBoundingClientRect()),
  texts: texts.map((text) => plain(text.getBoundingClientRect())),
  sizes: texts.map((text) => parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a),
  words: texts.map((text) => text.textContent),
  columns: picture.closest(".panels") ? (picture.closest(".halves") ? 2 : 3) : 1,
};
"""


@pytest.mark.parametrize("phone", either([False, True], [True]))
def test_texts_and_axes(browser, flight, phone):
    with driven(browser, flight / "page.html", phone=phone, unfolded=True) as driver:
        frames = driver.find_elements(By.CSS_SELECTOR, ".live:has(> svg.figure)")
        visible = [frame for frame in frames if frame.size["height"]]
        assert len(visible) > 30
        for frame in visible[::4]:
            scroll_to_plot(driver, frame)
            measured = driver.execute_script(MEASURE, frame.find_element(By.CSS_SELECTOR, "svg.figure"))
            assert measured["live"] == pytest.approx(measured["axes"], abs=1.0)
            assert min(measured["sizes"]) == pytest.approx(11.0)
            assert max(measured["sizes"]) <= 9.0 * 11.0 / 8.0 + 1e-6
            left, top, right, bottom = measured["figure"]
            width = 366.0 if phone else (1000.0, 491.0, 321.3)[measured["columns"] - 1]
            assert right - left == pytest.approx(width, abs=1.0)
            for box in measured["texts"]:
                assert left - 1.0 <= box[0] <= box[2] <= right + 1.0
                assert top - 1.0 <= box[1] <= box[3] <= bottom + 1.0
            for one, other in combinations(zip(measured["words"], measured["texts"], strict=True), 2):
                assert are_apart(one[1], other[1]), (one, other)


def are_apart(one, other):
    """Return True if lines of text, higher than their letters by 3 px above and below, do not overlap."""
    gaps = [max(other[side] - one[side + 2], one[side] - other[side + 2]) for side in (0, 1)]
    return gaps[0] >= 0.0 or gaps[1] >= -6.0


def test_the_cursor_over_a_figure_that_remains_a_picture(browser, tmp_path):
    """Its numbers have more digits than a page; the cursor is where the other figure has it."""
    curves = [
        CurveFigure(title, (), (scalar(f"ship.{title}"),), (title,), None, None, True, None)
        for title in ("level", "height")
    ]
    run = flown(level=1e9 + np.sin(TIME), height=np.sin(TIME))
    write_run_report(run, tmp_path / "page.html", "Two", curves)
    with driven(browser, tmp_path / "page.html") as driver:
        picture = driver.find_element(By.CSS_SELECTOR, ".pictured:has(> svg.figure)")
        area = scroll_to_plot(driver, driver.find_element(By.CSS_SELECTOR, ".live:has(> svg.figure)"))
        ActionChains(driver).move_to_element_with_offset(area, area.size["width"] // 4, 0).perform()
        beyond, cursor, axes = driver.execute_script(CURSORS, picture, area)
        assert cursor > 0.7
        assert beyond == pytest.approx([cursor, axes[0], axes[1]], abs=0.002)


CURSORS = """
const [picture, area] = arguments;
const box = (element) => element.getBoundingClientRect();
const svg = picture.querySelector("svg"), style = getComputedStyle(svg);
const padding = (side) => parseFloat(style["padding" + side]);
const [outer, line, live] = [box(svg), box(picture.querySelector(".cursor")), box(area)];
const width = outer.width - padding("Left") - padding("Right");
return [
  [(line.left - outer.left - padding("Left")) / width, line.top - outer.top, outer.bottom - line.bottom],
  (box(area.querySelector(".cursor")).left - live.left) / live.width,
  [padding("Top"), padding("Bottom")],
];
"""
