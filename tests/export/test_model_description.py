"""modelDescription.xml as read by FMPy, compared with the block's declaration.

Truth: the declarations. FMPy's validation of built FMUs is in test_fmus_elsewhere.py.
"""

import io
import re
import zipfile

import pytest
from fmpy import read_model_description
from lxml import etree

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.description.common import literal
from perilune.fmus_src.export.description.fmi2 import model_description
from perilune.fmus_src.units import unit_definition

BLOCKS = catalogue()
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


def read(block):
    text = model_description(block, guid="{g}", origin={"generationTool": "test"}, needs_execution_tool=True)
    return etree.fromstring(text)


def names(block):
    return [name for variable in block.variables.values() for name in variable.element_names()]


@pytest.mark.parametrize("name", BLOCKS)
def test_variables_are_those_declared(fmus, name):
    block = BLOCKS[name]
    description = read_model_description(str(fmus / f"{name}.fmu"))
    variables = {variable.name: variable for variable in description.modelVariables}
    assert list(variables) == names(block)
    references = [variable.valueReference for variable in variables.values()]
    assert references == list(range(len(references)))
    for declared in block.variables.values():
        names_and_starts = zip(declared.element_names(), declared.elements, strict=True)
        about = zip(declared.units(), declared.descriptions(), strict=True)
        for (element, start), (unit, words) in zip(names_and_starts, about, strict=True):
            actual = variables[element]
            assert (actual.causality, actual.type) == (declared.causality, declared.fmi_type)
            if declared.enumeration:
                items = {item.name: int(item.value) for item in actual.declaredType.items}
                assert items == {name: number for number, name in declared.enumeration.names.items()}
            assert actual.description.startswith(re.sub(r"\s+", " ", words))
            if isinstance(declared, Parameter | Input):
                value = {"Real": float, "Integer": int, "Enumeration": int, "Boolean": lambda text: text == "true"}[
                    actual.type
                ](actual.start)
                assert value == start
            if actual.type == "Real":
                assert actual.unit == unit
            for bound, text in ((declared.minimum, actual.min), (declared.maximum, actual.max)):
                assert (bound is None) == (text is None)
                assert bound is None or float(text) == bound
    assert {unit.name for unit in description.unitDefinitions} == {
        unit for variable in block.variables.values() for unit in variable.units() if unit
    }
    for defined in description.unitDefinitions:
        exponents = {base: getattr(defined.baseUnit, base) for base in BASE_UNITS}
        assert {base: power for base, power in exponents.items() if power} == unit_definition(defined.name).exponents
        assert (defined.baseUnit.factor, defined.baseUnit.offset) == (1.0, 0.0)


@pytest.mark.parametrize("name", BLOCKS)
def test_dependencies_are_those_declared(fmus, name):
    block = BLOCKS[name]
    description = read_model_description(str(fmus / f"{name}.fmu"))
    direct = {output.variable.name: {v.name for v in output.dependencies} for output in description.outputs}
    expected = {}
    for output in block.variables.values():
        if isinstance(output, Output):
            inputs = [block.variables[name] for name in block.direct_inputs(output)]
            elements = {element for variable in inputs for element in variable.element_names()}
            expected |= {element: elements for element in output.element_names()}
    assert direct == expected
    initial = {unknown.variable.name for unknown in description.initialUnknowns}
    assert initial == set(expected)


class Odd(Block):
    """Awkward values & <markup> in "words"."""

    number = Parameter(0.1 + 0.2, unit="m/s", description="a < b & c > d", minimum=-1e-300, maximum=1e300)
    tiny = Parameter([5e-324, -0.0, 1.7976931348623157e308], unit="1", description="extremes")
    whole = Parameter(-(2**31), description="smallest Integer")
    flag = Parameter(True, description="yes")
    level = Input([1.0, 2.0], unit="m", description="two")
    y = Output([0.0, 0.0], unit="m", direct=("level",), description="out")
    state = State([0.0] * 3, description="inside")

    def step(self, t: float, h: float) -> None:
        pass


def test_awkward_values_come_back_to_the_last_bit():
    root = read(Odd)
    starts = {variable.get("name"): variable[0].get("start") for variable in root.iter("ScalarVariable")}
    assert float(starts["number"]).hex() == (0.1 + 0.2).hex()
    assert [float(starts[f"tiny[{i}]"]).hex() for i in (1, 2, 3)] == [value.hex() for value in Odd.tiny.start]
    assert (starts["whole"], starts["flag"], starts["state[1]"]) == (str(-(2**31)), "true", None)
    assert literal(True) == "true"
    assert float(literal(1 / 3)) == 1 / 3


def test_markup_is_escaped_and_valid():
    text = model_description(
        Odd, guid="{g}", origin={"generationTool": "a & b"}, needs_execution_tool=False, sources=("odd.c",)
    )
    description = read_model_description(io.BytesIO(_zipped(text)))
    variables = {variable.name: variable for variable in description.modelVariables}
    assert variables["number"].description == "a < b & c > d; not used by this block"
    assert description.description == 'Awkward values & <markup> in "words".'
    assert description.coSimulation.needsExecutionTool is False


def test_two_calls_give_the_same_bytes():
    def make():
        return model_description(Odd, guid="{g}", origin={"generationTool": "t"}, needs_execution_tool=True)

    assert make() == make()


def _zipped(text):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("modelDescription.xml", text)
    return buffer.getvalue()
