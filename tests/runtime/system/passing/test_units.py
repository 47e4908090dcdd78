"""Rules of units: one test for each row of the table in the reference, by the name of the row.

Truth: FMI 2.0 and 3.0 (units, attributes of variables) and SSP 1.0 (connections, mappings): 10 degC are 283.15 K, a
difference of 10 degC is a difference of 10 K and of 18 degF; factors of SI; results by hand.
"""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from lxml import etree

import perilune
from docs.reference.formats.pages import format_pages
from perilune.analysis.differences.differences import compare_runs
from perilune.analysis.differences.recorded_run import read_run
from perilune.analysis.documents.figures.signal_reader import SignalReader
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import (
    UNITS,
    component,
    connection,
    document,
    fly,
    inline,
    inline_mapping,
    pack,
    retouched,
    system,
)
from tests.support.foreign.passing import build_passing, passing_fmu
from tests.support.locks import made_once

RELATIVE = "degC relativeQuantity=true"
TYPED = "- declaredType=Difference"
LINEAR = '<ssc:LinearTransformation factor="2" offset="7"/>'
SUPPRESSED = 'suppressUnitConversion="true"'


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    return made_once(tmp_path_factory, "passing_fmus", build_passing)


@pytest.fixture
def fmu(tmp_path, built):
    """Return a builder of FMUs in the folder of the test."""
    return lambda name, version=2, **declared: passing_fmu(tmp_path, built, name, version, **declared)


@pytest.fixture
def arrival(tmp_path, fmu):
    """Return what arrives of 10 in the unit of an output, and the notes of `validate` on differences."""

    def arrive(source, target, versions=(2, 2), inner="", attributes="", ends=("output y -", "input u -")):
        fmu("a", versions[0], y=source)
        fmu("b", versions[1], u=target)
        wires = connection("a.y", "b.u", inner, attributes)
        root = system(component("a", "a", ends[0]), component("b", "b", ends[1]), connections=wires)
        path = pack(tmp_path / "s.ssp", tmp_path, document(root))
        notes = prepare_system(path).network.notes
        return fly(path)["b.u"][0], [note for note in notes if "relativeQuantity" in note]

    return arrive


@pytest.fixture
def packed(tmp_path):
    """Return a packer of a system of FMUs in the folder of the test."""
    return lambda *elements, units=UNITS, **more: pack(
        tmp_path / "s.ssp", tmp_path, document(system(*elements, **more), units=units)
    )


def slug(row):
    return f"test_{row.replace(' ', '_')}"


def test_the_table_and_the_tests_have_the_same_rows():
    lines = format_pages()["standards.md"].partition("## Units\n")[2].partition("\n## ")[0].splitlines()
    rows = [line.split("|")[1].strip() for line in lines if line.startswith("|")][2:]
    tests = [name for name in globals() if name.startswith("test_")]
    assert tests[1:] == [slug(row) for row in rows]


@pytest.mark.parametrize("versions", [(2, 3), (3, 2)])
def test_factor_and_offset(arrival, versions):
    assert arrival("degC", "K", versions)[0] == 283.15
    assert arrival("K", "degF", versions)[0] == pytest.approx(10.0 * 1.8 - 459.67, rel=1e-14)
    assert arrival("km", "m", versions)[0] == 10_000.0


@pytest.mark.parametrize("versions", [(2, 2), (3, 3)])
@pytest.mark.parametrize("declared", [RELATIVE, TYPED, "degC relativeQuantity=1 declaredType=Difference"])
def test_relative_quantity(arrival, versions, declared):
    assert arrival(declared, "K relativeQuantity=true", versions) == (10.0, [])
    assert arrival(declared, "K", versions)[0] == 10.0
    assert arrival("K", declared, versions)[0] == 10.0
    assert arrival(declared, "degF relativeQuantity=true", versions)[0] == pytest.approx(18.0, rel=1e-15)
    absolute = "degC relativeQuantity=false declaredType=Difference"
    assert arrival(absolute, "K", versions)[0] == 283.15


