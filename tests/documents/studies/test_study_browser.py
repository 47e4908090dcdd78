"""Pages of the studies in a browser: legible on a phone, rendered on a wide screen. Truth: its layout."""

import numpy as np
import pytest
from matplotlib import image

from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.narrow import assert_legible

BLUE, VERMILION = (0, 114, 178), (213, 94, 0)


@pytest.fixture(scope="module", params=either(["rare", "worst", "sensitivity"], ["worst"]))
def page(request, tmp_path_factory):
    path = tmp_path_factory.mktemp(request.param) / "page.html"
    request.getfixturevalue(f"{request.param}_result").report(path)
    return path


def test_a_study_is_legible_on_a_telephone(browser, page, tmp_path):
    assert_legible(browser, page, tmp_path)


def test_a_study_is_painted(browser, page, tmp_path):
    start(browser, page, tmp_path, f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3]
    colours = (BLUE,) if "Sobol" in page.read_text(encoding="utf-8") else (BLUE, VERMILION)
    for colour in colours:
        assert np.count_nonzero(np.all(np.abs(pixels * 255.0 - colour) < 2.0, axis=-1)) > 50
