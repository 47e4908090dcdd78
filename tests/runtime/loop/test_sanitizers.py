"""Loop under the address and undefined-behaviour sanitizers: `make sanitize`.

Truth: the sanitizers, which end the process, during the tests of simulations and reductions in other folders.
"""

import os
import shutil
import subprocess
import sys

import pytest

from tests.runtime.fused.test_sanitizers import find_file
from tests.support.lengths import LONG
from tests.support.native.sanitizers import UNDEFINED

SIMULATIONS = ("tests/runtime/fmi3", "tests/runtime/flight", "tests/runtime/loop/test_elementary.py")
REDUCTIONS = ("tests/campaigns/definition/test_reductions.py",)
TESTS = """
import sys
import pytest
from perilune.analysis.runtime.loop import library
library.FLAGS = (*library.FLAGS, "-O1", "-fno-sanitize-recover=all", "-fsanitize=address," + sys.argv[1])
assert not library.built_file(library.BUILD, library.local_platform(library.FMI)).is_file()
raise SystemExit(pytest.main(["-q", "-n", "0", "-p", "no:cacheprovider", *sys.argv[2:]]))
"""


@pytest.mark.skipif(not LONG, reason="some minutes: make sanitize")
@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc, which has a library to preload")
@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("tests", [SIMULATIONS, REDUCTIONS], ids=["simulations", "reductions"])
def test_no_sanitizer_objects(tests):
    runtime = [find_file("libasan.so"), find_file("libstdc++.so")]  # the former looks for the latter, which pyarrow has
    environment = os.environ | {"LD_PRELOAD": " ".join(runtime), "ASAN_OPTIONS": "detect_leaks=0", "PERILUNE_LONG": "0"}
    command = [sys.executable, "-c", TESTS, UNDEFINED, *tests]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
