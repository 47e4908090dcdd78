"""Inputs over time, evaluated at communication points.

Truth: FMPy's `Input.interpolate`, bit for bit, over series with events, close times and points outside.
"""

from __future__ import annotations

import numpy as np
import pytest
from fmpy.simulation import Input
from hypothesis import example, given
from hypothesis import strategies as st

from perilune.analysis.runtime.system import inputs
from perilune.analysis.runtime.system.inputs import hold, interpolate
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from perilune.common.errors import InputError

TIMES = st.lists(st.sampled_from([0.0, 0.1, 0.2, 0.3, 0.30000000000000004, 0.5, 0.7, 1.0, 3.0]), min_size=1, max_size=9)
POINTS = st.lists(
    st.one_of(st.floats(-1.0, 4.0), st.sampled_from([0.0, 0.1, 0.1 + 1e-12, 0.3, 0.30000000000000004, 1.0, 3.0])),
    min_size=1,
    max_size=9,
)


@given(TIMES, POINTS, st.booleans(), st.integers(0, 2**31))
@example([0.0, 0.0, 1.0], [0.0], True, 0)
@example([0.0, 1.0, 1.0, 1.0], [1.0], True, 0)
def test_as_fmpy_has_it(times, points, after_event, seed):
    time = np.sort(np.array(times))
    values = np.random.default_rng(seed).normal(size=time.size)
    table = values[np.newaxis]
    for discrete, ours in ((False, interpolate), (True, hold)):
        actual = ours(np.array(points), time, values, after_event=after_event)
        for point, value in zip(points, actual, strict=True):
            theirs, _ = Input.interpolate(point, time, table, discrete=discrete, after_event=after_event)
            assert value == np.ravel(theirs)[0], (discrete, point)


def test_in_closed_form():
    time, values = np.array([1.0, 3.0, 3.0, 5.0]), np.array([10.0, 20.0, 40.0, 0.0])
    points = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    assert interpolate(points, time, values, after_event=True).tolist() == [10, 10, 15, 40, 20, 0, 0]
    assert interpolate(points, time, values, after_event=False).tolist() == [10, 10, 15, 20, 20, 0, 0]
    assert hold(points, time, values, after_event=True).tolist() == [10, 10, 10, 40, 40, 0, 0]
    assert hold(points, time, values, after_event=False).tolist() == [10, 10, 10, 10, 40, 40, 0]


@pytest.mark.parametrize("ours", [interpolate, hold])
def test_one_sample_is_held(ours):
    assert ours(np.array([-1.0, 0.5, 2.0]), np.array([0.5]), np.array([7.0]), after_event=True).tolist() == [7.0] * 3


def test_points_in_blocks_have_the_same_bits(tiny, monkeypatch):
    fmu = str(tiny / "gain.fmu")
    series = read_series({"time": [0.0, 0.35, 0.35, 0.8], "u": [1.0, 2.0, -1.0, 0.3]})
    whole = prepare_system(fmu, SystemOptions(step=0.01, stop_time=1.0), series=series).drive.table
    monkeypatch.setattr(inputs, "POINTS", 7)
    split = prepare_system(fmu, SystemOptions(step=0.01, stop_time=1.0), series=series).drive.table
    assert split.shape == (102, 1)
    assert split.tobytes() == whole.tobytes()


@pytest.mark.parametrize("step", [1e-7, 1e-12])
def test_more_points_than_memory_are_refused(tiny, monkeypatch, step):
    monkeypatch.setenv("PERILUNE_MEMORY_FRACTION", "1e-9")
    series = read_series({"time": [0.0], "u": [1.0]})
    with pytest.raises(
        InputError, match=r"rows of 1 inputs take \S+ GB, over 0% of the free memory; give a longer step"
    ):
        prepare_system(str(tiny / "gain.fmu"), SystemOptions(step=step, stop_time=1.0), series=series)
