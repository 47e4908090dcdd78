"""Systems, parameter sets, campaigns and descriptions of FMUs with something changed.

Truth: good documents; the reader raises nothing but an `InputError` in one line, whatever is changed in them.
"""

from __future__ import annotations

import pytest
from hypothesis import settings

from tests.fuzz.documents import (
    any_campaign,
    any_description,
    any_parameter_set,
    any_system,
    campaign_reader,
    read_parameters,
    system_reader,
)
from tests.fuzz.originals import CAMPAIGN, SSD, SSV
from tests.support.lengths import either

pytestmark = pytest.mark.flies


def test_the_originals_are_good(tiny_folder, tmp_path):
    system_reader(tiny_folder, tmp_path)(SSD.encode())
    campaign_reader(tiny_folder, tmp_path)(CAMPAIGN.encode())
    assert read_parameters(SSV.encode())


@pytest.mark.parametrize("target", [any_system, any_parameter_set, any_campaign, any_description])
def test_any_change(tiny_folder, tmp_path, target):
    settings(max_examples=either(4000, 350))(target(tiny_folder, tmp_path))()
