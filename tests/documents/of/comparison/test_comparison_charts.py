"""Charts of a comparison: bands over time, final positions about the target, paths.

Truth: percentiles and covariances by numpy, the chi-square distribution by scipy; the same bands drawn by matplotlib.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from perilune.analysis.documents.common.colours import FAINT, INK, look
from perilune.analysis.documents.common.panels import PANEL_WIDTH
from perilune.analysis.documents.of.comparison.flights.band_figures import band_chart, frame_of, overlaid_bands
from perilune.analysis.documents.of.comparison.flights.bands import LEVELS, bands_of
from perilune.analysis.documents.of.comparison.flights.end_figures import (
    dispersion_chart,
    dispersion_figures,
    overlaid_ends,
)
from perilune.analysis.documents.of.comparison.flights.ends import Ends
from perilune.analysis.documents.of.comparison.flights.recorded import ComparedFlight, FlightQuantity
from perilune.analysis.documents.of.comparison.flights.trajectories import FlightPath, VariantPaths
from perilune.analysis.documents.of.comparison.flights.trajectory_figures import plan_figures, side_figures
from tests.documents.chart.matplotlib_bands import read_bands
from tests.documents.chart.test_history_charts import plain

STYLES = {"one": look(0), "two": look(1)}
ENDS = (-20.0, 20.0)
STEPS = np.arange(30.0)
AXES = ("north", "west", "up")


def has_axes(figure, abscissa, ordinate):
    """Return True if its chart has these words at its axes."""
    return (figure.chart.x.label, figure.chart.title) == (abscissa, ordinate)


def quantity(kind="motion", unit="m", name="a.b", *, is_stepped=False):
    return FlightQuantity(name, name.rpartition(".")[2], unit, kind, (name,), lambda signals: signals[name], is_stepped)


def flights(name="a.b", *, is_stepped=False, scale=1.0):
    rows = scale * np.random.default_rng(3).normal(size=(9, STEPS.size)).cumsum(axis=1)
    rows = np.round(rows) if is_stepped else rows
    return [ComparedFlight(trial, trial < 7, STEPS, {name: row}, True) for trial, row in enumerate(rows)]


@pytest.mark.parametrize("is_stepped", [False, True])
def test_bands_are_those_of_matplotlib(is_stepped):
    measured = quantity(is_stepped=is_stepped)
    bands = bands_of(measured, flights(is_stepped=is_stepped))
    frame = frame_of(measured, {"one": bands})
    chart = band_chart(measured, bands, STYLES["one"].colour, frame)
    expected = read_bands(bands, frame, STYLES["one"].colour, is_stepped=is_stepped)
    for field in ("x", "y", "areas", "rules", "notes"):
        assert plain(getattr(chart, field)) == plain(getattr(expected, field)), field
    assert [(plain(each.x), plain(each.y), each.colour, each.width, each.opacity) for each in chart.curves] == [
        (plain(each.x), plain(each.y), each.colour, each.width, each.opacity) for each in expected.curves
    ]
    assert chart.curves[-1].name == "median"


def test_median_and_bands_are_percentiles():
    actual = flights(scale=1e6)
    bands = bands_of(quantity(), actual)
    chart = band_chart(quantity(), bands, "#000000", frame_of(quantity(), {"one": bands}))
    good = 1e-3 * np.stack([flight.signals["a.b"] for flight in actual if flight.success])  # km: the way is long
    rows = np.percentile(good, LEVELS, axis=0, method="inverted_cdf")
    np.testing.assert_allclose(chart.curves[-1].y, rows[2], rtol=1e-12)
    for area, low, high in zip(chart.areas, rows[:2], rows[:2:-1], strict=True):
        corners = {*zip(np.round(area.x, 9).tolist(), np.round(area.y, 6).tolist(), strict=True)}
        assert corners == {
            *zip(STEPS.tolist(), np.round(low, 6).tolist(), strict=True),
            *zip(STEPS.tolist(), np.round(high, 6).tolist(), strict=True),
        }
    assert [curve.colour for curve in chart.curves] == [INK] * 2 + [FAINT] * 4 + ["#000000"]


def test_errors_over_sigma_have_the_lines_of_a_consistent_filter():
    name = "checker.normalised_error_square"
    measured = quantity("consistency", None, name)
    bands = bands_of(measured, flights(name))
    chart = band_chart(measured, bands, "#000000", frame_of(measured, {"one": bands}))
    assert [rule.at for rule in chart.rules] == pytest.approx(chi2.ppf([0.05, 0.5, 0.95], 6))
    assert not overlaid_bands(measured, {"one": bands, "two": bands}, STYLES, "x")[0].chart.areas


def test_overlaid_lines_are_in_the_order_of_the_legend():
    bands = {"one": bands_of(quantity(), flights()), "two": bands_of(quantity(), flights(scale=2.0))}
    (figure,) = overlaid_bands(quantity(), bands, STYLES, "x")
    chart = figure.chart
    assert [curve.colour for curve in chart.curves] == [STYLES[name].colour.lower() for name in ("one", "two")]
    for curve, band in zip(chart.curves, bands.values(), strict=True):
        np.testing.assert_array_equal(curve.y, band.percentiles[2])


def is_to_scale(chart, width, height):
    """Return True if a unit is equally long on both axes."""
    _, _, across, up = chart.box
    along_x, along_y = width * across / np.ptp(chart.x.ends), height * up / np.ptp(chart.y.ends)
    return along_x == pytest.approx(along_y, rel=1e-4)


def ends(seed, trials=60, spread=1.0):
    errors = spread * np.random.default_rng(seed).normal(size=(trials, 3)) @ np.diag([3.0, 1.0, 1.0]) + [1.0, 2.0, 0.0]
    errors[0] = np.nan
    errors[-1] = [1e3, 0.0, 0.0]
    return Ends("ship.position", "position", "target", errors, np.arange(trials) < trials - 4)


def test_ends_have_their_ellipses_and_marks():
    errors = ends(1)
    chart = dispersion_chart(errors, "#0072B2", 1.0, "m", ENDS, ENDS)
    good = errors.errors[1:-4, :2]
    failed, successful, *ellipses, mean, arrow, target = chart.curves
    np.testing.assert_array_equal(np.stack([successful.x, successful.y], axis=1), good)
    assert failed.x.size == 4
    for sigma, curve in enumerate(ellipses, 1):
        away = np.stack([curve.x, curve.y]) - good.mean(axis=0)[:, np.newaxis]
        distance = np.sqrt(np.sum(away * np.linalg.solve(np.cov(good.T), away), axis=0))
        np.testing.assert_allclose(distance, sigma, rtol=1e-9)
    np.testing.assert_allclose([mean.x[0], mean.y[0]], good.mean(axis=0), rtol=1e-12)
    assert (target.x[0], target.y[0]) == (0.0, 0.0)
    assert (arrow.x[0], arrow.y[0]) == pytest.approx((0.9 * ENDS[1], 0.0))
    assert chart.notes[0].text == "1 outside (failed), farthest 1000 m; 1 without an end"


def test_one_scale_whatever_lies_outside():
    """Six times the maximum norm below which 90 % of the successful trials of the least dispersed contender are."""
    one, other = (ends(seed, spread=spread) for seed, spread in ((1, 1.0), (2, 40.0)))
    charts = [each.chart for each in dispersion_figures({"one": one, "two": other}, STYLES, "x")]
    away = np.sort(np.abs(one.errors[1:-4, :2]).max(axis=1))
    assert 1.08 * 6.0 * away[-8] <= charts[0].y.ends[1] <= 1.08 * 6.0 * away[-4]  # of 55, at least 90 %
    assert charts[0].x.ends == pytest.approx(charts[1].x.ends, rel=0.02)
    limits = [charts[1].x.ends[1], charts[1].y.ends[1]]
    points = other.errors[1:, :2]
    outside = np.any(np.abs(points) > limits, axis=1)
    failed, farthest = outside[-4:].sum(), np.hypot(*points.T).max()
    assert charts[1].notes[0].text == (
        f"{outside.sum()} outside ({failed} failed), farthest {farthest:.0f} m; 1 without an end"
    )
    arrow = charts[1].curves[-2]
    assert (arrow.x[0], arrow.y[0]) == pytest.approx((0.9 * limits[0], 0.0), abs=1e-6)  # to the trial at (1000, 0) m
    (together,) = overlaid_ends({"one": one, "two": other}, STYLES, "x")
    assert together.chart.notes[0].text.startswith("1 of 2 outside, to ")


def test_a_lone_trial_far_away_does_not_stretch_the_scale():
    near = ends(3)
    stray = replace(near, errors=np.where(np.arange(60)[:, None] == 5, [2e3, -1e3, 0.0], near.errors))
    (alone,), (with_stray,) = (dispersion_figures({"one": each}, STYLES, "x") for each in (near, stray))
    chart = with_stray.chart
    assert chart.x.ends[1] < 4.0 * alone.chart.x.ends[1]
    assert chart.notes[0].text.startswith("2 outside (1 failed), farthest 2240 m")  # the root of 5


def test_overlaid_ellipses_are_in_the_order_of_the_legend():
    lost = Ends("ship.position", "position", "target", np.full((3, 3), np.nan), np.full(3, True))
    (figure,) = overlaid_ends({"one": lost, "two": ends(2)}, STYLES, "x")
    chart = figure.chart
    assert [curve.colour for curve in chart.curves[:2]] == [STYLES[name].colour.lower() for name in STYLES]
    assert np.isnan(chart.curves[0].x).all()
    assert is_to_scale(chart, PANEL_WIDTH, 3.1)
    assert has_axes(figure, "x, m", "y, m")
    (other,) = overlaid_ends({name: replace(ends(2), axes=AXES) for name in STYLES}, STYLES, "x")
    assert has_axes(other, "north, m", "west, m")


def test_paths_are_to_scale_where_their_sides_are_alike():
    path = FlightPath(True, np.linspace(-5e4, 0.0, 9), np.linspace(9e3, 0.0, 9), np.stack([STEPS[:9], 2.0 * STEPS[:9]]))
    failed = FlightPath(False, path.along, 2.0 * path.height, path.plan)
    bundle = VariantPaths([path, failed], np.array([1.0, 1.0]), "ship.altitude", None)
    (side,) = side_figures({"one": bundle}, STYLES)
    chart = side.chart
    assert chart.x.label == "downrange from the target, km"
    np.testing.assert_allclose(chart.curves[0].x, 1e-3 * path.along, rtol=1e-12)
    assert [curve.dashes for curve in chart.curves] == [(), (4.0, 2.0)]
    assert [(rule.at, rule.upright) for rule in chart.rules] == [(0.0, True), (0.0, False)]
    assert (chart.areas[0].y.min(), chart.areas[0].y.max()) == (chart.y.ends[0], 0.0)
    (plan,) = plan_figures({"one": bundle}, STYLES)
    chart = plan.chart
    assert is_to_scale(chart, PANEL_WIDTH, 2.5)
    assert has_axes(plan, "x, m", "y, m")
    (other,) = plan_figures({"one": replace(bundle, axes=AXES)}, STYLES)
    assert has_axes(other, "north, m", "west, m")
    assert (chart.curves[-1].x[0], chart.curves[-1].y[0]) == (1.0, 1.0)
