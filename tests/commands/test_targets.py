"""Where results go: refused before a flight where they cannot, whole or not there otherwise, told at the end."""

import errno
import json
from pathlib import Path

import pytest

from perilune.analysis.atomic import whole_file
from perilune.analysis.cli import main

pytestmark = pytest.mark.usefixtures("fmus")
RUN = ["run", "lunar_terminal_guidance"]
BATCH = ["batch", "lunar_terminal_guidance", "--campaign", "paper", "--trials", "2"]


@pytest.fixture
def nothing_flies(monkeypatch):
    def fly(*_, **__):
        raise AssertionError("it flew")

    monkeypatch.setattr("perilune.analysis.commands.run.fly", fly)
    monkeypatch.setattr("perilune.analysis.commands.campaigns.batch.run_batch", fly)


@pytest.mark.usefixtures("nothing_flies")
@pytest.mark.parametrize("command", [RUN, BATCH])
@pytest.mark.parametrize(
    ("option", "target", "words"),
    [
        ("--report", "folder", "is a folder; give the name of a file in it"),
        ("--report", "file/page.html", "is a file; give another folder"),
        ("--json", "folder", "is a folder"),
        ("--output", "file/x.csv", "is a file; give another folder"),
    ],
)
def test_targets_that_cannot_be_written_are_refused_before_a_flight(tmp_path, capsys, command, option, target, words):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("mine")
    before = sorted(tmp_path.rglob("*"))
    assert main([*command, option, str(tmp_path / target)]) == 2
    captured = capsys.readouterr()
    assert captured.err.startswith(f"perilune: {option}: ")
    assert words in captured.err
    assert captured.err.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before
    assert (tmp_path / "file").read_text() == "mine"


def test_a_folder_with_results_is_not_written_over_without_a_word(tmp_path, capsys):
    out = tmp_path / "out"
    assert main([*BATCH, "--output", str(out)]) == 0
    before = (out / "trials" / "000000.parquet").read_bytes()
    capsys.readouterr()
    assert main([*BATCH, "--seed", "5", "--output", str(out)]) == 2
    words = "holds results already (manifest.json, trials, draws.parquet, summary.json); "
    words += "give another, or --resume to go on, or --overwrite"
    assert words in capsys.readouterr().err
    assert (out / "trials" / "000000.parquet").read_bytes() == before
    assert main([*BATCH, "--seed", "5", "--output", str(out), "--overwrite"]) == 0
    assert json.loads((out / "summary.json").read_text())["seed"] == 5


def test_what_another_campaign_flew_with_does_not_stay(tmp_path):
    """A campaign of four FMUs over the folder of one with one parameter set more; a file of the user's stays."""
    out = tmp_path / "out"
    assert main([*BATCH, "--output", str(out)]) == 0
    alone = {path.name for path in (out / "files").iterdir()}
    assert main([*BATCH, "--parameters", "noisy.ssv", "--output", str(out), "--overwrite"]) == 0
    (out / "files" / "mine.txt").write_text("mine")
    assert main([*BATCH, "--output", str(out), "--overwrite"]) == 0
    assert {path.name for path in (out / "files").iterdir()} == alone | {"mine.txt"}


def test_one_file_that_cannot_be_written_keeps_no_other(tmp_path, capsys, monkeypatch):
    """A disk that is full when the page is written."""

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device", str(tmp_path / "page.html"))

    monkeypatch.setattr("perilune.analysis.reports.run.run_report.write_run_report", full)
    table, page = tmp_path / "flight.csv", tmp_path / "page.html"
    assert main([*RUN, "--output", str(table), "--report", str(page)]) == 2
    captured = capsys.readouterr()
    assert captured.out.splitlines()[0].startswith("lunar_terminal_guidance: finished")
    assert captured.out.splitlines()[-1] == f"written: {table}"
    assert captured.err == f"perilune: {page}: No space left on device; give another path or make room\n"
    assert table.read_text().startswith("time,")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
def test_a_full_disk_names_the_file_and_leaves_nothing(tmp_path):
    path = tmp_path / "table.bin"
    path.write_text("old")

    def write():
        with whole_file(path) as partial:
            partial.symlink_to("/dev/full")
            with partial.open("wb") as file:
                file.write(b"x" * 100_000)

    with pytest.raises(OSError, match="No space left") as caught:
        write()
    assert caught.value.filename == str(path)
    assert [entry.name for entry in tmp_path.iterdir()] == ["table.bin"]
    assert path.read_text() == "old"


def test_requirements_on_one_flight(capsys):
    assert main([*RUN, "--require", "time < 300", "--require", "plant.mass > 0"]) == 0
    assert main([*RUN, "--require", "plant.speed < 1"]) == 2
    assert "plant.speed: no such number in what results" in capsys.readouterr().err
    assert main([*RUN, "--require", "plant.position[1] < 0"]) == 1
    assert capsys.readouterr().err == "perilune: --require: plant.position[1] < 0: not met\n"
