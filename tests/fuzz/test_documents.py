"""Randomly altered documents, tables, expressions and archives.

Truth: valid documents; the reader raises only an `InputError` of one line, for any alteration.
"""

from __future__ import annotations

import pytest
from hypothesis import settings

from tests.fuzz.documents import (
    any_campaign,
    any_description,
    any_fmi3_description,
    any_parameter_set,
    any_parameter_set_with_arrays,
    any_system,
    any_system_with_arrays,
    campaign_reader,
    read_parameters,
    system_reader,
)
from tests.fuzz.originals import CAMPAIGN, SSD, SSD_2, SSV, SSV_2
from tests.fuzz.tables import any_archive, any_draws, any_expression, any_mapping, any_series
from tests.support.lengths import either

pytestmark = pytest.mark.flies


def test_the_originals_are_good(tiny_folder, tmp_path):
    for text in (SSD, SSD_2):
        system_reader(tiny_folder, tmp_path)(text.encode())
    campaign_reader(tiny_folder, tmp_path)(CAMPAIGN.encode())
    assert read_parameters(SSV.encode())
    assert [each.name for each in read_parameters(SSV_2.encode())][:2] == ["a[1,1]", "a[1,2]"]


DOCUMENTS = [any_system, any_system_with_arrays, any_parameter_set, any_parameter_set_with_arrays]
OTHERS = [any_campaign, any_description, any_fmi3_description]
TABLES = [any_mapping, any_series, any_draws, any_expression, any_archive]


@pytest.mark.parametrize("target", [*DOCUMENTS, *OTHERS, *TABLES])
def test_any_change(tiny_folder, tmp_path, target):
    settings(max_examples=either(4000, 250))(target(tiny_folder, tmp_path))()
