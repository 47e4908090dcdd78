"""The engine that lays diagrams out; without its bundle these tests are left out."""

import pytest

from perilune.analysis.reports.diagram.elk import Engine, is_available


@pytest.fixture(scope="session")
def layout_bundle() -> None:
    """Needed: `make web`."""
    if not is_available():
        pytest.skip("no layout bundle")


@pytest.fixture(scope="module")
def engine(layout_bundle):
    with Engine() as loaded:
        yield loaded
