"""Reductions of rows to numbers, especially settled and first, with and without windows.

Truth: their definitions in plain Python over exact rationals, on random rows; edge cases by hand; sums of Python floats
in order; each simulation evaluated alone.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.campaign import Metric
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.metrics import evaluate_metric, names_needed
from perilune.analysis.campaigns.definition.reductions import REDUCTIONS

STEP = Fraction(1, 10)  # s; 0.1 * 3 exceeds 0.3 in doubles
TRUTHS = st.sampled_from([0.0, 1.0, -2.5, math.nan])
HALVES = st.integers(-4, 60).map(lambda halves: halves * STEP / 2)  # s, on rows and between them
WINDOWS = st.none() | st.tuples(HALVES, HALVES).filter(lambda ends: ends[0] < ends[1])
ROWS = st.lists(st.tuples(TRUTHS, st.floats(-1e3, 1e3)), min_size=1, max_size=25)


def metric(reduction, **options):
    formula = Expression("p.ok" if reduction == "settled" else "p.x")
    condition = Expression("p.ok") if reduction == "first" else None
    return Metric("m", formula, reduction, condition=condition, **options)


def value(reduction, rows, window=None, **options):
    times = 0.1 * np.arange(len(rows))
    truths, values = (np.array(column) for column in zip(*rows, strict=True))
    ends = None if window is None else tuple(map(float, window))
    requested = metric(reduction, window=ends, **options)
    return evaluate(requested, times, {"time": times, "p.ok": truths, "p.x": values})


def evaluate(requested, times, values):
    """Evaluate a metric of one flight."""
    (number,) = evaluate_metric(requested, times, values, np.array([times.size]))
    return number


def inside(rows, window):
    """Return exact time, truth and value of the rows of a window, and its begin."""
    exact = [(k * STEP, truth in (1.0, -2.5), x) for k, (truth, x) in enumerate(rows)]
    low, high = window or (0, len(rows))
    return [row for row in exact if low <= row[0] <= high], max(Fraction(low), Fraction(0))


@given(ROWS, WINDOWS)
def test_settled_by_its_definition(rows, window):
    retained, start = inside(rows, window)
    expected = math.inf if retained else math.nan
    for k in reversed(range(len(retained))):
        if not retained[k][1]:
            break
        expected = float(retained[k][0] - start) if k else 0.0
    assert value("settled", rows, window) == pytest.approx(expected, abs=1e-12, nan_ok=True)


@given(ROWS, WINDOWS, st.integers(0, 30).map(lambda halves: halves * STEP / 2))
def test_first_by_its_definition(rows, window, delay):
    retained, _ = inside(rows, window)
    expected = math.nan
    holding = [time for time, truth, _ in retained if truth]
    if holding:
        expected = next((x for time, _, x in retained if time >= holding[0] + delay), math.nan)
    assert value("first", rows, window, delay=float(delay)) == pytest.approx(expected, nan_ok=True, rel=0, abs=0)


def ok(*truths):
    return [(float(truth), float(k)) for k, truth in enumerate(truths)]


@pytest.mark.parametrize(
    ("truths", "window", "expected"),
    [
        ((1, 1, 1), None, 0.0),
        ((0, 1, 1), None, 0.1),
        ((1, 0, 1), None, 0.2),
        ((1, 1, 0), None, math.inf),
        ((0,), None, math.inf),
        ((1,), None, 0.0),
        ((1, 1, math.nan), None, math.inf),
        ((math.nan, 0.5, 2), None, 0.1),
        ((0, 0, 1, 1), (0.1, 0.3), 0.1),
        ((0, 0, 1, 1), (0.05, 9), 0.15),  # from t0, where no row lies
        ((0, 1, 1, 1), (0.05, 9), 0.0),  # in every row of the window
        ((0, 1, 1, 1), (-5, 9), 0.1),  # from the flight's first row, which is later than t0
        ((0, 1, 1, 1), (-math.inf, math.inf), 0.1),
        ((1, 1, 0, 0), (0.0, 0.1), 0.0),  # what comes after the window does not matter
        ((1, 1, 1), (0.25, 9), math.nan),
    ],
)
def test_settled_by_hand(truths, window, expected):
    assert value("settled", ok(*truths), window) == pytest.approx(expected, abs=1e-12, nan_ok=True)


@pytest.mark.parametrize(
    ("truths", "delay", "window", "expected"),
    [
        ((0, 1, 1, 1), 0, None, 1),
        ((1, 0, 0, 0), 0, None, 0),
        ((0, 1, 0, 0), 0.2, None, 3),  # 0.1 + 0.2 is above 0.3 in doubles
        ((0, 1, 0, 0), 0.15, None, 3),
        ((0, 1, 0, 0), 0.25, None, math.nan),
        ((0, 0, 0, 0), 0, None, math.nan),
        ((math.nan, 0, 1, 0), 0, None, 2),
        ((1, 0, 0, 1), 0, (0.1, 9), 3),
        ((1, 0, 0, 0), 0.2, (0, 0.1), math.nan),  # the row lies after the window
    ],
)
def test_first_by_hand(truths, delay, window, expected):
    assert value("first", ok(*truths), window, delay=delay) == pytest.approx(expected, nan_ok=True)


def test_settled_of_a_flight_that_does_not_begin_at_zero():
    times = 100.0 + 0.5 * np.arange(10)
    record = {"time": times, "p.ok": times >= 102.0}
    assert evaluate(metric("settled"), times, record) == 2.0
    assert evaluate(metric("settled", window=(101.0, math.inf)), times, record) == 1.0


def test_constants_are_conditions_and_values_too():
    times = np.arange(3.0)
    requested = Metric("m", Expression("time"), "first", condition=Expression("case == 2"))
    actual = [evaluate(requested, times, {"time": times, "case": case}) for case in (1.0, 2.0)]
    assert actual == [pytest.approx(math.nan, nan_ok=True), 0.0]


def test_the_conditions_names_are_needed_too():
    requested = Metric("m", Expression("p.x + time"), "first", condition=Expression("p.ok and case > 1"))
    assert names_needed([requested], ["case"]) == {"p.x", "p.ok"}


@given(st.lists(st.lists(st.floats(-1e3, 1e3), max_size=12), min_size=1, max_size=6), st.sampled_from(REDUCTIONS))
def test_flights_together_are_each_alone_to_the_bit(flights, reduction):
    metric = Metric("m", Expression("p.x"), reduction, (-1.0, 1.0), (0.05, 0.85), condition=Expression("p.x > 0"))
    times = [0.1 * np.arange(len(rows)) for rows in flights]
    ends = np.cumsum([len(rows) for rows in flights])
    joined, signal = np.concatenate(times), np.concatenate([np.array(rows) for rows in flights])
    together = evaluate_metric(metric, joined, {"p.x": signal}, ends)
    alone = [evaluate(metric, each, {"p.x": np.array(rows)}) for each, rows in zip(times, flights, strict=True)]
    assert together.tobytes() == np.array(alone).tobytes()


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=200))
def test_means_are_summed_from_the_first_row_to_the_last(rows):
    times, values = np.arange(len(rows)), {"x": np.array(rows)}
    total = squares = 0.0
    for number in rows:
        total, squares = total + number, squares + number * number
    assert evaluate(Metric("m", Expression("x"), "mean"), times * 0.5, values) == total / len(rows)
    assert evaluate(Metric("m", Expression("x"), "rms"), times * 0.5, values) == math.sqrt(squares / len(rows))
