"""A strict FMU of FMI 3.0 for each test, with and without event mode."""

from functools import partial

import pytest

from tests.support.fmi3.strict_pair import pack_strict_pair


@pytest.fixture
def strict_pair(tmp_path):
    """Return a writer of an .ssp of two strict FMUs, see `pack_strict_pair`."""
    return partial(pack_strict_pair, tmp_path)
