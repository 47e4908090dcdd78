"""Fused steps under the address and undefined-behaviour sanitizers, in two threads: `make sanitize`.

Truth: the sanitizers, which end the process; the table of the native FMUs.
"""

import os
import shutil
import subprocess
import sys

import pytest

from tests.support.lengths import LONG
from tests.support.native.sanitizers import UNDEFINED

# A campaign of each system, and some trials of it.
CAMPAIGNS = {
    "entry_attitude": ("cases", 24),
    "hover_transfer": ("tracking", 8),
    "landing_mission": ("faults", 8),
    "lunar_descent_2d": ("table1", 9),
    "lunar_landing": ("lag", 3),
    "lunar_terminal_guidance": ("noisy", 4),
    "orbital_attitude": ("noisy", 40),
    "robot_rendezvous": ("seeds", 4),
    "satellite_pointing": ("dispersed", 3),
}
FLIGHTS = """
import sys
import perilune
from perilune.analysis.runtime.fused import fuse
system, campaign, trials = sys.argv[1], sys.argv[2], int(sys.argv[3])
native = perilune.batch(system, campaign, trials=trials, workers=2, flavour="native")
fuse.FLAGS = (*fuse.FLAGS, "-O1", "-fno-sanitize-recover=all", "-fsanitize=address," + sys.argv[4])
fused = perilune.batch(system, campaign, trials=trials, workers=2, flavour="fused")
assert repr(fused.table().to_pydict()) == repr(native.table().to_pydict())
"""


def find_file(name):
    """Return the path of a library of gcc."""
    command = ["gcc", f"-print-file-name={name}"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.skipif(not LONG, reason="half a minute for each system: make sanitize")
@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc, which has a library to preload")
@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("system", CAMPAIGNS)
def test_no_sanitizer_objects(system):
    campaign, trials = CAMPAIGNS[system]
    runtime = [find_file("libasan.so"), find_file("libstdc++.so")]  # the former looks for the latter, which pyarrow has
    environment = os.environ | {"LD_PRELOAD": " ".join(runtime), "ASAN_OPTIONS": "detect_leaks=0"}
    command = [sys.executable, "-c", FLIGHTS, system, campaign, str(trials), UNDEFINED]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
