"""Foreign FMUs are loaded only into child processes: neither the command nor its simulation server maps their library.

Truth: /proc/PID/maps of every process of the command, read while the FMU waits in a step for the reader.
"""

from __future__ import annotations

import ast
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from perilune.common.paths import ROOT
from tests.support.foreign.odd_fmu import Call, Deed, odd_fmu
from tests.support.lengths import either

pytestmark = [pytest.mark.flies, pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")]
CAMPAIGN = """
system = "odd"
trials = 30
seed = 3

[draw."odd.gain"]
distribution = "uniform"
low = 1.0
high = 2.0

[metric.last]
expression = "odd.y"
reduction = "final"

[success]
expression = "last > 0"
"""
COMMANDS = {
    "run": ["run", "{fmu}", "--stop-time", "1"],
    "validate": ["validate", "{fmu}"],
    "batch": ["batch", "{fmu}", "--campaign", "{campaign}", "--stop-time", "1", "--step", "0.25", "--workers", "1"],
    "batch with two workers": ["batch", "{fmu}", "--campaign", "{campaign}", "--stop-time", "1", "--step", "0.25"],
    "rare": [
        "rare",
        "{fmu}",
        "--campaign",
        "{campaign}",
        "--stop-time",
        "1",
        "--step",
        "0.25",
        "--failure",
        "last < 0",
    ],
}


def maps(process):
    try:
        return Path(f"/proc/{process}/maps").read_text()
    except OSError:
        return ""


def family_of(command):
    """Return the processes that a command has started, and those that these have."""
    servers, children = [], []
    for each in psutil.Process(command.pid).children(recursive=True):
        with suppress(psutil.NoSuchProcess):  # it has ended in the meantime
            (servers if each.ppid() == command.pid else children).append(each.pid)
    return servers, children


def waiting(tmp_path, words, **quirks):
    """Start a command whose FMU waits in its calls; return its processes: command, server, children."""
    fmu = odd_fmu(tmp_path, **quirks)
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    line = [text.format(fmu=fmu, campaign=tmp_path / "c.toml") for text in words]
    command = subprocess.Popen(
        [sys.executable, "-m", "perilune", *line],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        # a shell that runs the tests in the background hands SIGINT down as ignored
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and command.poll() is None:
        servers, children = family_of(command)
        if any("/odd.so" in maps(child) for child in children):
            return command, servers, children
        time.sleep(0.02)
    command.kill()
    raise AssertionError(f"{line}: no child has loaded the FMU")


@pytest.mark.parametrize("name", either(list(COMMANDS), ["batch with two workers"]))
def test_no_other_process_has_them(tmp_path, name):
    """And Ctrl-C ends the command at once, although a call does not return, whichever child it is in."""
    command, servers, children = waiting(tmp_path, COMMANDS[name], DEED=Deed.HANG, IN=Call.INITIALISATION)
    try:
        assert servers
        assert all("/odd.so" not in maps(process) for process in (command.pid, *servers))
        assert all(maps(process) for process in (command.pid, *servers))
    finally:
        command.send_signal(signal.SIGINT)
        command.wait(60.0)
    assert not [process for process in (*servers, *children) if psutil.pid_exists(process)]


def test_children_of_a_killed_command_are_gone(tmp_path):
    command, servers, children = waiting(tmp_path, COMMANDS["run"], DEED=Deed.HANG, IN=Call.STEP)
    os.kill(command.pid, signal.SIGKILL)
    command.wait()
    deadline = time.monotonic() + 10.0
    while time.monotonic() < deadline and any(map(psutil.pid_exists, (*servers, *children))):
        time.sleep(0.02)
    assert not [process for process in (*servers, *children) if psutil.pid_exists(process)]


def test_describe_loads_nothing(tmp_path):
    """Its constructor would end the process."""
    fmu = odd_fmu(tmp_path, DEED=Deed.SEGFAULT, IN=Call.CONSTRUCTION)
    done = subprocess.run([sys.executable, "-m", "perilune", "describe", str(fmu)], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


# Processes that may load FMUs: a child; this process through the door, where they are Perilune's own;
# the reference loop, which tests alone open.
LOADERS = {
    "analysis/runtime/process/child.py",
    "analysis/runtime/process/opening.py",
    "analysis/runtime/flight/simulation.py",
    "analysis/runtime/instances/reset_check.py",
    "analysis/runtime/program/opening.py",
}


def test_who_loads_fmus():
    """By what each file imports: `Simulation`, `reset_verdict` or `instantiate` of these modules."""
    loaders = set()
    for path in sorted((ROOT / "analysis").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").endswith(
                ("flight.simulation", "instances.instance", "reset_check", "instance")
            ):
                names = {alias.name for alias in node.names}
                if names & {"Simulation", "instantiate"} or (names & {"reset_verdict"} and "flight/" not in str(path)):
                    loaders.add(path.relative_to(ROOT).as_posix())
    assert loaders == LOADERS
