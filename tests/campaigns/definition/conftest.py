"""Campaigns written in the tests themselves."""

from collections.abc import Callable

import pytest

from perilune.analysis.campaigns.definition.campaign import Campaign
from tests.support.campaigns.texts import make_campaign, parse_text


@pytest.fixture(scope="session")
def parse() -> Callable[[str], Campaign]:
    """See `parse_text`."""
    return parse_text


@pytest.fixture(scope="session")
def campaign() -> Callable[..., Campaign]:
    """See `make_campaign`."""
    return make_campaign
