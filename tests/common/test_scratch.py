"""Temporary folders: removed with their process, or by the next process.

Truth: the folders among the temporary files.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

MAKES = """
import os, signal, sys
from perilune.common.scratch import make_folder
print(make_folder(), flush=True)
sys.stdin.readline()
"""


def process(folder):
    environment = {**os.environ, "TMPDIR": str(folder)}
    command = [sys.executable, "-c", MAKES]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)


def make_old(folder):
    """Set the time stamps to those of a process of an hour ago."""
    for lock in folder.glob("*/lock"):
        os.utime(lock, (time.time() - 3600, time.time() - 3600))


def test_it_goes_with_its_process(tmp_path):
    maker = process(tmp_path)
    maker.stdout.readline()
    assert len(list(tmp_path.iterdir())) == 1
    maker.communicate("\n")
    assert not list(tmp_path.iterdir())


def test_those_of_processes_that_were_killed_are_swept(tmp_path):
    killed, alive = process(tmp_path), process(tmp_path)
    left, locked = killed.stdout.readline().strip(), alive.stdout.readline().strip()
    killed.kill()
    killed.wait()
    make_old(tmp_path)
    process(tmp_path).communicate("\n")
    assert not os.path.exists(left)
    assert os.path.exists(locked)
    alive.communicate("\n")


def test_a_young_one_is_left_alone(tmp_path):
    """Its process may be about to lock it."""
    killed = process(tmp_path)
    killed.stdout.readline()
    killed.kill()
    killed.wait()
    process(tmp_path).communicate("\n")
    assert len(list(tmp_path.iterdir())) == 1
