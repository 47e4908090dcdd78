"""docs/campaigns.md: its example is a campaign, and it names all there is."""

import re
from pathlib import Path

from perilune.analysis.campaign.campaign import REDUCTIONS, TRACES
from perilune.analysis.campaign.distributions import DISTRIBUTIONS
from perilune.analysis.campaign.draws import draw_table
from perilune.analysis.campaign.expressions import FUNCTIONS
from perilune.analysis.campaign.file import REDUCTION_OF

TEXT = (Path(__file__).parents[2] / "docs" / "campaigns.md").read_text(encoding="utf-8")


def test_the_example_is_a_campaign(parse):
    (example,) = re.findall(r"```toml\n(.*?)```", TEXT, re.DOTALL)
    campaign = parse(example)
    assert draw_table(campaign).parameters(0).keys() == {
        "plant.initial_mass",
        "plant.initial_position[1]",
        "plant.initial_position[2]",
    }


def test_every_word_is_documented():
    words = set(re.findall(r"[a-z_0-9]+", " ".join(re.findall(r"`([^`\n]+)`", TEXT))))
    keys = {key for arguments, _ in DISTRIBUTIONS.values() for key in arguments}
    assert {*DISTRIBUTIONS, *keys, *REDUCTIONS, *REDUCTION_OF, *TRACES, *FUNCTIONS} <= words
