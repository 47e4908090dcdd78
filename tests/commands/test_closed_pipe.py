"""A closed pipe or a full disk prevents no result from being written and changes no exit status.

Truth: a pipe of the operating system whose reading end is closed before the command begins; the same command with a
reader.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.foreign.odd_fmu import Call, Deed, odd_fmu
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
CAMPAIGN = f"{SYSTEM} --campaign paper --compare guidance=analytic_guidance --workers 1"
VERBS = {
    "run": (f"run {SYSTEM} --output a.csv --report a.html --json a.json", ["a.csv", "a.csv.json", "a.html", "a.json"]),
    "batch": (f"batch {CAMPAIGN} --trials 2 --output a --report a.html", ["a", "a.html"]),
    "law": ("design law diveev_2013 --output a.ssv --graph a.svg", ["a.ssv", "a.svg"]),
}


def perilune(words: str, folder: Path, output, unbuffered: bool = True) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, **({"PYTHONUNBUFFERED": "1"} if unbuffered else {})}
    return subprocess.run(
        [sys.executable, "-m", "perilune", *words.split()],
        cwd=folder,
        env=environment,
        stdout=output,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )


def closed() -> int:
    """Return the writing end of a pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


@pytest.mark.parametrize("verb", either([*VERBS], ["run"]))
def test_nothing_is_lost(verb, tmp_path):
    words, files = VERBS[verb]
    output = closed()
    done = perilune(words, tmp_path, output)
    os.close(output)
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in tmp_path.iterdir()} >= set(files)


@pytest.mark.parametrize(
    ("words", "status", "unbuffered"),
    [
        ("design transfer --dry-mass 590", 1, False),
        ("run --help", 0, False),
    ],
)
def test_the_status_is_that_of_a_command_that_is_read(words, status, unbuffered, tmp_path):
    """Written at once, or all at the end, which is what Python does with a pipe."""
    output = closed()
    done = perilune(words, tmp_path, output, unbuffered)
    os.close(output)
    assert done.returncode == status
    assert "Traceback" not in done.stderr
    assert "Broken pipe" not in done.stderr


def test_the_first_line_is_enough_for_a_reader(tmp_path):
    line = f"{sys.executable} -m perilune run {SYSTEM} --output a.csv | head -1"
    done = subprocess.run(
        ["bash", "-o", "pipefail", "-c", line], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"{SYSTEM}: completed at t = 207.2 s, 2073 samples\n"
    assert (tmp_path / "a.csv").read_text().count("\n") == 2074


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
def test_output_that_goes_to_a_full_disk_is_named_and_costs_no_file(tmp_path):
    with Path("/dev/full").open("w") as full:
        done = perilune("design law diveev_2013 --output a.ssv", tmp_path, full)
    assert done.returncode == 2
    assert done.stderr.startswith("perilune: standard output: No space left on device; ")
    assert done.stderr.count("\n") == 1
    assert (tmp_path / "a.ssv").is_file()


def test_standard_error_that_nobody_reads(tmp_path):
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m perilune design transfer --dry-mass 590 --json a.json 2>&- >&-"],
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 1
    assert (tmp_path / "a.json").is_file()


@pytest.mark.parametrize("options", either(["", "--in-process"], ["--in-process"]))
def test_what_an_fmu_prints_gets_into_no_file_where_no_stream_is_open(options, tmp_path):
    """Whatever the process opens first would else have the number of standard output."""
    odd_fmu(tmp_path, DEED=Deed.PRINT, IN=Call.STEP)
    words = f"{sys.executable} -m perilune run odd.fmu --stop-time 1 --step 0.25 {options} --report page.html --output"
    for file, streams in (("open.csv", ">/dev/null 2>/dev/null"), ("closed.csv", "<&- >&- 2>&-")):
        done = subprocess.run(["bash", "-c", f"{words} {file} {streams}"], cwd=tmp_path, timeout=100, check=False)
        assert done.returncode == 0
    assert (tmp_path / "closed.csv").read_bytes() == (tmp_path / "open.csv").read_bytes()
