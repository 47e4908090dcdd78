"""Statements on the page of a comparison about data that batches did not record, or not for the same trials.

Truth: hand-written batches with incomplete records.
"""

import pytest

from perilune.analysis.campaigns.folder.shard_files import write_draws
from tests.support.pages.checks import assert_self_contained, parse, text_of
from tests.support.pages.comparison_samples import CAMPAIGN, write_sample
from tests.support.pages.written import write_comparison_page


def lines(page):
    return [" ".join(part.text_content().split()) for part in parse(page).xpath("//p[@class='empty']")]


def test_what_is_not_recorded_is_said_and_not_drawn(tmp_path):
    bare = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    bare = bare[: bare.index("[metric.x_error")] + bare[bare.index("[record]") :]
    write_sample(tmp_path / "bare", traced=0, final=False, text=bare)
    page = write_comparison_page([tmp_path / "bare"], tmp_path / "page.html")
    assert_self_contained(page)
    assert lines(page) == [
        "No trajectories and no commands over time: no flight has a trace; give the campaign's [record] the keys "
        "every, signals and trials.",
        "No propellant: no metric is in kg, and [record] final does not contain a mass.",
        "No dispersion of the final position and velocity: [record] final does not contain its three elements.",
        "Nothing is recorded over time.",
        "No normalised estimation errors: no metric's name ends in _over_sigma.",
    ]


def test_of_what_goes_nowhere_no_path_and_no_propellant_are_missed(tmp_path):
    bare = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    sampling = 'every = 2\nsignals = ["pilot.status"]\ntrials = 4'
    write_sample(tmp_path / "still", final=False, text=bare.replace("{sampling}", sampling))
    page = write_comparison_page([tmp_path / "still"], tmp_path / "page.html")
    assert_self_contained(page)
    assert lines(page) == []
    headings = [part.text for part in parse(page).xpath("//h2 | //h3")]
    assert not {"Trajectories", "At the end", "Other recorded signals"} & set(headings)
    assert "pilot.status" in [part.text for part in parse(page).xpath("//h4")]


@pytest.mark.slow
def test_propellant_from_final_masses_where_no_metric_tells_it(tmp_path):
    text = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    write_sample(tmp_path / "mass", text=text)
    page = write_comparison_page([tmp_path / "mass"], tmp_path / "page.html")
    assert "final ship.mass" in text_of(page)
    assert not lines(page)


@pytest.mark.slow
def test_traces_of_failures_only_are_called_biased(tmp_path):
    result = write_sample(tmp_path / "out")
    result.provenance["record"] = {"every": None, "signals": [], "trials": None, "traces": "failures"}
    for trials in result.trials.values():
        for trial in [trial for trial in trials.traces if trials.success[trial]]:
            del trials.traces[trial]
    result.write(tmp_path / "other")
    write_draws(result.plan, tmp_path / "other", 50)
    page = write_comparison_page([tmp_path / "other"], tmp_path / "page.html")
    assert "do not compare their spread" in text_of(page)
    assert "pilot.thrust_direction above the horizontal" in text_of(page)
    assert "pilot.status" not in [part.text for part in parse(page).xpath("//h4")]  # not among what is known by name
