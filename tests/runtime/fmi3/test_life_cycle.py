"""Event mode, early returns, terminations and failures, with an FMU that rejects calls that FMI 3.0 does not allow."""

import fmpy
import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.instances.trial import begin, read, step
from perilune.analysis.runtime.system.fmu import load_fmu
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_fmu import strict_fmu

STEPS = {0: 0, 0.125: 0, 0.3: 3, 0.5: 3}


def series(folder):
    """Write column d of a file: 0, then 3 from 0.3 s on, then 3 still."""
    path = folder / "d.csv"
    path.write_text("\n".join(["time,d", *(f"{time},{value}" for time, value in STEPS.items())]))
    return str(path)


def test_discrete_input_is_given_in_event_mode_when_it_changes(tmp_path):
    path = str(strict_fmu(tmp_path, events=True))
    flight = perilune.simulate(path, input=series(tmp_path), set={"Strict.rounds": 5})
    assert flight.status == "stop_time"
    # it changes at the communication point of 0.5 s, of which the step to 0.75 s knows
    assert flight.signals["Strict.events"].tolist() == [0, 0, 0, 1, 1]
    assert flight.signals["Strict.accepted"].tolist() == [0, 0, 0, 3, 3]


def test_without_a_discrete_input_in_flight_there_is_no_event_mode(tmp_path):
    """The FMU handles events within its steps then; a continuous input needs no event."""
    flight = perilune.simulate(str(strict_fmu(tmp_path, events=True)), set={"Strict.early": 0.1, "Strict.d": 3})
    assert flight.status == "stop_time"
    assert not flight.signals["Strict.events"].any()
    assert not flight.signals["Strict.returns"].any()


def test_early_returns_are_continued_to_the_communication_point(tmp_path):
    """Each step of 0.25 s is cut at 0.1 and 0.2 s, each cut an event; y' = gain u continues across them."""
    path = str(strict_fmu(tmp_path, events=True))
    flight = perilune.simulate(path, input=series(tmp_path), set={"Strict.early": 0.1})
    assert flight.status == "stop_time"
    assert flight.signals["Strict.returns"].tolist() == [0, 2, 4, 6, 8]
    assert flight.signals["Strict.events"].tolist() == [0, 2, 4, 7, 9]
    assert np.allclose(flight.signals["Strict.y[1]"], 0.5 * flight.time, rtol=1e-14)


def test_events_are_those_of_fmpy(tmp_path):
    """FMPy takes a sample at each early return, too: at the communication points both have the same bits."""
    path = str(strict_fmu(tmp_path, events=True, is_lenient=True))
    settings = {"early": 0.07, "gain": [0.3, 0.7], "rounds": 2}
    changes = np.array([(0.0, 0), (0.5, 0), (0.5, 3), (1.0, 3)], dtype=[("time", np.float64), ("d", np.int32)])
    expected = fmpy.simulate_fmu(
        path,
        start_values=settings,
        input=changes,
        output_interval=0.25,
        use_event_mode=True,
        early_return_allowed=True,
    )
    (tmp_path / "changes.csv").write_text("time,d\n0,0\n0.5,0\n0.5,3\n1,3")
    values = {f"Strict.{name}": number for name, number in settings.items()}
    flight = perilune.simulate(path, set=values, input=str(tmp_path / "changes.csv"))
    last = [int(np.flatnonzero(expected["time"] == time)[-1]) for time in flight.time]
    for element in (0, 1):
        assert np.array_equal(flight.signals[f"Strict.y[{element + 1}]"], expected["y"][last, element])
    for name in ("events", "returns", "accepted"):
        assert flight.signals[f"Strict.{name}"][-1] == expected[name][-1], name


def test_an_fmu_ends_the_simulation(tmp_path):
    flight = perilune.simulate(str(strict_fmu(tmp_path)), set={"Strict.end_at": 0.6})
    assert (flight.status, flight.message) == ("terminated", "Strict asked for termination at t = 0.6 s")
    assert flight.time.tolist() == [0.0, 0.25, 0.5, 0.6]
    assert np.allclose(flight.signals["Strict.y[1]"], 0.5 * flight.time, rtol=1e-14)


def test_an_fmu_ends_the_simulation_in_event_mode(tmp_path):
    path = tmp_path / "ends.csv"
    path.write_text("time,d\n0,0\n0.5,0\n0.5,-1\n1,-1")
    flight = perilune.simulate(str(strict_fmu(tmp_path, events=True)), input=str(path))
    assert flight.status == "terminated"
    assert flight.time[-1] == 0.5


@pytest.mark.parametrize(
    ("trouble", "message"),
    [
        ("fails", "fmi3DoStep returned error at t = 0.25 s: as asked for"),
        ("discards", "fmi3DoStep returned discard at t = 0.25 s: as asked for"),
        ("dies", "fmi3DoStep returned fatal at t = 0.25 s: as asked for"),
        ("stands_still", "fmi3DoStep does not advance at t = 0.25 s: no message in its log"),
        ("never_settles", "fmi3UpdateDiscreteStates does not settle in event mode at t = 0 s: no message in its log"),
    ],
)
def test_failures_are_named(tmp_path, trouble, message):
    path = str(strict_fmu(tmp_path, events=True))
    flight = perilune.simulate(path, input=series(tmp_path), set={"Strict.trouble": trouble})
    assert (flight.status, flight.message) == ("failed", f"Strict: {message}")


