"""Folders that are missing, damaged, or links elsewhere: refused in one line, before and while they are served.

Truth: a valid folder with known changes.
"""

from __future__ import annotations

import json
import shutil

import pyarrow
import pyarrow.parquet
import pytest

from perilune.analysis.cli import main
from tests.support.campaigns.folders import flip_bit
from tests.support.campaigns.show_client import ShowClient


@pytest.fixture
def folder(campaign_folder, tmp_path):
    return shutil.copytree(campaign_folder, tmp_path / "results")


def refusal(folder, capsys):
    assert main(["show", str(folder)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    return lines[0]


def to_elsewhere(path, tmp_path):
    """Replace a file or folder by a link to the same elsewhere."""
    elsewhere = tmp_path / "elsewhere"
    path.rename(elsewhere)
    path.symlink_to(elsewhere)


@pytest.mark.parametrize("name", ["summary.json", "trials", "trials/000001.parquet"])
def test_a_link_in_the_folder(folder, tmp_path, capsys, name):
    to_elsewhere(folder / name, tmp_path)
    line = refusal(folder, capsys)
    assert f"{name}: a link, not a " in line


def test_a_link_that_comes_later(folder, tmp_path):
    client = ShowClient(folder)
    to_elsewhere(folder / "trials" / "000002.parquet", tmp_path)
    answer = client.query("counts", histograms=client.numbers("metric.m1"))
    assert answer.status_code == 422
    assert "000002.parquet: a link, not a regular file" in answer.text
    assert "\n" not in answer.text


def test_no_folder_of_a_campaign(tmp_path, capsys):
    assert "manifest.json: not found" in refusal(tmp_path, capsys)
    assert "manifest.json: not found" in refusal(tmp_path / "nowhere", capsys)


def test_damage(folder, capsys):
    path = folder / "trials" / "000003.parquet"
    path.write_bytes(path.read_bytes()[:-20])
    assert "000003.parquet: cannot be read as parquet" in refusal(folder, capsys)


def test_damage_in_a_page_of_a_file(folder):
    client = ShowClient(folder)
    flip_bit(folder / "trials" / "000001.parquet")  # of its last column
    answer = client.query("counts", histograms=client.numbers("metric.m39"))
    assert answer.status_code == 422
    assert "000001.parquet: cannot be read as parquet" in answer.text
    assert client.query("counts", histograms=client.numbers("metric.m6")).status_code == 200


def change(path, changed):
    table = pyarrow.parquet.read_table(path)
    pyarrow.parquet.write_table(changed(table).replace_schema_metadata(table.schema.metadata), path)


@pytest.mark.parametrize(
    ("changed", "problem"),
    [
        (lambda table: table.slice(0, 5), "5 rows, not 500 for each of 3 variants"),
        (lambda table: table.take(list(range(table.num_rows - 1, -1, -1))), "the rows are not the trials 500 to 999"),
        (lambda table: table.drop_columns(["metric.m1"]), "metric.m1: no such column"),
        (
            lambda table: table.set_column(0, "variant", pyarrow.array(["alpha"] * 1500)),
            "contains rows of a variant other than beta",
        ),
    ],
)
def test_rows_that_are_not_those_of_the_campaign(folder, changed, problem):
    client = ShowClient(folder)
    change(folder / "trials" / "000001.parquet", changed)
    answer = client.query("counts", histograms=client.numbers("metric.m1"))
    assert answer.status_code == 422
    assert problem in answer.text


def test_another_campaign_in_its_place(folder):
    """Another campaign of as many trials and the same columns."""
    client = ShowClient(folder)
    path = folder / "trials" / "000001.parquet"
    table = pyarrow.parquet.read_table(path)
    about = json.loads(table.schema.metadata[b"perilune"]) | {"batch": "another"}
    pyarrow.parquet.write_table(table.replace_schema_metadata({"perilune": json.dumps(about)}), path)
    answer = client.query("counts", histograms=client.numbers("metric.m1"))
    assert answer.status_code == 422
    assert "belongs to another batch than the campaign that was opened" in answer.text


def test_a_column_that_the_summary_does_not_declare(folder, capsys):
    for path in (folder / "trials").iterdir():
        change(path, lambda table: table.append_column("metric.other", table["end_time"]))
    assert "the campaign's summary does not declare 'other'" in refusal(folder, capsys)


def test_wrong_options(campaign_folder, refusal):
    assert "--port" in refusal(["show", str(campaign_folder), "--port", "70000"])
