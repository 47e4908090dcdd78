"""StoredResults.traces: recorded signals of trials as an xarray.Dataset.

Truth: the written traces in memory, some of which are shortened first.
"""

from dataclasses import replace

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.folder.shard_files import write_draws
from perilune.analysis.campaigns.trials import TrialTable
from tests.support.pages.comparison_samples import SIGNALS, sample_batch, write_sample

LENGTHS = {0: 21, 1: 13, 2: 5, 3: 21}  # rows of the first flights; END is 20 s


@pytest.fixture(scope="module")
def written():
    """Return a batch whose flights of beta end at different times, one of them between two rows of the others."""
    sample = sample_batch(traced=4)
    beta = sample.trials["beta"]
    traces = {
        trial: {name: values[: LENGTHS[trial]].copy() for name, values in actual.items()}
        for trial, actual in beta.traces.items()
    }
    traces[2]["time"][-1] += 0.25
    return replace(sample, rows=sample.trials | {"beta": TrialTable(beta.table, traces)})


@pytest.fixture(scope="module")
def folder(written, tmp_path_factory):
    place = tmp_path_factory.mktemp("traces")
    write_draws(written.plan, place, 50)
    written.write(place)
    return place


def test_every_value_stands_at_its_trial_and_time(folder, written):
    actual = perilune.open_results(folder).traces("beta")
    assert list(actual.data_vars) == SIGNALS
    assert actual["trial"].values.tolist() == [0, 1, 2, 3]
    times = sorted({*np.arange(0.0, 21.0).tolist(), 4.25})
    assert actual["time"].values.tolist() == times
    for name in SIGNALS:
        expected = np.full((4, len(times)), np.nan)
        for trial, trace in written.trials["beta"].traces.items():
            for time, value in zip(trace["time"], trace[name], strict=True):
                expected[trial, times.index(time)] = value
        np.testing.assert_array_equal(actual[name].values, expected)
    assert np.isnan(actual["ship.mass"].sel(trial=1, time=13.0))
    assert actual["ship.mass"].sel(trial=1).count() == LENGTHS[1]


def test_units_are_attributes(folder):
    actual = perilune.open_results(folder).traces("alpha", ["ship.mass", "ship.velocity[1]", "pilot.status"])
    assert actual["ship.mass"].attrs == {"units": "kg"}
    assert actual["ship.velocity[1]"].attrs == {"units": "m/s"}
    assert actual["pilot.status"].attrs == {}
    assert actual["time"].attrs == {"units": "s"}
    assert actual.attrs == {"system": "ship", "campaign": "test.toml", "variant": "alpha"}


def test_a_signal_that_no_trace_has(folder):
    with pytest.raises(KeyError, match=r"no signal ship.mas; the nearest of \d+ known names: ship.mass"):
        perilune.open_results(folder).traces("beta", ["ship.mas"])


def test_traces_of_another_campaign_are_left_out(folder, tmp_path):
    write_sample(tmp_path, traced=6, seed=8)
    write_sample(tmp_path, traced=2)
    assert perilune.open_results(tmp_path).traces("beta")["trial"].values.tolist() == [0, 1]


def test_a_campaign_without_traces(tmp_path):
    write_sample(tmp_path, traced=0)
    with pytest.raises(KeyError, match="no trace of beta"):
        perilune.open_results(tmp_path).traces("beta")


def test_a_damaged_trace_is_named(folder, tmp_path):
    write_sample(tmp_path, traced=2)
    path = tmp_path / "traces" / "beta" / "000001.parquet"
    path.write_bytes(path.read_bytes()[:-10])
    with pytest.raises(perilune.InputError, match=r"beta/000001\.parquet: cannot be read as parquet"):
        perilune.open_results(tmp_path).traces("beta")
