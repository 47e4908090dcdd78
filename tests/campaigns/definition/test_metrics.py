"""perilune.analysis.campaigns.definition.metrics, compared with closed forms of sampled signals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.campaign import Metric
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.metrics import evaluate_metric, names_needed, successes
from perilune.common.errors import InputError

TIMES = 0.1 * np.arange(1001)  # s; rounding makes 0.1 * 3 exceed 0.3


def metric(expression, reduction, **options):
    return Metric("m", Expression(expression, ("c.toml", "metric.m.expression")), reduction, **options)


def value(expression, reduction, times=TIMES, /, **options):
    decay = {"p.x": np.exp(-times / 10), "p.goal": 2.0}
    return evaluate(metric(expression, reduction, **options), times, {"time": times, **decay})


def evaluate(requested, times, values):
    """Evaluate a metric of one flight."""
    (number,) = evaluate_metric(requested, times, values, np.array([times.size]))
    return number


@pytest.mark.parametrize(
    ("expression", "reduction", "expected"),
    [
        ("p.x", "final", math.exp(-10)),
        ("p.x", "max", 1.0),
        ("p.x", "min", math.exp(-10)),
        ("p.x - p.goal", "max", -1.0),
        # geometric series of 1001 rows
        ("p.x", "mean", (1 - math.exp(-10.01)) / (1 - math.exp(-0.01)) / 1001),
        ("p.x", "rms", math.sqrt((1 - math.exp(-20.02)) / (1 - math.exp(-0.02)) / 1001)),
        ("time", "final", 100.0),
        ("p.goal", "mean", 2.0),
        ("p.x > 0.5", "max", 1.0),
    ],
)
def test_reductions(expression, reduction, expected):
    assert value(expression, reduction) == pytest.approx(expected, rel=1e-12)


def test_last_outside_is_the_settling_time():
    # exp(-t/10) > 0.05 up to t = 10 ln 20 = 29.957 s
    assert value("p.x", "last_outside", band=(-0.05, 0.05)) == pytest.approx(29.9)
    assert value("p.x", "last_outside", band=(-0.05, 0.05), window=(35, 100)) == pytest.approx(35.0)


def test_last_outside_of_signals_that_are_never_or_always_outside():
    assert value("p.x", "last_outside", band=(0, 2)) == 0.0
    assert value("p.x", "last_outside", band=(0.5, 2)) == math.inf
    assert value("0 * time / 0", "last_outside", band=(-math.inf, math.inf)) == math.inf


def test_windows_include_both_ends_despite_rounding():
    assert TIMES[3] > 0.3
    assert value("time", "max", window=(0.1, 0.3)) == TIMES[3]
    assert value("time", "min", window=(0.1, 0.3)) == 0.1
    assert value("time", "mean", window=(99.95, math.inf)) == pytest.approx(100.0)


def test_a_flight_that_ended_before_the_window_has_no_value():
    assert math.isnan(value("p.x", "max", window=(200, 300)))


def test_a_record_of_one_row():
    assert value("time + p.x", "final", np.array([3.0]), window=(3, 4)) == pytest.approx(3 + math.exp(-0.3))


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=30))
def test_reductions_are_ordered(samples):
    times, record = np.arange(len(samples)) * 0.5, {"x": np.array(samples)}
    low, mean, rms, high = (
        evaluate(metric("x", reduction), times, record) for reduction in ("min", "mean", "rms", "max")
    )
    margin = 1e-9 * max(1.0, abs(low), abs(high))
    assert low - margin <= mean <= high + margin
    assert abs(mean) <= rms + margin


def test_names_are_looked_up_in_record_draws_and_parameters():
    metrics = [Metric("a", Expression("p.x + q.k + d + time"), "final"), Metric("b", Expression("p.x"), "min")]
    times = np.array([0.0, 1.0])
    values = {"time": times, "p.x": np.array([1.0, 2.0]), "q.k": 10, "d": 100}
    assert [evaluate(requested, times, values) for requested in metrics] == [113.0, 1.0]
    assert names_needed(metrics, ["d"]) == {"p.x", "q.k"}


def test_an_unknown_name_is_an_input_error():
    with pytest.raises(
        InputError, match=r"^c\.toml: metric\.m\.expression: 'p\.y' in 'p\.y' is unknown; use one of p\.x, p\.goal"
    ):
        value("p.y", "final")


@pytest.mark.parametrize(
    ("text", "error", "expected"),
    [
        ("error <= 200 and status < 2", 200.0, True),
        ("error <= 200 and status < 2", 200.1, False),
        ("not error > 200", math.nan, False),
        ("error > 200", math.inf, False),
        ("status == 1", math.nan, True),
        ("error / status", 0.0, False),
        ("log(-error)", 1.0, False),
        ("1", 1.0, True),
    ],
)
def test_success(text, error, expected):
    """The second of three trials: each is evaluated by its metrics."""
    metrics = {"error": np.array([200.0, error, math.nan]), "status": np.ones(3)}
    assert successes(Expression(text), metrics, 3)[1] == expected
