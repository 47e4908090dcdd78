"""A process that ends with another process, on systems whose kernel does not support this.

Truth: the operating system, which reports when a process has ended.
"""

from __future__ import annotations

import subprocess
import sys

from perilune.common.family.ending import end_after

LIMIT = 30.0  # s, for a machine that is busy
WAIT = "import time; print(flush=True); time.sleep(600)"
FOLLOW = f"from {end_after.__module__} import end_after; end_after({{}}); {WAIT}"


def test_it_ends_after_another_one():
    with (
        subprocess.Popen([sys.executable, "-c", WAIT]) as leader,
        subprocess.Popen([sys.executable, "-c", FOLLOW.format(leader.pid)], stdout=subprocess.PIPE) as follower,
    ):
        follower.stdout.readline()
        assert follower.poll() is None
        leader.kill()
        leader.wait()
        assert follower.wait(LIMIT) == 1
