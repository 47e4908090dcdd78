"""Campaigns that are killed, interrupted, divided or extended: the same bytes as an undisturbed campaign.

Truth: every file that the same campaign writes to another folder without interruption.
"""

import random
import shutil
import signal
import subprocess
import sys

import pytest

import perilune
from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of, killed_when, shards_in, started, workers_of
from tests.support.interrupts import interrupted_when
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
TRIALS = 110  # five shards, the last one of ten trials
CAMPAIGN = [SYSTEM, "--campaign", "paper", "--trials", str(TRIALS)]


@pytest.fixture(scope="module")
def whole(tmp_path_factory, fmus):
    """Return the files that the campaign writes without a disturbance."""
    folder = tmp_path_factory.mktemp("whole") / "out"
    assert main(["batch", *CAMPAIGN, "--output", str(folder), "--workers", "1"]) == 0
    return bytes_of(folder)


@pytest.mark.parametrize("options", [["--workers", "2"], ["--engine", "processes", "--workers", "2"]][either(0, 1) :])
def test_every_engine_leaves_the_same_bytes(whole, tmp_path, options):
    assert main(["batch", *CAMPAIGN, "--output", str(tmp_path / "out"), *options]) == 0
    assert bytes_of(tmp_path / "out") == whole


def test_shards_one_by_one_in_any_order(whole, tmp_path, capsys):
    out = str(tmp_path / "out")
    assert main(["prepare", *CAMPAIGN, "--output", out]) == 0
    assert f"perilune shard {out} 0-4" in capsys.readouterr().out
    numbers = list(range(5))
    random.Random(7).shuffle(numbers)
    for number in numbers[:-1]:
        assert main(["shard", out, str(number), "--workers", "1"]) == 0
    capsys.readouterr()
    assert main(["merge", out]) == 2
    missing = numbers[-1]
    words = f"shards {missing}: 1 of 5 shards are missing; perilune shard {out} {missing} simulates them"
    assert words in capsys.readouterr().err
    assert main(["shard", out, "0-4"]) == 0
    assert "shards: 1 simulated, 4 already complete, 0 of 5 missing" in capsys.readouterr().out
    assert main(["merge", out]) == 0
    assert "analytic_guidance" in capsys.readouterr().out
    assert bytes_of(tmp_path / "out") == whole


def test_a_complete_campaign_is_left_alone(tmp_path):
    out = tmp_path / "out"
    few = ["batch", SYSTEM, "--campaign", "paper", "--trials", "10", "--stop-time", "10", "--output", str(out)]
    assert main(few) == 0
    before = {path: path.stat().st_mtime_ns for path in (out / "trials").iterdir()}
    assert main([*few, "--resume"]) == 0
    assert {path: path.stat().st_mtime_ns for path in (out / "trials").iterdir()} == before


def test_more_trials_extend_it(tmp_path):
    """The last shard, which held fewer trials, is flown again; the others are those that were there."""
    out = tmp_path / "out"
    short = {"stop_time": 10.0}
    first = ["batch", SYSTEM, "--campaign", "paper", "--stop-time", "10", "--output", str(out)]
    assert main([*first, "--trials", "60"]) == 0
    before = bytes_of(out)
    assert main([*first, "--trials", str(TRIALS), "--resume"]) == 0
    after = bytes_of(out)
    assert [after[f"trials/00000{shard}.parquet"] == before[f"trials/00000{shard}.parquet"] for shard in range(3)] == [
        True, True, False,
    ]  # fmt: skip
    expected = perilune.batch(SYSTEM, "paper", trials=TRIALS, **short)
    actual = perilune.merge(out)
    assert actual.table().equals(expected.table())
    assert actual.summary == expected.summary


def test_ctrl_c_leaves_what_can_be_gone_on_with(whole, tmp_path, capsys, refusal):
    out = tmp_path / "out"
    with interrupted_when(lambda: shards_in(out) >= 2):
        assert main(["batch", *CAMPAIGN, "--output", str(out), "--workers", "2"]) == 1
    hint = f"completed trials are stored in {out}: resume with the same command and --resume, or with shard"
    assert hint in capsys.readouterr().err
    assert not (out / "summary.json").exists()
    assert 2 <= shards_in(out) < 5
    assert "summary.json: not found; complete the batch: repeat its command with resume" in refusal(
        ["compare", str(out), "--report", str(tmp_path / "page.html")]
    )
    assert main(["batch", *CAMPAIGN, "--output", str(out), "--resume"]) == 0
    assert bytes_of(out) == whole


def test_a_killed_parent_is_gone_on_with(whole, tmp_path):
    out = tmp_path / "out"
    line = ["batch", *CAMPAIGN, "--output", out, "--engine", "processes", "--workers", "2"]
    for shards in (1, 3):
        process = started(*line, *(["--resume"] if shards > 1 else []))
        assert killed_when(process, lambda shards=shards: shards_in(out) >= shards)
        process.communicate()  # its workers end, too: what they write to is closed
    assert main(["batch", *CAMPAIGN, "--output", str(out), "--resume"]) == 0
    assert bytes_of(out) == whole


