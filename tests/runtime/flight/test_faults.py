"""Faults on connectors, with each row computed by hand.

Truth: the definition. In [start, stop) an output or input has another value (override), its own value plus a bias, or
its value at the start of the freeze. A fault on an output affects every reader, a fault on an input only that
component. A triple follows a ramp 1, 1.5, 2, 2.5, 3.
"""

import math

import numpy as np
import pytest

from perilune.analysis.options.fault import Fault
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, fly, pack, system

RAMP = component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
TWIN = component("twin", "gain", "input u Real m; output y Real m")
DELAY = component("delay", "delay", "input u Real m; output y Real m")
WHOLE = component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean")
WIRES = "".join(connection("ramp.y", f"{name}.u") for name in ("gain", "twin", "delay"))
WIRES += connection("ramp.flag", "whole.b") + connection("ramp.count", "whole.n")
TRUE = [1.0, 1.5, 2.0, 2.5, 3.0]


@pytest.fixture
def flown(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, TWIN, DELAY, WHOLE, connections=WIRES)))

    def run(*faults, **options):
        result = fly(path, faults=faults, **options)
        return {name: column.tolist() for name, column in result.signals.items()}

    return run


# kind, value, and what a reader makes of the ramp from t = 0.25 s to 0.75 s
KINDS = [("override", 9.0, [9.0, 9.0]), ("bias", 0.5, [2.0, 2.5]), ("freeze", 0.0, [1.5, 1.5])]


@pytest.mark.parametrize(("kind", "value", "inside"), KINDS)
def test_on_an_output_every_reader_sees_it(flown, kind, value, inside):
    actual = flown(Fault("ramp.y", kind, value, 0.25, 0.75))
    observed = [1.0, *inside, 2.5, 3.0]
    assert actual["ramp.y"] == actual["gain.u"] == actual["twin.u"] == actual["delay.u"] == observed
    assert actual["gain.y"] == [3 * y for y in observed]
    assert actual["delay.y"] == [5.0, *observed[:-1]]


@pytest.mark.parametrize(("kind", "value", "inside"), KINDS)
def test_on_an_input_only_that_component_sees_it(flown, kind, value, inside):
    actual = flown(Fault("gain.u", kind, value, 0.25, 0.75))
    observed = [1.0, *inside, 2.5, 3.0]
    assert actual["gain.u"] == observed
    assert actual["gain.y"] == [3 * y for y in observed]
    assert actual["ramp.y"] == actual["twin.u"] == actual["delay.u"] == TRUE


@pytest.mark.parametrize(("kind", "value", "inside"), KINDS)
def test_on_the_input_of_a_source(flown, kind, value, inside):
    actual = flown(Fault("delay.u", kind, value, 0.25, 0.75))
    observed = [1.0, *inside, 2.5, 3.0]
    assert actual["delay.u"] == observed
    assert actual["delay.y"] == [5.0, *observed[:-1]]
    assert actual["gain.u"] == TRUE


def test_from_the_start_and_without_end(flown):
    assert flown(Fault("ramp.y", "override", 4.0))["gain.y"] == [12.0] * 5
    assert flown(Fault("ramp.y", "freeze"))["gain.y"] == [3.0] * 5
    assert flown(Fault("ramp.y", "bias", 1.0, start=0.5))["gain.u"] == [1.0, 1.5, 3.0, 3.5, 4.0]


def test_on_whole_numbers(flown):
    actual = flown(Fault("ramp.count", "bias", 100.0, 0.5), Fault("whole.b", "override", 1.0, 0.25, 0.5))
    assert actual["whole.m"] == [0, 1, 102, 103, 104]
    assert actual["whole.c"] == [0, 1, 0, 0, 0]
    assert actual["ramp.flag"] == [0] * 5


def test_two_faults_on_one_connector_apply_in_turn(flown):
    actual = flown(Fault("ramp.y", "bias", 1.0, 0.25), Fault("ramp.y", "freeze", start=0.5))
    assert actual["gain.u"] == [1.0, 2.5, 3.0, 3.0, 3.0]


