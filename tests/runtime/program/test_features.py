"""Features of systems in the interpreted loop. Truth: rows and status of the reference loop, to the bit."""

import pytest

from perilune.analysis.options.fault import parse_fault
from perilune.analysis.runtime.ssp.conversions import Transformation
from perilune.analysis.runtime.system.network import NodeLink
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from tests.support.builders import component, connection, document, pack, system
from tests.support.flights.reference import assert_same, prepared_for
from tests.support.fmi3.strict_fmu import TROUBLES, strict_fmu
from tests.support.fmi3.strict_pair import pack_strict_pair
from tests.support.foreign.odd_fmu import odd_fmu

RAMP = component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
CROSS = "input a Real m; input b Real m; output ya Real m; output yb Real m"
CHANGES = {"time": [0.0, 0.125, 0.3, 0.5, 0.75, 1.0], "d": [0.0, 0.0, 3.0, 3.0, 0.0, 5.0]}

both = pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])


@pytest.fixture
def packed(tiny, tmp_path):
    """Return a writer of an .ssp of components of the tiny FMUs."""

    def make(*elements, wires, declared="", stop=2.0):
        lines = "".join(connection(*wire) for wire in wires)
        return pack(tmp_path / "s.ssp", tiny, document(system(*elements, connections=lines, declared=declared), stop))

    return make


@both
def test_system_connectors_and_an_end(packed, algorithm):
    """A root input over time in another unit, root outputs, one of them `finished`."""
    path = packed(
        RAMP,
        GAIN,
        wires=[("u", "gain.u"), ("gain.y", "out"), ("ramp.flag", "finished")],
        declared="input u Real km; output out Real km; output finished Boolean",
    )
    options = SystemOptions(algorithm=algorithm, set={"ramp.flag_at": 5})
    series = read_series({"time": [0.0, 1.0, 1.0, 2.0], "u": [0.1, 0.7, -1.0, 3.0]})
    faults = [parse_fault("gain.u=bias:0.1@0.3..0.8"), parse_fault("gain.y=freeze@1")]
    assert assert_same(prepare_system(path, options, series=series), faults) == "finished"


@both
def test_connections_of_several_terms(packed, algorithm):
    path = packed(
        RAMP, GAIN, component("delay", "delay", "input u Real m; output y Real m"),
        wires=[("ramp.y", "gain.u"), ("gain.y", "delay.u")],
    )  # fmt: skip
    prepared = prepare_system(path, SystemOptions(algorithm=algorithm))
    link = prepared.network.driver["gain.u"]
    link.added += [
        NodeLink(prepared.network.nodes["delay.y"], link.target, Transformation(0.1, 0.7), 0),
        NodeLink(link.source, link.target, Transformation(-3.3, 0.0), 0),
    ]
    assert assert_same(prepared, [parse_fault("gain.u=freeze@0.5..1")]) == "stop_time"


@both
def test_a_connection_read_a_step_late(packed, algorithm):
    left, right = (component(name, "cross", CROSS) for name in ("left", "right"))
    path = packed(
        RAMP, right, left,
        wires=[("ramp.y", "left.a"), ("left.ya", "right.a"), ("right.ya", "left.b"), ("left.yb", "right.b")],
    )  # fmt: skip
    prepared = prepare_system(path, SystemOptions(algorithm=algorithm))
    assert bool(prepared.schedule.late)
    assert assert_same(prepared, [parse_fault("left.b=bias:1@0")]) == "stop_time"


@both
def test_an_fmu_of_fmi_2_ends_the_flight(tiny_folder, tmp_path, algorithm):
    odd_fmu(tmp_path, ENDS_AT=0.6)
    (tmp_path / "gain.fmu").write_bytes((tiny_folder / "native" / "gain.fmu").read_bytes())
    root = system(component("odd", "odd", "output y Real"), GAIN, connections=connection("odd.y", "gain.u"))
    prepared = prepared_for(pack(tmp_path / "s.ssp", tmp_path, document(root)), algorithm=algorithm)
    assert assert_same(prepared, [parse_fault("gain.u=bias:1@0.6")]) == "terminated"


@both
@pytest.mark.parametrize("events", [False, True])
def test_all_types_of_fmi_3(tmp_path, events, algorithm):
    """Whole numbers of 64 bits, and texts: the receiver counts what is not exact."""
    prepared = prepared_for(pack_strict_pair(tmp_path, events=events), algorithm=algorithm)
    faults = [parse_fault("sink.small_in=override:3@0.5..1"), parse_fault("source.single[1]=bias:0.1@0.5")]
    assert assert_same(prepared) == assert_same(prepared, faults) == "stop_time"


@pytest.mark.parametrize("given", [{"early": 0.1}, {"early": 0.07, "rounds": 2}, {"end_at": 0.6}, {"rounds": 5}])
def test_event_mode_and_early_returns(tmp_path, given):
    path = str(strict_fmu(tmp_path, events=True))
    options = SystemOptions(set={f"Strict.{name}": number for name, number in given.items()})
    prepared = prepare_system(path, options, series=read_series(CHANGES))
    assert assert_same(prepared) == ("terminated" if "end_at" in given else "stop_time")


@pytest.mark.parametrize("trouble", TROUBLES)
def test_failures_of_fmi_3(tmp_path, trouble):
    path = str(strict_fmu(tmp_path, events=True))
    options = SystemOptions(set={"Strict.trouble": trouble})
    prepared = prepare_system(path, options, series=read_series(CHANGES))
    assert assert_same(prepared) == ("stop_time" if trouble in ("fine", "talks") else "failed")
