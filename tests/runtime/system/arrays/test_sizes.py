"""Sizes of arrays from structural parameters: by parameter sets and options, through systems; missing sizes.

Truth: numbers of elements by hand; the precedence of values in SSP 2.0, ParameterBindings. FMUs of FMI 2.0 have no
structural parameters, so these belong to systems.
"""

from types import SimpleNamespace

import pytest

from perilune.analysis.runtime.ssp.dimensions import Dimension
from perilune.analysis.runtime.ssp.ssd_reader import read_ssd
from perilune.analysis.runtime.system.arrays.sizes import Sizes
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.arrays.documents import in_version_2
from tests.support.builders import component, connection, document, inline, pack, parameter_set, system

GAIN = component("gain", "three_gain", "input u(3) Float64 m")
INNER = "structuralParameter n UInt64; input in(n) Float64 m"


def inputs(tmp_path, fmus, root, **options):
    path = pack(tmp_path / "s.ssp", fmus, in_version_2(document(root)), **options.pop("files", {}))
    network = prepare_system(path, SystemOptions(open_inputs="start", **options)).network
    return [node.name for node in network.nodes.values() if node.component is None and node.kind == "input"]


def nested(inner="", outer="", declared=""):
    """Return a system with an inner one, whose input has as many elements as its structural parameter says."""
    wires = connection("m", "inner.n") if declared else ""
    return system(
        system(GAIN, name="inner", declared=INNER, bindings=inner, connections=connection("in", "gain.u")),
        bindings=outer,
        declared=declared,
        connections=wires,
    )


THREE = ["inner.in[1]", "inner.in[2]", "inner.in[3]"]


def test_from_the_parameter_set_of_the_system(array_fmus, tmp_path):
    assert inputs(tmp_path, array_fmus, nested(inner=inline("n=UInt64:3"))) == THREE


def test_the_outer_value_wins(array_fmus, tmp_path):
    assert inputs(tmp_path, array_fmus, nested(inline("n=UInt64:2"), inline("inner.n=UInt64:3"))) == THREE


def test_options_win_over_all(array_fmus, tmp_path):
    root = nested(inline("n=UInt64:2"), inline("inner.n=UInt64:1"))
    assert inputs(tmp_path, array_fmus, root, set={"inner.n": 3}) == THREE
    files = {"resources___three__ssv": in_version_2(parameter_set("inner.n=UInt64:3"))}
    assert inputs(tmp_path, array_fmus, root, files=files, parameters=("three",)) == THREE


def test_through_a_connection(array_fmus, tmp_path):
    root = nested(inline("n=UInt64:2"), inline("m=UInt64:3"), declared="structuralParameter m UInt64")
    assert inputs(tmp_path, array_fmus, root) == THREE


def test_of_a_component_it_is_what_the_fmu_declares_unless_it_is_given(tmp_path):
    declared = {name: SimpleNamespace(start=start) for name, start in (("n", "4"), ("m", None))}
    text = document(
        system(component("c", "c", "structuralParameter n UInt64; constant m UInt64; input in(n) Float64 m"))
    )
    description = read_ssd(in_version_2(text).encode(), "s.ssd", lambda name, element: b"")
    component_ = description.system.elements["c"]
    for given, expected in (({}, 4), ({"c.n": 2}, 2), ({"c.m": 2}, 4)):
        sizes = Sizes(description, lambda given=given: given, lambda name, element: SimpleNamespace(variables=declared))
        assert sizes.size(component_, "c.", Dimension(None, "n", 1), "in") == expected


@pytest.mark.parametrize(
    ("root", "words"),
    [
        (
            nested(),
            r"inner\.in, Dimension \(line \d+\): inner\.n has no value; give this parameter a value in a parameter set",
        ),
        (nested(inline("n=UInt64:2")), r"connection in -> gain\.u \(line \d+\): connects 2 elements with 3 elements"),
        (
            nested(inline("n=Float64:2.5")),
            r"inner\.in, Dimension \(line \d+\): inner\.n is 2\.5, which is not a valid size",
        ),
        (
            system(GAIN, declared="parameter n UInt64; input in(n) Float64 m"),
            r"in, Dimension \(line \d+\): sizeConnector n is neither a structural parameter nor a constant of root",
        ),
        (
            system(GAIN, declared="input in(k) Float64 m"),
            r"in, Dimension \(line \d+\): sizeConnector k is neither a structural parameter nor a constant of root",
        ),
    ],
)
def test_without_a_size_is_refused_in_one_line(array_fmus, tmp_path, root, words):
    with pytest.raises(InputError, match=words) as refusal:
        inputs(tmp_path, array_fmus, root)
    assert "\n" not in refusal.value.text


def test_size_and_its_connector_exclude_each_other(array_fmus, tmp_path):
    text = in_version_2(document(system(GAIN))).replace('size="3"', 'size="3" sizeConnector="n"')
    with pytest.raises(InputError, match=r"u, Dimension \(line \d+\): has both size and sizeConnector; remove one"):
        prepare_system(pack(tmp_path / "s.ssp", array_fmus, text), SystemOptions())
