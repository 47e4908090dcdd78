"""Pages in a real browser: they load, render and request no other resources. Truth: the browser."""

import numpy as np
import pytest
from matplotlib import image

from tests.support.documents.run_page import write_run_report
from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.samples import mixed_batch, run_result, write_batch_page


@pytest.mark.parametrize(
    ("write", "result"),
    either([(write_run_report, run_result), (write_batch_page, mixed_batch)], [(write_batch_page, mixed_batch)]),
    ids=either(["run", "batch"], ["batch"]),
)
def test_pages_render(browser, tmp_path, write, result):
    page = tmp_path / "page.html"
    write(result(), page, "In a browser")
    dom = start(browser, page, tmp_path, "--dump-dom")
    assert dom.count('class="figure') == page.read_text(encoding="utf-8").count('class="figure') > 2
    assert "<h1>In a browser</h1>" in dom
    assert "SHA-256" in dom
    start(browser, page, tmp_path, f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3]
    assert pixels.shape[:2] == (3000, 1100)
    for colour in ((0, 114, 178), (213, 94, 0)):  # blue and vermilion lines of the figures
        assert np.count_nonzero(np.all(np.abs(pixels * 255.0 - colour) < 2.0, axis=-1)) > 50