KILLED = """
import os, pathlib, signal, sys
from perilune.common.atomic import whole_file
with whole_file(pathlib.Path(sys.argv[1])) as partial:
    partial.write_bytes(b"PAR1")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_killed_writers_leave_is_taken_away(whole, tmp_path):
    """A kill amid any file of a campaign; what else its owner keeps in that folder stays."""
    out = tmp_path / "out"
    assert main(["prepare", *CAMPAIGN, "--output", str(out)]) == 0
    content = next((out / "files").iterdir()).name
    for name in ("draws.parquet", "trials/000001.parquet", "traces/x/000007.parquet", f"files/{content}"):
        killed = subprocess.run([sys.executable, "-c", KILLED, str(out / name)], check=False)
        assert killed.returncode == -signal.SIGKILL
    assert len(list(out.rglob(".*"))) == 5  # with the lock
    (out / ".mine").write_text("kept")
    assert main(["batch", *CAMPAIGN, "--output", str(out), "--resume"]) == 0
    assert {path.name for path in out.rglob(".*")} == {".lock", ".mine"}
    (out / ".mine").unlink()
    assert bytes_of(out) == whole


@pytest.mark.slow  # test_a_killed_parent_is_gone_on_with kills workers, too, and test_dask.py one of another machine
def test_killed_workers_fly_again(tmp_path):
    trials, kills = 2000, 20
    source = random.Random(11)
    line = ["batch", SYSTEM, "--campaign", "paper", "--trials", trials, "--workers", "2"]
    process = started(*line, "--engine", "processes", "--output", tmp_path / "killed")
    count = -(-trials // max(25, -(-trials // 40)))
    done = 0
    for kill in range(kills):
        wanted = min(1 + kill, count * 3 // 4)
        done += killed_when(
            process,
            lambda wanted=wanted: shards_in(tmp_path / "killed") >= wanted,
            lambda: source.choice(workers_of(process)),
        )
    _, said = process.communicate()
    assert (process.returncode, done) == (0, kills), said
    assert main([*map(str, line), "--output", str(tmp_path / "whole")]) == 0
    assert bytes_of(tmp_path / "killed") == bytes_of(tmp_path / "whole")


REFUSED = {
    "another seed": (
        ["--seed", "9"],
        "manifest.json: holds another campaign: seed was 20170700, is 9",
    ),
    "fewer trials": (["--trials", "20"], "trials: holds a campaign of 30 trials, not 20"),
    "a value": (["--set", "plant.initial_mass=900"], "options.set.plant.initial_mass was nothing, is 900"),
    "a comparison": (["--compare", "guidance=analytic_guidance"], "campaign.compare.guidance was"),
}


@pytest.fixture(scope="module")
def begun(tmp_path_factory, fmus):
    folder = tmp_path_factory.mktemp("begun") / "out"
    command = ["batch", SYSTEM, "--campaign", "paper", "--trials", "30", "--stop-time", "5", "--output", str(folder)]
    assert main(command) == 0
    return command, folder


@pytest.mark.parametrize("name", REFUSED)
def test_another_campaign_is_not_mixed_into_it(begun, capsys, name):
    command, folder = begun
    options, words = REFUSED[name]
    before = bytes_of(folder)
    assert main([*command, "--resume", *options]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert said.count("\n") == 1
    assert bytes_of(folder) == before


def test_what_flies_is_what_the_folder_holds(begun, tmp_path, refusal):
    """A damaged file of the campaign is found out; one changed elsewhere is not looked at."""
    _, folder = begun
    copy = tmp_path / "copy"
    perilune.batch(SYSTEM, "paper", trials=30, stop_time=5.0, output=copy)
    (copy / "trials" / "000000.parquet").unlink()
    fmu = next((copy / "files").glob("*.fmu"))
    retained = fmu.read_bytes()
    fmu.write_bytes(retained[:-1])
    assert f"{fmu.name}: its SHA-256 does not match its name" in refusal(["shard", str(copy), "0"])
    fmu.write_bytes(retained)
    assert main(["shard", str(copy), "0"]) == 0
    assert bytes_of(copy / "trials") == bytes_of(folder / "trials")
    assert "shard: 2: no such shard; give 0 to 1" in refusal(["shard", str(copy), "2"])


def test_a_damaged_shard_is_named_and_flown_again_once_removed(begun, tmp_path, capsys):
    command, folder = begun
    copy = shutil.copytree(folder, tmp_path / "copy")
    shard = copy / "trials" / "000001.parquet"
    shard.write_bytes(shard.read_bytes()[:-60])
    repeated = [*command[:-1], str(copy), "--resume"]
    assert main(repeated) == 2
    said = capsys.readouterr().err
    assert f"{shard}: cannot be read as parquet" in said
    assert "remove this file: the batch's command with --resume simulates its trials again" in said
    shard.unlink()
    assert main(repeated) == 0
    assert bytes_of(copy) == bytes_of(folder)


MISTAKES = {
    "threads": (["--overwrite", "--flavour", "python", "--engine", "threads"], "--engine: threads: Python FMUs"),
    "resume and overwrite": (["--overwrite", "--resume"], "--resume: --overwrite: one keeps the stored results"),
    "neither": ([], "holds results already (manifest.json, trials, draws.parquet, summary.json)"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_costs_no_results(begun, name, refusal):
    command, folder = begun
    options, words = MISTAKES[name]
    before = bytes_of(folder)
    assert words in refusal([*command, *options])
    assert bytes_of(folder) == before
