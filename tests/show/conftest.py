"""A campaign's folder of many metrics, and the application that shows it."""

from __future__ import annotations

import pytest

from tests.support.campaigns.many_metrics import write_many
from tests.support.campaigns.show_client import ShowClient


@pytest.fixture(scope="session")
def campaign_folder(tmp_path_factory):
    """Write 2100 trials of each of three variants; the last shard of 500 has fewer."""
    folder = tmp_path_factory.mktemp("client") / "results"
    write_many(folder, 2100, 500, ("alpha", "beta", "gamma"))
    return folder


@pytest.fixture
def client(campaign_folder):
    client = ShowClient(campaign_folder)
    yield client
    client.service.stop()
