"""Recorded trials inside the page of a batch: selection of trials and of their data.

Truth: the traces of the batch; counts by hand.
"""

import numpy as np
import pytest

from perilune.analysis.campaigns.trials import TrialTable
from perilune.analysis.documents.of.batch.embedded_flights import embedded_flights
from perilune.analysis.documents.of.batch.recorded_flights import (
    FLIGHT_LIMIT,
    ROW_LIMIT,
    choose_flights,
    read_flights,
)
from tests.support.pages.samples import batch_result

NAMES = ("ship.position[1]", "ship.position[2]", "ship.position[3]", "ship.mass", "ship.count")


def traced_batch(success, rows, *, missing=()):
    """Return a batch of which each trial with ``rows`` recorded NAMES at that many samples; the variants are alike."""
    outcomes = {variant: [(each, 1.0, 2.0) for each in success] for variant in ("one", "other")}
    batch = batch_result(outcomes)
    traces = {
        trial: {"time": 0.5 * np.arange(size)}
        | {name: trial + np.sqrt(np.arange(size) + k) for k, name in enumerate(NAMES) if name not in missing}
        for trial, size in rows.items()
    }
    batch.rows = {variant: TrialTable(trials.table, traces) for variant, trials in batch.rows.items()}
    types = {name: {"unit": "rad" if name == "ship.mass" else "m", "type": "Real"} for name in NAMES}
    batch.provenance |= {
        "record": {"every": 1, "signals": list(NAMES), "trials": None, "traces": "none"},
        "signals": types | {"ship.count": {"unit": None, "type": "Integer"}},
    }
    return batch


@pytest.mark.parametrize(
    ("failures", "successes", "failed", "succeeded"), [(30, 30, 10, 10), (4, 30, 4, 16), (30, 4, 16, 4), (3, 2, 3, 2)]
)
def test_half_of_a_quota_are_failures(failures, successes, failed, succeeded):
    success = [False] * failures + [True] * successes
    batch = traced_batch(success, dict.fromkeys(range(len(success)), 3))
    assert FLIGHT_LIMIT == 40  # 20 for each of two variants
    expected = [*range(failed), *range(failures, failures + succeeded)]
    assert choose_flights(batch) == {"one": expected, "other": expected}


def test_only_traced_trials_are_chosen():
    batch = traced_batch([True] * 9, {4: 3, 7: 3})
    assert choose_flights(batch) == {"one": [4, 7], "other": [4, 7]}
    assert choose_flights(traced_batch([True] * 9, {})) == {}
    assert embedded_flights(traced_batch([True] * 9, {})) is None


def test_long_flights_are_thinned_alike_and_keep_their_ends():
    sizes = {0: 2 * ROW_LIMIT + 1, 1: 8, 2: 0}
    batch = traced_batch([True, False, True], sizes)
    flights, stride = read_flights(batch, choose_flights(batch), NAMES)
    assert stride == 3
    assert [(each.name.variant, each.name.trial, each.name.failed) for each in flights] == [
        (variant, trial, failed) for variant in ("one", "other") for trial, failed in ((0, False), (1, True))
    ]
    for each in flights:
        last = sizes[each.name.trial] - 1
        expected = sorted({*range(0, last, 3), last})
        np.testing.assert_array_equal(each.flight.time, 0.5 * np.array(expected))
        trace = batch.rows["one"].traces[each.name.trial]
        np.testing.assert_array_equal(each.flight.signals["ship.mass"], trace["ship.mass"][expected])


def test_a_panel_for_each_vector_and_a_column_for_each_signal(monkeypatch):
    monkeypatch.setattr("perilune.analysis.documents.of.batch.embedded_flights._declared_scene", lambda batch: None)
    batch = traced_batch([True, True], {1: 5})
    embedded = embedded_flights(batch)
    panels = embedded.document["panels"]
    assert [(each["title"], each["unit"], each["steps"], len(each["lines"])) for each in panels] == [
        ("ship.position", "m", False, 3),
        ("ship.mass", "deg", False, 1),
        ("ship.count", "", True, 1),
    ]
    batch.provenance["signals"]["ship.position[3]"]["axis"] = "up"
    named = embedded_flights(batch).document["panels"][0]["lines"]
    assert [each["name"] for each in named] == ["ship.position[1]", "ship.position[2]", "up"]
    first = embedded.document["flights"][0]
    assert (first["variant"], first["trial"]) == ("one", 1)
    trace = batch.rows["one"].traces[1]
    for name, column in zip(NAMES, first["columns"], strict=True):
        np.testing.assert_array_equal(column, trace[name])
    assert embedded.scene is None
    assert embedded.notes[0].startswith("2 of 2 trials")


def test_a_scene_that_cannot_be_read_is_named_and_costs_no_page():
    batch = traced_batch([True, True], {1: 5})  # of a system that is not there
    embedded = embedded_flights(batch)
    assert embedded.scene is None
    assert any(note.startswith("The system's scene cannot be read: ") for note in embedded.notes)
