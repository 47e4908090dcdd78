"""--until-decided: a campaign ends with the first shard at whose end its requirements are decided.

Truth: the same campaign simulated to its end, with trials counted by hand at the looks of the stopping rule.
"""

import json

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.verdicts.acceptance import AcceptanceVerdict
from perilune.analysis.campaigns.verdicts.stopping import stopping_rule
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS
from tests.support.campaigns.folders import bytes_of, shards_in

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
PAPER = SYSTEMS / SYSTEM / "campaigns" / "paper.toml"
SAMPLED = '[record]\nevery = 500\nsignals = ["plant.mass"]'
REQUIREMENT = """
[requirement.lands]
expression = "success"
share = 0.95
confidence = 0.9
"""
TRIALS, SHARD = 200, 25


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    path = tmp_path_factory.mktemp("campaign") / "c.toml"
    path.write_text(PAPER.read_text().replace("[record]", SAMPLED) + REQUIREMENT)
    return path


@pytest.fixture(scope="module")
def whole(campaign, fmus):
    return perilune.batch(SYSTEM, campaign, trials=TRIALS)


def expected_end(whole):
    """Return trials at the end of the first shard before which every variant has a verdict at some look."""
    ends = []
    for trials in whole.trials.values():
        rule, failures = stopping_rule(0.95, 0.9), np.cumsum(~trials.success)
        verdicts = {look: rule.decide(look, int(failures[look - 1])) for look in rule.looks(TRIALS)}
        ends.append(min(look for look, verdict in verdicts.items() if verdict is not AcceptanceVerdict.UNDECIDED))
    return -(-max(ends) // SHARD) * SHARD


def test_it_ends_where_it_is_decided(campaign, whole, tmp_path, capsys):
    end = expected_end(whole)
    assert 0 < end < TRIALS
    command = ["batch", SYSTEM, "--campaign", str(campaign), "--trials", str(TRIALS), "--until-decided"]
    assert main([*command, "--output", str(tmp_path / "one"), "--workers", "1"]) == 1  # A* does not land so often
    assert "astar_guidance: requirement lands: " in capsys.readouterr().err
    assert main([*command, "--output", str(tmp_path / "two"), "--workers", "2"]) == 1
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")
    assert shards_in(tmp_path / "one") == end // SHARD
    document = json.loads((tmp_path / "one" / "summary.json").read_text())
    assert document["trials"] == end
    assert {int(path.stem) for path in (tmp_path / "one" / "traces").rglob("*.parquet")} == set(range(end))
    for variant, actual in document["variants"].items():
        lands = actual["requirements"]["lands"]
        assert lands["verdict"] == ("met" if variant == "analytic_guidance" else "not met")
        assert lands["rule"] == "until decided"
        assert lands["failures"] == int(np.sum(~whole.trials[variant].success[:end]))
    before = bytes_of(tmp_path / "one")
    assert main([*command, "--output", str(tmp_path / "one"), "--resume"]) == 1
    assert bytes_of(tmp_path / "one") == before
    assert perilune.merge(tmp_path / "one").to_json()["variants"] == document["variants"]


def test_there_must_be_something_to_decide(refusal):
    assert "--until-decided: the campaign has no requirement; declare a [requirement" in refusal(
        ["batch", SYSTEM, "--campaign", "paper", "--until-decided"]
    )
