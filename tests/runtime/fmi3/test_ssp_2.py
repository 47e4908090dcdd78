"""SSP 2.0 with FMUs of FMI 3.0: array connectors for array variables, both sized by structural parameters.

Truth: the strict FMU integrates y' = gain u by Euler's method, element by element; numpy repeats the integration.
"""

import numpy as np
import pytest
from lxml import etree

import perilune
from perilune.analysis.runtime.ssp.documents import check_schema
from perilune.analysis.runtime.ssp.version_2.package import convert_package
from perilune.common.errors import InputError
from perilune.fmus_src.export.archive import read_zip
from tests.support.arrays.documents import in_version_2
from tests.support.builders import component, connection, document, inline, pack, system, write_zip
from tests.support.fmi3.strict_fmu import strict_fmu

DECLARED = "structuralParameter n UInt64; parameter gain({0}) Float64; input u({0}) Float64; output y({0}) Float64"
GAINS = {"one": [1.0, 2.0, 3.0], "two": [0.5, 0.25, 4.0]}
INPUT = np.array([2.0, -1.0, 0.5])


def strict(name, size, bindings=""):
    return component(name, "strict", DECLARED.format(size), bindings)


def written(size, bindings=("", ""), outer="m=UInt64:3; in(3)=Float64:2,-1,0.5"):
    """Return two in a row, whose sizes are that of the system's structural parameter."""
    wires = [("m", "one.n"), ("m", "two.n"), ("in", "one.u"), ("one.y", "two.u"), ("two.y", "out")]
    return in_version_2(
        document(
            system(
                *(strict(name, size, each) for name, each in zip(GAINS, bindings, strict=True)),
                declared="structuralParameter m UInt64; input in(m) Float64; output out(?) Float64",
                bindings=inline(outer),
                connections="".join(connection(start, end) for start, end in wires),
            )
        )
    )


def given_gains():
    return [inline(f"gain(3)=Float64:{','.join(map(str, gains))}") for gains in GAINS.values()]


def expected(time):
    """Return the outputs of both, by Euler's steps with the inputs of each step's start."""
    first, second = np.zeros((len(time), 3)), np.zeros((len(time), 3))
    for step, length in enumerate(np.diff(time)):
        first[step + 1] = first[step] + length * np.array(GAINS["one"]) * INPUT
        second[step + 1] = second[step] + length * np.array(GAINS["two"]) * first[step]
    return first, second


def elements(flight, name):
    return np.column_stack([flight.signals[f"{name}[{each}]"] for each in (1, 2, 3)])


@pytest.mark.parametrize("size", ["n", "?", "3"])
def test_arrays_sized_through_a_connection(tmp_path, size):
    strict_fmu(tmp_path)
    flight = perilune.simulate(str(pack(tmp_path / "s.ssp", tmp_path, written(size, given_gains()))))
    first, second = expected(flight.time)
    np.testing.assert_allclose(elements(flight, "one.y"), first, rtol=1e-15)
    np.testing.assert_allclose(elements(flight, "out"), second, rtol=1e-15)


def test_arrays_of_two_elements_as_the_fmu_declares_them(tmp_path):
    strict_fmu(tmp_path)
    root = system(strict("one", "n"), declared="input in(2) Float64", connections=connection("in", "one.u"))
    path = str(pack(tmp_path / "s.ssp", tmp_path, in_version_2(document(root))))
    flight = perilune.simulate(path, set={"in": [3.0, 5.0]})
    assert [flight.signals[f"one.y[{each}]"][-1] for each in (1, 2)] == [3.0, 10.0]
    assert "one.y[3]" not in flight.signals


def test_another_size_than_the_fmu_has_is_refused(tmp_path):
    strict_fmu(tmp_path)
    with pytest.raises(InputError, match=r"one\.gain \(line \d+\): has 3 elements in .*, but 2 here"):
        perilune.simulate(str(pack(tmp_path / "s.ssp", tmp_path, written("2", given_gains()))))
    with pytest.raises(
        InputError,
        match=r"in, Dimension \(line \d+\): m is 2\.5, which is not a valid size; give this parameter a value",
    ):
        perilune.simulate(str(pack(tmp_path / "t.ssp", tmp_path, written("n", outer="m=Float64:2.5"))))


