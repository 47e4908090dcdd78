"""Worst case by simulation.

Truth: the worst corner of the box of a linear system; repeated simulations of the reported points; random trials inside
the same box, fifty times as many under `make long`.
"""

import json

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.studies.draw_space import DrawSpace
from perilune.analysis.studies.sample_flights import SampleFlights
from perilune.common.errors import InputError
from tests.support.foreign.linear_system import linear_system
from tests.support.foreign.odd_fmu import odd_system
from tests.support.lengths import LONG, either

# a.gain to 3 times 1.2; b and c along the axes (1, 1) and (1, -1) of their covariance, variances 1.28 and 0.72.
CORNER = 0.5 * (3.6 + 3.0 * np.sqrt(2.0 * 1.28))


@pytest.fixture(scope="module")
def linear(tmp_path_factory):
    return linear_system(tmp_path_factory.mktemp("linear"))


@pytest.fixture(scope="module")
def actual(linear, tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    return folder, perilune.worst(*linear, metric="total", flights=400, workers=1, output=folder)


def test_the_worst_is_the_corner(actual):
    _, result = actual
    assert result.value == pytest.approx(CORNER, rel=1e-6)
    assert result.flights <= 400
    assert result.worst["draws"]["a.gain"] == pytest.approx(3.6, rel=1e-6)
    assert result.worst_random["value"] < CORNER
    assert result.random_trials == 80


def test_it_flies_again_to_the_last_bit(actual, linear):
    folder, result = actual
    repeated = perilune.batch(*linear, draws=folder / "worst.parquet", workers=1).trials["default"].metrics["total"]
    assert repeated.tolist() == [result.worst["value"], result.worst_random["value"]]
    document = json.loads((folder / "worst.json").read_text())
    assert document["worst"]["metrics"]["total"] == result.value
    assert document == result.json_document(folder)


def test_workers_do_not_matter(actual, linear):
    _, result = actual
    other = perilune.worst(*linear, metric="total", flights=400, workers=2)
    assert other.json_document() == result.json_document()
    assert other.flown.points.tobytes() == result.flown.points.tobytes()


def test_without_a_metric_it_is_the_margin_of_success(linear):
    result = perilune.worst(*linear, flights=200, sigmas=1.0, workers=1)
    assert result.badness.text == "margin of not (total < 3.0902323)"
    assert result.value == pytest.approx(CORNER / 3.0 - 3.0902323, rel=1e-3)


def test_a_failed_flight_is_the_worst(tmp_path):
    system = odd_system(tmp_path, BREAKS=True)
    campaign = tmp_path / "c.toml"
    campaign.write_text(
        'system = "odd.ssp"\ntrials = 4\nseed = 1\n'
        '[draw."odd.gain"]\ndistribution = "uniform"\nlow = -0.001\nhigh = 1\n'
        '[metric.last]\nexpression = "odd.y"\nreduction = "final"\n[success]\nexpression = "last < 9"\n'
    )
    result = perilune.worst(system, campaign, metric="-last", flights=300, workers=1, output=tmp_path / "out")
    assert result.worst["value"] is None
    assert result.worst["draws"]["odd.gain"] < 0.0
    assert result.flights < 300
    repeated = perilune.batch(system, campaign, draws=tmp_path / "out" / "worst.parquet")
    assert repeated.trials["default"].statuses[0] == "failed"


def test_the_command(linear, tmp_path, capsys):
    line = ["worst", linear[0], "--campaign", linear[1], "--metric", "total", "--flights", "150", "--workers", "1"]
    assert main([*line, "--output", str(tmp_path / "out"), "--require", "worst < 5"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("total: worst 4.2, of 150 points in 150 simulations")
    assert "worst of 30 random trials" in text
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "flights.parquet", "worst.json", "worst.parquet",
    ]  # fmt: skip
    assert main([*line, "--require", "worst < 4"]) == 1
    assert "--require: worst < 4: not met" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"metric": "totl"}, "metric: totl: neither a metric nor a draw of the campaign.*total"),
        ({"flights": 50}, "flights: 50: too few; give 100 or more"),
        ({"sigmas": 0.0}, "sigmas: 0"),
        ({"sigmas": 0.01}, "none of 20 random trials is within 0.01 sigmas"),
    ],
)
def test_refusals(linear, options, words):
    with pytest.raises(InputError, match=words):
        perilune.worst(*linear, workers=1, **({"flights": 100} | options))


# Campaigns without noise, and what is to be worst: two guidances of one box, a descent and a landing, with steps as
# coarse as they allow, so that a hundred thousand flights take minutes.
CASES = {
    "flight time": ("lunar_terminal_guidance", "paper", {"guidance": "analytic_guidance"}, {}, "flight_time"),
    "velocity error": ("lunar_terminal_guidance", "paper", {"guidance": "astar_robust_guidance"}, {}, "velocity_error"),
    "propellant": (
        "lunar_descent_2d", "robustness_joint", None, {"step": 0.1, "set": {"sensor.sample_period": 0.1}}, "propellant",
    ),
    "demand": (
        "lunar_landing", "terminal_box", {"guidance": "astar_robust_guidance"},
        {"step": 0.1, "parameters": ("ideal.ssv",)}, "largest_demand",
    ),
}  # fmt: skip


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("case", CASES if LONG else ["flight time"])
def test_no_random_trial_of_the_box_is_worse(case):
    system, campaign, compare, options, metric = CASES[case]
    trials = either(100_000, 1000)
    result = perilune.worst(
        system,
        campaign,
        metric=metric,
        compare=compare,
        flights=either(2000, 300),
        noise_trial=0,
        workers=1,
        **options,
    )
    chosen = None if compare is None else {slot: [fmu] for slot, fmu in compare.items()}
    plan = read_plan(system, campaign, SystemOptions(**options), compare=chosen)
    space, expression = DrawSpace(plan.campaign), Expression(metric)
    random = np.random.default_rng(9)
    maximum = -np.inf
    with SampleFlights(plan, space.from_box(np.full((1, space.size), 0.5), 3.0), workers=either(None, 1)) as flights:
        still = flights.noise.same(np.zeros(1000, dtype=int))  # noise that changes nothing in these campaigns
        for _ in range(trials // 1000):
            flown, _ = flights.fly(space.from_box(random.random((1000, space.size)), 3.0), still)
            maximum = max(maximum, float(np.max(expression.evaluate(flown.metrics))))
    print(f"{case}: worst {result.value}, of {trials} random trials {maximum}")
    assert result.value >= maximum
