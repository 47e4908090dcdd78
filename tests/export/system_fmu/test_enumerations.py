"""Enumerations of a system as one FMU: statuses, phases and methods of its blocks, with types.

Truth: the declarations of the blocks, FMPy, the semantic checks of the FMU Manipulation Toolbox, closed forms.
"""

from __future__ import annotations

from pathlib import Path

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

import perilune
from perilune.analysis.exports.system_fmu.choices import Preparation
from perilune.analysis.exports.system_fmu.fmu_variables import Variables
from perilune.analysis.exports.system_fmu.model import SystemModel
from perilune.analysis.runtime.ssp.archive import open_system, system_names
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from perilune.fmus_src.variables import Output
from tests.support.builders import component, connection, document, pack, system
from tests.support.lengths import either
from tests.support.native.system_fmus import Slave, build_one, fly_one
from tests.support.native.toolbox import find_semantic_errors

STEP = 0.25  # s, of the small systems


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", either(system_names(), ["landing_mission", "orbital_attitude"]))
def test_every_enumeration_of_a_shipped_system_is_one(name: str) -> None:
    """All parameters, and with every output of a component exposed these, too."""
    preparation = Preparation(open_system(name), SystemOptions(flavour="native"), {})
    components = preparation.choice({}).prepared.network.fmus
    blocks = {component: catalogue()[fmu.name] for component, fmu in components.items()}
    declared = {
        f"{component}.{variable.name}": variable
        for component, block in blocks.items()
        for variable in block.variables.values()
        if variable.enumeration is not None
    }
    exposed = [full for full, variable in declared.items() if isinstance(variable, Output)]
    variables = {
        each.name: each for each in Variables(SystemModel(preparation.choices(), exposed, ()), {}, {}).declared
    }
    typed = {each.name: each.enumeration for each in variables.values() if each.type == "Enumeration"}
    assert set(typed) == declared.keys() & variables.keys() >= set(exposed)
    assert exposed
    for full, kind in typed.items():
        enumeration = declared[full].enumeration
        assert enumeration is not None
        assert kind is not None
        assert (kind.name, kind.numbers) == (enumeration.__name__, {v: k for k, v in enumeration.names.items()})
        assert {member.number: member.meaning for member in kind.members} == enumeration.meanings
        start = variables[full].start
        assert start is None or start in enumeration.names


BLOCK = '''
"""A block whose output is ten times its mode."""

from perilune import Block, Enumeration, Output, Parameter, member


class Mode(Enumeration, first={first}):
    """What it does."""

    SLOW = member("slowly")
    {second} = member("otherwise")


class {name}(Block):
    """y = 10 mode + {shift}, state = mode."""

    mode = Parameter(Mode, start={start}, description="mode")
    y = Output(0.0, description="it")
    state = Output(Mode, start={start}, description="the mode")

    def initialize(self) -> None:
        self.state = self.mode
        self.y = 10.0 * self.mode + {shift}

    def step(self, t: float, h: float) -> None:
        self.state = self.mode
        self.y = 10.0 * self.mode + {shift}
'''
NAMES = {"Early": (0, "FAST", 1, 0.5), "Late": (1, "STOPPED", 2, 0.25), "Alike": (0, "FAST", 0, 0.75)}


