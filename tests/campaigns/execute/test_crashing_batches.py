"""Campaigns whose FMU ends its process in some trials: these are counted in the output, and simulated again on request.

Truth: the FMU's source, which ends the process if its count is 13; the batch in one command.
"""

from __future__ import annotations

import json
import shutil

import pyarrow.parquet
import pytest

from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu

pytestmark = pytest.mark.flies


@pytest.fixture(scope="module")
def crashing(tmp_path_factory):
    """Return the words of a command that simulates it, and the folder that it wrote."""
    folder = tmp_path_factory.mktemp("crashing")
    fmu = odd_fmu(folder, DEED=Deed.SEGFAULT, IN=Call.STEP, COUNTED=13)
    (folder / "c.toml").write_text(COUNTS.format(name="odd", trials=75))
    words = [str(fmu), "--campaign", str(folder / "c.toml"), "--step", "0.25", "--stop-time", "1"]
    assert main(["batch", *words, "--output", str(folder / "out"), "--workers", "1"]) == 1
    return words, folder / "out"


def crashed(folder):
    """Count the crashed trials of a folder."""
    statuses = pyarrow.parquet.read_table(folder / "trials", columns=["status"])["status"].to_pylist()
    return statuses.count("crashed")


def test_the_result_counts_them(crashing, tmp_path, capsys):
    words, folder = crashing
    assert main(["batch", *words, "--report", str(tmp_path / "page.html"), "--json", str(tmp_path / "r.json")]) == 1
    count = crashed(folder)
    assert 0 < count < 75
    line = f"default: {count} crashed of 75 trials, counted as failures"
    assert f"perilune: {line}; --retry-crashed simulates them again\n" in capsys.readouterr().err
    assert line in (tmp_path / "page.html").read_text()
    assert json.loads((tmp_path / "r.json").read_text())["variants"]["default"]["statuses"]["crashed"] == count


def test_simulated_again(crashing, tmp_path):
    """Only shards with such trials are; the FMU being what it is, to the same bytes."""
    words, folder = crashing
    out = shutil.copytree(folder, tmp_path / "out")
    before = {path.name: path.stat().st_mtime_ns for path in (out / "trials").iterdir()}
    assert main(["batch", *words, "--output", str(out), "--resume", "--retry-crashed"]) == 1
    after = {path.name: path.stat().st_mtime_ns for path in (out / "trials").iterdir()}
    repeated = {name for name in before if after[name] != before[name]}
    assert repeated == {path.name for path in (folder / "trials").iterdir() if crashed_in(path)}
    assert bytes_of(out) == bytes_of(folder)
    assert main(["batch", *words, "--output", str(out), "--retry-crashed"]) == 2


def crashed_in(path):
    return "crashed" in pyarrow.parquet.read_table(path, columns=["status"])["status"].to_pylist()