def test_ends_that_disagree(arrival):
    number, notes = arrival(RELATIVE, "K", (2, 3))
    assert number == 10.0
    assert [note.partition(" (line")[0] for note in notes] == ["connection a.y -> b.u"]
    assert (
        "a.y is a difference (relativeQuantity), but b.u is not; values are converted without the offsets" in notes[0]
    )
    assert arrival("K relativeQuantity=true", "K") == (10.0, [])  # no offset, no question


def test_connectors_of_systems(fmu, packed):
    fmu("difference", u="K relativeQuantity=true", y="K relativeQuantity=true")
    fmu("absolute", u="K")
    ends = "input u -; output y -"
    deep = system(
        component("b", "difference", ends),
        name="deep",
        declared="input in Real K; output out Real degC",
        connections=connection("in", "b.u") + connection("b.y", "out"),
    )
    wires = connection("t", "deep.in") + connection("deep.out", "all")
    path = packed(deep, declared="input t Real degC; output all Real degF", connections=wires)
    run = fly(path, set={"t": 5.0})
    names = ("deep.in", "deep.b.u", "deep.b.y", "deep.out")
    assert [run[name][0] for name in names] == [5.0, 5.0, 10.0, 10.0]
    assert run["all"][0] == pytest.approx(18.0, rel=1e-15)
    both = component("b", "difference", "input u -"), component("c", "absolute", "input u -")
    wires = connection("t", "b.u") + connection("t", "c.u")
    assert fly(packed(*both, declared="input t Real K", connections=wires), set={"t": 5.0})["c.u"][0] == 5.0
    with pytest.raises(
        InputError, match=r"connection t -> b\.u .*t is connected both with values and with differences"
    ):
        fly(packed(*both, declared="input t Real degC", connections=wires), set={"t": 5.0})
    bindings = inline("t=Real:5 degC")
    with pytest.raises(
        InputError, match=r"t \(line \d+\): t is connected both with .* between degC and K applies to only one of them"
    ):
        fly(packed(*both, declared="input t Real K", connections=wires, bindings=bindings))


def test_base_units(arrival):
    with pytest.raises(InputError, match=r"connection a\.y -> b\.u \(line \d+\): units are not convertible: m and K"):
        arrival("m", "K")
    assert arrival("J quantity=Energy", "N.m quantity=Torque")[0] == 10.0


def test_radians(arrival):
    assert arrival("rad", "1")[0] == arrival("1", "rad")[0] == 10.0


def test_names_of_units(arrival):
    assert arrival("Cel", "degC")[0] == 10.0


def test_no_base_units(arrival):
    assert arrival("EUR", "EUR")[0] == 10.0
    for other in ("USD", "1"):
        with pytest.raises(InputError, match=f"units are not convertible: EUR and {other}"):
            arrival("EUR", other)


def test_no_unit(arrival, fmu, packed):
    assert arrival("-", "degC")[0] == arrival("degC", "-")[0] == 10.0
    fmu("a", y="degC")
    inner = component("a", "a", "output y -")
    path = packed(inner, declared="output through Real", connections=connection("a.y", "through"))
    assert fly(path)["through"][0] == 10.0


def test_undefined_unit(arrival, fmu, packed):
    assert arrival("Rankine", "degC")[0] == 10.0
    with pytest.raises(InputError, match=r"b\.u \(line \d+\): unit Rankine is not defined"):
        arrival("degC", "K", ends=("output y -", "input u Real Rankine"))
    fmu("a", start="K")
    path = packed(component("a", "a", "output y -", inline("start=Real:5 Rankine")))
    with pytest.raises(InputError, match="unit Rankine is not defined here"):
        fly(path)
    assert fly(path, allow_unmatched=True)["a.y"][0] == 5.0


