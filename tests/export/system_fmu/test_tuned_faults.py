"""Faults of tunable parameters as inputs of a system as one FMU.

Truth: the same faults in the system simulated from its FMUs, bit by bit; the ramp, y(k + 1) = y(k) + slope h, by hand.
"""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

import perilune
from perilune.analysis.options.fault import Fault
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, fly, inline, pack, system
from tests.support.native.system_fmus import Slave, build_one
from tests.support.native.toolbox import find_semantic_errors

STEP, STOP = 0.25, 2.0  # s
KINDS = {"override": 1, "bias": 2, "freeze": 3}
RAMP = component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
SIGNALS = ("ramp.y", "ramp.flag", "gain.y")
FAULTS = (
    Fault("ramp.slope", "override", 5.0, 0.5, 1.25),
    Fault("ramp.flag_at", "override", 2, 0.0, 1.0),
    Fault("ramp.inverted", "override", True, 1.5),
    Fault("gain.factor", "bias", 4.0, 0.75, 1.5),
)


@pytest.fixture
def path(tiny_folder: Path, tmp_path: Path) -> Path:
    """Return the system of a ramp, and a gain that follows it."""
    text = document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u")), stop=STOP, step=STEP)
    return pack(tmp_path / "s.ssp", tiny_folder / "native", text)


def set_faults(faults: tuple[Fault, ...], time: float) -> dict[str, float]:
    """Return the inputs of an FMU for what is exchanged at a time (s)."""
    inputs: dict[str, float] = {}
    for fault in faults:
        active = fault.start - 1e-9 <= time < fault.stop - 1e-9
        inputs[f"fault.{fault.name}.kind"] = KINDS[fault.kind] * active
        inputs[f"fault.{fault.name}.value"] = float(fault.value)
    return inputs


def fly_with_faults(slave: Slave, faults: tuple[Fault, ...], steps: int) -> dict[str, list[float]]:
    """Return the signals of an FMU that has begun, with the inputs of each step's end."""
    rows = [[slave.get(name) for name in SIGNALS]]
    for _ in range(steps):
        slave.set(set_faults(faults, slave.time + STEP))
        slave.step(STEP)
        rows.append([slave.get(name) for name in SIGNALS])
    return {name: list(column) for name, column in zip(SIGNALS, zip(*rows, strict=True), strict=True)}


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_the_bits_of_the_system(path: Path, tmp_path: Path, algorithm: str) -> None:
    """Components before and after others; a freeze keeps values that a fault before it does not reach."""
    names = [fault.name for fault in FAULTS]
    fmu = build_one(tmp_path / "one.fmu", path, exposed=SIGNALS, faulty=names, algorithm=algorithm)
    assert validate_fmu(str(fmu)) == []
    assert find_semantic_errors(fmu) == []
    for number, faults in enumerate((FAULTS, (Fault("ramp.slope", "freeze", start=0.5), FAULTS[3]))):
        native = fly(path, faults, algorithm=algorithm)
        slave = Slave(fmu, tmp_path / f"one_{number}", **set_faults(faults, 0.0))
        flown = fly_with_faults(slave, faults, len(native.time) - 1)
        assert flown == {name: native[name].tolist() for name in SIGNALS}


def test_a_parameter_that_is_set_between_steps_is_what_the_fault_is_of(path: Path, tmp_path: Path) -> None:
    """Closed form: slopes 2, 3, 3 + 0.5, 1 + 0.5 and 1 m/s."""
    slave = Slave(build_one(tmp_path / "one.fmu", path, exposed=SIGNALS, faulty=["ramp.slope"]), tmp_path / "one")
    heights = [slave.get("ramp.y")]
    for slope, kind in ((2.0, 0), (3.0, 2), (3.0, 2), (1.0, 0), (1.0, 0)):  # the fault is of the step that follows
        slave.set({"ramp.slope": slope, "fault.ramp.slope.kind": kind, "fault.ramp.slope.value": 0.5})
        slave.step(STEP)
        heights.append(slave.get("ramp.y"))
    assert [b - a for a, b in pairwise(heights)] == [0.5, 0.75, 0.875, 0.375, 0.25]


