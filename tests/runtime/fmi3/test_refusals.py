"""Unsupported FMUs of FMI 3.0, and unsupported options of supported FMUs: one line each."""

import re

import fmpy
import pytest

import perilune
from tests.support.builders import component, connection, document, pack, retouched, system, write_zip
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_fmu import strict_fmu

# As the Reference-FMU `Clocks` declares itself (v0.0.39), which is for scheduled execution.
CLOCKS = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Clocks" instantiationToken="{C5F142BA-B849-42DA-B4A1-4745BFF3BE28}">
<ScheduledExecution modelIdentifier="Clocks"/>
<ModelVariables>
<Clock name="inClock1" valueReference="1001" causality="input" variability="discrete" intervalVariability="constant"
 intervalDecimal="0.1" priority="1"/>
<Int32 name="totalInClock1Ticks" valueReference="2001" causality="output" variability="discrete" clocks="1001"/>
</ModelVariables>
<ModelStructure><Output valueReference="2001"/></ModelStructure>
</fmiModelDescription>"""


def changed(pattern: str, text: str):
    return lambda description: re.sub(pattern, text, description, count=1, flags=re.DOTALL)


DESCRIPTIONS = {
    "clocks": (
        changed(
            "</ModelVariables>",
            '<Clock name="tick" valueReference="99" intervalVariability="triggered"/></ModelVariables>',
        ),
        r"tick \(line \d+\): is a Clock, and FMUs with clocks are not supported; export the FMU without clocks",
    ),
    "model exchange": (
        changed("<CoSimulation[^>]*/>", '<ModelExchange modelIdentifier="Strict"/>'),
        "CoSimulation: not a co-simulation FMU: its interfaces are ModelExchange; export the FMU for co-simulation",
    ),
    "no type": (changed("<Int8 name=", "<Int9 name="), r"small \(line \d+\): Int9 is not a type of FMI 3.0; fix"),
    "no name": (changed(' name="early"', ""), r"Float64 \(line \d+\): no attribute name; fix"),
    "no reference": (
        changed(' valueReference="8"', ' valueReference="x"'),
        r"early \(line \d+\), valueReference: 'x' is not a value reference",
    ),
    "names twice": (changed('name="factor"', 'name="early"'), "early: two variables have this name"),
    "start": (changed('start="0.5 0.25"', 'start="0.5 much"'), r"u \(line \d+\), start: 'much' is not a number"),
    "size": (
        changed('start="2" min="0" max="4"', 'start="-2"'),
        r"n \(line \d+\), start: '-2' is not a number of elements",
    ),
    "huge": (changed('start="2" min="0" max="4"', 'start="2000000"'), "Dimension: its arrays have 8000004 elements"),
    "dimension": (
        changed('<Dimension valueReference="1"/>', '<Dimension valueReference="8"/>'),
        r"Dimension \(line \d+\): has neither a start nor a structural parameter",
    ),
    "dependency": (changed('dependencies=""', 'dependencies="1000"'), "dependencies: 1000 is not a value reference"),
    "step": (changed('stepSize="0.25"', 'stepSize="soon"'), "stepSize: 'soon' is not a number"),
    "draft": (changed('fmiVersion="3.0"', 'fmiVersion="3.0-rc.2"'), "fmiVersion: '3.0-rc.2' is not supported"),
}


@pytest.mark.parametrize("case", DESCRIPTIONS)
def test_descriptions(tmp_path, case):
    change, expected = DESCRIPTIONS[case]
    path = retouched(strict_fmu(tmp_path), tmp_path / "changed.fmu", change)
    refused(rf"changed\.fmu: .*{expected}", str(path))


def test_scheduled_execution(tmp_path):
    binary = f"binaries/{fmpy.platform_tuple}/Clocks{fmpy.sharedLibraryExtension}"
    path = write_zip(tmp_path / "Clocks.fmu", {"modelDescription.xml": CLOCKS, binary: b"a library"})
    refused(
        "CoSimulation: not a co-simulation FMU: its interfaces are ScheduledExecution; export the FMU for "
        "co-simulation",
        str(path),
    )


def test_binary_for_another_platform(tmp_path):
    path = strict_fmu(tmp_path)
    other = retouched(path, tmp_path / "other.fmu", changed('modelIdentifier="Strict"', 'modelIdentifier="Other"'))
    refused(rf"binaries/{fmpy.platform_tuple}/Other.*: no binary for this platform; export the FMU for", str(other))


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"record": ["blob"]}, "blob: variables of type Binary are not recorded; name numbers"),
        ({"record": ["text"]}, "text: variables of type String are not recorded; name numbers and Booleans"),
        (
            {"set": {"Strict.blob_in": "00"}},
            "Strict.blob_in: a value of type Binary cannot be set; connect it with a Binary output",
        ),
        ({"set": {"Strict.small_in": 128}}, "Strict.small_in: 128 is not of type Int8; give a smaller number"),
        ({"set": {"Strict.wider_in": -1}}, "Strict.wider_in: -1 is not of type UInt64"),
        ({"set": {"Strict.wide_in": 2**63}}, "Strict.wide_in: 9223372036854775808 is not of type Int64"),
        ({"set": {"Strict.single_in[1]": 1e39}}, r"single_in\[1\]: 1e\+39 is not of type Float32"),
        ({"set": {"Strict.u[1]": -200}}, r"u\[1\]: -200.0 is below the minimum -100"),
        ({"set": {"Strict.n": 5}}, "Strict.n: 5 is above the maximum 4; give a smaller value"),
        ({"set": {"Strict.n": -1}}, "Strict.n: -1 is negative; give a size"),
        ({"set": {"Strict.n": "many"}}, "Strict.n: 'many' is not of type Integer; write a whole number"),
        ({"set": {"Strict.n": 3, "Strict.u[1]": 1.0}}, r"Strict.u\[3\]: u\[3\] has neither a value nor a start"),
        ({"set": {"Strict.u[3]": 1.0}}, r"Strict.u\[3\]: matches no parameter"),
        ({"set": {"Strict.u": [1, 2, 3]}}, r"3 values for the 2 elements Strict.u\[1\] \.\.\.; give 2"),
        ({"set": {"Strict.trouble": "some"}}, "the enumeration has no item some"),
        (
            {"faults": ["Strict.small=override:200@0"]},
            "200 is not of type Integer; give a whole number from -128 to 127",
        ),
        ({"faults": ["Strict.blob=override:1@0"]}, "Strict.blob: no component has such a connector"),
    ],
)
def test_options(tmp_path, options, expected):
    refused(expected, str(strict_fmu(tmp_path)), **options)


def test_structural_parameter_sampled(tmp_path):
    path, plan = str(strict_fmu(tmp_path)), tmp_path / "plan.toml"
    draw = '[draw."Strict.n"]\ndistribution = "choice"\nvalues = [1, 2]\n'
    metric = '[metric.a]\nexpression = "Strict.events"\nreduction = "final"\n[success]\nexpression = "a < 9"\n'
    plan.write_text(f'system = "strict"\ntrials = 2\nseed = 1\n{draw}{metric}')
    with pytest.raises(perilune.InputError, match="a structural parameter, which sizes arrays, cannot vary"):
        perilune.batch(path, plan)


def test_input_by_two_names(tmp_path):
    named = changed(
        'name="d" valueReference="5" causality="input" start="0"/>',
        r'name="d" valueReference="5" causality="input" start="0"><Alias name="also"/></Int32>',
    )
    retouched(strict_fmu(tmp_path), tmp_path / "aliased.fmu", named)
    root = system(
        component("a", "strict", "output small Integer"),
        component("b", "aliased", "input d Integer; input also Integer"),
        connections=connection("a.small", "b.d") + connection("a.small", "b.also"),
    )
    path = pack(tmp_path / "t.ssp", tmp_path, document(root))
    refused("b.also: is another name of b.d, which is also connected or driven; connect one of them", str(path))


def test_binary_to_string(tmp_path):
    strict_fmu(tmp_path)
    root = system(
        component("a", "strict", "output blob Binary"),
        component("b", "strict", "input text_in String; output text String"),
        connections=connection("a.blob", "b.text_in"),
    )
    path = pack(tmp_path / "t.ssp", tmp_path, document(root))
    refused("connection a.blob -> b.text_in .*: types differ: Binary and String", str(path))


def test_schema_flaws_are_notes(tmp_path):
    """As of FMI 2.0: flown with a note, refused by `strict`."""
    path = retouched(
        reference_fmu(3, "Dahlquist"),
        tmp_path / "flawed.fmu",
        changed("<DefaultExperiment", '<DefaultExperiment odd="1"'),
    )
    assert perilune.simulate(str(path)).status == "stop_time"
    refused("not valid: .*attribute 'odd' is not allowed", str(path), strict=True)


def refused(expected: str, path: str, **options: object) -> None:
    with pytest.raises(perilune.InputError, match=expected) as error:
        perilune.simulate(path, **options)
    assert "\n" not in str(error.value)


def test_an_empty_instantiation_token_is_one(tmp_path):
    path = retouched(strict_fmu(tmp_path), tmp_path / "empty.fmu", changed('Token="by hand"', 'Token=""'))
    assert perilune.simulate(path).status == "stop_time"
    assert perilune.validate(path)[0].problems == ()


def test_an_empty_name_is_not_said_to_be_missing(tmp_path):
    path = retouched(strict_fmu(tmp_path), tmp_path / "empty.fmu", changed('name="early"', 'name=""'))
    with pytest.raises(perilune.InputError, match=r"Float64 \(line \d+\): the attribute name is empty; fix"):
        perilune.simulate(path)
