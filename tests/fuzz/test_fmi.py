"""Native FMUs accept any sequence of calls. `make fuzz` runs two million calls, guided by coverage.

Truth: the sanitizers of the compiler.
"""

from __future__ import annotations

import shutil
import subprocess

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from tests.fuzz.fmi import build
from tests.support.lengths import LONG, either

DENSE = ("kalman_navigation", "landing_sequencer")
BLOCKS = [block for block in catalogue().values() if not block.python_only and (LONG or block.fmu_name in DENSE)]
CASES = [(block, 2 + (number + k) % 2) for number, block in enumerate(BLOCKS) for k in range(either(2, 1))]
RUNS = either(20_000, 300)


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc, whose sanitizers these are")
@pytest.mark.parametrize(("block", "version"), CASES, ids=lambda part: getattr(part, "fmu_name", part))
def test_any_calls(block: type[Block], version: int, tmp_path):
    program = build(block, version, tmp_path, guided=False)
    done = subprocess.run([program, str(RUNS), "1"], capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
