"""perilune.analysis.batch.summary"""

import json
import math

import numpy as np
import pytest

from perilune.analysis.batch.summary import TrialColumns, requirement_values, success_interval, summarise, summary_text
from perilune.analysis.campaign.campaign import Metric
from perilune.analysis.campaign.expressions import Expression

METRICS = [Metric("miss", Expression("p.x"), "final", unit="m")]
GOOD = TrialColumns(["finished"] * 4, np.array([True, True, True, False]), {"miss": np.array([1.0, 2.0, 6.0, 500.0])})
BAD = TrialColumns(["nonfinite", "finished"], np.array([False, False]), {"miss": np.array([math.nan, 900.0])})


@pytest.fixture(scope="module")
def summary():
    return summarise({"good": GOOD, "bad": BAD}, METRICS)


def test_rates_and_statuses(summary):
    assert summary["good"]["trials"] == 4
    assert summary["good"]["success_rate"] == 0.75
    assert summary["good"]["success_interval"] == list(success_interval(3, 4))
    assert summary["bad"]["statuses"] == {"finished": 1, "nonfinite": 1}


def test_metrics_are_over_successes_and_over_all(summary):
    good = summary["good"]
    assert good["metrics_over"] == "successful trials"
    expected = {"count": 3, "mean": 3.0, "std": pytest.approx(math.sqrt(7)), "max": 6.0, "min": 1.0, "unit": "m"}
    assert good["metrics"]["miss"] == expected
    assert good["metrics_all"]["miss"]["max"] == 500.0


def test_what_cannot_be_had_is_none(summary):
    assert summary["bad"]["metrics"]["miss"] == {
        "count": 0, "mean": None, "std": None, "max": None, "min": None, "unit": "m"
    }  # fmt: skip
    assert summary["bad"]["metrics_all"]["miss"]["count"] == 1
    assert summary["bad"]["metrics_all"]["miss"]["std"] is None


def test_is_strict_json(summary):
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary


def test_requirements_reach_every_number(summary):
    values = requirement_values(summary)
    text = "good.success_rate > 0.7 and good.metrics.miss.max < 7 and good.success_interval[1] < bad.trials"
    assert Expression(text).evaluate(values) == 1.0
    assert math.isnan(values["bad.metrics.miss.mean"])


def test_text_is_aligned_and_complete(summary):
    lines = summary_text(summary).splitlines()
    rates, metrics = lines[:3], lines[4:]
    assert rates[0].split("  ")[0] == "variant"
    assert rates[1].split() == ["good", "4", "75.00", "19.41", "to", "99.37", "4", "finished"]
    assert len({len(line) for line in rates}) == 1
    assert metrics[1].split() == ["miss", "good", "3", "2.646", "1", "6", "m"]
    assert metrics[2].split() == ["miss", "bad", "-", "-", "-", "-", "m"]


def test_text_without_metrics():
    assert len(summary_text(summarise({"good": GOOD}, [])).splitlines()) == 2
