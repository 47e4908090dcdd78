"""Every type of FMI 3.0 from FMU to FMU. Truth: the receiver, written in C, counts values that differ."""

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from tests.support.builders import component, connection, document, pack, system
from tests.support.fmi3.strict_fmu import strict_fmu


@pytest.mark.parametrize("events", [False, True])
@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_all_types_arrive_as_sent(strict_pair, events, algorithm):
    """Among them 2^53 + 1 and 2^64 - 1, which no float64 is, a Binary with zeros, 0.1 in single precision."""
    flight = perilune.simulate(strict_pair(events=events), algorithm=algorithm)
    assert flight.status == "stop_time"
    assert flight.signals["sink.mismatches"].tolist() == [0.0] * 9
    assert flight.signals["source.mismatches"].any()  # it keeps its starts, while its outputs go on
    assert flight.signals["source.wide"][-1] == float(2**53 + 1 + 8)  # rounded in the record only


def test_integer_beyond_the_receivers_type_ends_the_flight(tmp_path):
    strict_fmu(tmp_path)
    root = system(
        component("source", "strict", "output wide Integer"),
        component("sink", "strict", "input small_in Integer; output small Integer"),
        connections=connection("source.wide", "sink.small_in"),
    )
    flight = perilune.simulate(str(pack(tmp_path / "t.ssp", tmp_path, document(root))))
    assert flight.status == "nonfinite"
    assert flight.message == "sink.small_in is 9007199254740992.0, beyond the limits of Int8, at t = 0 s"


@pytest.mark.parametrize("number", [2**53 + 1, -(2**63), 2**63 - 1])
def test_whole_numbers_of_64_bits_are_set_exactly(tmp_path, number):
    """A parameter that an FMU changes would be refused when it is read back."""
    flight = perilune.simulate(str(strict_fmu(tmp_path)), set={"Strict.wide_in": number}, record=["wide_in"])
    assert flight.status == "stop_time"
    assert flight.signals["Strict.wide_in"].tolist() == [float(number)] * 5
    assert flight.provenance["parameters"]["Strict.wide_in"] == number


def test_columns_of_whole_numbers_are_wide_enough(tmp_path):
    flight = perilune.simulate(str(strict_fmu(tmp_path)))
    for suffix in ("parquet", "csv"):
        flight.write(tmp_path / f"flight.{suffix}")
    table = pyarrow.parquet.read_table(tmp_path / "flight.parquet")
    assert [str(table[f"Strict.{name}"].type) for name in ("small", "wide", "wider")] == ["int32", "int64", "double"]
    assert table["Strict.wide"].to_pylist() == flight.signals["Strict.wide"].tolist()
    assert (tmp_path / "flight.csv").read_text().splitlines()[-1].split(",")[
        table.column_names.index("Strict.small")
    ] == "-46"


def test_whole_arrays_and_elements_are_set(tmp_path):
    """y' = gain u, constant: u as a whole; of gain an element, the other keeps its start; n sizes both."""
    path = str(strict_fmu(tmp_path))
    settings = {"Strict.n": 3, "Strict.gain": [4, 5, 6], "Strict.u": "1,2,3"}
    whole = perilune.simulate(path, set=settings)
    assert [whole.signals[f"Strict.y[{n}]"][-1] for n in (1, 2, 3)] == [4.0, 10.0, 18.0]
    part = perilune.simulate(path, set={"Strict.gain[1]": 8, "Strict.u": [1, 1]})
    assert [part.signals[f"Strict.y[{n}]"][-1] for n in (1, 2)] == [8.0, 2.0]
    empty = perilune.simulate(path, set={"Strict.n": 0})
    assert "Strict.y[1]" not in empty.signals


def test_sizes_in_the_bindings_of_a_description(tmp_path):
    """A component's own, overridden by the system's, as all parameters are."""
    strict_fmu(tmp_path)
    inner = '<ssd:ParameterBinding prefix="">{}</ssd:ParameterBinding>'
    values = '<ssd:ParameterValues><ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>{}</ssv:Parameters>'
    values += "</ssv:ParameterSet></ssd:ParameterValues>"
    one = '<ssv:Parameter name="{}"><ssv:Integer value="{}"/></ssv:Parameter>'
    own_values = inner.format(values.format(one.format("n", 4)))
    outer = inner.format(values.format(one.format("first.n", 1)))
    root = system(
        component("first", "strict", "output y[1] Real", bindings=own_values),
        component("second", "strict", "output y[4] Real", bindings=own_values),
        bindings=outer,
    )
    settings = {f"second.{array}[{element}]": 1.0 for array in ("gain", "u") for element in (1, 2, 3, 4)}
    flight = perilune.simulate(str(pack(tmp_path / "t.ssp", tmp_path, document(root))), set=settings)
    assert {name for name in flight.signals if ".y[" in name} == {
        "first.y[1]",
        *(f"second.y[{element}]" for element in (1, 2, 3, 4)),
    }
    assert np.array_equal(flight.signals["second.y[4]"], flight.time)