def test_a_parameter_of_the_system_is_what_the_fault_is_of(tiny_folder: Path, tmp_path: Path) -> None:
    """In the unit of the component; bounds are those of the component. Closed form: y = 3 (k + 1) m."""
    ssd = document(
        system(
            component("gain", "gain", "parameter factor Real; input u Real m; output y Real m"),
            connections=connection("k", "gain.factor") + connection("u", "gain.u") + connection("gain.y", "y"),
            declared="parameter k Real; input u Real m; output y Real m",
            bindings=inline("k=Real:2"),
        ),
        stop=STOP,
        step=STEP,
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    slave = Slave(build_one(tmp_path / "one.fmu", path, faulty=["gain.factor"]), tmp_path / "one", u=3.0, k=4.0)
    named = {each.variable.name: {known.name for known in each.dependencies} for each in slave.description.outputs}
    assert named == {"y": {"u", "fault.gain.factor.kind", "fault.gain.factor.value"}}
    assert slave.get("y") == 12.0
    slave.set({"fault.gain.factor.kind": 2, "fault.gain.factor.value": 1.0})
    slave.step(STEP)
    assert slave.get("y") == 15.0
    slave.set({"k": 10.0})
    slave.step(STEP)
    assert slave.get("y") == 33.0
    with pytest.raises(FMICallException):
        slave.set({"k": 101.0})
    assert slave.messages[-1].startswith("fmi2SetReal: gain.factor = 101.0 is above its maximum 100.0")


def test_saved_states_have_the_parameter_and_its_fault(path: Path, tmp_path: Path) -> None:
    """A flight continued from serialised bytes, in another instance, is the flight."""
    faults = (Fault("ramp.slope", "freeze", start=0.5), FAULTS[3])
    fmu = build_one(tmp_path / "one.fmu", path, exposed=SIGNALS, faulty=[fault.name for fault in faults])
    first, second = (Slave(fmu, tmp_path / name, **set_faults(faults, 0.0)) for name in ("a", "b"))
    fly_with_faults(first, faults, 3)
    first.set({"ramp.slope": 7.0})
    saved = first.fmu.serializeFMUstate(first.fmu.getFMUstate())
    second.fmu.setFMUstate(second.fmu.deSerializeFMUstate(saved))
    second.time = first.time
    assert fly_with_faults(second, faults, 4) == fly_with_faults(first, faults, 4)


def test_bounds_and_fixed_parameters(path: Path, tmp_path: Path) -> None:
    """The FMU refuses what it would refuse as a parameter; the export what is fixed."""
    fmu = build_one(tmp_path / "one.fmu", path, exposed=SIGNALS, faulty=["gain.factor"])
    above, below = "above its maximum 100.0", "below its minimum -100.0"
    for number, (kind, amount, side) in enumerate([(1, 101.0, above), (2, 98.0, above), (2, -104.0, below)]):
        slave = Slave(fmu, tmp_path / str(number))
        slave.set({"fault.gain.factor.kind": kind, "fault.gain.factor.value": amount})
        with pytest.raises(FMICallException):
            slave.step(STEP)
        assert slave.messages[0].startswith(f"gain.factor: TuningError: its value is {side}")
    slave = Slave(fmu, tmp_path / "start")
    with pytest.raises(FMICallException):
        slave.set({"gain.factor": 200.0})
    problem = "faults: ramp.start: a parameter that is fixed after initialisation; set it before the start"
    with pytest.raises(InputError, match=re.escape(problem)):
        build_one(tmp_path / "no.fmu", path, faulty=["ramp.start"])


def test_of_a_slot_the_candidate_that_flies_has_it(tiny_folder: Path, path: Path, tmp_path: Path) -> None:
    """Also one that does not fly is not compared with its bounds."""
    gain = tiny_folder / "native" / "gain.fmu"
    other = tmp_path / "other.fmu"
    other.write_bytes(gain.read_bytes())
    fmu = build_one(tmp_path / "one.fmu", path, {"gain": [str(gain), str(other)]}, SIGNALS, ["gain.factor"])
    values = {"gain.use": 2, "gain.gain.factor": 1000.0, "gain.other.factor": 8.0}
    slave = Slave(fmu, tmp_path / "two", **values, **set_faults((FAULTS[3],), 0.0))
    flown = fly_with_faults(slave, (FAULTS[3],), 8)
    native = fly(path, [FAULTS[3]], set={"gain.factor": 8.0})
    assert flown == {name: native[name].tolist() for name in SIGNALS}
    with pytest.raises(FMICallException):
        Slave(fmu, tmp_path / "one", **{"gain.use": 1, "gain.gain.factor": 1000.0})


@pytest.mark.usefixtures("fmus")
def test_a_shipped_system(tmp_path: Path) -> None:
    """Gravity that is another for a while: the bits of `perilune run --fault`."""
    fault = Fault("plant.gravity", "bias", 0.05, 20.0, 60.0)
    native = perilune.simulate("lunar_terminal_guidance", faults=[fault], flavour="native", stop_time=100.0)
    exposed = ["plant.position[1]", "plant.position[3]", "guidance.time_to_go"]
    fmu = build_one(
        tmp_path / "one.fmu", "lunar_terminal_guidance", exposed=exposed, faulty=[fault.name], stop_time=100.0
    )
    slave = Slave(fmu, tmp_path / "one", **set_faults((fault,), 0.0))
    step = float(native.time[1] - native.time[0])
    rows = [[slave.get(name) for name in exposed]]
    for end in native.time[1:]:
        slave.set(set_faults((fault,), float(end)))
        slave.step(step)
        rows.append([slave.get(name) for name in exposed])
    for column, name in enumerate(exposed):
        assert [row[column] for row in rows] == native[name].tolist()
