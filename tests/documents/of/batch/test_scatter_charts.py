"""Charts of trials over two metrics, and over the inputs that explain most about success.

Truth: the trials of hand-written batches.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from perilune.analysis.documents.of.batch.scatters import (
    _limits,
    _radius,
    failure_chart,
    influence_on_success,
    scatter_chart,
)
from tests.documents.of.batch.test_scatters import CONTACTS, FAR, NEAR, PLANE
from tests.support.pages.samples import DRAWS, batch_result, mixed_batch


def chart_of(batch, variant, everything):
    """Return the chart of a variant in the batch's only scatter plot."""
    campaign = batch.plan.campaign
    (scatter,) = campaign.scatters
    metrics = {metric.name: metric for metric in campaign.metrics}
    pair = (metrics[scatter.x], metrics[scatter.y])
    ends = _limits(everything, _radius(scatter, pair[0]))
    return scatter_chart(variant, batch.plotted[variant].dots.success, scatter, pair, *ends)


def test_marks_are_bound_to_the_trials_of_their_variant():
    batch = batch_result({"near": NEAR, "far": FAR}, DRAWS + CONTACTS)
    points = np.array([row[1:] for row in NEAR + FAR]).T
    for variant in ("near", "far"):
        chart = chart_of(batch, variant, points)
        assert [(dots.variant, dots.success, dots.cross) for dots in chart.dots] == [
            (variant, True, False),
            (variant, False, True),
        ]
        assert {dots.names for dots in chart.dots} == {("metric.east", "metric.north")}
        finite = points[:, np.isfinite(points).all(axis=0)]
        for axis, row in zip((chart.x, chart.y), finite, strict=True):
            assert axis.ends[0] < min(row.min(), -10.0)
            assert axis.ends[1] > max(row.max(), 10.0)
        (circle,) = chart.areas
        np.testing.assert_allclose(np.hypot(circle.x, circle.y), 10.0, rtol=1e-12)


def test_angles_are_displayed_in_degrees():
    text = DRAWS + PLANE.format("rad", "rad", f"circle = {math.pi / 6}")
    chart = chart_of(batch_result({"near": NEAR}, text), "near", np.zeros((2, 1)))
    np.testing.assert_allclose(np.hypot(chart.areas[0].x, chart.areas[0].y), 30.0, rtol=1e-12)
    assert chart.x.label == "east, deg"


def test_nothing_finite_and_no_circle():
    batch = batch_result({"near": NEAR}, DRAWS + PLANE.format("m", "kg", ""))
    chart = chart_of(batch, "near", np.full((2, 3), math.nan))
    assert chart.x.ends == chart.y.ends == (-0.5, 0.5)
    assert not chart.areas
    assert not chart.curves


def test_failures_over_inputs():
    batch = mixed_batch()
    names = list(influence_on_success(batch, "shaky"))[:2]
    draws = batch.plan.draws.columns
    chart = failure_chart(batch, "shaky", names)
    assert {dots.names for dots in chart.dots} == {(f"draw.{names[0]}", f"draw.{names[1]}")}
    for axis, name in zip((chart.x, chart.y), names, strict=True):
        margin = 0.05 * np.ptp(draws[name])
        assert axis.ends == pytest.approx((draws[name].min() - margin, draws[name].max() + margin), rel=1e-9)
    over_trials = failure_chart(batch, "shaky", names[:1])
    assert over_trials.dots[0].names == (f"draw.{names[0]}", "trial")
    assert over_trials.y.ends == pytest.approx((-0.05 * 39, 1.05 * 39), rel=1e-9)
