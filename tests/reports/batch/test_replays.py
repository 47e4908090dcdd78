"""Trials to fly again on the page of a batch.

Truth: outcomes made by hand, whose worst trials are seen; and the command line itself, which must fly the trial that
the batch flew.
"""

import json
import math
import shlex
from dataclasses import replace

import pytest

import perilune
from perilune.analysis.campaign.campaign import Variant
from perilune.analysis.cli import main
from perilune.analysis.reports.batch.batch_report import write_batch_report
from perilune.analysis.reports.batch.replays import replay_command, replays
from perilune.analysis.system.faults import parse_fault
from perilune.analysis.system.options import SystemOptions
from tests.support.pages.checks import text_of
from tests.support.pages.samples import DRAWS, METRICS, batch_result

ONE = [(True, 0.1, 0.2), (False, 3.0, 0.1), (True, 0.3, 0.2), (False, math.nan, 0.1), *[(False, 2.0, 0.0)] * 2]
TWO = [(True, 0.1, 0.0)] * 5 + [(True, 0.2, 0.0)]


def test_the_first_failures_and_where_a_metric_is_largest():
    """Three of the four failures of one; its tilt is largest in two trials, which tells of neither."""
    found = replays(batch_result({"one": ONE, "two": TWO}, DRAWS + METRICS))
    assert [(row.variant, row.trial) for row in found] == [("one", 1), ("one", 3), ("one", 4), ("two", 5)]
    assert [list(map(str, row.reasons)) for row in found] == [
        ["failure: stop_time (ship.status 2)", 'largest miss: <data value="3.0">3</data> m'],
        ["failure: stop_time (ship.status 2)"],
        ["failure: stop_time (ship.status 2)"],
        ['largest miss: <data value="0.2">0.2</data> m'],
    ]
    assert found[3].command == (
        "perilune batch ship --campaign test.toml --trials 6 --seed 7 --compare guidance=two --replay 5"
    )


def test_what_never_settles_is_largest():
    rows = [(True, 1.0, 0.0), (True, math.inf, 0.0)]
    (found,) = replays(batch_result({"default": rows}, DRAWS + METRICS))
    assert (found.trial, found.reasons) == (1, ['largest miss: <data value="inf">\N{INFINITY}</data> m'])


def test_nothing_to_fly_again(tmp_path):
    result = batch_result({"default": [(True, 0.0, 0.0)] * 3}, METRICS)
    assert replays(result) == []
    write_batch_report(result, tmp_path / "page.html", "Calm")
    assert "Trials to fly again" not in text_of((tmp_path / "page.html").read_text(encoding="utf-8"))


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
        no_feedthrough=("plant",),
    )
    fault = parse_fault("plant.x=bias:0.5@1..2")
    command = replay_command(replace(plan, options=options, faults=(fault,)), Variant("default", {}), 2)
    words = "--use plant=other --parameters 'a set.ssv' --set plant.latch=true --set plant.x=1.5 --no-feedthrough plant"
    more = "--step 0.1 --stop-time 20.0 --variant Other --flavour python --algorithm jacobi"
    assert command == (
        f"perilune batch ship --campaign test.toml --trials 3 --seed 7 {words} {more} --fault {fault} "
        "--allow-unmatched --replay 2"
    )


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
    found = replays(result)
    assert found
    row = found[0]
    program, *words = shlex.split(row.command)
    assert program == "perilune"
    assert main([*words, "--json", "-"]) == 0
    flown = json.loads(capsys.readouterr().out)["variants"]
    assert list(flown) == [row.variant]
    trials = result.trials[row.variant]
    for name, value in flown[row.variant]["metrics"].items():
        assert value == trials.metrics[name][row.trial]
