"""Campaigns of foreign FMUs: metrics depend neither on the number of workers nor on the order of trials.

Truth: the closed form of the odd FMU, y(1 s) = gain u + 2 with u = 0.5, for the gains in the table of draws.
"""

import numpy as np
import pytest

import perilune
from tests.support.foreign.odd_fmu import odd_fmu, odd_system

CAMPAIGN = """
system = "odd.ssp"
trials = 24
seed = 3

[draw."odd.gain"]
distribution = "uniform"
low = {low}
high = 2.0

[success]
expression = "last < 100"

[metric.last]
expression = "odd.y"
reduction = "final"
"""


def flown(folder, low=-1.0, workers=1, compare=None, **quirks):
    path = odd_system(folder, **quirks)
    campaign = folder / "c.toml"
    campaign.write_text(CAMPAIGN.format(low=low))
    return perilune.batch(path, campaign, workers=workers, compare=compare)


def check(result):
    """Check every trial against the closed form; trials that a gain below 0 breaks have no metric."""
    for trials in result.trials.values():
        gains = result.plan.draws.columns["odd.gain"]
        expected = np.where([status == "failed" for status in trials.statuses], np.nan, gains * 0.5 + 2.0)
        np.testing.assert_allclose(trials.metrics["last"], expected, rtol=1e-13)


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("quirk", ["KEEPS_STATE", "KEEPS_PARAMETERS", "RESET", "LOSES_EARLY"])
def test_a_trial_does_not_know_of_the_one_before(tmp_path, quirk, workers):
    result = flown(tmp_path, workers=workers, **{quirk: 3 if quirk == "RESET" else True})
    check(result)
    assert result.summary["default"].statuses == {"stop_time": 24}


@pytest.mark.parametrize("workers", [1, 2])
def test_a_failed_trial_does_not_spoil_the_next(tmp_path, workers):
    result = flown(tmp_path, workers=workers, BREAKS=True)
    check(result)
    below = int((result.plan.draws.columns["odd.gain"] < 0.0).sum())
    assert 0 < below < 24
    assert result.summary["default"].statuses == {"failed": below, "stop_time": 24 - below}


def test_a_parameter_that_is_not_taken_is_a_failed_trial(tmp_path):
    result = flown(tmp_path, IGNORES_GAIN=True)
    assert result.summary["default"].statuses == {"failed": 24}
    assert "odd.gain: was set to" in result.trials["default"].messages[0]


@pytest.mark.parametrize("workers", [1, 2])
def test_one_instance_in_each_process(tmp_path, workers):
    """Variants in turn, each with an FMU that a process can hold one instance of: workers are processes.

    The first one's reset does not work, which every process finds out.
    """
    other = odd_fmu(tmp_path, "other", once=True, ONE_AT_A_TIME=True)
    result = flown(
        tmp_path,
        workers=workers,
        compare={"odd": [str(tmp_path / "odd.fmu"), str(other)]},
        once=True,
        ONE_AT_A_TIME=True,
        KEEPS_STATE=True,
    )
    assert len(result.trials) == 2
    check(result)


def test_an_end_that_an_fmu_asks_for_is_a_good_one(tmp_path):
    result = flown(tmp_path, ENDS_AT=0.6)
    assert result.summary["default"].statuses == {"terminated": 24}
    gains = result.plan.draws.columns["odd.gain"]
    np.testing.assert_allclose(result.trials["default"].metrics["last"], 0.6 * (gains * 0.5 + 2.0), rtol=1e-13)
    assert set(result.trials["default"].end_time) == {0.6}
    assert result.trials["default"].messages == {}
