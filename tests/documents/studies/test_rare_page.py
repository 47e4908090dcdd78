"""Page of a rare failure: numbers, figures, conditions.

Truth: the arrays of the result, counted here; the closed form of the linear system's failure; scipy's binomial test.
"""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from perilune.analysis.documents.of.studies.rare import design_table, level_table
from perilune.analysis.documents.of.studies.rare_figures import (
    design_chart,
    exceedance_chart,
    interval_chart,
    limit_state_chart,
)
from perilune.analysis.studies.noise import Noise
from perilune.analysis.studies.rare.interpretation import Equivalent, equivalents, influence, level_spans
from tests.documents.leads import assert_lead_everywhere
from tests.support.pages.checks import assert_self_contained, data_values, text_of
from tests.support.pages.studies import LIMIT


def page_of(result, folder):
    result.report(folder / "page.html")
    return (folder / "page.html").read_text(encoding="utf-8")


def test_the_headline_states_the_estimate_and_its_conditions(rare_result, tmp_path):
    page = page_of(rare_result, tmp_path)
    assert_self_contained(page)
    values = set(data_values(page))
    assert {repr(rare_result.probability), *map(repr, rare_result.interval), repr(rare_result.flights)} <= values
    words = text_of(page)
    assert f"Failure: total > {LIMIT}" in words
    assert "3 dispersed parameters: a.gain, b.gain, c.gain" in words
    assert "No component draws random numbers." in words
    assert "conditional on" not in words.casefold()
    assert page_of(rare_result, tmp_path) == page


def test_noise_of_one_trial_stands_in_every_section(rare_result, tmp_path):
    fixed = replace(rare_result, noise=Noise(("imu", "star"), 4, 7))
    words = text_of(page_of(fixed, tmp_path))
    assert "Noise of imu, star: noise of trial 4 in all simulations, seed 7." in words
    assert "All numbers: conditional on the noise realisation of trial 4." in words
    lead = words[words.index("Failure probability") : words.index("Failure: total")]
    assert "conditional on the noise realisation of trial 4" in lead
    assert words.casefold().count("conditional on the noise realisation of trial 4.") >= 6


def test_random_noise_is_no_condition(rare_result, tmp_path):
    flown = rare_result.flown
    number = len(flown.values)
    plotted = {**flown.draws, "streams_of.imu": np.arange(number)}
    flown = type(flown)()
    flown.add(rare_result.flown.points, plotted, rare_result.flown.metrics, rare_result.flown.values)
    random = replace(rare_result, noise=Noise(("imu",), None, 7), flown=flown.whole())
    words = text_of(page_of(random, tmp_path))
    assert "Noise of imu: random." in words
    assert "conditional on" not in words.casefold()
    assert "noise of imu" in words  # a column of the design points


def test_levels_are_those_that_were_flown(rare_result):
    spans = level_spans(rare_result)
    assert [span.first for span in spans] == [1, *(span.last + 1 for span in spans[:-1])]
    assert spans[0].last == rare_result.samples
    assert spans[-1].last == rare_result.flights == len(rare_result.flown.values)
    values = rare_result.flown.values
    for span, following in itertools.pairwise(spans):
        assert span.following == following.threshold
        own = np.sort(values[: spans[0].last])[::-1]
        if span.number == 1:  # a tenth of the first level is in the second
            assert own[int(0.1 * own.size) - 1] == following.threshold
    rows = level_table(rare_result).rows
    assert len(rows) == len(spans)
    product = np.prod([level.probability for level in rare_result.simulation.levels])
    assert product == pytest.approx(rare_result.probability, rel=1e-12)
    assert rows[-1][5].value == spans[-1].reached * rare_result.simulation.levels[-1].probability


