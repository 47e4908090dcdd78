"""Inputs over time as files and arrays: reading, and one line for each error.

Truth: the written numbers; `fmpy.read_csv`.
"""

from __future__ import annotations

import fmpy
import numpy as np
import pytest

from perilune.analysis.runtime.system.series import read_series
from perilune.common.errors import InputError


def test_a_file_as_fmpy_reads_it(tmp_path):
    path = tmp_path / "inputs.csv"
    rows = [(0.1 * n, np.sin(n), 1e-300 * n, n) for n in range(50)]
    fmpy.write_csv(path, np.array(rows, dtype=[("time", float), ("a.b[1]", float), ("c", float), ("n", int)]))
    actual, theirs = read_series(path), fmpy.read_csv(path)
    assert np.array_equal(actual.time, theirs["time"])
    assert list(actual.columns) == ["a.b[1]", "c", "n"]
    for name, values in actual.columns.items():
        assert np.array_equal(values, theirs[name])


def test_what_spreadsheets_write(tmp_path):
    path = tmp_path / "inputs.csv"
    path.write_bytes(b'\xef\xbb\xbftime, "a[1,2]", flag\r\n0, 1e3, TRUE\r\n\r\n1, -2, false\r\n')
    actual = read_series(path)
    assert actual.time.tolist() == [0.0, 1.0]
    assert {name: values.tolist() for name, values in actual.columns.items()} == {"a[1,2]": [1e3, -2], "flag": [1, 0]}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ": empty; write a comma-separated file"),
        ("time,u\n", ": no samples; give a line of numbers"),
        ("time\n0\n", ": no column except time; give a column"),
        ("u,time\n0,0\n", ": line 1: the first column is 'u', not time; write"),
        ("time;u\n0;0\n", ": line 1: the first column is 'time;u', not time; write"),
        ("time,u,u\n0,0,0\n", ": line 1: column u occurs twice; remove"),
        ("time,u\n0,1\n1\n", ": line 3: 1 values, but there are 2 columns; give"),
        ("time,u\n0,1\n\n1,high\n", ": line 4, column u: 'high' is not a number; give"),
        ("time,u\n0,\n", ": line 2, column u: no number; give"),
        ("time,u\n0,1\n1,nan\n", ": line 3, column u: nan is not finite; give"),
        ("time,u\n0,1\ninf,1\n", ": line 3, column time: inf is not finite; give"),
        ("time,u\n0,1\n2,1\n1,1\n", ": line 4, column time: the time falls from 2 s to 1 s; sort"),
        ("time,u\n0,1 2\n", ": line 2, column u: '1 2' is not a number; give"),
    ],
)
def test_files_that_are_wrong(tmp_path, text, expected):
    path = tmp_path / "inputs.csv"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        read_series(path)
    assert str(error.value).startswith(f"{path}{expected}")


def test_no_file_and_no_text(tmp_path):
    with pytest.raises(InputError, match="not found; give a CSV file"):
        read_series(tmp_path / "none.csv")
    path = tmp_path / "inputs.csv"
    path.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(InputError, match="not a CSV file"):
        read_series(path)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"u": [1.0]}, "input: time: no such column"),
        (np.zeros(3), "input: time: no such column"),
        ({"time": [0.0, 1.0], "u": [1.0]}, r"column u: its shape is \(1,\), but the shape of time is \(2,\)"),
        ({"time": [0.0], "u": ["high"]}, "column u: not numbers"),
        ({"time": [0.0, 1.0], "u": [1.0, np.nan]}, "sample 1, column u: nan is not finite"),
        ({"time": [1.0, 0.0], "u": [1.0, 2.0]}, "sample 1, column time: the time falls"),
    ],
)
def test_arrays_that_are_wrong(given, expected):
    with pytest.raises(InputError, match=expected):
        read_series(given)
