"""The study that tests of its page and figures look at."""

import pytest


@pytest.fixture(scope="module")
def report(studies):
    return studies.everything


@pytest.fixture(scope="module")
def page(stability_page):
    return stability_page.read_text(encoding="utf-8")
