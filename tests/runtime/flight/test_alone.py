"""Single FMU with inputs over time in `perilune.simulate`.

Truth: `fmpy.simulate_fmu` with the same step, bit for bit.
"""

from __future__ import annotations

import fmpy
import numpy as np
import pytest

import perilune
from tests.support.lone_fmus import build_lone_fmu

STEP, STOP = 0.125, 2.0  # a step whose multiples are exact: FMPy steps by their differences
OUTPUTS = {"dynamic": ["x", "v", "seen"], "follower": ["u_out", "d_out", "n_out", "b_out"]}


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    folder = tmp_path_factory.mktemp("alone")
    return {name.lower(): build_lone_fmu(name, folder) for name in ("Dynamic", "Follower")}


def fmpy_flight(path, series, names, **options):
    return fmpy.simulate_fmu(
        str(path), stop_time=STOP, output_interval=STEP, step_size=STEP, input=series, output=names, **options
    )


def series_of(**columns):
    dtype = [(name, np.asarray(values).dtype) for name, values in columns.items()]
    return np.array(list(zip(*columns.values(), strict=True)), dtype=dtype)


SERIES = {
    "dynamic": {
        "continuous": series_of(time=[0.0, 0.37, 1.21, 2.0], force=[0.0, 1.7, -0.3, 0.9]),
        "event": series_of(time=[0.0, 0.5, 0.5, 2.0], force=[0.0, 1.0, -2.0, 0.1], level=[1.0, 1.0, 2.0, 3.0]),
        "discrete": series_of(time=[0.0, 0.375, 1.1, 1.9], level=[0.0, 1.0, -1.0, 4.0]),
        "outside": series_of(time=[0.6, 1.1], force=[3.0, 1.0], level=[2.0, 5.0]),
        "event at the start": series_of(time=[0.0, 0.0, 1.0], force=[1.0, 4.0, 5.0], level=[1.0, 2.0, 3.0]),
    },
    "follower": {
        "all": series_of(
            time=[0.0, 0.375, 0.375, 1.3, 2.0], u=[0.0, 1.0, 5.0, -3.0, 0.7], d=[0.0, 1.0, 2.0, 3.0, 4.0],
            n=[1, 2, -3, 4, 5], b=[True, False, False, True, False],
        ),
        "some": series_of(time=[0.0, 2.0], u=[0.0, 1.0]),
    },
}  # fmt: skip


@pytest.mark.parametrize(("name", "case"), [(name, case) for name, cases in SERIES.items() for case in cases])
@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_as_fmpy_flies_it(fmus, name, case, algorithm):
    series = SERIES[name][case]
    theirs = fmpy_flight(fmus[name], series, OUTPUTS[name])
    ours = perilune.simulate(fmus[name], input=series, step=STEP, stop_time=STOP, algorithm=algorithm)
    assert ours.status == "stop_time"
    assert np.array_equal(ours.time, theirs["time"])
    for output in OUTPUTS[name]:
        assert np.array_equal(ours[f"{name.title()}.{output}"], theirs[output]), output


@pytest.mark.parametrize(("fmu", "output"), [("gain", "y"), ("delay", "y")])
def test_own_fmus_as_fmpy_flies_them(tiny, fmu, output):
    series = series_of(time=[0.0, 0.5, 0.5, 2.0], u=[0.3, 1.0, -2.0, 0.1])
    theirs = fmpy_flight(tiny / f"{fmu}.fmu", series, [output])
    ours = perilune.simulate(tiny / f"{fmu}.fmu", input=series, step=STEP, stop_time=STOP)
    assert np.array_equal(ours[f"{fmu}.{output}"], theirs[output])


def test_another_step_differs_by_how_fmpy_rounds_it(fmus):
    series = SERIES["dynamic"]["event"]
    theirs = fmpy.simulate_fmu(
        str(fmus["dynamic"]), stop_time=STOP, output_interval=0.1, step_size=0.1, input=series, output=["x"]
    )
    ours = perilune.simulate(fmus["dynamic"], input=series, step=0.1, stop_time=STOP)
    assert np.array_equal(ours.time, theirs["time"])
    np.testing.assert_allclose(ours["Dynamic.x"], theirs["x"], rtol=1e-13)


def test_without_inputs_and_with_values(fmus):
    theirs = fmpy_flight(fmus["dynamic"], None, ["x"], start_values={"damping": 0.9, "force": 2.0})
    ours = perilune.simulate(
        fmus["dynamic"], set={"Dynamic.damping": 0.9, "Dynamic.force": 2.0}, step=STEP, stop_time=STOP
    )
    assert np.array_equal(ours["Dynamic.x"], theirs["x"])
    assert "input" not in ours.provenance


@pytest.mark.parametrize(
    ("experiment", "expected"),
    [
        ("", (0.0, 1.0, 0.002)),
        ('startTime="1" stopTime="3" stepSize="0.25"', (1.0, 3.0, 0.25)),
        ('startTime="2"', (2.0, 3.0, 0.002)),
        ('stopTime="1" stepSize="0.3"', (0.0, 0.9, 0.3)),
    ],
)
def test_the_fmu_proposes_times(tmp_path, experiment, expected):
    path = build_lone_fmu("Dynamic", tmp_path, experiment)
    start, stop, step = expected
    result = perilune.simulate(path)
    assert (result.time[0], result.time[1] - start) == (start, pytest.approx(step))
    assert result.time[-1] == pytest.approx(stop)
    assert perilune.describe(path)["alone"] == {
        "component": "Dynamic", "start_time": start, "stop_time": pytest.approx(stop), "step": step
    }  # fmt: skip
    theirs = fmpy.simulate_fmu(str(path), output=["x"])
    assert result.time[0] == theirs["time"][0]
    if not experiment.startswith("stopTime"):
        assert result.time[-1] == pytest.approx(theirs["time"][-1])
        np.testing.assert_allclose(result["Dynamic.x"], theirs["x"], rtol=1e-12)


def test_inputs_from_a_file_that_fmpy_wrote(fmus, tmp_path):
    series = SERIES["follower"]["all"]
    path = tmp_path / "inputs.csv"
    fmpy.write_csv(path, series)
    assert ",True" in path.read_text()
    written = perilune.simulate(fmus["follower"], input=path, step=STEP, stop_time=STOP)
    settings = perilune.simulate(fmus["follower"], input=series, step=STEP, stop_time=STOP)
    columns = {f"Follower.{name}" if name != "time" else name: series[name] for name in series.dtype.names}
    named = perilune.simulate(fmus["follower"], input=columns, step=STEP, stop_time=STOP)
    for name, values in settings.signals.items():
        assert np.array_equal(written[name], values)
        assert np.array_equal(named[name], values)
    assert written.provenance["input"]["signals"] == [f"Follower.{name}" for name in ("u", "d", "n", "b")]