def test_whose_definition(arrival, fmu, packed):
    """The SSD's UNITS has no Cel."""
    assert arrival("degC", "Cel", ends=("output y -", "input u Real Cel"))[0] == 10.0
    fmu("a", y="m")
    inner = component("a", "a", "output y Real m")
    other = UNITS.replace('name="m"><ssc:BaseUnit m="1"', 'name="m"><ssc:BaseUnit factor="1000" m="1"')
    with pytest.raises(InputError, match=r"a\.y \(line \d+\): its unit is m \(m\) in .*, but m \(1000 m\) here"):
        fly(packed(inner, units=other))
    entries = f'<ssb:DictionaryEntry name="x"><ssc:Real unit="m"/></ssb:DictionaryEntry>{other}'.replace("ssd:", "ssb:")
    content = f'<ssb:SignalDictionary version="1.0">{entries}</ssb:SignalDictionary>'
    bus = f'<ssd:SignalDictionary name="bus">{content}</ssd:SignalDictionary>'
    extra = f"<ssd:SignalDictionaries>{bus}</ssd:SignalDictionaries>"
    with pytest.raises(
        InputError, match=r"Unit m: is m \(1000 m\) here, m \(m\) in .*; use a different name for each unit"
    ):
        fly(packed(inner, extra=extra))


def test_connector_and_variable(arrival):
    with pytest.raises(InputError, match=r"a\.y \(line \d+\): its unit is degC in .*a\.fmu, but K here"):
        arrival("degC", "K", ends=("output y Real K", "input u -"))
    assert arrival(RELATIVE, "degC", ends=("output y Real K", "input u -"))[0] == 10.0
    assert arrival("Cel", "K", ends=("output y Real degC", "input u -"))[0] == 283.15


@pytest.mark.parametrize("attributes", ['factor="0"', 'factor="INF"', 'offset="NaN"'])
def test_impossible_unit(fmu, packed, attributes):
    fmu("a", y="K")
    fmu("odd", units=f'<Unit name="odd"><BaseUnit K="1" {attributes}/></Unit>')
    odd = f'<ssc:Unit name="odd"><ssc:BaseUnit K="1" {attributes}/></ssc:Unit>'
    units = UNITS.replace("</ssd:Units>", f"{odd}</ssd:Units>")
    words = r"Unit odd: no value can be converted with factor .* and offset .*; give finite numbers"
    for path in (packed(component("a", "a", "output y -"), units=units), packed(component("a", "odd", "output y -"))):
        with pytest.raises(InputError, match=words):
            fly(path)


@pytest.mark.parametrize("versions", [(2, 3), (3, 2)])
def test_display_unit(arrival, versions):
    assert arrival("K displayUnit=degC", "K displayUnit=degF", versions)[0] == 10.0


def test_transformation(arrival):
    assert arrival("degC", "K", inner=LINEAR)[0] == 2.0 * 283.15 + 7.0
    assert arrival(RELATIVE, "K", inner=LINEAR)[0] == 2.0 * 10.0 + 7.0


def test_suppressed_conversion(arrival):
    assert arrival("degC", "K", attributes=SUPPRESSED)[0] == 10.0
    assert arrival("degC", "K", inner=LINEAR, attributes=SUPPRESSED)[0] == 27.0
    assert arrival("m", "K", attributes=SUPPRESSED)[0] == 10.0


@pytest.mark.parametrize("version", [2, 3])
def test_parameter_sets(fmu, packed, version):
    fmu("absolute", version, start="K")
    fmu("difference", version, start="K relativeQuantity=true")
    values = inline("start=Real:5 degC")
    of_the_ssd = re.sub(r"<ssv:Units>.*?</ssv:Units>", "", values, flags=re.DOTALL)
    for bindings in (values, of_the_ssd):
        pair = (component(name, name, "output y -", bindings) for name in ("absolute", "difference"))
        run = fly(packed(*pair))
        assert (run["absolute.y"][0], run["difference.y"][0]) == (278.15, 5.0)
    through = {"declared": "parameter p Real degC", "connections": connection("p", "d.start")}
    inner = component("d", "difference", "parameter start -; output y -")
    assert fly(packed(inner, bindings=inline("p=Real:9 degF"), **through))["d.y"][0] == pytest.approx(5.0, rel=1e-15)


