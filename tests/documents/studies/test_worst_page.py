"""Page of a worst case: search, box, worst simulation, noise realisations.

Truth: the worst corner of the box of a linear system; numpy's running maximum and median.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.documents.cell import Quantity
from perilune.analysis.documents.of.studies.worst import metric_table, parameter_table, simulate_worst
from perilune.analysis.documents.of.studies.worst_figures import box_chart, fresh_chart, search_chart, trials_chart
from perilune.analysis.documents.of.studies.worst_points import box_lanes, objective_of, point_values
from perilune.analysis.studies.flown import Flown
from perilune.analysis.studies.noise import Noise
from perilune.analysis.studies.worst.realisations import FreshNoise, Realisations
from tests.documents.leads import assert_lead_everywhere
from tests.support.pages.checks import assert_self_contained, data_values, text_of

# a.gain to 3 times 1.2; b and c along the axes (1, 1) and (1, -1) of their covariance, variances 1.28 and 0.72.
CORNER = 0.5 * (3.6 + 3.0 * np.sqrt(2.0 * 1.28))
REACH = 3.0 * (np.sqrt(1.28) + np.sqrt(0.72)) / np.sqrt(2.0)  # of b and c from their means, one at a time


def page_of(result, folder):
    result.report(folder / "page.html")
    return (folder / "page.html").read_text(encoding="utf-8")


def test_the_page(worst_result, tmp_path):
    page = page_of(worst_result, tmp_path)
    assert_self_contained(page)
    assert {repr(worst_result.value), repr(worst_result.worst_random["value"])} <= set(data_values(page))
    words = text_of(page)
    assert "total: worst" in words
    assert "a search proves no bound" in words
    assert "3 dispersed parameters: a.gain, b.gain, c.gain" in words
    assert f"{worst_result.folder}/worst.parquet" in words
    assert "Simulation of the worst case" in words


def test_every_point_and_the_worst_so_far_are_drawn(worst_result):
    points, line = search_chart(worst_result).curves[:2]
    np.testing.assert_array_equal(points.y, worst_result.flown.values)
    np.testing.assert_array_equal(line.y, np.maximum.accumulate(worst_result.flown.values))
    assert line.y[-1] == pytest.approx(CORNER, rel=1e-4)
    phases = worst_result.phases
    assert (phases[0].name, phases[0].evaluations) == ("random trials", worst_result.random_trials)
    assert sum(phase.evaluations for phase in phases) == len(worst_result.flown.values)


def test_the_histogram_holds_the_random_trials(worst_result):
    chart = trials_chart(worst_result)
    trials = worst_result.flown.values[: worst_result.random_trials]
    assert sum(bar.y.max() for bar in chart.areas) == trials.size == 60
    for bar in chart.areas:
        low, high = bar.x.min(), bar.x.max()
        assert bar.y.max() == np.sum((trials >= low) & ((trials < high) | (high == trials.max())))
    assert [rule.at for rule in chart.rules] == [trials.max(), worst_result.value]


def test_the_search_box_has_a_lane_for_each_parameter(worst_result):
    lanes = box_lanes(worst_result)
    chart = box_chart(lanes)
    random, worst = chart.curves[::2], chart.curves[1::2]
    for lane, one, other in zip(lanes, random, worst, strict=True):
        span = lane.high - lane.low
        assert lane.low + one.x[0] * span == pytest.approx(lane.random)
        assert lane.low + other.x[0] * span == pytest.approx(lane.worst)
    assert {lane.label for lane in lanes} <= {note.text for note in chart.notes}


def test_the_worst_is_in_the_corner_of_the_box(worst_result):
    lanes = {lane.name: lane for lane in box_lanes(worst_result)}
    assert lanes["a.gain"].at(lanes["a.gain"].worst) == pytest.approx(1.0, abs=1e-4)
    assert (lanes["a.gain"].low, lanes["a.gain"].high) == pytest.approx((-3.6, 3.6))
    assert (lanes["b.gain"].low, lanes["b.gain"].high) == pytest.approx((1.0 - REACH, 1.0 + REACH))
    assert (lanes["c.gain"].low, lanes["c.gain"].high) == pytest.approx((-1.0 - REACH, -1.0 + REACH))


def test_the_flight_is_that_of_the_worst_case(worst_result):
    flight, _ = simulate_worst(worst_result, worst_result.plan)
    final = flight.final()
    assert final["a.y"] + final["b.y"] + final["c.y"] - 6.0 == worst_result.value


def noisy(result, matters):
    """Return the first 30 simulations as 10 random trials of 3 realisations, the rest as the search, 9 fresh ones."""
    flown = Flown()
    later = 3 if matters else 1
    count = 30 + later * ((result.flown.values.size - 30 - 9) // later) + 9
    plotted = {
        **{name: column[:count] for name, column in result.flown.draws.items()},
        "streams_of.imu": np.zeros(count),
    }
    metrics = {name: column[:count] for name, column in result.flown.metrics.items()}
    flown.add(result.flown.points[:count], plotted, metrics, result.flown.values[:count])
    fresh = FreshNoise(result.flown.values[count - 9 : count], 0.5)
    return replace(
        result, flown=flown.whole(), over=Realisations(3, 0.5), fresh=fresh, noise_matters=matters, random_trials=10,
        noise=Noise(("imu",), None, 7), plan=None, phases=(),
    )  # fmt: skip


@pytest.mark.parametrize("matters", [True, False])
def test_a_point_has_the_median_of_its_realisations(worst_result, matters, tmp_path):
    study = noisy(worst_result, matters)
    flown = study.flown.values
    actual = point_values(study)
    np.testing.assert_array_equal(actual[:10], np.median(flown[:30].reshape(10, 3), axis=1))
    remainder = flown[30:-9]
    np.testing.assert_array_equal(actual[10:], np.median(remainder.reshape(-1, 3), axis=1) if matters else remainder)
    assert objective_of(study).random == int(np.argmax(actual[:10]))
    chart = fresh_chart(study)
    assert chart.curves[0].y[-1] == 1.0
    median, worst, _ = (rule.at for rule in chart.rules)
    assert (median, worst) == (np.median(flown[-9:]), flown[-9:].max())
    words = text_of(page_of(study, tmp_path))
    assert "under 9 fresh noise realisations" in words
    if matters:
        same = np.all(study.flown.points[:-9] == study.flown.points[study.row], axis=1)
        largest = flown[:-9][same].max()
        assert study.worst_realisation == largest
        assert f"(median, quantile 0.5, of 3 noise realisations; worst of them {largest:.6g})" in words
        assert f" (median, quantile 0.5, of 3 noise realisations; worst of them {largest:.6g}), of " in study.lines()[0]
        document = study.json_document()
        assert (document["quantile"], document["worst_realisation"]) == (0.5, largest)
    else:
        assert "(one noise realisation), of" in words
        assert " (one noise realisation), of " in study.lines()[0]


def test_a_margin_is_worse_where_it_is_smaller(worst_result):
    margin = replace(worst_result.badness, size=lambda value: 0.0 - value)
    objective = objective_of(replace(worst_result, badness=margin))
    assert not objective.rising
    np.testing.assert_array_equal(objective.worst_so_far(), np.minimum.accumulate(-worst_result.flown.values))


def test_all_media_have_the_lead(worst_result, tmp_path):
    lead = assert_lead_everywhere(worst_result, tmp_path)
    assert [each.value for each in lead if isinstance(each, Quantity)] == [worst_result.value]
    assert [row[1].value for row in metric_table(worst_result).rows] == [*worst_result.worst["metrics"].values()]
    random = worst_result.worst_random["draws"]
    assert [row[-1].value for row in parameter_table(worst_result).rows] == [*random.values()]


def test_only_the_page_simulates_the_worst_case(worst_result, tmp_path, monkeypatch):
    def simulate(*_):
        raise AssertionError("it simulated")

    monkeypatch.setattr("perilune.analysis.verbs.worst.simulate_worst", simulate)
    assert worst_result.lines()
    assert worst_result._repr_html_()
    with pytest.raises(AssertionError, match="it simulated"):
        worst_result.report(tmp_path / "page.html")
