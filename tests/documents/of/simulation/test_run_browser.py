"""Page of a run with figures declared by its system, in a real browser.

Truth: the number of figures in its source, and the content that fits a screen.
"""

import numpy as np
import pytest
from matplotlib import image
from selenium.webdriver.common.by import By

from tests.support.documents.run_page import write_run_report
from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.driven import driven, scroll_to_plot
from tests.support.pages.own_samples import ANGLES, ERROR, PULSES, angles, errors, flown, pulses
from tests.support.pages.samples import run_result


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
    assert not inked[-40:].any()  # the whole page is in the picture


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height"), [(1100, 5600), (400, 10000)])
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
    assert not inked[-40:].any()  # the whole page is in the picture


COUNT = """
const {width, height} = arguments[0];
const copy = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
copy.drawImage(arguments[0], 0, 0);
const pixels = copy.getImageData(0, 0, width, height).data;
const counts = [0, 0];
for (let at = 0; at < pixels.length; at += 4)
  [[0, 114, 178], [213, 94, 0]].forEach((colour, index) => {
    if (pixels[at + 3] === 255 && colour.every((each, which) => pixels[at + which] === each)) counts[index] += 1;
  });
return counts;
"""


def test_a_legend_hides_a_path_with_its_marks(browser, tmp_path):
    """Blue and vermilion pixels of both views: none of a path that is hidden, dots and circle included."""
    run = run_result()
    for name in run.signals:
        if name.startswith("crew.cook.position"):
            run.signals[name] = 0.7 * run.signals[name] + 40.0
    write_run_report(run, tmp_path / "page.html", "Two")
    with driven(browser, tmp_path / "page.html") as driver:
        entries = driver.find_elements(By.XPATH, "//h2[.='Trajectory']/following-sibling::p[1]/span")
        assert [entry.text for entry in entries] == ["ship.position", "crew.cook.position"]
        frames = driver.find_elements(By.XPATH, "//h2[.='Trajectory']/..//div[contains(@class, 'live')]")
        for frame in frames:
            scroll_to_plot(driver, frame)
        canvases = [frame.find_element(By.TAG_NAME, "canvas") for frame in frames]

        def pixels():
            return [driver.execute_script(COUNT, canvas) for canvas in canvases]

        assert len(canvases) == 2
        assert np.all(np.array(pixels()) > 50)
        for index, entry in enumerate(entries):
            driver.execute_script("arguments[0].click()", entry)
            displayed = np.array(pixels())
            assert np.all(displayed[:, index] == 0)
            assert np.all(displayed[:, 1 - index] > 50)
            driver.execute_script("arguments[0].click()", entry)
        assert np.all(np.array(pixels()) > 50)
