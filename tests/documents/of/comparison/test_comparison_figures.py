"""Content of a comparison's figures: bands over time, paths, ellipses, and quantities of signals.

Truth: percentiles, norms and projections computed here with numpy from the traces; properties of ellipses (points of
the k-sigma ellipse have the Mahalanobis distance k, and the ellipse contains the expected share of points).
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path

from perilune.analysis.campaigns.compare.campaign_comparison import Contender
from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.campaigns.folder.stored import read_batch
from perilune.analysis.campaigns.trials import TrialTable
from perilune.analysis.documents.common.colours import Look
from perilune.analysis.documents.of.campaign.recorded_names import names_of_record, vectors
from perilune.analysis.documents.of.comparison.flights.band_figures import band_figures
from perilune.analysis.documents.of.comparison.flights.bands import LEVELS, bands_of
from perilune.analysis.documents.of.comparison.flights.ends import Ends, dispersion, ellipse, ends_of, target_of
from perilune.analysis.documents.of.comparison.flights.recorded import (
    ComparedFlight,
    FlightQuantity,
    doubling,
    quantities,
    read_flights,
    trials_with_traces,
)
from perilune.analysis.documents.of.comparison.flights.trajectories import collect_paths
from tests.support.campaigns.trial_tables import changed
from tests.support.pages.comparison_samples import DIRECTION, POSITION, SIGNALS, TARGET, VELOCITY, write_sample


@pytest.fixture(scope="module")
def batch(tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures") / "out"
    write_sample(folder)
    return read_batch(folder)


@pytest.fixture(scope="module")
def comparison(batch):
    return compare([batch.folder])


@pytest.fixture(scope="module")
def flights(batch, comparison):
    trials = trials_with_traces(comparison.contenders.values())
    return {
        label: read_flights(contender, trials[label], names_of_record(batch.document))
        for label, contender in comparison.contenders.items()
    }


def test_quantities_are_told_by_name_and_unit(batch):
    actual = [(quantity.label, quantity.unit, quantity.kind, quantity.held) for quantity in quantities(batch.document)]
    assert actual == [
        ("ship.position[3]", "m", "motion", False),
        ("ship.velocity, magnitude", "m/s", "motion", False),
        ("ship.mass", "kg", "motion", False),
        ("pilot.thrust", "N", "commands", False),
        ("pilot.thrust_direction above the horizontal", "rad", "commands", False),
        ("pilot.status", None, "other", True),
        ("checker.x_error_ratio", None, "consistency", False),
    ]


def test_altitude_takes_the_place_of_height(tmp_path):
    result = write_sample(tmp_path / "out")
    record = result.provenance["record"]
    record["signals"] = ["ship.altitude", *SIGNALS]
    result.provenance["signals"]["ship.altitude"] = {"unit": "m", "type": "Real"}
    for trials in result.trials.values():
        for trace in trials.traces.values():
            trace["ship.altitude"] = trace["ship.position[3]"] + 5.0
    result.write(tmp_path / "out")
    batch = read_batch(tmp_path / "out")
    assert "ship.position[3]" not in [quantity.label for quantity in quantities(batch.document)]
    contender = compare([tmp_path / "out"]).contenders["alpha"]
    bundle = collect_paths(contender, read_flights(contender, [0], names_of_record(batch.document)))
    assert bundle.height == "ship.altitude"
    assert bundle.paths[0].height[0] == pytest.approx(505.0)
    # without a final altitude a path ends with its last sample, and none is lost
    for variant, trials in result.trials.items():
        result.trials[variant] = changed(trials, {"end_time": trials.end_time + 0.3})
    result.write(tmp_path / "out")
    contender = compare([tmp_path / "out"]).contenders["alpha"]
    flights = read_flights(contender, range(12), names_of_record(batch.document))
    paths = collect_paths(contender, flights).paths
    assert [path.plan.shape[1] for path in paths] == [flight.time.size for flight in flights]


def test_downrange_over_a_round_body_is_along_its_ground(tmp_path):
    """A steady descent over 0.4 rad of a sphere of 1000 km to the target, whose altitude is recorded."""
    result = write_sample(tmp_path / "out")
    result.provenance["record"]["signals"] = ["ship.altitude", *SIGNALS]
    result.provenance["signals"]["ship.altitude"] = {"unit": "m", "type": "Real"}
    result.provenance["targets"] = {name: {} for name in result.trials}
    radius = 1e6
    for variant, trials in result.trials.items():
        result.trials[variant] = changed(trials, {f"final.{name}": None for name in trials.final})
        for number, trace in enumerate(trials.traces.values()):
            angle = np.linspace(-0.4, 0.0, trace["time"].size) if number else np.zeros(trace["time"].size)
            altitude = 100.0 - 1e5 * angle  # the first flight stays over the target: it shows no curvature
            trace["ship.altitude"] = altitude
            for name, values in zip(
                POSITION,
                ((radius + altitude) * np.sin(angle), 0.0 * angle, (radius + altitude) * np.cos(angle) - radius),
                strict=True,
            ):
                trace[name] = values
    result.write(tmp_path / "out")
    batch = read_batch(tmp_path / "out")
    contender = compare([tmp_path / "out"]).contenders["alpha"]
    bundle = collect_paths(contender, read_flights(contender, [0, 1], names_of_record(batch.document)))
    assert bundle.radius == pytest.approx(radius, rel=1e-9)
    assert bundle.over_ground
    path = bundle.paths[1]
    np.testing.assert_allclose(path.along, radius * np.linspace(-0.4, 0.0, path.along.size), atol=1e-3)
    np.testing.assert_allclose(path.height, 100.0 - 0.1 * path.along, atol=1e-3)  # 1e5 m a radian of 1000 km


def test_values_of_quantities(batch, flights):
    flight = flights["beta"][3]
    by_label = {quantity.label: quantity for quantity in quantities(batch.document)}
    signals = flight.signals
    speed = np.sqrt(sum(signals[name] ** 2 for name in VELOCITY))
    np.testing.assert_allclose(by_label["ship.velocity, magnitude"].values(signals), speed, rtol=1e-15)
    elevation = np.arcsin(signals[DIRECTION[2]] / np.sqrt(sum(signals[name] ** 2 for name in DIRECTION)))
    actual = by_label["pilot.thrust_direction above the horizontal"].values(signals)
    np.testing.assert_allclose(actual, elevation, rtol=1e-12)


def test_vectors_have_elements_1_to_3_and_nothing_else():
    names = ["a.x[1]", "a.x[2]", "a.x[3]", "b.y[1]", "b.y[2]", *(f"c.z[{i}]" for i in (1, 2, 3, 4)), "d"]
    assert vectors(names) == {"a.x": ("a.x[1]", "a.x[2]", "a.x[3]")}


def test_bands_are_percentiles_over_the_successful_flights(batch, flights):
    quantity = next(quantity for quantity in quantities(batch.document) if quantity.label == "ship.mass")
    for label, actual in flights.items():
        good = np.stack([flight.signals["ship.mass"] for flight in actual if flight.success])
        bands = bands_of(quantity, actual)
        assert bands.flights == len(good)
        assert len(good) < 12 or label == "alpha"
        assert bands.time.tolist() == actual[0].time.tolist()
        assert np.array_equal(bands.percentiles, np.percentile(good, LEVELS, axis=0, method="inverted_cdf"))


def test_errors_over_sigma_are_told_over_all_flights(batch, flights):
    quantity = quantities(batch.document)[-1]
    values = np.stack([flight.signals[quantity.label] for flight in flights["gamma"]])
    expected = np.percentile(values, LEVELS, axis=0, method="inverted_cdf")
    assert np.array_equal(bands_of(quantity, flights["gamma"]).percentiles, expected)


def test_a_command_in_the_last_row_is_left_out(batch, flights):
    thrust = next(quantity for quantity in quantities(batch.document) if quantity.label == "pilot.thrust")
    assert bands_of(thrust, flights["alpha"]).time[-1] == flights["alpha"][0].time[-2]


def make_flight(rows, value=1.0, success=True, step=1.0):
    return ComparedFlight(0, success, step * np.arange(rows), {"a.b": np.full(rows, value)}, False)


def test_bands_end_where_few_still_fly():
    quantity = FlightQuantity("a.b", "b", None, "other", ("a.b",), lambda signals: signals["a.b"])
    flights = [make_flight(10) for _ in range(7)] + [make_flight(20, 2.0)]
    bands = bands_of(quantity, flights)
    assert bands.time[-1] == 9.0  # one of eight is fewer than a quarter
    assert bands_of(quantity, [make_flight(10) for _ in range(3)] + [make_flight(20, 2.0)]).time[-1] == 19.0
    only_failed = bands_of(quantity, [make_flight(10, success=False)])
    assert (only_failed.flights, only_failed.failed) == (1, [])
    assert bands_of(quantity, [make_flight(1)]) is None
    assert bands_of(FlightQuantity("c", "c", None, "other", ("c",), lambda signals: signals["c"]), flights) is None


def test_whole_numbers_are_held_and_others_interpolated():
    values = {"a.b": np.array([0.0, 1.0, 3.0])}
    coarse = ComparedFlight(0, True, np.array([0.0, 2.0, 4.0]), values, False)
    fine = make_flight(5, 0.0)
    for held, expected in ((True, [0.0, 0.0, 1.0, 1.0, 3.0]), (False, [0.0, 0.5, 1.0, 2.0, 3.0])):
        quantity = FlightQuantity("a.b", "b", None, "other", ("a.b",), lambda signals: signals["a.b"], held)
        bands = bands_of(quantity, [fine, coarse])
        np.testing.assert_array_equal(bands.percentiles[LEVELS.index(95.0)], expected)
        np.testing.assert_array_equal(bands.percentiles[LEVELS.index(50.0)], np.zeros(5))  # of two the lower, a value


@given(st.integers(1, 10**6), st.integers(1, 1000))
def test_rows_are_thinned_by_powers_of_two(rows, most):
    step = doubling(rows / most)
    assert step & (step - 1) == 0
    assert rows / step <= most
    assert step == 1 or rows / (step // 2) > most


def test_long_traces_are_thinned_and_keep_their_ends(tmp_path):
    result = write_sample(tmp_path / "out", traced=2)
    for variant, trials in result.trials.items():
        times = {trial: 0.01 * np.arange(2001 + 100 * trial) for trial in trials.traced()}
        traces = {trial: {"time": time, **dict.fromkeys(SIGNALS, np.sin(time))} for trial, time in times.items()}
        result.trials[variant] = TrialTable(trials.table, traces)
    result.write(tmp_path / "out")
    contender = compare([tmp_path / "out"]).contenders["beta"]
    for flight in read_flights(contender, [0, 1], ["ship.mass"]):
        assert 250 <= flight.time.size <= 502
        assert flight.time[-1] == 0.01 * (2000 + 100 * flight.trial)
        np.testing.assert_array_equal(flight.signals["ship.mass"], np.sin(flight.time))


def test_the_same_trials_are_shown_of_every_variant(batch, comparison):
    assert trials_with_traces(comparison.contenders.values()) == {
        label: list(range(12)) for label in comparison.contenders
    }
    lacking = replace(batch, traced=batch.traced | {"beta": [0, 1, 2, 5, 7]})
    contenders = [Contender(name, lacking, name, 0, k) for k, name in enumerate(("alpha", "beta"))]
    assert trials_with_traces(contenders) == {label: [0, 1, 2, 5, 7] for label in ("alpha", "beta")}
    apart = replace(batch, traced=batch.traced | {"alpha": [1, 3], "beta": [2, 4]})
    contenders = [Contender(name, apart, name, 0, k) for k, name in enumerate(("alpha", "beta"))]
    assert trials_with_traces(contenders) == {"alpha": [1, 3], "beta": [2, 4]}


def test_paths_run_along_the_line_to_the_target(comparison, flights):
    contender = comparison.contenders["gamma"]
    bundle = collect_paths(contender, flights["gamma"])
    assert bundle.height == "ship.position[3]"
    np.testing.assert_array_equal(bundle.target, TARGET[:2])
    for flight, path in zip(flights["gamma"], bundle.paths, strict=True):
        start = np.array([flight.signals["ship.position[1]"][0], flight.signals["ship.position[2]"][0]])
        assert path.along[0] == pytest.approx(-np.linalg.norm(TARGET[:2] - start), rel=1e-12)
        end = np.array([contender.trials.final[f"ship.position[{i}]"][flight.trial] for i in (1, 2)])
        np.testing.assert_allclose(path.plan[:, -1], end, rtol=1e-12)
        across = np.linalg.norm(end - TARGET[:2]) ** 2 - path.along[-1] ** 2
        assert across >= -1e-9  # no nearer than along the line


def test_the_end_is_added_to_a_sampled_path(tmp_path):
    result = write_sample(tmp_path / "out", traced=3)
    for trials in result.trials.values():
        for trial, trace in trials.traces.items():
            trials.traces[trial] = {name: values[:-4] for name, values in trace.items()}
    result.write(tmp_path / "out")
    contender = compare([tmp_path / "out"]).contenders["beta"]
    flights = read_flights(contender, [0, 1, 2], SIGNALS)
    for flight, path in zip(flights, collect_paths(contender, flights).paths, strict=True):
        assert path.plan.shape[1] == flight.time.size + 1
        assert path.plan[0, -1] == contender.trials.final["ship.position[1]"][flight.trial]
        assert path.height[-1] == contender.trials.final["ship.position[3]"][flight.trial]


def test_ends_are_about_the_target(comparison):
    contender = comparison.contenders["beta"]
    ends = ends_of(contender, "position")
    assert (ends.signal, ends.target) == ("ship.position", "pilot.target_position")
    for k in range(3):
        expected = contender.trials.final[f"ship.position[{k + 1}]"] - TARGET[k]
        np.testing.assert_array_equal(ends.errors[:, k], expected)


def test_a_target_that_is_drawn_differs_from_trial_to_trial(batch):
    plotted = replace(batch, draws=batch.draws | {"pilot.target_position[2]": np.arange(40.0)})
    target = target_of(Contender("beta", plotted, "beta", 0, 1), "position").values
    assert target[:, 1].tolist() == list(range(40))
    assert np.all(target[:, [0, 2]] == TARGET[[0, 2]])


@given(st.integers(3, 60), st.integers(0, 10**6), st.floats(0.5, 3.0))
def test_ellipses_are_so_many_deviations_away(count, seed, sigma):
    source = np.random.default_rng(seed)
    good = source.normal(size=(count, 3)) @ source.normal(size=(3, 3)) + source.normal(size=3)
    difference = ellipse(good, sigma) - good[:, :2].mean(axis=0)[:, np.newaxis]
    sample = np.cov(good[:, :2].T)
    distance = np.sqrt(np.sum(difference * np.linalg.solve(sample, difference), axis=0))
    np.testing.assert_allclose(distance, sigma, rtol=1e-5)


def test_ellipses_hold_what_the_page_says_of_normal_errors():
    good = np.random.default_rng(1).normal(size=(200_000, 3)) @ np.array([[2.0, 0.7, 0], [0, 0.5, 0], [0, 0, 1]])
    for sigma, fraction in ((1, 0.393), (2, 0.865), (3, 0.989)):  # test_comparison_tables.py: that the page says so
        inside = Path(ellipse(good, sigma).T).contains_points(good[:, :2])
        assert np.mean(inside) == pytest.approx(fraction, abs=0.004)


def test_dispersion_of_few_trials():
    errors = np.array([[3.0, 4.0, 1.0], [np.nan, 0.0, 0.0], [1.0, 1.0, 1.0]])
    one = dispersion(Ends("a", "position", "b", errors, np.array([True, True, False])))
    assert (one.count, one.mean, one.std, one.axes, one.radii) == (1, [3.0, 4.0, 1.0], None, None, [5.0, 5.0, 5.0])
    none = dispersion(Ends("a", "position", "b", errors, np.array([False, True, False])))
    assert (none.count, none.mean, none.radii) == (0, None, None)


def test_errors_far_beyond_expectation_leave_the_frame_and_the_panel_says_so():
    name = "checker.normalised_error_square"
    quantity = FlightQuantity(
        name, name.rpartition(".")[2], None, "consistency", (name,), lambda signals: signals[name]
    )
    values = np.array([1300.0, 5.0, 6.0, 7.0])
    wild = bands_of(quantity, [ComparedFlight(0, True, np.arange(4.0), {name: values}, False)])
    calm = bands_of(quantity, [ComparedFlight(0, True, np.arange(4.0), {name: np.minimum(values, 9.0)}, False)])
    plain = Look("#000000", "-", "o")
    clipped, whole = band_figures(quantity, {"wild": wild, "calm": calm}, {"wild": plain, "calm": plain}, "x")
    assert [note.text for note in clipped.chart.notes] == ["clipped; full range 5 to 1300"]
    assert not whole.chart.notes
    assert whole.chart.y.ends[1] <= 25.0  # chi-square of six: nine tenths lie between 1.6 and 12.6
