"""What a system written our way gives."""

import pytest

from tests.support.foreign.plain_system import fly_plain


@pytest.fixture
def plain(tiny, tmp_path):
    return fly_plain(tiny, tmp_path)
