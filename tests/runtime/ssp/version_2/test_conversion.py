"""Documents converted to SSP 2.0: valid by its schemas, smaller, and with the same elements when flattened.

Truth: the description before conversion; the schemas of SSP 2.0; generated documents known element by element.
"""

from __future__ import annotations

import itertools
from dataclasses import replace
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from perilune.analysis.runtime.ssp.dimensions import array_shapes, element_names
from perilune.analysis.runtime.ssp.documents import NAMESPACES, check_schema, children
from perilune.analysis.runtime.ssp.parameter_sets import read_parameter_set
from perilune.analysis.runtime.ssp.ssd_reader import read_ssd
from perilune.analysis.runtime.ssp.version_2.descriptions import convert_description
from perilune.analysis.runtime.ssp.version_2.element_values import merge_values
from perilune.analysis.runtime.ssp.version_2.fmu_arrays import arrays_of_fmu
from perilune.analysis.runtime.ssp.version_2.package import convert_package
from perilune.analysis.runtime.ssp.version_2.trees import to_version_2
from perilune.analysis.runtime.system.arrays.elements import expand_arrays
from perilune.analysis.runtime.system.arrays.sizes import Sizes, walk
from perilune.fmus_src.export.archive import read_zip
from tests.support.builders import NAMESPACES as SPACES
from tests.support.builders import (
    component,
    connection,
    document,
    external,
    fly,
    inline,
    mapping,
    pack,
    parameter_set,
    system,
    write_zip,
)

OTHERS = ("set.ssv", "map.ssm", "bus.ssb")
SHAPES = {"one.y": (3,), "one.m": (2, 2), "two.u": (3,), "two.v": (2, 2), "two.w": (3,)}
SCALARS = {"one.y": (), "two.w": ()}


def arrays_of(shapes):
    """Return the arrays of each source's FMU."""
    return lambda source: {
        name.partition(".")[2]: shape
        for name, shape in shapes.items()
        if name.partition(".")[0] == source.removeprefix("resources/").removesuffix(".fmu") and shape
    }


def written(connections="", binding="", shapes=SHAPES):
    """Return a system of two components with an element each for all elements of their arrays."""
    components = []
    for part in ("one", "two"):
        declared = "; ".join(
            f"{'output' if part == 'one' else 'input'} {each} Real m"
            for name, shape in shapes.items()
            if name.startswith(part)
            for each in element_names(name.partition(".")[2], shape)
        )
        components.append(component(part, part, declared, binding if part == "one" else ""))
    return document(system(*components, connections=connections))


def flattened(text, shapes):
    """Return connectors and connections of a document, array by array replaced by elements;
    lines and names of types apart."""

    def load(name, element):
        names = {
            each: SimpleNamespace(start=None)
            for array, shape in shapes.items()
            if array.startswith(f"{name}.")
            for each in element_names(array.partition(".")[2], shape)
        }
        return SimpleNamespace(label=name, variables=names, description=SimpleNamespace(fmiVersion="3.0"))

    description = read_ssd(text, "s.ssd", lambda name, element: b"")
    root = expand_arrays(description, Sizes(description, dict, load)).system
    connectors = {
        f"{path}{owner.name}.{name}": replace(each, line=0, exact_type=None, array="")
        for path, inner in walk(root)
        for owner in (inner, *inner.elements.values())
        for name, each in owner.connectors.items()
    }
    connections = {
        (each.start, each.end, each.suppress_unit_conversion, each.transformation)
        for _, inner in walk(root)
        for each in inner.connections
    }
    return connectors, connections


def converted(text, shapes=SHAPES):
    root, bound = convert_description(etree.fromstring(text.encode()), arrays_of(shapes))
    check_schema(root, "ssd", "s.ssd")
    return etree.tostring(root), root, bound


def wires_of(pairs):
    return "".join(
        connection(start, end, inner, 'suppressUnitConversion="true"' if suppressed else "")
        for start, end, inner, suppressed in pairs
    )


STARTS = [each for name in ("one.y", "one.m") for each in element_names(name, SHAPES[name])]
ENDS = [each for name in ("two.u", "two.v", "two.w") for each in element_names(name, SHAPES[name])]
ENDINGS = st.sampled_from(["", '<ssc:LinearTransformation factor="2" offset="0.5"/>'])


@st.composite
def connected(draw):
    """Draw connections of elements, an element driven once: whole arrays, slices of them, in any order."""
    pairs = []
    for array in ("two.u", "two.v", "two.w"):
        ends = element_names(array, SHAPES[array])
        source = draw(st.sampled_from(["one.y", "one.m", "any", "none"]))
        inner, suppressed = draw(ENDINGS), draw(st.booleans())
        if source in ("one.y", "one.m") and SHAPES[source] == SHAPES[array]:
            pairs += [
                (start, end, inner, suppressed)
                for start, end in zip(element_names(source, SHAPES[source]), ends, strict=True)
            ]
        elif source == "any":
            pairs += [
                (draw(st.sampled_from(STARTS)), end, draw(ENDINGS), suppressed) for end in ends if draw(st.booleans())
            ]
    return draw(st.permutations(pairs))


