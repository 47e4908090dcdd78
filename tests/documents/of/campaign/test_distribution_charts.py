"""Charts of distributions and of success probabilities.

Truth: fractions counted here, scipy's exact interval of a binomial; the same distribution drawn by matplotlib.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from perilune.analysis.campaigns.definition.campaign import Metric
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.documents.chart.svg.fluid import POINT
from perilune.analysis.documents.common.colours import look
from perilune.analysis.documents.font.text import text_width
from perilune.analysis.documents.of.campaign.distributions import distribution_chart, rates_chart
from tests.documents.chart.matplotlib_distributions import read_distribution
from tests.documents.chart.test_history_charts import plain
from tests.support.pages.samples import batch_result

STYLES = [look(0), look(1)]
ANY = st.floats(-1e6, 1e6) | st.floats(-3.0, 3.0) | st.just(math.nan) | st.just(math.inf)


def metric(unit="m"):
    return Metric("miss", Expression("0"), "final", unit=unit)


def step_at(curve, at):
    """Return the ordinate of a curve of steps."""
    return curve.displayed[np.searchsorted(curve.x, at, side="right") - 1]


@given(st.lists(st.tuples(ANY, ANY), min_size=1, max_size=30).filter(lambda rows: np.isfinite(rows).any()))
def test_a_distribution_is_the_fraction_of_trials_below(rows):
    samples = dict(zip(("a", "b"), np.array(rows).T, strict=True))
    chart = distribution_chart(metric(), samples, STYLES)
    low, high = chart.x.ends
    everything = np.concatenate(list(samples.values()))
    finite = everything[np.isfinite(everything)]
    assert high > finite.max()
    assert chart.x.logarithmic or low < finite.min()
    for curve, (name, series) in zip(chart.curves[:2], samples.items(), strict=True):
        assert (curve.name, curve.metric, curve.unit, curve.steps) == (name, "metric.miss", "%", True)
        assert (curve.x[0], curve.x[-1]) == (low, high)
        for at in series[np.isfinite(series) & (series >= low)]:
            assert step_at(curve, at) == pytest.approx(100.0 * np.mean(series <= at), rel=1e-12)
        assert curve.displayed[-1] == pytest.approx(100.0 * np.mean(np.isfinite(series)), rel=1e-12)
    lone = [curve.colour for curve, series in zip(chart.curves, samples.values(), strict=False)
            if np.count_nonzero(np.isfinite(series)) == 1]  # fmt: skip
    assert [curve.colour for curve in chart.curves[2:]] == lone  # a lone number has a dot


@pytest.mark.parametrize(
    ("name", "unit", "samples"),
    [
        ("decades", "m", 10.0 ** np.linspace(-3.0, 4.0, 200)),
        ("plain", "m", np.linspace(3.0, 9.0, 50)),
        ("angles", "rad", np.linspace(-0.1, 0.7, 50)),
        ("integers", "1", np.array([0.0, 1.0, 1.0, 3.0])),
        ("tail", "m", np.concatenate([[0.0, 1e-9], np.geomspace(1.0, 1e3, 300)])),
        ("gaps", "m", np.array([1.0, math.nan, 3.0, math.inf, 4.0])),
    ],
)
def test_constructed_equals_read_back(name, unit, samples):
    by_label = {"one": samples, "two": 1.5 * samples[::2]}
    chart = distribution_chart(metric(unit), by_label, STYLES)
    assert plain(chart) == plain(read_distribution(metric(unit), by_label, STYLES)), name


def test_errors_over_sigma_have_an_abscissa_of_both_signs():
    chart = distribution_chart(metric("1"), {"a": np.array([1.0, 2000.0])}, STYLES[:1], half_range=3.5)
    assert not chart.x.logarithmic
    assert chart.x.ends[0] == -3.5
    assert (chart.curves[0].x[0], chart.curves[0].x[-1]) == chart.x.ends


def test_success_probabilities_have_their_intervals_and_texts():
    batch = batch_result({
        "steady": [(True, 0.0, 0.0)] * 30,
        "shaky": [(k % 3 > 0, 0.0, 0.0) for k in range(30)],
    })  # fmt: skip
    chart = rates_chart(batch, {"shaky": 0.5})
    for lane, (name, successes) in enumerate((("steady", 30), ("shaky", 20))):
        interval = binomtest(successes, 30).proportion_ci(0.95, "exact")
        bar, mark, *_ = [curve for curve in chart.curves if curve.y[0] == lane]
        assert bar.x.tolist() == pytest.approx([100.0 * interval.low, 100.0 * interval.high], rel=1e-9)
        assert mark.x.tolist() == pytest.approx([100.0 * successes / 30], rel=1e-12)
        assert chart.x.ends[0] <= bar.x[0] <= bar.x[1] <= chart.x.ends[1]
        texts = [note.text for note in chart.notes if abs(note.at[1] - lane) < 0.5]
        assert texts[-1].startswith(f"{100.0 * successes / 30:.2f} % ({100.0 * interval.low:.2f} to ")
        assert texts[0] == name
    (published,) = [curve for curve in chart.curves if curve.marker is not None and not curve.marker.fill and
                    curve.x.size == 1]  # fmt: skip
    assert (published.x[0], published.y[0]) == (50.0, 1.0)
    assert chart.y.ends[0] > 1.0 > 0.0 > chart.y.ends[1]  # the first lane is at the top


def test_texts_of_long_names_have_room_on_a_telephone():
    name = "analytic_exact_guidance__thrust_allocation"
    chart = rates_chart(batch_result({name: [(True, 0.0, 0.0)] * 4, "short": [(False, 0.0, 0.0)] * 4}), {})
    assert [note.text for note in chart.notes] == [name, "100.00 %", "short", "0.00 %"]
    for lane in (chart.notes[:2], chart.notes[2:]):
        assert sum(text_width(note.text, note.size) for note in lane) < (366.0 - 24.0) / POINT  # px of 390, in pt