@pytest.fixture(scope="module")
def fmus_of_modes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of three blocks with an enumeration of one name: two have the same members, one has others."""
    folder = tmp_path_factory.mktemp("modes")
    for name, (first, second, start, shift) in NAMES.items():
        text = BLOCK.format(name=name, first=first, second=second, start=start, shift=shift)
        (folder / f"{name}.py").write_text(text)
        build_own_blocks(folder / f"{name}.py", folder / "fmus", ["native"], [local_platform()])
    return folder / "fmus" / "native"


def test_types_of_one_name_and_other_items_have_two_names(fmus_of_modes: Path, tmp_path: Path) -> None:
    """Starts, values set and read are numbers by the calls of Integers: FMI 2.0.4, 2.1.7."""
    components = [component(name, name.lower(), "output y Real; output state Integer") for name in NAMES]
    path = pack(tmp_path / "s.ssp", fmus_of_modes, document(system(*components), stop=1.0, step=STEP))
    exposed = [f"{name}.{signal}" for name in NAMES for signal in ("y", "state")]
    fmu = build_one(tmp_path / "one.fmu", path, exposed=exposed)
    assert validate_fmu(str(fmu)) == []
    assert find_semantic_errors(fmu) == []

    slave = Slave(fmu, tmp_path / "unzipped", **{"Early.mode": 0, "Late.mode": 1})
    types = {name: each.declaredType.name for name, each in slave.variables.items() if each.type == "Enumeration"}
    assert types == {
        f"{name}.{part}": "Mode_2" if name == "Late" else "Mode" for name in NAMES for part in ("mode", "state")
    }
    members = {
        kind.name: {each.name: int(each.value) for each in kind.items} for kind in slave.description.typeDefinitions
    }
    assert members == {"Mode": {"SLOW": 0, "FAST": 1}, "Mode_2": {"SLOW": 1, "STOPPED": 2}}
    assert [slave.variables[f"{name}.mode"].start for name in NAMES] == ["1", "2", "0"]
    slave.step(STEP)
    assert [slave.get(f"{name}.state") for name in NAMES] == [0, 1, 0]
    assert [slave.get(f"{name}.y") for name in NAMES] == [0.5, 10.25, 0.75]
    with pytest.raises(FMICallException):
        Slave(fmu, tmp_path / "wrong", **{"Late.mode": 3})


def test_it_flies_as_its_components(fmus_of_modes: Path, tmp_path: Path) -> None:
    """By name of an member, too, where the FMU is a component itself."""
    ssd = document(system(component("Early", "early", "output y Real"), component("Late", "late", "output y Real")))
    path = pack(tmp_path / "s.ssp", fmus_of_modes, ssd)
    fmu = build_one(tmp_path / "one.fmu", path, exposed=["Early.y", "Late.y"])
    native = perilune.simulate(path, set={"Early.mode": "SLOW", "Late.mode": "SLOW"})
    flown = fly_one(fmu, {"Early.mode": 0, "Late.mode": 1})
    signals = ["s.Early.y", "s.Late.y"]
    nested = perilune.simulate(fmu, set={"s.Early.mode": "SLOW", "s.Late.mode": "SLOW"}, record=signals)
    for name in ("Early.y", "Late.y"):
        assert flown[name].tolist() == native[name].tolist() == nested[f"s.{name}"][: len(native.time)].tolist()


def test_a_signal_whose_candidates_have_other_items_is_an_integer(fmus_of_modes: Path, tmp_path: Path) -> None:
    ssd = document(system(component("c", "early", "output y Real; output state Integer")), stop=1.0, step=STEP)
    path = pack(tmp_path / "s.ssp", fmus_of_modes, ssd)
    for other, kind in (("late", "Integer"), ("alike", "Enumeration")):
        slots = {"c": [str(fmus_of_modes / f"{name}.fmu") for name in ("early", other)]}
        description = fmpy.read_model_description(str(build_one(tmp_path / f"{other}.fmu", path, slots, ["c.state"])))
        types = {each.name: each.type for each in description.modelVariables}
        assert types == {
            "c.use": "Enumeration",
            "c.early.mode": "Enumeration",
            f"c.{other}.mode": "Enumeration",
            "c.state": kind,
        }


def test_a_connector_without_a_type_has_that_of_its_source(fmus_of_modes: Path, tmp_path: Path) -> None:
    ssd = document(
        system(
            component("c", "late", "output state Integer"),
            connections=connection("c.state", "state"),
            declared="output state -",
        ),
        stop=1.0,
        step=STEP,
    )
    path = pack(tmp_path / "s.ssp", fmus_of_modes, ssd)
    slave = Slave(build_one(tmp_path / "one.fmu", path), tmp_path / "one")
    assert slave.variables["state"].declaredType.name == "Mode"
    assert slave.get("state") == 2