@given(connected(), st.booleans())
def test_the_elements_are_those_of_before(pairs, has_arrays):
    shapes = SHAPES if has_arrays else {}
    text = written(wires_of(pairs))
    after, root, _ = converted(text, shapes)
    before = flattened(text.encode(), SHAPES)
    assert flattened(after, SHAPES) == before
    names = [each.get("name") for each in root.iter(f"{{{NAMESPACES['ssd']}}}Connector")]
    assert any("[" in name for name in names) != has_arrays
    twice, _, _ = converted(after.decode(), shapes)
    assert flattened(twice, SHAPES) == before


def test_a_whole_array_is_one_connector_and_one_connection():
    pairs = [(f"one.y{index}", f"two.u{index}", "", False) for index in ("[1]", "[2]", "[3]")]
    _, root, _ = converted(written(wires_of(pairs)))
    (only,) = root.iter(f"{{{NAMESPACES['ssd']}}}Connection")
    assert dict(only.attrib) == {
        "startElement": "one",
        "startConnector": "y",
        "endElement": "two",
        "endConnector": "u",
    }
    sizes = {
        each.get("name"): [inner.get("size") for inner in children(each, "ssc:Dimension")]
        for each in root.iter(f"{{{NAMESPACES['ssd']}}}Connector")
    }
    assert sizes == {"y": ["3"], "m": ["2", "2"], "u": ["3"], "v": ["2", "2"], "w": ["3"]}


def test_part_of_an_array_is_connected_by_indices():
    pairs = [("one.m[2,1]", "two.u[3]", "", False)]
    _, root, _ = converted(written(wires_of(pairs)))
    (only,) = root.iter(f"{{{NAMESPACES['ssd']}}}Connection")
    assert (only.get("startConnector"), only.get("startIndices")) == ("m", "2 1")
    assert (only.get("endConnector"), only.get("endIndices")) == ("u", "3")


def test_arrays_of_systems_are_one_connector_whatever_the_fmus_have():
    inner = system(
        component("two", "two", "input u[1] Real m; input u[2] Real m"),
        name="inner",
        declared="input a[1] Real m; input a[2] Real m; input b[2] Real m",
        connections=connection("a[1]", "two.u[1]") + connection("a[2]", "two.u[2]"),
    )
    outer = system(
        inner,
        declared="input a[1] Real m; input a[2] Real m; input c[1] Real m; input c[2] Integer",
        connections=connection("a[1]", "inner.a[1]") + connection("a[2]", "inner.a[2]"),
    )
    text = document(outer)
    after, root, _ = converted(text, {})
    assert [each.get("name") for each in root.iter(f"{{{NAMESPACES['ssd']}}}Connector")] == [
        "a",
        "c[1]",
        "c[2]",
        "a",
        "b[2]",
        "u[1]",
        "u[2]",
    ]
    inner_wires = [dict(each.attrib) for each in root.iter(f"{{{NAMESPACES['ssd']}}}Connection")]
    assert {"startConnector": "a", "startIndices": "1", "endElement": "two", "endConnector": "u[1]"} in inner_wires
    assert {"startConnector": "a", "endElement": "inner", "endConnector": "a"} in inner_wires
    assert flattened(after, {}) == flattened(text.encode(), {})


NUMBERS = st.floats(allow_nan=False, allow_infinity=False).map(repr)


@given(st.dictionaries(st.sampled_from([*element_names("y", (3,)), *element_names("m", (2, 2)), "k"]), NUMBERS))
def test_values_are_those_of_before(values):
    text = parameter_set("; ".join(f"{name}=Real:{number} m" for name, number in values.items()))
    root = etree.fromstring(text)
    before = {each.name: each.value for each in read_parameter_set(root, "s.ssv")}
    to_version_2(root)
    merge_values(root, {"y": (3,), "m": (2, 2)})
    after = {each.name: each.value for each in read_parameter_set(root, "s.ssv")}
    assert after == before == {name: float(number) for name, number in values.items()}
    count = len(root.findall(".//{*}Parameter"))
    whole = [shape for name, shape in (("y", (3,)), ("m", (2, 2))) if set(element_names(name, shape)) <= set(values)]
    assert count == len(values) - sum(len(element_names("x", shape)) - 1 for shape in whole)


def test_values_of_different_units_or_types_stay():
    root = etree.fromstring(parameter_set("y[1]=Real:1 m; y[2]=Real:2 km; y[3]=Real:3 m"))
    to_version_2(root)
    merge_values(root, {"y": (3,)})
    assert [each.get("name") for each in root.findall(".//{*}Parameter")] == ["y[1]", "y[2]", "y[3]"]


