"""FMU that changes the working folder of the process: relative paths still refer to the command's folder.

Truth: the contents of the folders; the closed form of the odd FMU, y(1 s) = gain u + 2 with u = 0.5.
"""

import json
import os

import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from tests.support.builders import parameter_set
from tests.support.foreign.odd_fmu import odd_fmu, odd_system

CAMPAIGN = """
system = "odd.ssp"
trials = 4
seed = 3
parameters = ["more.ssv"]

[success]
expression = "last == 7"

[metric.last]
expression = "odd.y"
reduction = "final"

[record]
traces = "all"
"""


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """Return the folder that the FMU changes to; the test is in another."""
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    odd_system(here, GOES_TO=str(there))
    odd_fmu(here, "other", GOES_TO=str(there), LOSES_EARLY=True)
    (here / "more.ssv").write_text(parameter_set("odd.gain=Real:10"))
    (here / "c.toml").write_text(CAMPAIGN)
    monkeypatch.chdir(here)
    return there


def test_run(elsewhere, capsys):
    files = ["--output", "o.csv", "--report", "r.html", "--json", "j.json"]
    assert main(["run", "odd.ssp", "--parameters", "more.ssv", *files]) == 0
    here = elsewhere.with_name("here")
    assert os.getcwd() == str(here)
    assert list(elsewhere.iterdir()) == []
    assert {"o.csv", "o.csv.json", "r.html", "j.json"} <= {path.name for path in here.iterdir()}
    assert json.loads((here / "j.json").read_text())["final"]["odd.y"] == 7.0
    assert "written: o.csv, r.html, j.json" in capsys.readouterr().out


@pytest.mark.parametrize("workers", ["1", "2"])
def test_batch(elsewhere, workers):
    """Variants are read when they fly first, which is after an FMU has gone."""
    files = ["--output", "results", "--report", "r.html", "--json", "j.json"]
    arguments = [
        "batch",
        "odd.ssp",
        "--campaign",
        "c.toml",
        "--compare",
        "odd=odd.fmu,./other.fmu",
        "--workers",
        workers,
        *files,
    ]
    assert main(arguments) == 0
    here = elsewhere.with_name("here")
    assert list(elsewhere.iterdir()) == []
    assert {"r.html", "j.json", "results"} <= {path.name for path in here.iterdir()}
    table = pyarrow.parquet.read_table(here / "results" / "trials")
    assert table["metric.last"].to_pylist() == [7.0] * 8
    assert len(list((here / "results" / "traces").rglob("*.parquet"))) == 8


def test_replay(elsewhere):
    assert main(["replay", "odd.ssp", "1", "--campaign", "c.toml", "--output", "results.csv", "--json", "j.json"]) == 0
    here = elsewhere.with_name("here")
    assert list(elsewhere.iterdir()) == []
    assert (here / "results.csv").is_file()
    assert (here / "j.json").is_file()


def test_validate(elsewhere, capsys):
    assert main(["validate", "odd.fmu", "odd.ssp", "other.fmu", "--json", "j.json"]) == 0
    assert (elsewhere.with_name("here") / "j.json").is_file()
    assert capsys.readouterr().err == ""


def test_python_stays_where_it_was(elsewhere):
    result = perilune.simulate("odd.ssp", parameters=["more.ssv"])
    perilune.batch("odd.ssp", "c.toml", workers=1, output="results")
    result.write("o.csv")
    assert os.getcwd() == str(elsewhere.with_name("here"))
    assert list(elsewhere.iterdir()) == []
    assert (elsewhere.with_name("here") / "results" / "trials").is_dir()
