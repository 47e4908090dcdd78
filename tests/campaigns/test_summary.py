"""perilune.analysis.campaigns.summary: rates, metrics, requirements and groups. Truth: trials counted by hand."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.campaigns import summary as summaries
from perilune.analysis.campaigns.definition.campaign import TrialGroup
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.summary import requirement_values, success_interval, summarise
from perilune.analysis.campaigns.trials import TrialTable
from perilune.common.to_json import to_json
from tests.support.campaigns.trial_tables import describe, trial_table

GOOD = trial_table(["finished"] * 4, np.array([True, True, True, False]), {"miss": np.array([1.0, 2.0, 6.0, 500.0])})
BAD = trial_table(["nonfinite", "finished"], np.array([False, False]), {"miss": np.array([math.nan, 900.0])})


@pytest.fixture(scope="module")
def summary():
    return summarise({"good": GOOD, "bad": BAD})


def test_rates_and_statuses(summary):
    assert summary["good"].trials == 4
    assert summary["good"].success_rate == 0.75
    assert summary["good"].success_interval == success_interval(3, 4)
    assert summary["bad"].statuses == {"finished": 1, "nonfinite": 1}


def test_metrics_are_over_successes_and_over_all(summary):
    good = summary["good"]
    assert good.metrics_over == "successful trials"
    assert to_json(good.metrics["miss"]) == {
        "count": 3, "mean": 3.0, "std": pytest.approx(math.sqrt(7)), "max": 6.0, "min": 1.0,
        "rms": pytest.approx(math.sqrt(41 / 3)), "p5": 1.0, "p50": 2.0, "p95": 6.0, "p99": 6.0, "unit": "m",
    }  # fmt: skip
    assert good.metrics_all["miss"].max == 500.0


def test_what_cannot_be_had_is_none(summary):
    assert to_json(summary["bad"].metrics["miss"]) == {
        "count": 0, "mean": None, "std": None, "max": None, "min": None, "rms": None,
        "p5": None, "p50": None, "p95": None, "p99": None, "unit": "m",
    }  # fmt: skip
    assert summary["bad"].metrics_all["miss"].count == 1
    assert summary["bad"].metrics_all["miss"].std is None


def test_is_strict_json(summary):
    document = to_json(summary)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["good"]["success_rate"] == 0.75
    assert document["good"].keys().isdisjoint({"value", "groups", "requirements", "rates"})


def test_requirements_reach_every_number(summary):
    values = requirement_values(summary)
    text = "good.success_rate > 0.7 and good.metrics.miss.max < 7 and good.success_interval[1] < bad.trials"
    assert Expression(text).evaluate(values) == 1.0
    assert values["good.metrics.miss.p95"] == 6.0
    assert math.isnan(values["bad.metrics.miss.mean"])


def test_requirements_see_what_is_infinite():
    """A trial that never settles: the quantile is infinite, so a bound on it is not met, and not 0 either."""
    late = trial_table(["finished"] * 2, np.array([True, True]), {"miss": np.array([1.0, math.inf])})
    summary = summarise({"late": late})
    assert summary["late"].metrics["miss"].p95 == math.inf
    assert requirement_values(summary)["late.metrics.miss.p95"] == math.inf
    assert requirement_values(summary)["late.metrics.miss.p50"] == 1.0
    assert json.loads(json.dumps(to_json(summary), allow_nan=False))["late"]["metrics"]["miss"]["p95"] == "inf"


CASES = np.array([0.5, 2.0, 2.0, 0.5])
GROUPS = [TrialGroup("0.5", 0.5), TrialGroup("2", 2.0)]
PARTED = trial_table(GOOD.statuses, GOOD.success, GOOD.metrics, {"case": CASES})


def test_groups_are_summed_up_as_the_whole():
    summary = summarise({"good": PARTED}, GROUPS, "case")
    groups = summary["good"].groups
    assert replace(summary["good"], groups={}) == summarise({"good": GOOD})["good"]
    assert list(groups) == ["0.5", "2"]
    for group in GROUPS:
        members = [trial for trial, case in enumerate(CASES) if case == group.value]
        alone = trial_table(["finished"] * 2, GOOD.success[members], {"miss": GOOD.metrics["miss"][members]})
        assert groups[group.label] == replace(summarise({"x": alone})["x"], value=group.value)


def test_requirements_reach_groups_by_their_value():
    values = requirement_values(summarise({"good": PARTED}, GROUPS, "case"))
    text = 'good.groups["0.5"].success_rate == 0.5 and good.groups["2"].metrics.miss.p95 == 6'
    assert Expression(text).names <= set(values)
    assert Expression(text).evaluate(values) == 1.0
    assert values['good.groups["0.5"].success_interval[1]'] == success_interval(1, 2)[0]


class InParts(TrialTable):
    """Trials in two parts, which count how often they are read."""

    readings = 0

    def tables(self, names):
        self.readings += 1
        for first, count in ((0, 3), (3, 1)):
            yield self.table.select(names).slice(first, count)


@pytest.mark.parametrize("held", [12, 11])
def test_few_trials_are_read_once_and_many_come_to_the_same(monkeypatch, held):
    """Three columns of four trials are held, and their statuses with them; or no column is held."""
    monkeypatch.setattr(summaries, "IN_MEMORY", held)
    trials = InParts(PARTED.table).described(describe)
    assert summarise({"x": trials}, GROUPS, "case") == summarise({"x": PARTED}, GROUPS, "case")
    assert (trials.readings == 1) == (held >= 12)