def test_mappings(fmu, packed):
    fmu("absolute", start="K")
    fmu("difference", start="K relativeQuantity=true")
    for attributes, expected in (("", (2.0 * 278.15 + 7.0, 17.0)), (SUPPRESSED, (17.0, 17.0))):
        entry = f'<ssm:MappingEntry source="x" target="start" {attributes}>{LINEAR}</ssm:MappingEntry>'
        bindings = inline("x=Real:5 degC", mapping=inline_mapping(entry))
        pair = (component(name, name, "output y -", bindings) for name in ("absolute", "difference"))
        run = fly(packed(*pair))
        assert (run["absolute.y"][0], run["difference.y"][0]) == expected


def test_arrays(array_fmus, tmp_path):
    def in_degrees(text):
        text = text.replace('<BaseUnit m="1"/>', '<BaseUnit K="1" offset="273.15"/>').replace('name="m"', 'name="degC"')
        return text.replace('unit="m"', 'unit="degC" relativeQuantity="true"')

    retouched(array_fmus / "three.fmu", tmp_path / "three.fmu", in_degrees)
    wires = "".join(connection(f"three.y[{index}]", f"out[{index}]") for index in (1, 2, 3))
    three = component("three", "three", "output y[1] -; output y[2] -; output y[3] -")
    declared = "output out[1] Real K; output out[2] Real K; output out[3] Real K"
    path = pack(tmp_path / "s.ssp", tmp_path, document(system(three, declared=declared, connections=wires)))
    run = fly(path)
    assert [run[f"out[{index}]"][0] for index in (1, 2, 3)] == [1.0, 2.0, 3.0]


def test_plain_numbers(fmu, packed):
    fmu("a", start=RELATIVE, u="degC", z="K")
    path = packed(component("a", "a", "input u -; output y -; output z -"))
    run = perilune.simulate(
        path, set={"a.start": 4.0}, input={"time": [0.0, 1.0], "a.u": [5.0, 5.0]}, faults=["a.y=bias:3@0"]
    )
    assert (run["a.y"][0], run["a.z"][0]) == (7.0, 5.0)


def test_compiled_steps(built, fmu, packed, tmp_path):
    """`inside` is in K, and Perilune's as it was built: its C is fused."""
    fmu("a", y=RELATIVE)
    shutil.copy(built / "native" / "passing.fmu", tmp_path / "inside.fmu")
    path = packed(
        component("a", "a", "output y -"),
        component("inside", "inside", "input u -; output z -"),
        declared="output t Real degC",
        connections=connection("a.y", "inside.u") + connection("inside.z", "t"),
    )
    for flavour in ("native", "fused"):
        run = fly(path, flavour=flavour)
        assert (run["inside.u"][0], run["t"][0]) == (10.0, 10.0 - 273.15)


def test_limits_of_figures(fmu, packed):
    for unit, offset in ((RELATIVE, 0.0), ("degC", 273.15)):
        fmu("a", y=unit)
        reader = SignalReader(prepare_system(packed(component("a", "a", "output y -"))))
        band = etree.Element("Band", signal="a.y")
        assert reader.signal(band, "signal", unit=reader.unit(band, "K", "a.y")).offsets == (offset,)


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_recorded_runs(fmu, packed, tmp_path, ending):
    for name, unit in (("first", RELATIVE), ("second", "K relativeQuantity=true"), ("absolute", "K")):
        fmu("a", y=unit)
        fly(packed(component("a", "a", "output y -"))).write(tmp_path / f"{name}.{ending}")
    first, second, absolute = (read_run(tmp_path / f"{name}.{ending}") for name in ("first", "second", "absolute"))
    assert (first.relative, absolute.relative) == ({"a.y"}, frozenset())
    (compared,) = (signal for signal in compare_runs(first, second).signals if signal.name == "a.y")
    np.testing.assert_array_equal(compared.difference, 0.0)
