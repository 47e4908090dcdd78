"""Page on screens of two widths, measured by a real browser: smallest text of its figures, overflowing elements.

Chromium's window is never narrower than 500 px, so the page is shown in a frame of each width, with and without
scripts.
"""

from __future__ import annotations

import html
import json
import re
from dataclasses import dataclass
from pathlib import Path

from tests.support.pages.browser import start

PHONE, WIDE = 390, 1400  # px
SCRIPT = """<script>
addEventListener("load", () => {
  document.body.dataset.measured = JSON.stringify([...document.querySelectorAll("iframe")].map(measure));
});
const measure = (frame) => {
  const page = frame.contentDocument, view = frame.contentWindow;
  const seen = [...page.querySelectorAll("svg.figure text")].filter(text => text.getClientRects().length);
  const height = text => {
    const matrix = text.getScreenCTM();
    return parseFloat(view.getComputedStyle(text).fontSize) * Math.hypot(matrix.a, matrix.b);
  };
  const wide = [...page.querySelectorAll("body *")].filter(element => !element.closest(".scroll")
    && !element.closest("svg") && element.getBoundingClientRect().right > view.innerWidth + 1);
  return {
    width: view.innerWidth, texts: seen.length, smallest: Math.min(...seen.map(height)),
    overflow: page.documentElement.scrollWidth - page.documentElement.clientWidth,
    wide: wide.map(element => element.tagName + "." + element.className),
  };
};
</script>"""


SMALLEST = 11.0  # px
SCRIPTS = re.compile("<script.*?</script>", re.DOTALL)


@dataclass(frozen=True)
class Measured:
    """Measures of a page in a frame ``width`` px wide: number of visible ``texts`` of figures, height of the
    ``smallest`` (px), overflow of the page (px), and the elements too wide, without those that scroll."""

    width: int
    texts: int
    smallest: float
    overflow: int
    wide: list[str]


def measure(browser: str, page: Path, folder: Path) -> list[Measured]:
    """Measure a page in the browser, with all sections unfolded."""
    text = re.sub(r"<details(?! open)([^>]*)>", r"<details\1 open>", page.read_text(encoding="utf-8"))
    frames = "".join(
        f'<iframe style="width: {width}px; height: 3000px; border: 0" srcdoc="{html.escape(written)}"></iframe>'
        for width in (PHONE, WIDE)
        for written in (text, SCRIPTS.sub("", text))
    )
    framed = folder / "framed.html"
    document = f'<!DOCTYPE html><meta charset="utf-8"><body>{frames}{SCRIPT}</body>'
    framed.write_text(document, encoding="utf-8")
    dom = start(browser, framed, folder, "--dump-dom")
    collected = re.search(r'data-measured="([^"]*)"', dom)
    assert collected is not None, "the page did not load"
    return [Measured(**each) for each in json.loads(html.unescape(collected[1]))]


def assert_legible(browser: str, page: Path, folder: Path) -> None:
    """Assert that no text of a figure is smaller than `SMALLEST`, and nothing makes the page wider than the screen."""
    measured = measure(browser, page, folder)
    assert [each.width for each in measured] == [PHONE, PHONE, WIDE, WIDE]
    for each in measured:
        assert each.texts > 8
        assert each.smallest >= SMALLEST - 1e-6
        assert (each.overflow, each.wide) == (0, [])
