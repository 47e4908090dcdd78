"""`perilune replay FOLDER TRIAL`: simulation of a trial of a stored campaign from its folder alone.

Truth: the stored metrics of the trial, compared to the last bit; `simulate` with the same draws; the commands on the
page. The folder is moved, and its source files are removed.
"""

from __future__ import annotations

import json
import shlex
import shutil

import numpy as np
import pyarrow.parquet
import pytest
from lxml import html

import perilune
from perilune.analysis.campaigns.folder.shard_files import shard_path
from perilune.analysis.cli import main
from perilune.analysis.documents.of.batch.content import BatchContent
from perilune.analysis.documents.of.batch.replays import extremes_to_replay
from perilune.analysis.runtime.flight import interruptible
from perilune.common.paths import SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
TRIALS = 6


@pytest.fixture(scope="module")
def folder(fmus, tmp_path_factory):
    """Return a campaign of two variants with noise, a fault that varies by trial, changed values and a set.

    System, campaign and parameter set were in another folder, which is gone.
    """
    made, retained = tmp_path_factory.mktemp("made"), tmp_path_factory.mktemp("kept")
    shutil.copytree(SYSTEMS / SYSTEM, made / SYSTEM)
    (campaign,) = (made / SYSTEM).rglob("noisy.toml")
    fault = (
        '\n[fault.thrust]\nconnector = "allocation.thrust_acceleration"\nkind = "bias"\n'
        'value = "1e-3 * ground_range / 1e5"\nstart = "10 + ground_range / 1e5"\nend = "60"\n'
    )
    shutil.copy(campaign, made / "mine.toml")
    with (made / "mine.toml").open("a") as file:
        file.write(fault)
    perilune.batch(
        made / SYSTEM,
        made / "mine.toml",
        compare={"guidance": ["analytic_guidance", "astar_guidance"]},
        trials=TRIALS,
        seed=11,
        workers=1,
        set={"plant.initial_mass": 950.0},
        faults=["navigation.position[3]=bias:2@30..40"],
        step=0.2,
        output=made / "out",
    )
    (made / "out").rename(retained / "campaign")
    shutil.rmtree(made)
    return retained / "campaign"


def stored(folder, variant):
    table = pyarrow.parquet.read_table(folder / "trials")
    return {row["trial"]: row for row in table.to_pylist() if row["variant"] == variant}


@pytest.mark.parametrize("variant", ["analytic_guidance", "astar_guidance"])
def test_every_metric_is_the_stored_one_to_the_last_bit(folder, variant):
    rows = stored(folder, variant)
    for trial in (0, TRIALS - 1):
        actual = perilune.replay(folder, trial, configuration=variant)
        row = rows[trial]
        names = [name.removeprefix("metric.") for name in row if name.startswith("metric.")]
        assert len(names) > 2
        assert {name: value.hex() for name, value in actual.metrics.items()} == {
            name: float(row[f"metric.{name}"]).hex() for name in names
        }
        assert (actual.status, actual.success) == (row["status"].partition(" (")[0], row["success"])
        assert actual.time[-1] == row["end_time"]
        assert actual["plant.position"].shape == (actual.time.size, 3)
        assert (actual.stored, actual.differences) == (True, ())
        assert len(actual.replayed.faults) == 2


