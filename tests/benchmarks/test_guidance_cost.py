"""Recorded steps of a law equal the steps of its simulation, and callgrind's counts are reproducible."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from benchmarks.guidance_cost import compile_steps, count_instructions, record_guidance, time_steps

LAW = "gravity_turn_guidance"

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")


@pytest.fixture
def program(fmus: Path, tmp_path: Path) -> Path:
    return compile_steps(LAW, record_guidance(LAW, 1.0), tmp_path)


def test_every_step_of_the_recording_is_timed(program: Path) -> None:
    """The initialisation, and the steps at 0 to 1 s every 0.1 s."""
    assert len(time_steps([str(program)])) == 12


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="valgrind is not installed")
def test_instructions_are_those_that_another_tool_counts(program: Path) -> None:
    """Truth: callgrind's sum over the whole run of the same function, and itself once more."""
    counts = count_instructions(program)
    options = ["--collect-atstart=no", "--toggle-collect=counted", f"--callgrind-out-file={program}.out"]
    whole = subprocess.run(
        ["valgrind", "--tool=callgrind", *options, str(program)], check=True, capture_output=True, text=True
    )
    collected = int(whole.stderr.split("Collected : ")[1].split()[0])
    assert len(counts) == 12
    assert sum(counts) == collected
    assert counts == count_instructions(program)
