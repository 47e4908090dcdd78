"""Pages in a real browser: they load, lay out and paint, and fetch nothing."""

import os
import shutil
import subprocess

import numpy as np
import pytest
from matplotlib import image
from reports.samples import mixed_batch, run_result

from analysis.reports.batch_report import write_batch_report
from analysis.reports.run_report import write_run_report

NO_BROWSER = "no chromium"  # tests/conftest.py tells at the end what was left out for it
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--window-size=1100,3000",
)  # fmt: skip


@pytest.fixture(scope="module")
def browser():
    """The path of chromium; without it the tests that ask for it are left out, which CI does not allow."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if found is None and os.environ.get("PERILUNE_REQUIRE_BROWSER") == "1":
        pytest.fail("chromium is not installed, and PERILUNE_REQUIRE_BROWSER=1 asks for it")
    if found is None:
        pytest.skip(NO_BROWSER)
    return found


def start(browser, page, folder, *arguments):
    command = [browser, *FLAGS, f"--user-data-dir={folder / 'profile'}", *arguments, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout


@pytest.mark.parametrize(
    ("write", "result", "figures"),
    [(write_run_report, run_result, 4), (write_batch_report, mixed_batch, 3)],
    ids=["run", "batch"],
)
def test_pages_render(browser, tmp_path, write, result, figures):
    page = tmp_path / "page.html"
    write(result(), page, "In a browser")
    dom = start(browser, page, tmp_path, "--dump-dom")
    assert dom.count('class="figure"') == figures
    assert "<h1>In a browser</h1>" in dom
    assert "SHA-256" in dom
    start(browser, page, tmp_path, f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3]
    assert pixels.shape[:2] == (3000, 1100)
    for colour in ((0, 114, 178), (213, 94, 0)):  # blue and vermilion lines of the figures
        assert np.count_nonzero(np.all(np.abs(pixels * 255.0 - colour) < 2.0, axis=-1)) > 50
