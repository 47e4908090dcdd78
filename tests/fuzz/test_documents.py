"""Documents, tables, expressions and archives with something changed.

Truth: good documents; the reader raises nothing but an `InputError` in one line, whatever is changed in them.
"""

from __future__ import annotations

import pytest
from hypothesis import settings

from tests.fuzz.documents import (
    any_campaign,
    any_description,
    any_fmi3_description,
    any_parameter_set,
    any_system,
    campaign_reader,
    read_parameters,
    system_reader,
)
from tests.fuzz.originals import CAMPAIGN, SSD, SSV
from tests.fuzz.tables import any_archive, any_draws, any_expression, any_mapping, any_series
from tests.support.lengths import either

pytestmark = pytest.mark.flies


def test_the_originals_are_good(tiny_folder, tmp_path):
    system_reader(tiny_folder, tmp_path)(SSD.encode())
    campaign_reader(tiny_folder, tmp_path)(CAMPAIGN.encode())
    assert read_parameters(SSV.encode())


DOCUMENTS = [any_system, any_parameter_set, any_campaign, any_description, any_fmi3_description]
TABLES = [any_mapping, any_series, any_draws, any_expression, any_archive]


@pytest.mark.parametrize("target", [*DOCUMENTS, *TABLES])
def test_any_change(tiny_folder, tmp_path, target):
    settings(max_examples=either(4000, 1000))(target(tiny_folder, tmp_path))()