def test_the_limit_state_of_every_simulation_is_drawn(rare_result):
    chart = limit_state_chart(rare_result)
    good, failed = chart.curves
    numbers = np.concatenate([good.x, failed.x])
    values = np.concatenate([good.y, failed.y])
    np.testing.assert_array_equal(values[np.argsort(numbers)], rare_result.flown.values)
    assert np.all(failed.y >= 0.0)
    assert np.all(good.y < 0.0)
    spans = level_spans(rare_result)
    assert [(area.x.tolist(), area.y[0]) for area in chart.areas] == [
        ([span.first, span.last], span.following) for span in spans
    ]
    assert [note.text for note in chart.notes] == [str(span.number) for span in spans]


def test_the_curve_of_the_first_level_is_its_empirical_one(rare_result):
    chart = exceedance_chart(rare_result)
    empirical, levels, interval = chart.curves
    own = rare_result.flown.values[: rare_result.samples]
    for limit in np.quantile(own, [0.013, 0.5, 0.987]):
        row = np.searchsorted(empirical.x, limit, side="right") - 1  # from there on it holds to the next
        assert empirical.y[row] == pytest.approx(np.mean(own >= limit), rel=1e-12)
    assert levels.x[-1] == 0.0
    assert levels.y[-1] == rare_result.probability
    assert interval.y.tolist() == list(rare_result.interval)
    low, high = chart.y.ends
    expected = [k * 10.0**n for n in range(-9, 3) for k in range(1, 10) if low <= k * 10.0**n <= high]
    assert [at for at, _ in chart.y.ticks] == pytest.approx(expected)


def test_design_points_lie_behind_the_plane_of_the_failure(rare_result):
    """The failure is a half space at LIMIT standard deviations: nothing that failed is nearer."""
    assert all(entry["distance"] >= LIMIT for entry in rare_result.failures)
    assert set(influence(rare_result)) == {"a.gain", "b.gain", "c.gain"}
    cloud, failures, points = design_chart(rare_result, "a.gain", "b.gain").curves
    assert cloud.x.size == rare_result.samples
    assert failures.x.size == np.count_nonzero(rare_result.flown.values >= 0.0)
    assert points.x.tolist() == [entry["draws"]["a.gain"] for entry in rare_result.failures]


def test_an_interval_from_0_goes_on_to_the_left():
    rows = [Equivalent("this study", 500.0, 1e-5, 4e-4), Equivalent("Monte Carlo", 500.0, 0.0, 7e-3)]
    chart = interval_chart(rows, 2e-4)
    spans = [curve for curve in chart.curves if curve.joined]
    assert [span.x.tolist() for span in spans] == [[1e-5, 4e-4], [chart.x.ends[0], 7e-3]]
    assert [span.y.tolist() for span in spans] == [[0.0, 0.0], [1.0, 1.0]]
    (arrow,) = (curve for curve in chart.curves if not curve.joined)
    assert arrow.y.tolist() == [1.0]
    assert [rule.at for rule in chart.rules] == [2e-4]
    assert [note.text for note in chart.notes] == ["this study: 500 simulations", "Monte Carlo: 500 simulations"]


def test_monte_carlo_equivalents(rare_result):
    study, as_many, same = equivalents(rare_result)
    assert (study.low, study.high) == rare_result.interval
    fraction, trials = rare_result.probability, same.simulations
    variation = rare_result.simulation.interval.variation
    assert np.sqrt((1.0 - fraction) / (fraction * trials)) == pytest.approx(variation, rel=1e-3)
    for row in (as_many, same):
        ends = stats.binomtest(round(fraction * row.simulations), row.simulations).proportion_ci(0.95, method="exact")
        assert (row.low, row.high) == pytest.approx((ends.low, ends.high), rel=1e-9)


def test_a_failure_that_was_not_reached_is_a_bound(rare_result, tmp_path):
    simulation = replace(rare_result.simulation, probability=None, equivalent_trials=None)
    bound = replace(rare_result, simulation=simulation)
    page = page_of(bound, tmp_path)
    assert_self_contained(page)
    assert "Failure not reached: probability below" in text_of(page)


