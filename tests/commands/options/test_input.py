"""`perilune run` and `batch` of an FMU alone with `--input`.

Truth: `perilune.simulate` and the closed form of a gain; exit status 2 and one line for an invalid file.
"""

from __future__ import annotations

import csv
import json

import pytest

from perilune.analysis.cli import main

CAMPAIGN = """
system = "gain.fmu"
trials = 5
seed = 2

[draw."gain.factor"]
distribution = "uniform"
low = 1.0
high = 2.0

[metric.most]
expression = "gain.y"
reduction = "max"

[success]
expression = "most > 4"
"""


@pytest.fixture
def inputs(tmp_path):
    path = tmp_path / "inputs.csv"
    path.write_text('"time","u"\n0.0,1.0\n1.0,3.0\n')
    return path


def test_run(tiny, tmp_path, inputs, capsys):
    output, report = tmp_path / "flight.csv", tmp_path / "flight.html"
    command = ["run", str(tiny / "gain.fmu"), "--input", str(inputs), "--step", "0.25", "--output", str(output)]
    assert main([*command, "--report", str(report), "--require", "gain.y > 7.4", "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["input"]["signals"] == ["gain.u"]
    assert document["final"] == {"gain.u": 3.0, "gain.y": 7.5}  # the output follows a row behind, as in FMPy
    with output.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["gain.u"]) for row in rows] == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert [float(row["gain.y"]) for row in rows] == [3.0, 3.0, 4.5, 6.0, 7.5]
    assert "gain" in report.read_text()


def test_batch(tiny, tmp_path, inputs, capsys):
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    command = ["batch", str(tiny / "gain.fmu"), "--campaign", str(tmp_path / "c.toml"), "--input", str(inputs)]
    output, report = tmp_path / "results", tmp_path / "batch.html"
    options = ["--workers", "1", "--output", str(output), "--report", str(report)]
    assert main([*command, *options]) == 0
    assert main(["replay", command[1], "3", *command[2:], "--output", str(tmp_path / "replay.csv")]) == 1  # no success
    assert "trial 3: stop_time" in capsys.readouterr().out
    assert json.loads((output / "summary.json").read_text())["input"]["file"] == str(inputs)
    assert main(["compare", str(output)]) == 0
    assert report.read_text().lower().startswith("<!doctype html")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("time,u\n0,1\n1,high\n", "line 3, column u: 'high' is not a number; give a number"),
        ("time,w\n0,1\n", "column w: no such input; use one of factor, u"),
        ("u\n0\n", "line 1: the first column is 'u', not time; write"),
    ],
)
def test_files_that_are_wrong(tiny_folder, tmp_path, capsys, text, expected):
    path = tmp_path / "inputs.csv"
    path.write_text(text)
    assert main(["run", str(tiny_folder / "native" / "gain.fmu"), "--input", str(path)]) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"perilune: {path}: {expected}")
    assert error.count("\n") == 1
