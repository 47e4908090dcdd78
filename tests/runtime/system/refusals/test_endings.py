"""Commands that cannot complete: exit status 1 or 2, and one line that states the reason.

Truth: the table of refusals in docs/command_line.md. Most tests use the command line's `main` in this process, a few
the installed command.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from perilune.analysis.cli import main
from tests.support.builders import component, system
from tests.support.refused import GAIN, ONE_LINE, RAMP, ssp

TROUBLE = component("trouble", "trouble", "output y Real m")


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (1, ["division", "see the FMU's message"]),
        (2, ["trouble.y is inf at t = 0.75 s"]),
        (3, ["trouble.y is nan at t = 0.75 s"]),
        (4, ["division"]),
    ],
)
def test_runs_that_fail_exit_with_1(tmp_path, tiny, refused, kind, words):
    path = ssp(tmp_path, tiny, system(TROUBLE))
    refused(path, "trouble", *words, options=["--set", f"trouble.kind={kind}"], status=1)


def test_output_that_cannot_be_written(tmp_path, tiny, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = str(ssp(tmp_path, tiny))
    assert main(["run", path, "--output", "flight.xls"]) == 2
    assert re.fullmatch(r"perilune: --output: flight\.xls: neither .csv nor .parquet; .*\n", capfd.readouterr().err)
    (tmp_path / "file").write_text("")
    assert main(["run", path, "--output", "file/flight.csv"]) == 2
    error = capfd.readouterr().err
    assert ONE_LINE.fullmatch(error), error
    assert main(["run", path, "--json", str(tmp_path)]) == 2
    error = capfd.readouterr().err
    assert ONE_LINE.fullmatch(error), error


def command(*arguments, cwd):
    script = Path(sys.executable).with_name("perilune")
    return subprocess.run(
        [script, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env={**os.environ, "COLUMNS": "80"},
    )


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (["run", "broken.ssp", "--output", "out.csv"], 2),
        (["run", "trouble.ssp", "--set", "trouble.kind=1"], 1),
        (["validate", "broken.ssp", "nowhere.ssv"], 2),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_the_installed_command(tmp_path, tiny, arguments, status):
    ssp(tmp_path, tiny, system(RAMP, GAIN))
    ssp(tmp_path, tiny, system(TROUBLE), name="trouble.ssp")
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == status, done.stderr
    assert len(done.stderr.splitlines()) == (2 if "validate" in arguments else 1), done.stderr
    assert done.stderr.startswith("perilune")
    assert status == 1 or "Traceback" not in done.stderr
    assert "_seconds" not in done.stderr
    assert {entry.name for entry in tmp_path.iterdir()} == {"broken.ssp", "trouble.ssp"}


@pytest.mark.parametrize("arguments", [["run", "trouble.ssp", "--stpe", "1"], ["run"]], ids=" ".join)
def test_arguments_that_argparse_refuses(tmp_path, tiny, capfd, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    ssp(tmp_path, tiny, system(TROUBLE), name="trouble.ssp")
    with pytest.raises(SystemExit) as ending:
        main(arguments)
    captured = capfd.readouterr()
    assert (ending.value.code, captured.out) == (2, "")
    assert re.fullmatch(r"perilune: .*\n", captured.err)
    assert "_seconds" not in captured.err
    assert {entry.name for entry in tmp_path.iterdir()} == {"trouble.ssp"}
