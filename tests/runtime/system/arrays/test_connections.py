"""Connections of arrays, elements and rows, between components, through systems and dictionaries.

Truth: the closed forms of the FMUs; the rules of SSP 2.0 (indices from 1, arrays of one shape).
"""

import numpy as np
import pytest

from perilune.common.errors import InputError
from tests.support.arrays.documents import in_version_2
from tests.support.builders import component, connection, document, fly, inline, pack, system

THREE = component("three", "three", "output y(3) Float64 m")
GAIN = component("gain", "three_gain", "input u(3) Float64 m; output y(3) Float64 m")
GRID = component("grid", "grid", "output y(2,3) Float64 m")
GRID_GAIN = component("other", "grid_gain", "input u(2,3) Float64 m; output y(2,3) Float64 m")
STARTS = np.array([1.0, 2.0, 3.0])


def flown(tmp_path, fmus, *elements, **options):
    """Run a system of these elements, as SSP 2.0."""
    flight = {name: options.pop(name) for name in ("open_inputs",) if name in options}
    return fly(pack(tmp_path / "s.ssp", fmus, in_version_2(document(system(*elements, **options)))), **flight)


def values(run, name, shape):
    """Return an array of the run, first sample and last."""
    elements = [f"{name}[{','.join(str(each + 1) for each in index)}]" for index in np.ndindex(*shape)]
    return [np.array([run[each][sample] for each in elements]).reshape(shape) for sample in (0, -1)]


def test_vector_to_vector(array_fmus, tmp_path):
    run = flown(tmp_path, array_fmus, THREE, GAIN, connections=connection("three.y", "gain.u"))
    first, last = values(run, "gain.y", (3,))
    np.testing.assert_array_equal(first, 2.0 * STARTS)
    np.testing.assert_array_equal(last, 2.0 * (STARTS + np.array([1.0, 2.0, 3.0])))


def test_matrix_to_matrix_and_its_row_to_a_vector(array_fmus, tmp_path):
    wires = connection("grid.y", "other.u") + connection("grid.y", "gain.u", attributes='startIndices="2"')
    run = flown(tmp_path, array_fmus, GRID, GRID_GAIN, GAIN, connections=wires)
    starts = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    np.testing.assert_array_equal(values(run, "other.y", (2, 3))[0], 2.0 * starts)
    np.testing.assert_array_equal(values(run, "other.y", (2, 3))[1], 4.0 * starts)
    np.testing.assert_array_equal(values(run, "gain.y", (3,))[0], 2.0 * starts[1])


def test_elements_in_another_order_and_from_a_scalar(array_fmus, tmp_path):
    wires = "".join(
        connection("three.y", "gain.u", attributes=f'startIndices="{start}" endIndices="{end}"')
        for start, end in ((3, 1), (1, 3))
    )
    wires += connection("input", "gain.u", attributes='endIndices="2"')
    bindings = inline("input=Float64:9 m")
    run = flown(
        tmp_path, array_fmus, THREE, GAIN, connections=wires, declared="input input Float64 m", bindings=bindings
    )
    np.testing.assert_array_equal(values(run, "gain.u", (3,))[0], [3.0, 9.0, 1.0])


def test_units_and_transformations_apply_to_each_element(array_fmus, tmp_path):
    wires = connection("three.y", "out", '<ssc:LinearTransformation factor="2" offset="1"/>')
    run = flown(tmp_path, array_fmus, THREE, connections=wires, declared="output out(3) Float64 km")
    np.testing.assert_allclose(values(run, "out", (3,))[0], 2.0 * STARTS / 1000.0 + 1.0, rtol=1e-15)


@pytest.mark.parametrize("size", ["3", "?"])
def test_through_systems_whose_size_may_be_open(array_fmus, tmp_path, size):
    inner = system(
        GAIN,
        name="inner",
        declared=f"input in({size}) Float64 m; local out({size}) Float64 m",
        connections=connection("in", "gain.u") + connection("out", "gain.y"),
    )
    wires = connection("inner.in", "three.y") + connection("inner.out", "total")
    run = flown(tmp_path, array_fmus, THREE, inner, connections=wires, declared=f"output total({size}) Float64 m")
    np.testing.assert_array_equal(values(run, "total", (3,))[0], 2.0 * STARTS)


