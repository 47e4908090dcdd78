"""Page of a comparison in a real browser, wide and narrow: it loads, renders, and nothing overflows.

Truth: the figures and colours of the page; the widths in the layout of the browser.
"""

import numpy as np
import pytest
from matplotlib import image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.driven import driven, scroll_to_plot

COLOURS = ((0, 114, 178), (213, 94, 0), (0, 158, 115))  # of the three variants


@pytest.fixture(scope="module")
def page(comparison):
    return comparison / "page.html"


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height"), either([(1100, 14000), (400, 30000)], [(1100, 14000)]))
def test_page_renders_wide_and_narrow(browser, page, tmp_path, width, height):
    size = f"--window-size={width},{height}"
    start(browser, page, tmp_path, size, f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3] * 255.0
    assert pixels.shape[:2] == (height, width)
    for colour in COLOURS:
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 3.0, axis=-1)) > 300
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()  # nothing reaches the right edge: tables scroll in themselves
    assert not inked[-40:].any()  # the whole page is in the picture


def test_every_figure_is_laid_out(browser, page, tmp_path):
    dom = start(browser, page, tmp_path, "--dump-dom")
    assert dom.count('class="figure"') == page.read_text().count('class="figure"') == 46
    assert "3 variants on the same trials" in dom


@pytest.mark.slow
def test_the_cursor_has_the_median_alone_and_nothing_of_ellipses(browser, page):
    with driven(browser, page, unfolded=True) as driver:
        for label, count in (("ship.mass of alpha over time", 1), ("Final position of alpha about the target", 0)):
            frame = driver.find_element(By.XPATH, f"//*[starts-with(@aria-label, '{label}')]/..")
            area = scroll_to_plot(driver, frame)
            ActionChains(driver).move_to_element(area).perform()
            dots = [each for each in area.find_elements(By.CSS_SELECTOR, "i") if each.is_displayed()]
            assert len(dots) == count, label
