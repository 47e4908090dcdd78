"""A system as one FMU rejects the values that its components reject; unselected candidates are ignored.

Truth: the declarations of the blocks, and the set numbers.
"""

import math

import pytest
from fmpy.fmi1 import FMICallException

from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import component, connection, document, inline, pack, system
from tests.support.native.system_fmus import Slave, build_one

BLOCKS = '''
"""Gains of different bounds, the second of which integrates in steps of its own."""

from perilune import Block, Input, Output, Parameter


class Narrow(Block):
    """y = factor u."""

    factor = Parameter(0.5, unit="1", minimum=0.0, maximum=1.0, description="factor")
    orders = Parameter([1, 1], minimum=1, maximum=3, description="Integers")
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, unit="m", direct=True, description="it")

    def initialize(self) -> None:
        self.y = self.factor * self.u

    def step(self, t: float, h: float) -> None:
        self.y = self.factor * self.u


class Wide(Block):
    """y = factor u, where nothing integrates but steps are counted."""

    factor = Parameter(0.5, unit="1", minimum=0.0, maximum=100.0, description="factor")
    internal_step = Parameter(0.25, unit="s", minimum=1e-9, description="longest integration step")
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, unit="m", direct=True, description="it")

    def initialize(self) -> None:
        self.y = self.factor * self.u

    def step(self, t: float, h: float) -> None:
        self.y = self.factor * self.u
'''


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    """Build the FMU of a system with an input u, whose parameter k is the factor of the slot's
    component and of another."""
    folder = tmp_path_factory.mktemp("blocks")
    (folder / "blocks.py").write_text(BLOCKS)
    build_own_blocks(folder / "blocks.py", folder / "fmus", ["native"], [local_platform()])
    fmus = folder / "fmus" / "native"
    ssd = document(
        system(
            component("c", "wide", "parameter factor Real 1; input u Real m; output y Real m"),
            component("d", "wide", "input u Real m; output y Real m"),
            connections=connection("u", "c.u")
            + connection("u", "d.u")
            + connection("k", "c.factor")
            + connection("c.y", "y"),
            declared="parameter k Real 1; input u Real m; output y Real m",
            bindings=inline("k=Real:0.5 1"),
        )
    )
    path = pack(folder / "s.ssp", fmus, ssd)
    slots = {"c": [str(fmus / f"{name}.fmu") for name in ("wide", "narrow")]}
    return build_one(folder / "one.fmu", path, slots)


WIDE, NARROW = {"c.use": 1}, {"c.use": 2}


def refused(one, folder, values):
    """Return the messages of an instance that does not start."""
    slave = Slave(one, folder)
    slave.fmu.reset()
    with pytest.raises(FMICallException):
        slave.initialise(**values)
    return slave.messages


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"d.factor": 101.0}, "d.factor = 101.0 is above its maximum 100.0"),
        ({"d.internal_step": math.nan}, "d.internal_step = nan is not finite"),
        ({"k": -1.0} | WIDE, "c.wide.factor = -1.0 is below its minimum 0.0"),  # it follows from the system's parameter
        ({"k": 2.0} | NARROW, "c.narrow.factor = 2.0 is above its maximum 1.0"),
        ({"k": math.inf} | WIDE, "k = inf is not finite"),
        ({"c.narrow.orders[2]": 4} | NARROW, "c.narrow.orders[2] = 4 is above its maximum 3"),
        ({"u": math.nan}, "u = nan is not finite"),
        ({"c.use": 3}, "c.use = 3 is above its maximum 2"),
    ],
)
def test_a_system_does_not_start_with_a_wrong_value_and_says_which(one, tmp_path, values, message):
    assert refused(one, tmp_path / "one", values) == [f"StartError: {message}"]


@pytest.mark.parametrize("values", [{"k": 2.0, "u": 3.0} | WIDE, {"c.narrow.orders[1]": 9, "k": 2.0, "u": 3.0} | WIDE])
def test_bounds_of_a_candidate_that_is_not_chosen_do_not_count(one, tmp_path, values):
    assert Slave(one, tmp_path / "one", **values).get("y") == 6.0


def test_a_component_that_would_take_more_than_a_million_integration_steps_ends_the_step(one, tmp_path):
    slave = Slave(one, tmp_path / "one", **{"d.internal_step": 0.25e-6})
    slave.step(0.25)
    slave = Slave(one, tmp_path / "two", **{"d.internal_step": 0.24e-6})
    with pytest.raises(FMICallException):
        slave.step(0.25)
    assert slave.messages == [
        "d: StepError: the step holds more than a million integration steps; use a longer internal_step, "
        "in the step from t = 0.0 s over h = 0.25 s"
    ]


def test_parameters_that_all_readers_can_change_are_tunable(one, tmp_path):
    """k is passed on to its readers before the next step; the other's factor, and the choice, stay."""
    slave = Slave(one, tmp_path / "one", u=2.0, k=0.5, **WIDE)
    tunable = {name for name, each in slave.variables.items() if each.variability == "tunable"}
    assert tunable == {"k", "d.factor"}
    slave.step(0.5)
    assert slave.get("y") == 1.0
    slave.set({"k": 3.0, "d.factor": 7.0})  # beyond what the candidate that is not chosen may have
    assert slave.get("y") == 1.0
    slave.step(0.5)
    assert slave.get("y") == 6.0
    assert slave.get("d.factor") == 7.0


def test_a_reader_refuses_what_is_passed_on_to_it_and_nothing_is_changed(one, tmp_path):
    slave = Slave(one, tmp_path / "one", u=2.0, k=0.5, **NARROW)
    slave.step(0.5)
    with pytest.raises(FMICallException):
        slave.set({"k": 3.0})
    assert slave.messages == ["fmi2SetReal: c.narrow.factor = 3.0 is above its maximum 1.0"]
    assert slave.get("k") == 0.5
    slave.step(0.5)
    assert slave.get("y") == 1.0


def test_a_parameter_of_a_component_changes_the_next_step(tiny_folder, tmp_path):
    """A ramp of 2 m/s, from 0.5 s on of 5 m/s; its start is fixed."""
    ramp = component("ramp", "ramp", "output y Real m")
    ssd = document(system(ramp, connections=connection("ramp.y", "y"), declared="output y Real m"), step=0.25)
    path = build_one(tmp_path / "one.fmu", pack(tmp_path / "s.ssp", tiny_folder / "native", ssd))
    slave = Slave(path, tmp_path / "one")
    rows = []
    for n in range(4):
        if n == 2:
            slave.set({"ramp.slope": 5.0})
        slave.step(0.25)
        rows.append(slave.get("y"))
    assert rows == [1.5, 2.0, 3.25, 4.5]
    with pytest.raises(FMICallException):
        slave.set({"ramp.start": 5.0})
    assert slave.messages == ["fmi2SetReal: ramp.start is a parameter, fixed after initialisation"]