def test_over_a_signal_dictionary(array_fmus, tmp_path):
    entries = '<ssb:DictionaryEntry name="y"><ssc:Float64 unit="m"/><ssc:Dimension size="3"/></ssb:DictionaryEntry>'
    units = '<ssb:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssb:Units>'
    content = f'<ssb:SignalDictionary version="1.0">{entries}{units}</ssb:SignalDictionary>'
    bus = f'<ssd:SignalDictionary name="bus">{content}</ssd:SignalDictionary>'
    extra = f"<ssd:SignalDictionaries>{bus}</ssd:SignalDictionaries>"
    reference = (
        '<ssd:SignalDictionaryReference name="here" dictionary="bus"><ssd:Connectors>'
        '<ssd:Connector name="y" kind="inout"><ssc:Float64 unit="m"/><ssc:Dimension size="3"/></ssd:Connector>'
        "</ssd:Connectors></ssd:SignalDictionaryReference>"
    )
    wires = connection("three.y", "here.y") + connection("here.y", "gain.u")
    run = flown(tmp_path, array_fmus, THREE, GAIN, reference, connections=wires, extra=extra)
    np.testing.assert_array_equal(values(run, "bus.y", (3,))[0], STARTS)
    np.testing.assert_array_equal(values(run, "gain.y", (3,))[0], 2.0 * STARTS)


SCALAR = component("scalar", "ramp", "output y Float64 m")
REFUSED = {
    "another size than the FMU's": (
        {"elements": [component("three", "three", "output y(4) Float64 m")]},
        r"three\.y \(line \d+\): has 3 elements in .*, but 4 here",
    ),
    "another number of dimensions": (
        {"elements": [component("grid", "grid", "output y(6) Float64 m")]},
        r"grid\.y \(line \d+\): has 2 x 3 elements in .*, but 6 here",
    ),
    "no array of the FMU": (
        {"elements": [component("three", "three", "output count(3) Int32")]},
        r"three\.count \(line \d+\): is a scalar in ",
    ),
    "nothing of the FMU": (
        {"elements": [component("three", "three", "output z(3) Float64")]},
        r"three\.z \(line \d+\): is not an array of ",
    ),
    "a size of nobody": (
        {"elements": [THREE], "declared": "input in(?) Float64 m"},
        r"in \(line \d+\): dimension 1 has no size, neither here nor at a connected end",
    ),
    "a vector to a matrix": (
        {"elements": [THREE, GRID_GAIN], "connections": connection("three.y", "other.u")},
        r"connection three\.y -> other\.u \(line \d+\): connects 3 elements with 2 x 3 elements",
    ),
    "an element to a vector": (
        {"elements": [THREE, GAIN], "connections": connection("three.y", "gain.u", attributes='startIndices="1"')},
        r"connects a scalar with 3 elements",
    ),
    "an index beyond the end": (
        {
            "elements": [THREE, GAIN],
            "connections": connection("three.y", "gain.u", attributes='startIndices="4" endIndices="1"'),
        },
        r"no element 4 in three\.y, 3 elements",
    ),
    "an index too many": (
        {
            "elements": [THREE, GAIN],
            "connections": connection("three.y", "gain.u", attributes='startIndices="1 1" endIndices="1"'),
        },
        r"no element 1 1 in three\.y, 3 elements",
    ),
    "an index of a scalar": (
        {
            "elements": [THREE],
            "declared": "output out Float64 m",
            "connections": connection("three.y", "out", attributes='startIndices="1" endIndices="1"'),
        },
        r"no element 1 in out, a scalar",
    ),
    "index 0": (
        {
            "elements": [THREE, GAIN],
            "connections": connection("three.y", "gain.u", attributes='startIndices="0" endIndices="1"'),
        },
        r"Connection, startIndices \(line \d+\): 0 is not an index; count from 1",
    ),
    "an element driven twice": (
        {
            "elements": [THREE, GAIN],
            "connections": connection("three.y", "gain.u")
            + connection("three.y", "gain.u", attributes='startIndices="1" endIndices="2"'),
        },
        r"gain\.u\[2\] is driven twice",
    ),
    "an element of a name of its own": (
        {"elements": [THREE], "declared": "input in(2) Float64 m; input in[1] Float64 m"},
        r"in\[1\] \(line \d+\): is also declared in line \d+",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_does_not_fit_is_refused_in_one_line(array_fmus, tmp_path, name):
    options, words = REFUSED[name]
    with pytest.raises(InputError, match=words) as refusal:
        flown(tmp_path, array_fmus, *options["elements"], **{k: v for k, v in options.items() if k != "elements"})
    assert "\n" not in refusal.value.text


def test_too_many_elements_are_refused_before_they_are_made(array_fmus, tmp_path):
    with pytest.raises(InputError, match=r"arrays of a description: 1e\+24 elements, at most 1e\+06 are accepted"):
        flown(tmp_path, array_fmus, THREE, declared="input in(1000000000000,1000000000000) Float64 m")
