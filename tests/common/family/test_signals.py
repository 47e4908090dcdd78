"""No process of a command outlives it, for any signal that ends the command.

Truth: the operating system's list of its descendants, whose work takes far longer: FMUs that hang, a compiler that
sleeps, a study of many seconds.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress

import psutil
import pytest

from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu
from tests.support.interrupts import descendants, seconds_until_gone, started, wait_for
from tests.support.lengths import either

pytestmark = [pytest.mark.flies, pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")]
LIMIT = 30.0  # s, for a machine that is busy
SYSTEM = ["odd.fmu", "--stop-time", "1", "--step", "0.25"]
CAMPAIGN = [*SYSTEM, "--campaign", "c.toml", "--workers", "2"]
FIXED = ["--hold", "odd.count=1"]  # studies of draws go between values
GAIN = """
[draw."odd.gain"]
distribution = "uniform"
low = 1.0
high = 2.0
"""
SERVER, WORKER, COMPILER = "process.server import main", "loky", "sleep 600"
# Words of the command, what its processes have in their command lines, and how many of these there are.
COMMANDS = {
    "run": (["run", *SYSTEM], SERVER, 2),
    "validate": (["validate", "odd.fmu"], SERVER, 2),
    "batch": (["batch", *CAMPAIGN], SERVER, 2),
    "batch into a folder": (["batch", *CAMPAIGN, "--output", "out"], SERVER, 2),
    "prepare": (["prepare", *CAMPAIGN[:-2], "--output", "out"], SERVER, 2),
    "sensitivity": (["sensitivity", *CAMPAIGN, "--base", "64", *FIXED], SERVER, 2),
    "worst": (["worst", *CAMPAIGN, *FIXED], SERVER, 2),
    "rare": (["rare", *CAMPAIGN, *FIXED, "--failure", "last < 0"], SERVER, 2),
    "stability": (["stability", "robot_rendezvous", "--workers", "2"], WORKER, 2),
    "worst margin": (
        ["worst", "robot_rendezvous", "--loop", "attitude", "--campaign", "inertia", "--workers", "2"],
        WORKER,
        2,
    ),
    "fused": (["run", "lunar_terminal_guidance", "--flavour", "fused"], COMPILER, 1),
    "export": (["export", "lunar_terminal_guidance", "--as-fmu"], "keeper.py", 1),
}
SHORT = [
    ("stability", signal.SIGINT),
    ("fused", signal.SIGKILL),
]
SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL)


@pytest.fixture
def slow_compiler(tmp_path):
    """Return an environment whose compiler states its version, and leaves the work to a process that never ends."""
    (tmp_path / "bin").mkdir()
    script = tmp_path / "bin" / "cc"
    script.write_text('#!/bin/sh\ncase "$*" in *" -o "*) sleep 600 & wait ;; *) echo 1 ;; esac\n')
    script.chmod(0o755)
    return {"PATH": f"{script.parent}{os.pathsep}{os.environ['PATH']}", "XDG_CACHE_HOME": str(tmp_path / "cache")}


def there_are(count: int, text: str) -> Callable[[list[str]], bool]:
    return lambda lines: sum(text in line for line in lines) >= count


@pytest.mark.parametrize(
    ("name", "sent"), either([(name, sent) for name in COMMANDS for sent in SIGNALS], SHORT), ids=str
)
def test_all_descendants_end(tmp_path, slow_compiler, name, sent):
    odd_fmu(tmp_path, DEED=Deed.HANG, IN=Call.INITIALISATION)
    (tmp_path / "c.toml").write_text(COUNTS.format(name="odd", trials=30) + GAIN)
    words, text, count = COMMANDS[name]
    with started(words, tmp_path, slow_compiler) as command:
        wait_for(command, there_are(count, text))
        family = descendants(command)
        command.send_signal(sent)
        seconds, alive = seconds_until_gone(family, LIMIT)
        for each in family:
            with suppress(psutil.NoSuchProcess):
                each.kill()
        print(f"{name}: {sent.name}: {seconds:.2f} s")
        assert not alive
        command.wait(LIMIT)
