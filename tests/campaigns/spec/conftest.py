"""Campaigns written in the tests themselves."""

import tomllib
from collections.abc import Callable

import pytest

from perilune.analysis.campaigns.spec.campaign import Campaign
from perilune.analysis.campaigns.spec.file import parse_campaign
from perilune.analysis.campaigns.spec.toml.table import Table

HEAD = 'system = "s"\ntrials = {trials}\nseed = {seed}\n[success]\nexpression = "1"\n'


@pytest.fixture(scope="session")
def parse() -> Callable[[str], Campaign]:
    """A campaign from the whole text of its file, which errors call test.toml."""
    return lambda text: parse_campaign(Table(tomllib.loads(text), "test.toml"))


@pytest.fixture(scope="session")
def campaign(parse: Callable[[str], Campaign]) -> Callable[..., Campaign]:
    """A campaign from the part of its file below the required keys."""

    def make(text: str, trials: int = 8, seed: int = 1) -> Campaign:
        return parse(HEAD.format(trials=trials, seed=seed) + text)

    return make
