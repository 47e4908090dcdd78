"""Destinations of results: refused before a simulation where they cannot be written, whole or
absent otherwise, reported."""

import errno
import json
import sys
from pathlib import Path

import pytest

from perilune.analysis.cli import main
from perilune.analysis.options.option import Kind, options_of
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.atomic import whole_file

pytestmark = pytest.mark.usefixtures("fmus")
RUN = ["run", "lunar_terminal_guidance"]
BATCH = ["batch", "lunar_terminal_guidance", "--campaign", "paper", "--trials", "2"]


@pytest.fixture
def nothing_flies(monkeypatch):
    def fly(*_, **__):
        raise AssertionError("it flew")

    monkeypatch.setattr("perilune.analysis.verbs.run.fly", fly)
    monkeypatch.setattr("perilune.analysis.verbs.batch.open_campaign", fly)


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


# Further arguments of each verb; none of its work is reached.
ARGUMENTS = {
    "list": [],
    "describe": ["lunar_landing"],
    "validate": ["lunar_landing"],
    "run": RUN[1:],
    "batch": BATCH[1:],
    "prepare": [*BATCH[1:], "--output", "prepared"],
    "shard": ["there", "0"],
    "replay": ["there", "0"],
    "merge": ["there"],
    "rare": [*BATCH[1:4], "--failure", "position_error > 1"],
    "worst": [*BATCH[1:4], "--metric", "position_error"],
    "sensitivity": [*BATCH[1:4], "--base", "32"],
    "compare": ["there"],
    "show": ["there"],
    "diff": ["one.csv", "other.csv"],
    "verify": ["flat_moon_lander"],
    "design law": ["paper"],
    "design search": ["none.toml"],
    "design transfer": [],
    "design bound": [],
    "design bounds": ["lunar_landing", "--campaign", "laws_approach", "--trials", "1", "--workers", "1"],
    "stability": ["robot_rendezvous"],
    "docs": [],
    "new block": ["mine"],
    "new system": ["mine"],
    "compose": ["lunar_landing"],
    "export": ["lunar_landing"],
}
WRITING_NOTHING = {"show"}
BAD = {
    "folder": "is a folder; give the name of a file in it",
    "file/x": "file is a file; give another folder",
    "a/b/c/x": "there is no folder",
    "/perilune_new/x": "/perilune_new would be a new folder in the root; create it first (mkdir /perilune_new)",
    "n" * 300: "cannot be written in",
}
if sys.platform == "linux":
    BAD |= {"/proc/x": "cannot be written in /proc: ", "/dev/null": "is a device, not a regular file"}


def targets_of(verb):
    """Yield the options of a verb that name its outputs: flag, ending, and True for a folder."""
    files = [each for each in options_of(VERBS[verb].files).values() if each.kind is Kind.PATH]
    for each in [*files, *(each for each in options_of(VERBS[verb].options).values() if each.name == "output")]:
        ending = each.option.suffixes[0] if each.option.suffixes else ".ssp" if verb == "export" != each.name else ""
        yield f"--{each.flag}", ending if each.name != "json" else "", each.option.metavar == "DIR"
    yield from ((f"--{each.name}", "", True) for each in VERBS[verb].arguments if each.name == "output")


CASES = [(verb, *target) for verb in ARGUMENTS for target in targets_of(verb)]


def test_every_verb_is_in_the_table():
    assert set(ARGUMENTS) == set(VERBS)
    assert {verb for verb, *_ in CASES} == set(VERBS) - WRITING_NOTHING


@pytest.mark.parametrize(("verb", "flag", "ending", "is_folder"), CASES, ids=[f"{case[0]} {case[1]}" for case in CASES])
def test_targets_of_every_verb_are_tried_first(tmp_path, monkeypatch, capsys, verb, flag, ending, is_folder):
    """Each of them refused in one line that names option and remedy, and nothing is left behind, in /proc neither."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("mine")
    before = sorted(tmp_path.rglob("*"))
    for target, words in BAD.items():
        if is_folder and target in ("folder", "/dev/null"):
            continue
        written = target if target in ("folder", "/dev/null") else target + ending
        assert main([*verb.split(), *ARGUMENTS[verb], flag, written]) == 2
        error = capsys.readouterr().err
        assert error.startswith(f"perilune: {flag}: "), error
        assert error.count("\n") == 1
        assert words in error or (target == "/dev/null" and ending in error), error
        assert sorted(tmp_path.rglob("*")) == before
        assert not Path("/perilune_new").exists()


def test_a_link_among_devices_stays(tmp_path, monkeypatch, refusal):
    """/dev/stdout of a command whose output goes to a file: the link's end is an ordinary file."""
    (tmp_path / "log").write_text("")
    (tmp_path / "stdout").symlink_to(tmp_path / "log")
    monkeypatch.setattr("perilune.common.targets.DEVICES", tmp_path.resolve())
    assert "is a device, not a regular file" in refusal([*RUN, "--json", str(tmp_path / "stdout")])
    assert (tmp_path / "stdout").is_symlink()


def test_a_new_folder_is_made_one_level_down(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main([*RUN, "--report", "new/page.html", "--output", "other/table.csv"]) == 0
    assert main([*BATCH, "--output", "out/noisy"]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {"new", "other", "out"}


def test_a_folder_with_results_is_not_written_over_without_a_word(tmp_path, capsys):
    out = tmp_path / "out"
    assert main([*BATCH, "--output", str(out)]) == 0
    before = (out / "trials" / "000000.parquet").read_bytes()
    capsys.readouterr()
    assert main([*BATCH, "--seed", "5", "--output", str(out)]) == 2
    words = "holds results already (manifest.json, trials, draws.parquet, summary.json); "
    words += "give another folder, or --resume or --overwrite"
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

    monkeypatch.setattr("perilune.analysis.documents.render.html.write_document", full)
    table, page = tmp_path / "flight.csv", tmp_path / "page.html"
    assert main([*RUN, "--output", str(table), "--report", str(page)]) == 2
    captured = capsys.readouterr()
    assert captured.out.splitlines()[0].startswith("lunar_terminal_guidance: completed")
    assert captured.out.splitlines()[-1] == f"written: {table}"
    assert captured.err == f"perilune: {page}: No space left on device; free some space\n"
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


def test_requirements_on_one_flight(capsys, refusal):
    assert main([*RUN, "--require", "time < 300", "--require", "plant.mass > 0"]) == 0
    assert "plant.speed: the result has no such number" in refusal([*RUN, "--require", "plant.speed < 1"])
    assert main([*RUN, "--require", "plant.position[1] < 0"]) == 1
    assert capsys.readouterr().err == "perilune: --require: plant.position[1] < 0: not met\n"
