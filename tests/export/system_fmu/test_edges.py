"""Systems of few blocks at the limits of export as one FMU.

Truth: closed forms, and the same systems simulated from their FMUs.
"""

import re
import subprocess

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Terminated
from fmpy.validation import validate_fmu

import perilune
from perilune.analysis.options.fault import Fault
from perilune.common.errors import InputError
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import UNITS, component, connection, document, fly, inline, pack, system
from tests.support.native.system_fmus import Slave, build_one, fly_one

RAMP, GAIN = "output y Real m", "input u Real m; output y Real m"
STEP = 0.25  # s
PHASE = (
    '<ssd:Enumerations><ssc:Enumeration name="Phase"><ssc:Item name="go" value="2"/><ssc:Item name="stay" value="1"/>'
    "</ssc:Enumeration></ssd:Enumerations>"
)


@pytest.fixture
def make(tiny_folder, tmp_path):
    """Return a function from a root system to the system's file."""

    def make(*elements, **more):
        times = {key: more.pop(key) for key in ("stop", "step", "more", "units") if key in more}
        ssd = document(system(*elements, **more), **times)
        return pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)

    return make


def test_connectors_called_block(make, tmp_path):
    path = make(
        component("block", "gain", GAIN),
        component("ramp", "ramp", f"parameter start Real m; {RAMP}"),
        connections=connection("block_input", "block.u")
        + connection("block.y", "y")
        + connection("block_start", "ramp.start")
        + connection("ramp.y", "z"),
        declared="input block_input Real m; parameter block_start Real m; output y Real m; output z Real m",
        bindings=inline("block_start=Real:3 m"),
    )
    slave = Slave(build_one(tmp_path / "one.fmu", path, set={"block_input": 5.0}), tmp_path / "one")
    assert (slave.get("y"), slave.get("z")) == (15.0, 3.0)


def test_a_parameter_that_becomes_a_signal_of_a_system_inside(make, tmp_path):
    """Closed form: k in m is 1000 of it in km, and back; the gain's y is 3 k."""
    inner = system(
        component("g", "gain", GAIN),
        connections=connection("k", "g.u") + connection("g.y", "y"),
        declared="parameter k Real km; output y Real m",
        name="inner",
    )
    path = make(
        inner,
        connections=connection("k", "inner.k") + connection("inner.y", "y"),
        declared="parameter k Real m; output y Real m",
        bindings=inline("k=Real:3.5 m"),
    )
    fmu = build_one(tmp_path / "one.fmu", path)
    for k in (3.5, 10.0):
        assert fly_one(fmu, {"k": k})["y"][0] == perilune.simulate(path, set={"k": k})["y"][0]


def test_a_fault_on_an_input_that_an_input_of_the_system_feeds(make, tmp_path):
    """It holds for what is exchanged at the end of the step that it is set for, as in a window that begins there."""
    path = make(
        component("d", "delay", GAIN),
        connections=connection("u", "d.u") + connection("d.y", "y"),
        declared="input u Real m; output y Real m",
    )
    for kind, number in (("override", 1), ("bias", 2), ("freeze", 3)):
        fault = Fault("d.u", kind, 0.0 if kind == "freeze" else 10.0, 0.5, 0.75)
        native = fly(path, [fault], set={"u": 2.0})
        slave = Slave(build_one(tmp_path / f"{kind}.fmu", path, faulty=["d.u"]), tmp_path / kind, u=2.0)
        rows = [slave.get("y")]
        while len(rows) < len(native.time):
            active = slave.time + STEP == 0.5
            slave.set({"fault.d.u.kind": number * active, "fault.d.u.value": 10.0})
            slave.step(STEP)
            rows.append(slave.get("y"))
        assert rows == native["y"].tolist(), kind


def test_wrong_faults(make, tmp_path):
    path = make(
        component("r", "ramp", "output count Integer; output flag Boolean"),
        connections=connection("r.count", "n") + connection("r.flag", "b"),
        declared="output n Integer; output b Boolean",
    )
    fmu = build_one(tmp_path / "one.fmu", path, faulty=["r.count", "r.flag"])
    wrong = {
        ("r.count", 7, 0.0): "there is no such kind of fault; give 0 to 3",
        ("r.count", 1, 2.7): "the value is no whole number",
        ("r.count", 1, 3e9): "the value does not fit into 32 bits",
        ("r.count", 2, np.inf): "the value is not finite",
        ("r.flag", 1, np.nan): "the value is not finite",
        ("r.flag", 2, 1.0): "a Boolean has no bias; give an override",
        ("r.flag", 1, 0.5): "the value is no Boolean; give 0 or 1",
    }
    for number, ((name, kind, strength), message) in enumerate(wrong.items()):
        slave = Slave(fmu, tmp_path / str(number))
        slave.set({f"fault.{name}.kind": kind, f"fault.{name}.value": strength})
        with pytest.raises(FMICallException):
            slave.step(STEP)
        assert slave.messages[0].startswith(f"fault.{name}: {message}")


