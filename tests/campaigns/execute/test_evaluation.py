"""MetricEvaluator: joint evaluation of all trials of a task.

Truth: every metric of every trial evaluated separately, to the bit; statuses and last rows by hand.
"""

import itertools
import math
import tomllib

import numpy as np
import pytest

from perilune.analysis.campaigns.definition.checks import VariantNames
from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.metrics import evaluate_metric
from perilune.analysis.campaigns.definition.plan import TrialSamples
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.campaigns.draws.table import DrawTable
from perilune.analysis.campaigns.execute.evaluation import MetricEvaluator
from perilune.analysis.runtime.flight.group import FlightGroup
from perilune.analysis.runtime.flight.results import Flight

TEXT = """
[draw.bias]
distribution = "uniform"
low = 0
high = 1
[metric.miss]
expression = "norm(p.x - bias, sin(p.y) * exp(-time / 7))"
reduction = "final"
[metric.highest]
expression = "p.x * bias"
reduction = "max"
[metric.late]
expression = "p.x"
reduction = "final"
window = [0.0, 1.0]
[metric.gain]
expression = "p.gain"
reduction = "final"
[record]
final = ["p.y"]
traces = "{traces}"
[success]
expression = "miss < 1.5"
"""
COUNT = 40
SIZES = (0, 1, 4, 17, 40)  # where groups begin and end


def flight(number):
    """Return a flight by its number: every seventh fails, every eleventh without a row."""
    source = np.random.default_rng(number)
    rows = 0 if number % 11 == 10 else 5 + number % 4
    signals = {name: source.normal(size=rows) for name in ("p.x", "p.y", "p.status")}
    signals["p.status"] = np.zeros(rows)
    status = "failed" if rows == 0 or number % 7 == 6 else "finished"
    return Flight(np.arange(rows) * 0.5, signals, {}, status, "it broke" if status == "failed" else "")


def joined(numbers):
    """Join flights to a group."""
    flights = [flight(number) for number in numbers]
    return FlightGroup(
        time=np.concatenate([each.time for each in flights]),
        signals={name: np.concatenate([each.signals[name] for each in flights]) for name in flights[0].signals},
        ends=np.cumsum([each.time.size for each in flights]),
        statuses=[each.status for each in flights],
        complete=np.array([each.complete for each in flights]),
        messages=[each.message for each in flights],
    )


@pytest.fixture(params=["none", "failures", "all"])
def judged(request):
    head = 'system = "s"\ntrials = 40\nseed = 1\n'
    campaign = parse_campaign(TomlTable(tomllib.loads(head + TEXT.format(traces=request.param)), "test.toml"))
    bias = np.random.default_rng(3).uniform(size=COUNT)
    sampled = TrialSamples(campaign, None, [], range(100, 100 + COUNT), DrawTable(COUNT, {"bias": bias}), [])
    names = VariantNames([], ["p.x", "p.y"], ["p.status"], {"p.gain": 2.5})
    return campaign, names, sampled, bias


def test_together_or_one_by_one_to_the_bit(judged):
    campaign, names, sampled, bias = judged
    together, alone = MetricEvaluator(campaign, names), MetricEvaluator(campaign, names)
    singles = []
    for first, last in itertools.pairwise(SIZES):
        together.add(joined(range(first, last)), range(100 + first, 100 + last), sampled)
    for number in range(COUNT):
        alone.add(FlightGroup.of(flight(number)), range(100 + number, 101 + number), sampled)
        singles.append(alone.trials())
    actual = together.trials()
    assert actual.trial.tolist() == list(range(100, 100 + COUNT))
    assert list(actual.metrics) == ["miss", "highest", "late", "gain"]
    for number, single in enumerate(singles):
        one = flight(number)
        values = {"time": one.time, **one.signals, "p.gain": 2.5, "bias": bias[number]}
        for metric in campaign.metrics:
            number_of_rows = np.array([one.time.size])
            (expected,) = evaluate_metric(metric, one.time, values, number_of_rows) if one.complete else [math.nan]
            for value in (actual.metrics[metric.name][number], single.metrics[metric.name][0]):
                assert value == expected or math.isnan(expected)
        miss = actual.metrics["miss"][number]
        assert actual.success[number] == single.success[0] == (one.complete and miss < 1.5)
        assert actual.statuses[number] == one.status
        last = one.signals["p.y"][-1] if one.time.size else math.nan
        np.testing.assert_array_equal(
            [actual.final["p.y"][number], actual.end_time[number]], [last, one.time[-1] if one.time.size else math.nan]
        )
        retained = campaign.record.traces == "all" or (
            campaign.record.traces == "failures" and not actual.success[number]
        )
        assert (100 + number in actual.traces) == retained
        assert (100 + number in actual.messages) == (not one.complete)
    for trial, traces in actual.traces.items():
        assert traces["p.x"].tobytes() == flight(trial - 100).signals["p.x"].tobytes()
