"""modelDescription.xml of FMI 3.0 for every block.

Truth: FMPy's validation with the standard's schemas, and the FMI 2.0 description of the same block, as read by FMPy.
"""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.model_description import ModelDescription, read_build_description
from fmpy.validation import validate_fmu
from lxml import etree

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import SOURCE_OPTIONS
from perilune.fmus_src.export.description import fmi2, fmi3
from perilune.fmus_src.export.description.build import build_description
from perilune.fmus_src.export.description.terminals import terminals
from perilune.fmus_src.kernel.enumerations import Enumeration, member
from perilune.fmus_src.kernel.matrices import zeros
from perilune.fmus_src.kernel.records import Field, Record
from perilune.fmus_src.kernel.vector_types import Vector3
from tests.support.lengths import either
from tests.support.native.building import COMPILED, NATIVE

SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"


def describe(block: type[Block], folder: Path) -> tuple[ModelDescription, ModelDescription]:
    """Return the block as FMPy reads it in FMI 2.0 and 3.0; the latter is validated."""
    path = folder / "block.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(
            "modelDescription.xml", fmi3.model_description(block, token="{1}", origin={"generationTool": "test"})
        )
        archive.writestr("sources/block.c", "")
        text = build_description(block.fmu_name, "block.c", SOURCE_OPTIONS)
        archive.writestr("sources/buildDescription.xml", text)
    assert validate_fmu(str(path)) == []
    old = io.BytesIO()
    with zipfile.ZipFile(old, "w") as archive:
        text = fmi2.model_description(block, guid="{1}", origin={"generationTool": "test"}, needs_execution_tool=False)
        archive.writestr("modelDescription.xml", text)
    return fmpy.read_model_description(old), fmpy.read_model_description(str(path))


@pytest.mark.parametrize("name", either(NATIVE, COMPILED))
def test_a_block_is_described_as_in_fmi_2(name: str, tmp_path: Path) -> None:
    old, new = describe(catalogue()[name], tmp_path)
    groups: dict[str, list] = {}
    for variable in old.modelVariables:
        groups.setdefault(variable.name.partition("[")[0], []).append(variable)
    *variables, time = new.modelVariables
    assert (time.name, time.causality, time.valueReference) == ("time", "independent", len(variables))
    assert [variable.name for variable in variables] == list(groups)
    assert [variable.valueReference for variable in variables] == list(range(len(variables)))
    for variable in variables:
        elements = groups[variable.name]
        size = 1
        for length in variable.shape or ():
            size *= length
        assert size == len(elements)
        starts = [None] * size if variable.start is None else variable.start.split()
        assert starts == [each.start for each in elements]
        for each in elements:
            for key in ("causality", "variability", "initial", "unit", "min", "max", "nominal", "description"):
                assert getattr(variable, key) == getattr(each, key), (variable.name, key)
            assert variable.type == {"Real": "Float64", "Integer": "Int32"}.get(each.type, each.type)
            if each.type == "Enumeration":
                items = [[(i.name, i.value, i.description) for i in v.declaredType.items] for v in (variable, each)]
                assert items[0] == items[1]
    for kind in ("outputs", "initialUnknowns"):
        expected = {
            unknown.variable.name.partition("[")[0]: {each.name.partition("[")[0] for each in unknown.dependencies}
            for unknown in getattr(old, kind)
        }
        actual = {each.variable.name: {other.name for other in each.dependencies} for each in getattr(new, kind)}
        assert actual == expected
    assert [unit.name for unit in new.unitDefinitions] == [unit.name for unit in old.unitDefinitions]
    assert new.coSimulation.canGetAndSetFMUstate
    assert new.coSimulation.canSerializeFMUstate
    assert not new.coSimulation.hasEventMode
    assert not new.coSimulation.needsExecutionTool


def read_terminals(block: type[Block]) -> dict[str, dict[str, str]]:
    """Return variables of each terminal by the names of members, those within another under
    OUTER.INNER; schema checked."""
    text = terminals(block)
    if text is None:
        return {}
    root = etree.fromstring(text)
    etree.XMLSchema(file=str(SCHEMAS / "fmi3TerminalsAndIcons.xsd")).assertValid(root)
    read = {}
    for terminal in root.iter("Terminal"):
        outer = terminal.getparent()
        prefix = f"{outer.get('name')}." if outer is not None and outer.tag == "Terminal" else ""
        members = terminal.findall("TerminalMemberVariable")
        read[f"{prefix}{terminal.get('name')}"] = {m.get("memberName"): m.get("variableName") for m in members}
    return read


@pytest.mark.parametrize("name", NATIVE)
def test_terminals_have_each_connector_of_slots_and_bundles_once(name: str) -> None:
    block = catalogue()[name]
    members = [variable for terminal in read_terminals(block).values() for variable in terminal.values()]
    connectors = {key for key, variable in block.variables.items() if isinstance(variable, Input | Output)}
    of_slots = {
        key
        for base in block.__mro__
        if issubclass(base, Block) and base.is_interface
        for key in base.variables
        if key in connectors
    }
    of_bundles = {key for bundle in block.bundles.values() for key in bundle.names.values()}
    assert sorted(members) == sorted(of_slots | of_bundles)


