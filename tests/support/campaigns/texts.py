"""Campaigns from texts of tests."""

from __future__ import annotations

import tomllib

from perilune.analysis.campaigns.definition.campaign import Campaign
from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.table import TomlTable

HEAD = 'system = "s"\ntrials = {trials}\nseed = {seed}\n[success]\nexpression = "1"\n'


def parse_text(text: str) -> Campaign:
    """Parse a campaign from the whole text of its file, which errors call test.toml."""
    return parse_campaign(TomlTable(tomllib.loads(text), "test.toml"))


def make_campaign(text: str, trials: int = 8, seed: int = 1) -> Campaign:
    """Parse a campaign from the text of its file below the required keys."""
    return parse_text(HEAD.format(trials=trials, seed=seed) + text)
