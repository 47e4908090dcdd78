"""docs/campaigns.md: its examples are valid campaigns; the reference of keys is complete."""

import re

import numpy as np

import perilune
from docs.reference.formats.pages import format_pages
from perilune.analysis.campaigns.definition.campaign import TRACES
from perilune.analysis.campaigns.definition.distributions import DISTRIBUTIONS
from perilune.analysis.campaigns.definition.expressions import FUNCTIONS
from perilune.analysis.campaigns.definition.faults import KEYS
from perilune.analysis.campaigns.definition.file import REDUCTION_OF, SCATTER
from perilune.analysis.campaigns.definition.reductions import REDUCTIONS
from perilune.analysis.campaigns.definition.requirements import KEYS as REQUIREMENT
from perilune.analysis.campaigns.definition.requirements import SIDES
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.analysis.options.fault import KINDS
from tests.support.documented import page_text

TEXT = page_text("docs/campaigns.md")


EXAMPLES = re.findall(r"```toml\n(.*?)```", TEXT, re.DOTALL)


def test_the_example_is_a_campaign(parse):
    campaign = parse(EXAMPLES[0])
    assert draw_table(campaign).parameters(slice(0, 1)).keys() == {
        "plant.initial_mass",
        "plant.initial_position[1]",
        "plant.initial_position[2]",
    }


def test_every_word_is_documented():
    page = format_pages()["campaign.md"]
    words = set(re.findall(r"[a-z_0-9]+", " ".join(re.findall(r"`([^`\n]+)`", page))))
    keys = {key for kind in DISTRIBUTIONS.values() for key in kind.keys}
    assert {*DISTRIBUTIONS, *keys, *REDUCTIONS, *REDUCTION_OF, *TRACES, *FUNCTIONS, *KINDS, *KEYS, *SCATTER} <= words
    assert {*REQUIREMENT, *SIDES} <= words


def test_the_requirements_of_the_example(campaign):
    (example,) = (text for text in EXAMPLES if "[requirement.lands]" in text)
    metric = '[metric.miss]\nexpression = "plant.x"\nreduction = "final"\n'
    pinpoint, lands = campaign(metric + example).requirements
    assert (pinpoint.share, pinpoint.confidence, pinpoint.metric, lands.share) == (0.9987, 0.9, "miss", 0.95)


def test_the_faults_of_the_example_fly(fmus, tmp_path):
    """In each trial the jets of one axis fail when the draws say: the plant receives no pulses of those commanded."""
    path = tmp_path / "failures.toml"
    (example,) = (text for text in EXAMPLES if "[fault]" in text)
    record = '[record]\ntraces = "all"\n[success]\nexpression = "1"\n'
    path.write_text(f'system = "orbital_attitude"\ntrials = 3\nseed = 1\n{example}{record}')
    batch = perilune.batch("orbital_attitude", str(path), workers=1, flavour="native", stop_time=120.0)
    rows, lost_pulses = batch.table().to_pylist(), 0
    for trial, name in enumerate(("roll_jets", "yaw_jets", "pitch_jets")):
        assert [row[f"fault.{name}"] for row in rows] == [row["draw.axis"] == trial + 1 for row in rows]
        failed = rows[trial]["draw.failure_time"]
        assert rows[trial][f"fault.{name}.start"] == failed
        traces = batch.trials["default"].traces[trial]
        for axis in (1, 2, 3):
            commanded = traces[f"pulses.pulse_lengths[{axis}]"]
            lost = (traces["time"] >= failed) & (axis == rows[trial]["draw.axis"])
            assert traces[f"plant.pulse_lengths[{axis}]"].tolist() == np.where(lost, 0.0, commanded).tolist()
            lost_pulses += np.count_nonzero(commanded[lost])
    assert lost_pulses > 0