def test_written_with_elements_it_is_converted_to_arrays_and_flies_alike(tmp_path):
    strict_fmu(tmp_path)
    names = "; ".join(f"input u[{each}] Real; output y[{each}] Real; parameter gain[{each}] Real" for each in (1, 2))
    wires = "".join(connection(f"one.y[{each}]", f"two.u[{each}]") for each in (1, 2))
    wires += "".join(connection(f"in[{each}]", f"one.u[{each}]") for each in (1, 2))
    root = system(
        component("one", "strict", names, inline("gain[1]=Real:3; gain[2]=Real:4")),
        component("two", "strict", names),
        declared="input in[1] Real; input in[2] Real",
        bindings=inline("in[1]=Real:7; in[2]=Real:8"),
        connections=wires,
    )
    path = pack(tmp_path / "s.ssp", tmp_path, document(root))
    files = convert_package(read_zip(path), "s.ssp")
    description = etree.fromstring(files["SystemStructure.ssd"])
    check_schema(description, "ssd", "s.ssd")
    assert {each.get("name") for each in description.iterfind(".//{*}Connector")} == {"u", "y", "gain", "in"}
    assert len(description.findall(".//{*}Connection")) == 2
    assert {each.get("name") for each in description.iterfind(".//{*}Parameter")} == {"gain", "in"}
    one, two = (perilune.simulate(str(each)) for each in (path, write_zip(tmp_path / "t.ssp", files)))
    assert list(one.signals) == list(two.signals)
    for name, values in one.signals.items():
        np.testing.assert_array_equal(two.signals[name], values)
    assert one.signals["one.y[2]"][-1] == 32.0


def test_part_of_an_array_is_connected_and_the_other_part_keeps_its_start(tmp_path):
    """As an SSD of SSP 1.0 that declares some elements only, which is what it is converted from."""
    strict_fmu(tmp_path)
    root = system(
        component("one", "strict", "input u[1] Real; output y[1] Real; output y[2] Real"),
        declared="input in Real",
        bindings=inline("in=Real:7"),
        connections=connection("in", "one.u[1]"),
    )
    path = pack(tmp_path / "s.ssp", tmp_path, document(root))
    files = convert_package(read_zip(path), "s.ssp")
    for each in (path, write_zip(tmp_path / "t.ssp", files)):
        flight = perilune.simulate(str(each))
        assert [flight.signals[f"one.y[{number}]"][-1] for number in (1, 2)] == [7.0, 0.5]
    text = files["SystemStructure.ssd"].decode()
    text = text.replace(text[text.index("<ssd:Connections>") : text.index("</ssd:Connections>") + 18], "")
    with pytest.raises(InputError, match=r"one\.u\[1\] \(line \d+\), one\.u\[2\] \(line \d+\): 2 inputs are neither"):
        perilune.simulate(str(pack(tmp_path / "u.ssp", tmp_path, text)))


def test_an_array_without_dimensions_is_refused(tmp_path):
    strict_fmu(tmp_path)
    path = pack(tmp_path / "s.ssp", tmp_path, document(system(component("one", "strict", "input u Real"))))
    with pytest.raises(
        InputError, match=r"one\.u \(line \d+\): is an array in .*, but a scalar here; give the connector its Dim"
    ):
        perilune.simulate(str(path))


def test_every_type_by_its_name(tmp_path):
    strict_fmu(tmp_path)
    outputs = "output wide Int64; output wider UInt64; output text String; output blob Binary; output small Int8"
    inputs = "input wide_in Int64; input wider_in UInt64; input text_in String; input blob_in Binary"
    names = [("wide", "wide_in"), ("wider", "wider_in"), ("text", "text_in"), ("blob", "blob_in")]
    names += [("small", "small_in"), ("single", "single_in")]
    root = system(
        component("one", "strict", f"{outputs}; output single(2) Float32"),
        component(
            "two", "strict", f"{inputs}; input small_in Int8; input single_in(2) Float32; output mismatches Int32"
        ),
        connections="".join(connection(f"one.{start}", f"two.{end}") for start, end in names),
    )
    text = in_version_2(document(root))
    flight = perilune.simulate(str(pack(tmp_path / "s.ssp", tmp_path, text)))
    assert flight.signals["two.mismatches"].tolist() == [0.0] * 5
    with pytest.raises(InputError, match=r"one\.wide \(line \d+\): is Int64 in .*, Int32 here"):
        perilune.simulate(str(pack(tmp_path / "t.ssp", tmp_path, text.replace("ssc:Int64", "ssc:Int32"))))