def test_outputs_depend_on_faults(make, tmp_path):
    """Faults of signals that an output follows at once, not those before a delay."""
    path = make(
        component("r", "ramp", RAMP),
        component("g", "gain", GAIN),
        component("d", "delay", GAIN),
        connections="".join(map(connection, ("r.y", "g.y", "r.y", "d.y"), ("g.u", "fast", "d.u", "slow"))),
        declared="output fast Real m; output slow Real m",
    )
    slave = Slave(build_one(tmp_path / "one.fmu", path, faulty=["g.u", "d.u"]), tmp_path / "one")
    named = {each.variable.name: [known.name for known in each.dependencies] for each in slave.description.outputs}
    assert named == {"fast": ["fault.g.u.kind", "fault.g.u.value"], "slow": []}
    slave.set({"fault.g.u.kind": 1, "fault.g.u.value": 4.0})
    slave.step(STEP)
    assert slave.get("fast") == 12.0


def test_candidates_of_different_steps(make, tiny_folder, tmp_path):
    """Without a description's, the step is that of the FMUs."""
    file = tmp_path / "slow.py"
    file.write_text(SLOW)
    build_own_blocks(file, tmp_path / "fmus", ["native"], [local_platform()])
    path = make(component("c", "ramp", RAMP), step=None)
    slots = {"c": [str(tiny_folder / "native" / "ramp.fmu"), str(tmp_path / "fmus" / "native" / "slow.fmu")]}
    problem = re.escape(
        "slots: c: start, step or duration of the simulation depends on the candidate (steps: 0.1 s, 0.5 s); give step"
    )
    with pytest.raises(InputError, match=problem):
        build_one(tmp_path / "one.fmu", path, slots, exposed=["c.y"])


SLOW = '''
"""A block of a step of its own."""

from perilune import Block, Output


class Slow(Block):
    """y = t."""

    default_step = 0.5
    y = Output(0.0, unit="m", description="time")

    def initialize(self) -> None:
        self.y = 0.0

    def step(self, t: float, h: float) -> None:
        self.y = t + h
'''


def test_a_system_that_fails_at_its_start(make, tmp_path):
    path = make(component("t", "trouble", RAMP), connections=connection("t.y", "y"), declared="output y Real m")
    with pytest.warns(UserWarning, match="no reference trajectory: the system fails at its start: t"):
        build_one(tmp_path / "one.fmu", path, set={"t.kind": 4})


def test_an_enumeration_begins_with_its_first_item(make, tmp_path):
    path = make(
        component("r", "ramp", RAMP),
        connections=connection("e", "phase"),
        declared="input e Enumeration Phase; output phase Enumeration Phase",
        more=PHASE,
    )
    assert Slave(build_one(tmp_path / "one.fmu", path), tmp_path / "one").get("phase") == 2


def test_an_end_at_the_start(make, tmp_path):
    path = make(
        component("r", "ramp", "output flag Boolean; output y Real m"),
        connections=connection("r.flag", "finished") + connection("r.y", "y"),
        declared="output finished Boolean; output y Real m",
    )
    slave = Slave(build_one(tmp_path / "one.fmu", path, set={"r.flag_at": 0}), tmp_path / "one")
    assert slave.fmu.getBooleanStatus(fmi2Terminated)
    begun = slave.get("y")
    slave.step(STEP)
    assert slave.get("y") == begun


def test_an_input_that_is_an_output(make, tmp_path):
    """With Jacobi's algorithm, too, by which no component depends directly."""
    path = make(
        component("g", "gain", GAIN),
        connections=connection("u", "g.u") + connection("u", "y") + connection("g.y", "z"),
        declared="input u Real m; output y Real m; output z Real m",
    )
    slave = Slave(build_one(tmp_path / "one.fmu", path, algorithm="jacobi"), tmp_path / "one", u=2.0)
    named = {each.variable.name: [known.name for known in each.dependencies] for each in slave.description.outputs}
    assert named == {"y": ["u"], "z": []}
    slave.set({"u": 4.0})
    slave.step(STEP)
    assert (slave.get("y"), slave.get("z")) == (4.0, 12.0)


def test_two_mappings_one_behind_the_other(make, tmp_path):
    def mapped(start, end):
        entries = f'<ssc:MapEntry source="{start}" target="{end}"/><ssc:MapEntry source="1" target="1"/>'
        return f"<ssc:IntegerMappingTransformation>{entries}</ssc:IntegerMappingTransformation>"

    inner = system(
        component("r", "ramp", "parameter first_count Integer; output count Integer"),
        connections=connection("c", "r.first_count", mapped(5, 9)) + connection("r.count", "n"),
        declared="parameter c Integer; output n Integer",
        name="inner",
    )
    path = make(
        inner,
        connections=connection("c", "inner.c", mapped(4, 5)) + connection("inner.n", "n"),
        declared="parameter c Integer; output n Integer",
        bindings=inline("c=Integer:4"),
    )
    fmu = build_one(tmp_path / "one.fmu", path)
    assert [fly_one(fmu, {"c": c})["n"][0] for c in (4, 1)] == [9, 1]


