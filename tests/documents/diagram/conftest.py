"""The engine that lays diagrams out; without its bundle these tests are left out."""

import pytest

from perilune.analysis.documents.diagram.elk import Engine
from perilune.analysis.documents.interactive.script_bundles import read_bundle
from tests.support.pages.scripts import require_scripts


@pytest.fixture(scope="session")
def layout_bundle() -> str | None:
    """Return the script: `make web`."""
    require_scripts()
    return read_bundle("layout")


@pytest.fixture(scope="module")
def engine(layout_bundle):
    with Engine(layout_bundle) as loaded:
        yield loaded