def test_the_command(folder, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    row = stored(folder, "astar_guidance")[3]
    files = ["--output", "flight.parquet", "--report", "page.html", "--json", "flight.json"]
    command = ["replay", str(folder), "3", "--configuration", "astar_guidance"]
    status = main([*command, *files, "--require", f"metric.flight_time == {row['metric.flight_time']!r}"])
    captured = capsys.readouterr()
    assert status == 0 if row["success"] else 1
    assert "identical to the stored trial, bit for bit" in captured.out.splitlines()
    assert captured.out.splitlines()[-1] == "written: flight.parquet, page.html, flight.json"
    actual = json.loads((tmp_path / "flight.json").read_text())
    assert (actual["trial"], actual["configuration"], actual["stored"]) == (3, "astar_guidance", True)
    assert actual["metrics"] == {name[7:]: value for name, value in row.items() if name.startswith("metric.")}
    assert {limit["verdict"] for limit in actual["limits"]} == {"met"}
    table = pyarrow.parquet.read_table(tmp_path / "flight.parquet")
    assert table["time"][-1].as_py() == row["end_time"]
    assert f"{SYSTEM}, astar_guidance, trial 3" in (tmp_path / "page.html").read_text()


def test_a_trial_that_is_no_longer_the_stored_one_is_named(folder, tmp_path, capsys):
    """One bit of one metric changed in the shard, as another C library would have it."""
    other = tmp_path / "other"
    shutil.copytree(folder, other)
    path = shard_path(other, 0)
    with pyarrow.parquet.ParquetFile(path) as file:
        groups = [file.read_row_group(place) for place in range(file.num_row_groups)]
    place = groups[0].column_names.index("metric.flight_time")
    values = groups[0]["metric.flight_time"].to_numpy().copy()
    values[2] = np.nextafter(values[2], np.inf)
    groups[0] = groups[0].set_column(place, groups[0].schema.field(place), pyarrow.array(values))
    with pyarrow.parquet.ParquetWriter(path, groups[0].schema) as writer:
        for group in groups:
            writer.write_table(group)
    assert main(["replay", str(other), "2", "--configuration", "analytic_guidance"]) == 1
    line = capsys.readouterr().err.splitlines()[-1]
    assert f"trial 2: flight_time {values[2].item()!r} is stored, " in line
    assert main(["replay", str(other), "1", "--configuration", "analytic_guidance"]) == 0


def test_a_replay_that_is_cut_off_says_nothing_of_the_rest(tmp_path, capsys, monkeypatch):
    """A simulation of 400 000 steps, which takes a tenth of a second or more: the limit is a hundredth of that.

    A busy machine may need longer than PATIENCE for its initialisation.
    """
    monkeypatch.setattr(interruptible, "PATIENCE", 60.0)
    folder = str(tmp_path / "fine")
    options = ["--campaign", "paper", "--compare", "guidance=analytic_guidance", "--step", "5e-4", "--trials", "1"]
    assert main(["batch", "lunar_terminal_guidance", *options, "--output", folder]) == 0
    capsys.readouterr()
    assert main(["replay", folder, "0", "--timeout", "1e-3"]) == 1
    captured = capsys.readouterr()
    assert "equal to the stored trial" not in captured.out
    (line,) = [line for line in captured.err.splitlines() if "is stored" in line]
    assert line.endswith(
        "trial 0: status 'finished' is stored, 'timed_out' was simulated: other results are not compared"
    )


def test_a_campaign_that_has_not_flown(folder, tmp_path, capsys):
    """Its draws are there, and nothing to compare with."""
    bare = tmp_path / "bare"
    shutil.copytree(folder, bare)
    shutil.rmtree(bare / "trials")
    (bare / "summary.json").unlink()
    actual = perilune.replay(bare, 4, configuration="analytic_guidance")
    assert (actual.stored, actual.differences) == (False, ())
    assert actual.metrics["flight_time"] == stored(folder, "analytic_guidance")[4]["metric.flight_time"]


REFUSED = {
    "a trial beyond the last": (["6", "--configuration", "astar_guidance"], "trial 6: no such trial; give 0 to 5"),
    "no variant of two": (
        ["0"],
        "--configuration: the campaign has 2 configurations, and none is selected; give one of analytic_guidance",
    ),
    "another variant": (
        ["0", "--configuration", "astar"],
        "--configuration astar: no such configuration; use one of a",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused(name, folder, capsys):
    words, problem = REFUSED[name]
    assert main(["replay", str(folder), *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"perilune: {folder}: ")
    assert problem in line


def test_a_folder_that_is_none(tmp_path, refusal):
    assert "manifest.json: not found; give a folder that perilune batch" in refusal(["replay", str(tmp_path), "0"])


def test_a_comparison_names_the_failures_of_each_variant(tmp_path, monkeypatch):
    """Every flight fails on a thrust of 1e308 N; two folders, of which one has a single variant."""
    monkeypatch.chdir(tmp_path)
    for name, compare in (("both", ["analytic_guidance", "astar_guidance"]), ("one", ["astar_guidance"])):
        faults = ["guidance.thrust_acceleration=override:1e308@1"] if name == "both" else []
        options = {"trials": 2, "seed": 3, "workers": 1, "output": name, "stop_time": 5.0, "faults": faults}
        perilune.batch(SYSTEM, "paper", compare={"guidance": compare}, **options)
    comparison = perilune.compare("both", "one")
    comparison.report("page.html")
    page = html.parse("page.html")
    rows = [row for row in page.xpath("//table[contains(@class, 'replays')]//tr")[1:] if "others" in row.text_content()]
    commands = ["".join(row.xpath(".//code//text()")) for row in rows]
    names = ("analytic_guidance", "astar_guidance")
    expected = [f"perilune replay both {trial} --configuration {name}" for name in names for trial in (0, 1)]
    assert commands == [*expected, "perilune replay one 0", "perilune replay one 1"]
    assert all("0 of 2 others succeed" in row.text_content() for row in rows)
    assert main(shlex.split(commands[0])[1:]) == 1


def test_pages_print_the_short_command_where_there_is_a_folder(folder, tmp_path, monkeypatch, capsys):
    """As the user names it, and it flies."""
    monkeypatch.chdir(folder.parent)
    result = perilune.merge(folder.name)
    rows = [*BatchContent(result).replays, *extremes_to_replay(result)]
    assert rows
    for row in rows:
        assert row.command == f"perilune replay campaign {row.trial} --configuration {row.variant}"
    result.report(tmp_path / "page.html")
    assert rows[0].command in (tmp_path / "page.html").read_text()
    main(shlex.split(rows[0].command)[1:])
    assert "identical to the stored trial, bit for bit" in capsys.readouterr().out
    alone = perilune.batch(SYSTEM, "noisy", trials=2, workers=1, compare={"guidance": ["analytic_guidance"]})
    assert all(row.command.startswith("perilune replay ") for row in extremes_to_replay(alone))


GROWING = """
from perilune import Block, Output


class Growing(Block):
    \"\"\"Its second output, which no campaign reads, overflows.\"\"\"

    y = Output(0.0, description="time")
    z = Output(1.0, description="grows beyond all numbers")

    def step(self, t: float, h: float) -> None:
        self.y = t + h
        self.z = self.z * 1e200
"""
READS_Y = """
system = "growing"
trials = 2
seed = 1
[metric.last]
expression = "growing.y"
reduction = "final"
[success]
expression = "last > 0"
"""


def test_an_output_that_the_campaign_does_not_read_may_overflow(tmp_path, monkeypatch):
    """Status and metrics of the replay are those of the batch."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "growing.py").write_text(GROWING)
    perilune.export("growing.py", flavour="python", output="growing.fmu")
    (tmp_path / "reads_y.toml").write_text(READS_Y)
    options = {"stop_time": 4.0, "step": 1.0}
    batch = perilune.batch("growing.fmu", "reads_y.toml", workers=1, output="out", **options)
    assert {status for trials in batch.trials.values() for status in trials.statuses} == {"stop_time"}
    with pytest.warns(
        UserWarning,
        match=r"growing\.z .*; this signal is not recorded, since the campaign does "
        r"not use it",
    ):
        actual = perilune.replay("out", 1)
    assert (actual.status, actual.differences, actual.metrics) == ("stop_time", (), {"last": 4.0})
    assert actual["growing.y"].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert actual.problems() == []


def test_a_success_that_violates_limits_says_who_judges(tmp_path, capsys):
    """The campaign's success is a flight of 3 s, at whose end the system's limits are not kept."""
    campaign = tmp_path / "short.toml"
    campaign.write_text('extends = "paper"\ntrials = 1\nsuccess.expression = "flight_time > 0"\n')
    options = ["--configuration", "analytic_guidance", "--stop-time", "3"]
    assert main(["replay", SYSTEM, "0", "--campaign", str(campaign), *options]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert any("limits violated: " in line for line in lines)
    assert lines[-1].endswith(
        ": trial 0: a success of the campaign, since flight_time > 0 is met; "
        "the lines above come from the system's description"
    )
