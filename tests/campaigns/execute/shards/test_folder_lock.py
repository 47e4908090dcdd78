"""Lock of a campaign's folder: several processes may simulate shards, while the folder cannot be replaced.

Truth: the files that processes leave in a folder, and SQLite's lock, taken by hand.
"""

import os
import sqlite3
from contextlib import closing

import pytest

import perilune
from perilune.analysis.campaigns.folder.lock import FILE, lock_folder
from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of
from tests.support.foreign.odd_fmu import COUNTS, odd_fmu

BATCH = ["--stop-time", "1", "--step", "0.25", "--workers", "1"]


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """Return names of a system and a campaign, and a folder with two of its four shards."""
    folder = tmp_path_factory.mktemp("locked")
    fmu, campaign = odd_fmu(folder), folder / "c.toml"
    campaign.write_text(COUNTS.format(name="odd", trials=100))
    command = [str(fmu), "--campaign", str(campaign), "--output", str(folder / "out")]
    assert main(["prepare", *command, *BATCH[:4]]) == 0
    assert main(["shard", str(folder / "out"), "0-1", "--workers", "1"]) == 0
    return command, folder / "out"


@pytest.mark.parametrize("verb", [["batch", "--overwrite"], ["batch", "--resume", "--retry-crashed"]])
def test_a_folder_in_use_is_not_replaced(prepared, capsys, verb):
    command, out = prepared
    before = bytes_of(out)
    with lock_folder(out):
        assert main([verb[0], *command, *verb[1:], *BATCH]) == 2
    assert f"{out}: another process simulates this campaign" in capsys.readouterr().err.splitlines()[-1]
    assert bytes_of(out) == before


def test_shards_are_simulated_together(prepared):
    command, out = prepared
    with lock_folder(out):
        assert main(["shard", str(out), "2", "--workers", "1"]) == 0
        assert main(["batch", *command, "--resume", *BATCH]) == 0
    assert perilune.open_results(out).flown == 100


def test_a_folder_that_is_being_replaced_is_not_used(prepared, capsys):
    _, out = prepared
    with closing(sqlite3.connect(out / FILE, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        assert main(["shard", str(out), "0"]) == 2
    assert "another process replaces this campaign; wait until it has ended" in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["a pipe", "a link", "not a database"])
def test_what_is_no_lock_is_refused(prepared, tmp_path, kind, refusal):
    _, out = prepared
    lock = out / FILE
    lock.unlink(missing_ok=True)
    if kind == "a pipe":
        os.mkfifo(lock)
    elif kind == "a link":
        lock.symlink_to(tmp_path / "elsewhere")
    else:
        lock.write_text("this is not a database, but some text" * 100)
    assert kind in refusal(["shard", str(out), "0"])
    assert not (tmp_path / "elsewhere").exists()
    lock.unlink()
