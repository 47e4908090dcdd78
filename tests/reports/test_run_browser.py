"""The page of a run with figures that its system asks for, in a real browser.

Truth: how many figures its source has, and what a screen of a width can show.
"""

import numpy as np
import pytest
from matplotlib import image

from perilune.analysis.reports.run_report import write_run_report
from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.own_samples import ANGLES, ERROR, PULSES, angles, errors, flown, pulses


@pytest.mark.parametrize(("width", "height"), either([(1100, 4200), (400, 9000)], [(1100, 4200)]))
def test_page_renders_wide_and_narrow(browser, tmp_path, width, height):
    page = tmp_path / "page.html"
    write_run_report(flown(angles=angles(), **pulses(), **errors()), page, "Own", [ANGLES, PULSES, ERROR])
    picture = tmp_path / "page.png"
    dom = start(browser, page, tmp_path, "--dump-dom", f"--window-size={width},{height}", f"--screenshot={picture}")
    assert dom.count('class="figure') == page.read_text(encoding="utf-8").count('class="figure') > 2 + 2 + 2
    pixels = image.imread(picture)[..., :3] * 255.0
    assert pixels.shape[:2] == (height, width)
    for colour in ((0, 114, 178), (213, 94, 0)):  # lines and bars, blue and vermilion
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 2.0, axis=-1)) > 100
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()  # what is wider scrolls in itself
    assert not inked[-40:].any()  # the whole page was seen


@pytest.mark.parametrize(("width", "height"), either([(1100, 5600), (400, 10000)], [(1100, 5600)]))
def test_a_flight_through_phases_renders_wide_and_narrow(browser, mission_page, tmp_path, width, height):
    page = mission_page
    picture = tmp_path / "page.png"
    dom = start(browser, page, tmp_path, "--dump-dom", f"--window-size={width},{height}", f"--screenshot={picture}")
    assert dom.count('class="figure') == page.read_text(encoding="utf-8").count('class="figure') > 2 + 2 + 2
    assert dom.count("<table>") == page.read_text(encoding="utf-8").count("<table>")
    pixels = image.imread(picture)[..., :3] * 255.0
    assert pixels.shape[:2] == (height, width)
    for colour in ((0, 114, 178), (213, 94, 0), (0, 105, 77)):  # bars and lines, statuses and sites, what is kept
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 2.0, axis=-1)) > 20
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()  # what is wider scrolls in itself
    assert not inked[-40:].any()  # the whole page was seen
