"""Stability page in a real browser, wide and narrow, with all sections open: it renders, and nothing overflows.

Truth: the figures and colours of the page; the widths in the layout of the browser.
"""

import html
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import image

from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.checks import text_of, without_policy

COLOURS = ((0, 114, 178), (213, 94, 0), (0, 158, 115))  # lines of L, limits, circle of the modulus margin
MEASURE = """<script>
onerror = message => document.body.dataset.error = message;
addEventListener("load", () => {
  const page = document.documentElement, inside = element => element.closest(".scroll") !== null;
  const wide = [...document.querySelectorAll("body *")].filter(
    element => !inside(element) && !element.closest("svg") && element.getBoundingClientRect().right > innerWidth + 1);
  document.body.dataset.overflow = page.scrollWidth - page.clientWidth;
  document.body.dataset.wide = wide.map(element => element.tagName + "." + element.className).join(" ");
  const tops = [...document.querySelectorAll(".parts h4")].map(
    heading => [heading.textContent, Math.round(heading.getBoundingClientRect().top)]);
  document.body.dataset.tops = JSON.stringify(tops.slice(0, 3));
  document.body.dataset.closed = document.querySelectorAll("details:not([open])").length;
});
</script></body>"""


def unfolded(page):
    """Return the text of a page with all folded sections unfolded."""
    text = without_policy(page.read_text(encoding="utf-8"))
    return re.sub(r"<details(?! open)(?! class=\"printed\" open)", "<details open", text)


@pytest.fixture(scope="module")
def few(studies, tmp_path_factory):
    """Write a page so short that a picture holds it."""
    path = tmp_path_factory.mktemp("stability") / "page.html"
    everything = studies.everything
    loops = tuple(loop for loop in everything.loops if loop.loop != "pair")
    replace(everything, loops=loops).report(path)
    path.write_text(unfolded(path), encoding="utf-8")
    return path


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height"), either([(1200, 16000), (400, 30000)], [(1200, 16000)]))
def test_page_renders_wide_and_narrow(browser, few, tmp_path, width, height):
    size = f"--window-size={width},{height}"
    start(browser, few, tmp_path, size, f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3] * 255.0
    assert pixels.shape[:2] == (height, width)
    for colour in COLOURS:
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 3.0, axis=-1)) > 300
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()  # nothing reaches the right edge: tables scroll in themselves
    assert not inked[-40:].any()  # the whole page is in the picture


def test_nothing_overflows_and_no_script_fails(browser, stability_page, tmp_path):
    measured = tmp_path / "measured.html"
    measured.write_text(unfolded(stability_page).replace("</body>", MEASURE), encoding="utf-8")
    dom = start(browser, measured, tmp_path, "--window-size=500,2000", "--dump-dom")
    assert re.search(r"<body[^>]* data-overflow=\"0\"", dom)
    assert re.search(r"<body[^>]* data-wide=\"\"", dom)
    assert re.search(r"<body[^>]* data-closed=\"0\"", dom)
    assert not re.search(r"<body[^>]* data-error", dom)
    assert dom.count('class="figure"') == stability_page.read_text(encoding="utf-8").count('class="figure"') > 20


def test_margins_stand_next_to_the_method_they_are_computed_by(browser, few, tmp_path):
    """Without room for both the page of three loops is 800 px longer."""
    measured = tmp_path / "measured.html"
    measured.write_text(few.read_text(encoding="utf-8").replace("</body>", MEASURE), encoding="utf-8")
    dom = start(browser, measured, tmp_path, "--window-size=1200,2000", "--dump-dom")
    collected = re.search(r' data-tops="([^"]*)"', dom)
    assert collected is not None
    tops = dict(json.loads(html.unescape(collected[1])))
    assert tops["Method"] == tops["Classical"] < tops["Robust"]


def test_what_is_the_same_of_all_loops_is_stated_once(stability_page):
    text = text_of(stability_page.read_text(encoding="utf-8"))
    assert text.count("leave P \N{MINUS SIGN} N unstable closed-loop poles, and stable is P = N") == 1
    assert text.count("Disk margin: gain and phase may vary simultaneously within it") == 1