def test_texts_are_elements():
    root = etree.fromstring(parameter_set("y[1]=String:one; y[2]=String:two").replace('"two"', '"two words"'))
    to_version_2(root)
    merge_values(root, {"y": (2,)})
    assert [each.get("value") for each in root.findall(".//{*}Value")] == ["one", "two words"]
    assert [(each.name, each.value) for each in read_parameter_set(root, "s.ssv")] == [
        ("y[1]", "one"),
        ("y[2]", "two words"),
    ]


def test_values_behind_a_mapping_stay_elements():
    given_here = inline("y[1]=Real:1 m; y[2]=Real:2 m; y[3]=Real:3 m")
    mapping = (
        '<ssd:ParameterMapping><ssm:ParameterMapping version="1.0"><ssm:MappingEntry source="y[1]" target="y[1]"/>'
        "</ssm:ParameterMapping></ssd:ParameterMapping></ssd:ParameterBinding>"
    )
    _, plain, _ = converted(written(binding=given_here))
    _, mapped, _ = converted(written(binding=given_here.replace("</ssd:ParameterBinding>", mapping)))
    assert [len(root.findall(".//{*}Parameter")) for root in (plain, mapped)] == [1, 3]


def test_all_documents_of_a_package_are_of_version_2(tiny, tmp_path):
    entry = '<ssm:MappingEntry source="a" target="start"><ssc:LinearTransformation factor="2"/></ssm:MappingEntry>'
    entries = '<ssb:DictionaryEntry name="y"><ssc:Real unit="m"/></ssb:DictionaryEntry>'
    units = '<ssb:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssb:Units>'
    bus = (
        '<ssd:SignalDictionaries><ssd:SignalDictionary name="bus" source="resources/bus.ssb"/></ssd:SignalDictionaries>'
    )
    reference = (
        '<ssd:SignalDictionaryReference name="here" dictionary="bus"><ssd:Connectors>'
        '<ssd:Connector name="y" kind="inout"/></ssd:Connectors></ssd:SignalDictionaryReference>'
    )
    binding = external("resources/set.ssv", mapping='<ssd:ParameterMapping source="resources/map.ssm"/>')
    root = system(
        component("ramp", "ramp", "output y Real m", binding),
        reference,
        connections=connection("ramp.y", "here.y"),
        extra=bus,
    )
    path = pack(
        tmp_path / "s.ssp",
        tiny,
        document(root),
        resources___set__ssv=parameter_set("a=Real:3 m"),
        resources___map__ssm=mapping(entry),
        resources___bus__ssb=f'<ssb:SignalDictionary version="1.0" {SPACES}>{entries}{units}</ssb:SignalDictionary>',
    )
    files = convert_package(read_zip(path), "s.ssp")
    for name, kind in (("SystemStructure.ssd", "ssd"), *((f"resources/{each}", each[-3:]) for each in OTHERS)):
        converted_root = etree.fromstring(files[name])
        assert converted_root.get("version") == "2.0"
        check_schema(converted_root, kind, name)
        assert b"ssc:Real" not in files[name]
        assert b"ssv:Real" not in files[name]
    assert files["resources/ramp.fmu"] == (tiny / "ramp.fmu").read_bytes()
    for each in (path, write_zip(tmp_path / "t.ssp", files)):
        assert fly(each)["bus.y"][0] == 6.0


@pytest.mark.parametrize(
    ("variables", "expected"),
    [
        ('<Float64 name="x" valueReference="1"><Dimension start="3"/></Float64>', {"x": (3,)}),
        (
            '<UInt64 name="n" valueReference="2" causality="structuralParameter" start="4"/>'
            '<Float64 name="x" valueReference="1"><Dimension valueReference="2"/><Dimension start="2"/></Float64>'
            '<Float64 name="s" valueReference="3"/>',
            {"x": (4, 2)},
        ),
    ],
)
def test_arrays_of_an_fmu(variables, expected):
    text = '<fmiModelDescription fmiVersion="{}"><ModelVariables>{}</ModelVariables></fmiModelDescription>'
    assert arrays_of_fmu(etree.fromstring(text.format("3.0", variables))) == expected
    assert arrays_of_fmu(etree.fromstring(text.format("2.0", variables))) == {}


def test_arrays_are_those_of_which_every_element_is_there():
    names = [
        "a[1]",
        "a[2]",
        "b[1,1]",
        "b[1,2]",
        "b[2,1]",
        "b[2,2]",
        "c[1]",
        "c[3]",
        "d[1]",
        "d[1,1]",
        "e",
        "e[1]",
        "f[0]",
    ]
    for order in itertools.islice(itertools.permutations(names), 0, 40320, 997):
        assert array_shapes(order) == {"a": (2,), "b": (2, 2)}