def test_under_jacobi(flown):
    actual = flown(Fault("ramp.y", "override", 9.0, 0.25, 0.75), algorithm="jacobi")
    assert actual["gain.u"] == [1.0, 9.0, 9.0, 2.5, 3.0]
    assert actual["gain.y"] == [3.0, 3.0, 27.0, 27.0, 7.5]


def rounded_times(step):
    """Return steps whose n h is below, at and above the decimal number it stands for."""
    kinds = {}
    for n in range(1, 60):
        kinds.setdefault(np.sign(n * step - float(f"{n * step:.6g}")), n)
    return kinds.values()


@pytest.mark.parametrize("step", [0.1, 0.7, 0.3])
def test_windows_are_kept_whatever_the_rounding_of_time(flown, step):
    for first in rounded_times(step):
        start, stop = (float(f"{n * step:.6g}") for n in (first, first + 2))
        actual = flown(Fault("ramp.y", "override", -1.0, start, stop), step=step, stop_time=60 * step)
        assert [n for n, y in enumerate(actual["gain.u"]) if y == -1.0] == [first, first + 1]


def test_a_fault_ends_with_the_flight_it_was_made_for(flown):
    before = flown()
    flown(Fault("ramp.y", "freeze"))
    assert flown() == before


def test_other_faults_from_flight_to_flight(tiny, tmp_path):
    """One simulation, reset and reused: the values, windows and absences of its last `set_faults`, and no others."""
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, TWIN, DELAY, WHOLE, connections=WIRES)))
    bias, hold = Fault("gain.u", "bias", 1.0, 0.25), Fault("ramp.y", "freeze", start=0.5)
    flights = [
        ((bias, hold), [1.0, 2.5, 3.0, 3.0, 3.0]),
        ((None, None), TRUE),
        ((Fault("gain.u", "bias", -1.0, 0.75, 1.0), None), [1.0, 1.5, 2.0, 1.5, 3.0]),
        ((None, Fault("ramp.y", "freeze", start=0.25, stop=0.75)), [1.0, 1.5, 1.5, 2.5, 3.0]),
        ((bias, hold), [1.0, 2.5, 3.0, 3.0, 3.0]),
    ]
    with Simulation(prepare_system(path), faults=(bias, hold)) as simulation:
        for faults, observed in flights:
            simulation.set_faults(faults)
            result = simulation.fly()
            assert result["gain.u"].tolist() == observed
            assert result.provenance["faults"] == [str(fault) for fault in faults if fault is not None]


def test_faults_outlive_a_fatal_error(tmp_path, tiny_folder):
    """After one, FMI allows no instance to be used again: new ones fly with the faults that were set."""
    fail = component("trouble", "trouble", "output y Real m")
    gain = component("gain", "gain", "input u Real m; output y Real m")
    wires = connection("trouble.y", "gain.u")
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", document(system(fail, gain, connections=wires)))
    prepared = prepare_system(path)
    with Simulation(prepared, faults=[Fault("gain.u", "override", 1.0)]) as simulation:
        simulation.set_faults([Fault("gain.u", "override", 7.0, 0.5)])
        simulation._replace_instances()  # as `_advance` does
        assert simulation.fly()["gain.u"].tolist() == [1.0, 2.0, 7.0, 7.0, 7.0]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"name": "ramp.z", "kind": "bias"}, "ramp.z: no component has such a connector"),
        ({"name": "ramp.y", "kind": "melt"}, "unknown kind melt; use one of override, bias, freeze"),
        ({"name": "ramp.y", "kind": "bias", "start": 2.0, "stop": 1.0}, "empty window"),
        ({"name": "ramp.y", "kind": "bias", "value": math.nan}, "not finite"),
        ({"name": "ramp.y", "kind": "bias", "start": math.nan}, "empty window"),
        ({"name": "ramp.y", "kind": "freeze", "value": 1.0}, "ramp.y: a freeze has no value; omit the value"),
        ({"name": "ramp.flag", "kind": "bias", "value": 1.0}, "ramp.flag: a Boolean has no bias"),
    ],
)
def test_refused(flown, arguments, words):
    with pytest.raises(InputError, match=words):
        flown(Fault(**arguments))