def test_terminals_are_named_after_slots_and_bundles() -> None:
    switch = read_terminals(catalogue()["command_switch"])
    assert list(switch) == ["sequencer", "braking", "hover", "command"]
    assert switch["braking"]["burn_duration"] == "braking_burn_duration"
    assert switch["command"].keys() == switch["braking"].keys()
    guidance = read_terminals(catalogue()["analytic_guidance"])
    assert list(guidance) == ["terminal_guidance", "terminal_guidance.command"]
    assert guidance["terminal_guidance"]["position"] == "position"
    assert "burn_duration" not in guidance["terminal_guidance"]
    assert list(read_terminals(catalogue()["kalman_navigation"])) == ["navigation", "filtered_navigation"]
    assert read_terminals(catalogue()["forming_filter"]) == {}


class Phase(Enumeration, first=2):
    """Its activity."""

    CLIMB = member("upwards")
    FALL = member("down & out")


class Motion(Record):
    """Its motion."""

    position = Field(Vector3, unit="m", description="of the centre", frozen=True)
    speed = Field(unit="m/s", description="of the centre")


class Everything(Block):
    """All kinds of variables."""

    flags = Parameter([True, False], description="switches")
    gains = Parameter(zeros(2, 3), unit="1/s", description="gains")
    rows = Parameter([1.0, 2.0, 3.0, 4.0], columns=2, description="rows")
    wanted = Input(Phase, start=Phase.FALL, description="wanted")
    motion = State(Motion, speed=2.0)
    phase = Output(Phase, description="phase")

    def step(self, t: float, h: float) -> None:
        self.phase = self.wanted


def test_matrices_records_and_enumerations(tmp_path: Path) -> None:
    _, new = describe(Everything, tmp_path)
    variables = {variable.name: variable for variable in new.modelVariables}
    shapes = {name: variable.shape for name, variable in variables.items()}
    assert shapes == {
        "flags": (2,),
        "gains": (2, 3),
        "rows": (2, 2),
        "wanted": (),
        "motion.position": (3,),
        "motion.speed": (),
        "phase": (),
        "time": (),
    }
    assert (variables["flags"].start, variables["rows"].start) == ("true false", "1.0 2.0 3.0 4.0")
    assert (variables["motion.position"].unit, variables["motion.speed"].unit) == ("m", "m/s")
    assert (variables["wanted"].type, variables["wanted"].start) == ("Enumeration", "3")
    (phase,) = new.typeDefinitions
    assert (phase.name, phase.description) == ("Phase", "Its activity.")
    items = [(each.name, each.value, each.description) for each in phase.items]
    assert items == [("CLIMB", "2", "upwards"), ("FALL", "3", "down & out")]
    text = fmi3.model_description(Everything, token="", origin={})
    (layout,) = etree.fromstring(text).find("Annotations/Annotation[@type='org.perilune.state']")
    assert (layout.get("encoding"), layout.get("frozen")) == ("words", str(variables["motion.position"].valueReference))


def test_the_build_description_has_the_options_that_keep_bits(tmp_path: Path) -> None:
    describe(Everything, tmp_path)
    (configuration,) = read_build_description(str(tmp_path / "block.fmu"))
    (files,) = configuration.sourceFileSets
    assert files.sourceFiles == ["block.c"]
    root = etree.fromstring(build_description("block", "block.c", SOURCE_OPTIONS))  # FMPy leaves the options out
    options = root.find("BuildConfiguration/SourceFileSet").get("compilerOptions")
    assert {"-ffp-contract=off", "-fno-tree-vectorize"} <= set(options.split())


class Extremes(Block):
    """Numbers at the edge of what XML Schema's double and int hold."""

    limit = Parameter([float("inf"), -float("inf"), 1e308], maximum=float("inf"), description="limit")
    count = Parameter(2**31 - 1, minimum=-0.5, maximum=2**40, description="count")
    y = Output(0.0, description="y")

    def step(self, t: float, h: float) -> None:
        self.y = t


def test_infinite_and_wide_numbers_are_written_as_the_schema_has_them(tmp_path: Path) -> None:
    """FMPy validates both versions against the schema, and Python reads the starts back."""
    for description in describe(Extremes, tmp_path):
        starts = " ".join(each.start for each in description.modelVariables if each.name.startswith("limit"))
        assert list(map(float, starts.split())) == [float("inf"), -float("inf"), 1e308]
        (count,) = (each for each in description.modelVariables if each.name == "count")
        assert (count.start, count.min, count.max) == ("2147483647", "0", None)


@pytest.mark.parametrize("number", [2**31, -(2**31) - 1])
def test_a_start_beyond_32_bits_is_refused(number: int) -> None:
    wide = type("Wide", (Extremes,), {"__doc__": "Too wide.", "count": Parameter(number, description="count")})
    message = f"count: starts at {number}, beyond the 32-bit integers of FMI"
    with pytest.raises(ValueError, match=message):
        fmi3.model_description(wide, token="", origin={})
    with pytest.raises(ValueError, match=message):
        fmi2.model_description(wide, guid="", origin={}, needs_execution_tool=False)


def test_a_variable_time_is_refused() -> None:
    class Clock(Block):
        """Has a variable that FMI 3.0 has, too."""

        time = Output(0.0, unit="s", description="time")

        def step(self, t: float, h: float) -> None:
            self.time = t

    with pytest.raises(ValueError, match=r"Clock\.time: is reserved for FMI 3\.0's independent variable"):
        fmi3.model_description(Clock, token="", origin={})


def test_two_enumerations_of_one_name_are_refused() -> None:
    other = type("Phase", (Enumeration,), {"ONE": member("one")})

    class Two(Block):
        """Two of one name."""

        first = Output(Phase, description="first")
        second = Output(other, description="second")

        def step(self, t: float, h: float) -> None:
            self.first = 2

    with pytest.raises(ValueError, match="two: two enumerations are named Phase; rename one"):
        fmi3.model_description(Two, token="", origin={})
