"""Runs read from tables of Perilune and of other tools, and refusals.

Truth: the written arrays.
"""

import json

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from perilune.analysis.differences.recorded_run import read_run
from perilune.common.errors import InputError
from tests.support.pages.samples import run_result


def refuse(path):
    """Return the refusal of a table."""
    with pytest.raises(InputError) as refused:
        read_run(path)
    return refused.value


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_our_own_tables_come_back_with_units_and_origin(tmp_path, ending):
    result = run_result()
    result.signals["odd, name"] = result.time + 0.125
    result.types["odd, name"] = "Real"
    result.units["odd, name"] = None
    result.provenance["axes"] = {"ship.position[1]": "north"}
    path = tmp_path / f"flight.{ending}"
    result.write(path)
    run = read_run(path)
    np.testing.assert_array_equal(run.time, result.time)
    assert set(run.signals) == set(result.signals)
    for name, values in result.signals.items():
        np.testing.assert_array_equal(run.signals[name], values)
    assert run.units == {name: unit for name, unit in result.units.items() if unit}
    assert run.discrete == {name for name, kind in result.types.items() if kind in ("Integer", "Boolean")}
    assert run.axes == {"ship.position[1]": "north"}
    assert run.origin.startswith(f"{result.provenance['system']}, ")


def test_a_table_of_another_tool_has_names_and_numbers_alone(tmp_path):
    (tmp_path / "other.csv").write_text("time, h, on\n0,1.5,true\n0.5,2,false\n")
    run = read_run(tmp_path / "other.csv")
    assert run.signals["h"].tolist() == [1.5, 2.0]
    assert run.signals["on"].tolist() == [1.0, 0.0]
    assert (run.units, run.discrete, run.origin) == ({}, {"on"}, "")


def test_missing_and_infinite_numbers_are_numbers(tmp_path):
    (tmp_path / "wild.csv").write_text("time,h\n0,nan\n1,inf\n2,\n")
    values = read_run(tmp_path / "wild.csv").signals["h"]
    assert np.isnan(values[[0, 2]]).all()
    assert values[1] == np.inf


@pytest.mark.parametrize(
    ("name", "content", "element", "problem"),
    [
        ("none.csv", None, "", "not found"),
        ("empty.csv", "", "", "cannot be read as a table"),
        ("page.parquet", "<html>", "", "cannot be read as a table"),
        ("still.csv", "t,h\n0,1\n", "time", "no such column"),
        (
            "back.csv",
            "time,h\n1,1\n0,1\n",
            "time",
            "the time in row 2, 0, does not exceed the time in the preceding row",
        ),
        ("head.csv", "time,h\n", "time", "no samples"),
        ("twice.csv", "time,h,h\n0,1,2\n", "h", "there are two columns of this name"),
        ("words.csv", "time,h\n0,high\n", "h", "not a column of numbers"),
    ],
)
def test_what_is_no_run_is_refused_by_name(tmp_path, name, content, element, problem):
    if content is not None:
        (tmp_path / name).write_text(content)
    refusal = refuse(tmp_path / name)
    assert (refusal.element, problem in refusal.problem) == (element, True)
    assert refusal.file == str(tmp_path / name)


@pytest.mark.parametrize("text", ["[]", '{"units": 3}', "{", "[" * 100_000])
def test_a_damaged_document_beside_a_table_is_refused(tmp_path, text):
    (tmp_path / "flight.csv").write_text("time,h\n0,1\n")
    (tmp_path / "flight.csv.json").write_text(text)
    refusal = refuse(tmp_path / "flight.csv")
    assert refusal.file == str(tmp_path / "flight.csv.json")


@pytest.mark.parametrize("metadata", [b"{", b"[]", json.dumps({"system": 3}).encode()])
def test_strange_metadata_of_parquet_says_nothing(tmp_path, metadata):
    table = pyarrow.table({"time": [0.0, 1.0], "h": [1.0, 2.0]}).replace_schema_metadata({"perilune": metadata})
    pyarrow.parquet.write_table(table, tmp_path / "flight.parquet")
    assert read_run(tmp_path / "flight.parquet").origin in ("", "3")