def test_names_beyond_those_of_c(make, tmp_path):
    """Digits first, blanks, quotes, other alphabets: flat names, and the bits of the same system."""
    names = ["1st", 'q"x', "é t", "…", "SYSTEM_STEP", "a.use"]
    path = make(*(component(name.replace('"', "&quot;"), "ramp", RAMP) for name in names))
    exposed = [f"{name}.y" for name in names]
    fmu = build_one(tmp_path / "one.fmu", path, exposed=exposed)
    assert validate_fmu(str(fmu)) == []
    flown, native = fly_one(fmu), perilune.simulate(path)
    for name in exposed:
        assert np.array_equal(flown[name], native[name]), name


def test_what_is_refused(make, tmp_path, tiny_folder):
    def refusal(path, **options):
        with pytest.raises(InputError) as caught:
            build_one(tmp_path / "one.fmu", path, **options)
        return str(caught.value)

    texts = make(component("r", "ramp", RAMP), declared="input s String")
    assert "s (line" in refusal(texts)
    assert "its type, String, is not supported; export the system as .ssp" in refusal(texts)
    gain = make(component("g", "gain", GAIN))
    assert "expose: g.u: a parameter, which is always a parameter of the FMU" in refusal(gain, exposed=["g.u"])
    whole = "input n Integer; input b Boolean; output m Integer; output c Boolean"
    wires = [connection(f"{a}.{out}", f"{b}.{into}") for a, b in ("vw", "wv") for out, into in ("mn", "cb")]
    ring = make(component("v", "whole", whole), component("w", "whole", whole), connections="".join(wires))
    assert "would have no variables; give expose with a signal" in refusal(ring, algorithm="jacobi")


def test_an_input_begins_as_the_component_that_it_reaches(make, tmp_path):
    """Closed form: 7 m is the start of a delay's input, and 0.007 km."""
    path = make(
        component("d", "delay", GAIN),
        component("s", "careful", GAIN),
        connections="".join(map(connection, ("u", "d.y", "v", "s.y"), ("d.u", "y", "s.u", "z"))),
        declared="input u Real km; input v Real m; output y Real m; output z Real m",
    )
    native = fly(path, open_inputs="start")
    fmu = build_one(tmp_path / "one.fmu", path)
    starts = {each.name: each.start for each in Slave(fmu, tmp_path / "one").description.modelVariables}
    assert (starts["u"], starts["v"]) == ("0.007", "1.0")
    flown = fly_one(fmu)
    assert all(np.array_equal(flown[name], native[name]) for name in "yz")


def test_units_of_the_system(make, tmp_path):
    """Truth: the factor of the description, and the conversion of another system to m."""
    furlong = '<ssc:Unit name="furlong"><ssc:BaseUnit m="1" factor="201.168"/></ssc:Unit></ssd:Units>'
    path = make(
        component("g", "gain", GAIN),
        connections=connection("u", "g.u") + connection("g.y", "y"),
        declared="input u Real furlong; output y Real m",
        units=UNITS.replace("</ssd:Units>", furlong),
        stop=0.3,
        step=0.1,
    )
    description = Slave(build_one(tmp_path / "one.fmu", path), tmp_path / "one").description
    (unit,) = (each for each in description.unitDefinitions if each.name == "furlong")
    assert (unit.baseUnit.m, unit.baseUnit.factor) == (1, 201.168)
    assert description.defaultExperiment.stopTime == "0.3"


def test_a_system_without_signals(make, tmp_path):
    """Its C has no array of no elements."""
    fmu = build_one(tmp_path / "one.fmu", make(component("g", "gain", GAIN)))
    folder = fmpy.extract(str(fmu), str(tmp_path / "one"))
    warned = subprocess.run(
        ["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "s.c"],
        cwd=f"{folder}/sources",
        capture_output=True,
        text=True,
        check=False,
    )
    assert (warned.returncode, warned.stderr) == (0, "")


def test_connectors_of_systems_inside_can_be_exposed(make, tmp_path):
    inner = system(
        component("r", "ramp", RAMP), connections=connection("r.y", "y"), declared="output y Real m", name="inner"
    )
    path = make(inner)
    flown = fly_one(build_one(tmp_path / "one.fmu", path, exposed=["inner.y"]))
    assert np.array_equal(flown["inner.y"], perilune.simulate(path)["inner.y"])
