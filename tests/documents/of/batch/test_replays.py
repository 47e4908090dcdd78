"""Replay commands on the page of a batch.

Truth: hand-written outcomes with known worst trials; and the command line, which must reproduce the trial of the batch.
"""

import json
import math
import shlex
from dataclasses import replace

import pytest
from lxml import html

import perilune
from perilune.analysis.campaigns.definition.campaign import Variant
from perilune.analysis.cli import main
from perilune.analysis.commands.campaigns import replay_command
from perilune.analysis.documents.of.batch.content import BatchContent
from perilune.analysis.documents.of.batch.replays import extremes_to_replay
from perilune.analysis.documents.render.cell_markup import cell_markup
from perilune.analysis.documents.render.words import cell_text
from perilune.analysis.options.fault import parse_fault
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.series import read_series
from tests.support.pages.checks import assert_self_contained, text_of
from tests.support.pages.samples import DRAWS, METRICS, batch_result, write_batch_page

ONE = [(True, 0.1, 0.2), (False, 3.0, 0.1), (True, 0.3, 0.2), (False, math.nan, 0.1), *[(False, 2.0, 0.0)] * 2]
TWO = [(True, 0.1, 0.0)] * 5 + [(True, 0.2, 0.0)]


def told(rows):
    return [(row.variant, row.trial, list(map(cell_markup, row.reasons))) for row in rows]


def test_the_first_failures_and_where_a_metric_is_largest():
    """Three of the four failures of one; its tilt is largest in two trials, which tells of neither."""
    result = batch_result({"one": ONE, "two": TWO}, DRAWS + METRICS)
    ended = "stop_time (ship.status 2)"
    actual = BatchContent(result).replays
    assert [(row.variant, row.trial) for row in actual] == [("one", 1), ("one", 3), ("one", 4), ("two", 5)]
    reasons = [[cell_text(reason) for reason in row.reasons] for row in actual]  # miss is worst where it is no number
    assert reasons == [[ended], [ended, "worst miss: not a number m"], [ended], ["worst miss: 0.2 m"]]
    assert len({row.anchor for row in actual}) == 4
    actual = extremes_to_replay(result)
    assert told(actual) == [
        ("one", 1, ['miss: <data value="3.0">3</data> m']),
        ("two", 5, ['miss: <data value="0.2">0.2</data> m']),
    ]
    assert actual[1].command == (
        "perilune replay ship 5 --campaign test.toml --trials 6 --seed 7 --compare guidance=two"
    )


def test_a_trial_in_which_two_metrics_are_largest_stands_once():
    rows = [(True, 1.0, 0.1), (True, 2.0, 0.2)]
    (actual,) = extremes_to_replay(batch_result({"default": rows}, DRAWS + METRICS))
    assert [cell_text(reason).partition(":")[0] for reason in actual.reasons] == ["miss", "tilt"]


def test_what_never_settles_is_largest():
    rows = [(True, 1.0, 0.0), (True, math.inf, 0.0)]
    result = batch_result({"default": rows}, DRAWS + METRICS)
    assert told(extremes_to_replay(result)) == [("default", 1, ['miss: <data value="inf">\N{INFINITY}</data> m'])]


def test_nothing_to_fly_again(tmp_path):
    result = batch_result({"default": [(True, 0.0, 0.0)] * 3}, METRICS)
    assert BatchContent(result).replays == extremes_to_replay(result) == []
    write_batch_page(result, tmp_path / "page.html", "Calm")
    assert "Replay commands" not in text_of((tmp_path / "page.html").read_text(encoding="utf-8"))


def test_they_are_on_the_page(tmp_path):
    result = batch_result({"one": ONE, "two": TWO}, DRAWS + METRICS)
    write_batch_page(result, tmp_path / "page.html", "Again")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert_self_contained(page)
    for row in (*BatchContent(result).replays, *extremes_to_replay(result)):
        assert row.command in text_of(page)
    calm = batch_result({"two": TWO}, DRAWS + METRICS)
    write_batch_page(calm, tmp_path / "calm.html", "Calm")
    assert "No failures: two." in text_of((tmp_path / "calm.html").read_text(encoding="utf-8"))


def test_every_option_is_in_the_command():
    plan = batch_result({"default": [(True, 0.0, 0.0)] * 3}, METRICS).plan
    options = SystemOptions(
        use={"plant": "other"},
        parameters=("a set.ssv",),
        set={"plant.latch": True, "plant.x": 1.5},
        step=0.1,
        stop_time=20.0,
        algorithm="jacobi",
        variant="Other",
        flavour="python",
        allow_unmatched=True,
        feedthrough=("law",),
        no_feedthrough=("plant",),
    )
    fault = parse_fault("plant.x=bias:0.5@1..2")
    command = replay_command(replace(plan, options=options, faults=(fault,)), Variant("default", {}), 2)
    options = [
        "--campaign test.toml", "--trials 3", "--seed 7", "--use plant=other", "--parameters 'a set.ssv'",
        "--set plant.latch=true", "--set plant.x=1.5", "--feedthrough law", "--no-feedthrough plant", "--step 0.1",
        "--stop-time 20.0", "--variant Other", "--flavour python", "--algorithm jacobi", f"--fault {fault}",
        "--allow-unmatched",
    ]  # fmt: skip
    assert command.startswith("perilune replay ship 2 ")
    for option in options:
        assert f" {option}" in command
    assert len(command) == len("perilune replay ship 2") + sum(len(option) + 1 for option in options)


def test_inputs_over_time_are_in_the_command(tmp_path):
    plan, file = batch_result({"default": ONE}, METRICS).plan, tmp_path / "inputs.csv"
    file.write_text("time,push\n0,1\n2,3\n")
    command = replay_command(replace(plan, series=read_series(file)), Variant("default", {}), 0)
    assert command.endswith(f"--input {file}")


@pytest.mark.usefixtures("fmus")
def test_the_command_flies_what_the_batch_flew(capsys):
    """To the last bit."""
    result = perilune.batch(
        "lunar_terminal_guidance",
        "noisy",
        trials=3,
        seed=5,
        workers=1,
        compare={"guidance": ["analytic_guidance"]},
        set={"plant.initial_mass": 950.0},
    )
    row = extremes_to_replay(result)[0]
    program, *words = shlex.split(row.command)
    assert program == "perilune"
    assert main([*words, "--json", "-"]) == 0
    flown = json.loads(capsys.readouterr().out)
    assert flown["configuration"] == row.variant
    trials = result.trials[row.variant]
    for name, value in flown["metrics"].items():
        assert value == trials.metrics[name][row.trial]


@pytest.mark.usefixtures("fmus")
def test_the_command_of_a_page_writes_the_page_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    slot = "guidance=analytic_guidance,astar_guidance"
    options = ["--campaign", "paper", "--trials", "3", "--compare", slot, "--set", "plant.initial_mass=900"]
    assert main(["batch", "lunar_terminal_guidance", *options, "--report", "first.html"]) in (0, 1)
    page = (tmp_path / "first.html").read_text(encoding="utf-8")
    (command,) = html.document_fromstring(page).xpath("//p[@class='repeat']/code/text()")
    assert main([*shlex.split(command)[1:], "--report", "second.html"]) in (0, 1)
    assert (tmp_path / "second.html").read_text(encoding="utf-8") == page
