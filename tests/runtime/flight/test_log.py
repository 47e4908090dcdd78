"""Messages of FMUs, on standard error.

Truth: the messages of the test's FMU, step by step; FMI 2.0's statuses.
"""

from __future__ import annotations

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.lone_fmus import build_lone_fmu

CAMPAIGN = """
system = "Talking"
trials = 8
seed = 1

[draw."Talking.fails_at"]
distribution = "choice"
values = [9.0, 0.75]

[metric.last]
expression = "Talking.y"
reduction = "final"

[success]
expression = "last > 0"
"""
OK = [
    "t = 0 s: Talking: OK (logAll): ready",
    *(f"t = {t} s: Talking: OK (logAll): stepped to {t}" for t in (0.25, 0.5)),
]
WARNING = "t = 0.5 s: Talking: warning (logStatusWarning): half way"
LATER = "t = 0.75 s: Talking: OK (logAll): stepped to 0.75"
ERROR = "t = 0.75 s: Talking: error (logStatusError): too far | that is"
SAID = {"error": [ERROR], "warning": [WARNING, ERROR], "info": [*OK, WARNING, LATER, ERROR]}


@pytest.fixture(scope="module")
def talking(tmp_path_factory):
    return build_lone_fmu("Talking", tmp_path_factory.mktemp("talking"), 'stopTime="1" stepSize="0.25"')


@pytest.mark.parametrize("level", ["error", "warning", "info", "all"])
def test_levels(talking, capsys, level):
    result = perilune.simulate(talking, set={"Talking.fails_at": 0.75}, log=level)
    assert result.status == "terminated"  # which is what stock pythonfmu makes of a step that fails
    assert capsys.readouterr().err.splitlines() == [f"log: {line}" for line in SAID.get(level, SAID["info"])]


def test_without_it_nothing_is_written(talking, capsys):
    quiet = perilune.simulate(talking, set={"Talking.fails_at": 0.75})
    assert capsys.readouterr().err == ""
    assert quiet.message.endswith(
        "ready | stepped to 0.25 | stepped to 0.5 | half way | stepped to 0.75 | too far\nthat is"
    )
    assert perilune.simulate(talking, set={"Talking.fails_at": 0.75}, log="all").message == quiet.message


def test_the_command(talking, capsys):
    assert main(["run", str(talking), "--log", "warning"]) == 0
    printed = capsys.readouterr()
    assert printed.err == f"log: {WARNING}\n"
    assert printed.out == "Talking: stop time reached at t = 1 s, 5 samples\n"


@pytest.mark.parametrize("workers", ["1", "2"])
def test_a_batch_says_which_trial(talking, tmp_path, capfd, workers):
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    command = ["batch", str(talking), "--campaign", str(tmp_path / "c.toml"), "--workers", workers, "--log", "error"]
    assert main([*command, "--output", str(tmp_path / "results")]) == 0
    lines = [line for line in capfd.readouterr().err.splitlines() if line.startswith("log: ")]
    table = perilune.batch(talking, tmp_path / "c.toml", workers=1).table()
    failed = [trial for trial, value in enumerate(table["draw.Talking.fails_at"].to_pylist()) if value < 1.0]
    assert 0 < len(failed) < 8
    assert sorted(lines) == [f"log: default: trial {trial}: {ERROR}" for trial in failed]


def test_a_level_that_is_none(talking):
    with pytest.raises(InputError, match="log: loud: no such choice; use one of all, error, info, warning"):
        perilune.simulate(talking, log="loud")