def test_a_wide_interval_leaves_one_digit_and_a_bound_no_interval(rare_result, tmp_path):
    interval = rare_result.simulation.interval._replace(low=1.234e-12, high=0.0012345)
    simulation = replace(rare_result.simulation, probability=2.345e-7, interval=interval, families=1)
    wide = replace(rare_result, simulation=simulation)
    assert wide.lines()[0] == "failure probability 2e-7, 95 % interval 1.2e-12 to 0.0012"
    assert any(line.endswith("; independent families 1") for line in wide.lines())
    words = text_of(page_of(wide, tmp_path))
    assert "Failure probability 2e-7, 95 % interval 1.2e-12 to 0.0012" in words
    assert {repr(2.345e-7), repr(1.234e-12)} <= set(data_values(page_of(wide, tmp_path)))
    ended = replace(simulation.levels[-1], noise_acceptance=0.2, least_acceptance=0.01, source=0)
    levels = (*simulation.levels[:-1], ended)
    bound = replace(
        wide, simulation=replace(simulation, levels=levels, noise_ends=True), noise=Noise(("imu",), None, 7)
    )
    assert (
        bound.why_levels_ended
        == "levels end at level 3, since 1 % of the noise moves of imu are accepted, fewer than 5 %"
    )
    unnamed = replace(bound.simulation, levels=(*levels[:-1], replace(ended, source=None)))
    fixed = replace(bound, simulation=unnamed, noise=Noise(("imu",), 1, 7))  # so that failures need no streams
    assert fixed.lines()[0].startswith("failure probability below 0.0012, a 95 % bound; estimate 2e-7")
    assert "Failure probability below 0.0012, a 95 % bound; estimate 2e-7" in text_of(page_of(fixed, tmp_path))


def test_levels_that_end_for_the_noise_are_a_bound(rare_result, tmp_path):
    """The last level has no probability, and its simulations are those that are left."""
    simulation = rare_result.simulation
    *trusted, last = simulation.levels
    ended = replace(last, probability=None, deviation=None, noise_acceptance=0.04, least_acceptance=0.01, source=None)
    simulation = replace(
        simulation, levels=(*trusted, ended), probability=None, noise_ends=True, equivalent_trials=500.0
    )
    result = replace(rare_result, simulation=simulation)
    assert level_spans(result)[-1].last == rare_result.flights
    assert level_spans(result)[-1].reached is None
    page = page_of(replace(result, noise=Noise(("imu",), 1, 7)), tmp_path)  # held, so that failures need no streams
    assert_self_contained(page)
    words = text_of(page)
    assert "Failure not reached: probability below" in words
    assert "Levels end at level 3, since 1 % of the noise moves are accepted, fewer than 5 %" in words
    assert "a bound ten times lower, by Monte Carlo: perilune batch" in words
    assert "--trials 5000" in words


def test_the_command_that_flies_a_design_point_again(rare_result, tmp_path):
    words = text_of(page_of(rare_result, tmp_path))
    assert rare_result.replay(rare_result.folder, 0) in words
    without = text_of(page_of(replace(rare_result, folder=None), tmp_path))
    assert "The samples were not written" in without


def test_all_media_have_the_lead(rare_result, tmp_path):
    lead = assert_lead_everywhere(rare_result, tmp_path)
    numbers = [each.value for each in lead if not isinstance(each, str)]
    assert numbers == [rare_result.probability, *rare_result.interval]
    numbers = dict(rare_result.document().summary[1].entries)
    assert (numbers["simulations"], numbers["levels"]) == (rare_result.flights, len(rare_result.simulation.levels))
    for row, entry in zip(design_table(rare_result).rows, rare_result.failures, strict=True):
        assert [cell.value for cell in row[1:]] == [entry["distance"], entry["margin"], *entry["draws"].values()]
