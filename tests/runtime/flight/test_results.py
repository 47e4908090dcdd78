"""Files of a run: values are read back to the last bit, with types, units and provenance.

Truth: the arrays in memory; hashes computed here from the files; Python's csv module and pyarrow's reader.
"""

import csv
import hashlib
import json
from importlib.metadata import version

import numpy as np
import pyarrow.parquet
import pytest

from perilune.analysis.runtime.flight.results import Flight
from tests.support.builders import component, connection, document, fly, pack, system

RAMP = component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
SOURCE = component("source", "mode_ramp", "output count Enumeration Mode")


@pytest.fixture
def flight(tiny_folder, tmp_path):
    root = system(RAMP, GAIN, SOURCE, connections=connection("ramp.y", "gain.u"), declared="output finished Boolean")
    path = pack(tmp_path / "s.ssp", tiny_folder / "python", document(root))
    settings = {"ramp.start": 1 / 3, "ramp.slope": 0.1, "ramp.flag_at": 2, "source.first_count": "brake"}
    return path, fly(path, set=settings)


TYPES = {"ramp.y": "double", "ramp.flag": "bool", "ramp.count": "int32", "source.count": "int32", "gain.u": "double"}


def test_parquet_comes_back_with_units_and_provenance(flight, tmp_path):
    _, result = flight
    result.write(tmp_path / "new" / "flight.parquet")
    table = pyarrow.parquet.read_table(tmp_path / "new" / "flight.parquet")
    assert table.column_names == ["time", *result.signals]
    assert np.array_equal(table["time"], result.time)
    for name, column in result.signals.items():
        assert np.array_equal(np.array(table[name], dtype=float), column), name
    assert {name: str(table.schema.field(name).type) for name in TYPES} == TYPES
    units = {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in table.schema}
    assert (units["time"], units["ramp.y"], units["ramp.count"]) == ("s", "m", "")
    actual = json.loads(table.schema.metadata[b"perilune"])
    assert actual["status"] == "stop_time"
    assert actual["rows"] == 5
    assert actual["end_time"] == 1.0
    assert actual["step"] == 0.25
    assert actual["parameters"]["ramp.start"] == 1 / 3
    assert actual["parameters"]["source.first_count"] == 2
    assert actual["perilune"] == version("perilune")
    assert set(actual["fmus"]) == {"ramp", "gain", "source"}


def test_hashes_are_those_of_the_files(flight, tiny_folder):
    _, result = flight
    data = (tiny_folder / "python" / "ramp.fmu").read_bytes()
    assert result.provenance["fmus"]["ramp"]["sha256"] == hashlib.sha256(data).hexdigest()
    assert len(result.provenance["system_sha256"]) == 64


def test_the_hash_of_a_system_follows_its_content(tiny_folder, tmp_path):
    tiny = tiny_folder / "python"
    same = [pack(tmp_path / f"{name}.ssp", tiny, document(system(RAMP))) for name in "ab"]
    other = pack(tmp_path / "c.ssp", tiny, document(system(RAMP), stop=1.25))
    digests = [fly(path).provenance["system_sha256"] for path in (*same, other)]
    assert digests[0] == digests[1] != digests[2]


def test_csv_comes_back_to_the_last_bit(flight, tmp_path):
    _, result = flight
    result.write(tmp_path / "flight.csv")
    with (tmp_path / "flight.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    assert header == ["time", *result.signals]
    assert len(rows) == 5
    for position, name in enumerate(header[1:], start=1):
        expected = result[name]
        if result.types[name] == "Boolean":
            assert [row[position] for row in rows] == ["true" if value else "false" for value in expected]
        elif result.types[name] == "Real":
            assert [float(row[position]) for row in rows] == expected.tolist()
        else:
            assert [int(row[position]) for row in rows] == expected.tolist()
    beside = json.loads((tmp_path / "flight.csv.json").read_text())
    assert beside["units"]["ramp.y"] == "m"
    assert beside["units"]["time"] == "s"
    assert beside["parameters"]["ramp.start"] == 1 / 3


def test_last_values_have_their_types(flight):
    _, result = flight
    final = result.final()
    assert (type(final["ramp.y"]), type(final["ramp.count"]), type(final["ramp.flag"])) == (float, int, bool)
    assert final["ramp.count"] == 4
    assert final["ramp.flag"] is True


def test_a_flight_without_rows_can_be_written(tiny_folder, tmp_path):
    root = system(component("trouble", "trouble", "output y Real m"))
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", document(root))
    result = fly(path, set={"trouble.kind": 4})
    assert result.time.size == 0
    assert result.final() == {}
    for name in ("a.csv", "a.parquet"):
        result.write(tmp_path / name)
    actual = json.loads(pyarrow.parquet.read_schema(tmp_path / "a.parquet").metadata[b"perilune"])
    assert (actual["status"], actual["rows"], actual["end_time"]) == ("failed", 0, None)
    assert "division" in actual["message"]


def test_a_vector_by_its_own_name_and_a_wrong_one():
    flight = Flight(
        time=np.arange(2.0),
        signals={"a.r[1]": np.array([1.0, 2.0]), "a.r[2]": np.array([3.0, 4.0]), "a.speed": np.zeros(2)},
        types=dict.fromkeys(("a.r[1]", "a.r[2]", "a.speed"), "Real"),
        status="finished",
        message="",
    )
    assert flight["a.r"].tolist() == [[1.0, 3.0], [2.0, 4.0]]
    assert flight["a.r[2]"].tolist() == [3.0, 4.0]
    assert repr(flight) == "Flight(completed at t = 1 s, 2 samples, 3 signals)"
    with pytest.raises(KeyError, match=r"no signal a\.sped; use one of a\.speed, a\.r, a\.r\[1\], a\.r\[2\]"):
        flight["a.sped"]
