"""The engine that lays diagrams out; without its bundle these tests are left out."""

import pytest

from perilune.analysis.reports.diagram.elk import Engine
from perilune.analysis.reports.interactive.bundles import read_bundle


@pytest.fixture(scope="session")
def layout_bundle() -> str:
    """The script: `make web`."""
    script = read_bundle("layout")
    if script is None:
        pytest.skip("no layout bundle")
    return script


@pytest.fixture(scope="module")
def engine(layout_bundle):
    with Engine(layout_bundle) as loaded:
        yield loaded