@pytest.mark.parametrize(
    ("trouble", "last"), [("no_time", "nan"), ("no_end", "inf"), ("goes_back", "-0.125"), ("goes_beyond", "0.375")]
)
def test_an_early_return_at_a_time_outside_its_step_ends_the_simulation(tmp_path, trouble, last):
    path = str(strict_fmu(tmp_path, events=True))
    flight = perilune.simulate(path, input=series(tmp_path), set={"Strict.trouble": trouble})
    outside = f"lastSuccessfulTime {last} s, which is not in its step from 0 s to 0.25 s"
    message = f"Strict: fmi3DoStep returned early with {outside}: no message in its log"
    assert (flight.status, flight.message) == ("failed", message)
    assert flight.time.tolist() == [0.0]


def test_messages_are_no_formats(tmp_path, capfd):
    path = str(strict_fmu(tmp_path))
    assert perilune.simulate(path, set={"Strict.trouble": "talks"}, log="warning").status == "stop_time"
    assert "Strict: warning (logEvents): 100% of a %s" in capfd.readouterr().err


def test_an_array_that_cannot_be_read_back_is_reported_once(tmp_path):
    path = str(strict_fmu(tmp_path, hides_gain=True))
    settings = {"Strict.gain": [4.0, 5.0], "Strict.rounds": 3}
    with pytest.warns(
        UserWarning,
        match=r"strict\.fmu: gain cannot be read back, so it is not known whether "
        r"Strict accepts",
    ) as actual:
        flight = perilune.simulate(path, set=settings, in_process=True)
    assert len(actual) == 1
    assert flight["Strict.y"][-1].tolist() == [2.0, 1.25]


def test_a_number_that_an_fmu_changes_is_reported(tmp_path):
    path = str(strict_fmu(tmp_path, clamps_rounds=True))
    flight = perilune.simulate(path, set={"Strict.rounds": 3})
    assert flight.status == "failed"
    assert (
        "Strict.rounds: was set to 3, but has the value 2 in its FMU after initialisation: "
        "the FMU did not accept the value" in flight.message
    )


def test_tolerance_reaches_the_fmu(tmp_path):
    assert perilune.simulate(str(strict_fmu(tmp_path))).signals["Strict.tolerance"][0] == -1.0
    path = str(strict_fmu(tmp_path, tolerance=1e-7, name="tolerant"))
    assert perilune.simulate(path).signals["Strict.tolerance"][0] == 1e-7


def test_binary_beyond_its_room_ends_the_flight(strict_pair):
    flight = perilune.simulate(strict_pair(blob_size=65537))
    assert flight.status == "failed"
    assert flight.message == "source.blob gave a binary value of more than 65536 bytes at t = 0 s"


def test_state_of_one_instance_in_another():
    """Saved after 1 s, carried as bytes: the other continues with the same bits, and so does the first, set back."""
    path = reference_fmu(3, "VanDerPol")
    fmu = load_fmu(path.read_bytes(), str(path))
    first, second = instantiate(fmu, "first"), instantiate(fmu, "second")
    for instance in (first, second):
        begin(instance, {}, 0.0, None)
    for n in range(10):
        step(first, 0.1 * n, 0.1)
    state, at_first = first.state(), read(first, "output")
    serialized = first.serialize(state)
    step(first, 1.0, 0.1)
    later = read(first, "output")
    carried = second.deserialize(serialized)
    second.set_state(carried)
    first.set_state(state)
    for instance in (first, second):
        assert read(instance, "output") == at_first
        step(instance, 1.0, 0.1)
        assert read(instance, "output") == later != at_first
    first.free_state(state)
    second.free_state(carried)
    for instance in (first, second):
        instance.free()


PLAN = """
system = "strict"
trials = 8
seed = 1
[draw."Strict.trouble"]
distribution = "choice"
values = [0, 1]
[draw."Strict.u[1]"]
distribution = "uniform"
low = 1.0
high = 2.0
[metric.last]
expression = "Strict.y[1]"
reduction = "final"
[success]
expression = "last > 0"
"""


@pytest.mark.parametrize("events", [False, True])
def test_trials_after_failures_are_those_of_fresh_instances(tmp_path, events):
    """Reset, or instantiated again after an error: y is the drawn u after 1 s with gain 1."""
    path, plan = str(strict_fmu(tmp_path, events=events)), tmp_path / "plan.toml"
    plan.write_text(PLAN)
    trials = perilune.batch(path, plan, workers=1).trials["default"]
    flown = np.array(trials.statuses) == "stop_time"
    assert set(trials.statuses) == {"stop_time", "failed"}
    assert np.array_equal(trials.metrics["last"][flown], trials.draws["Strict.u[1]"][flown])
    assert "fmi3DoStep returned error" in next(iter(trials.messages.values()))
