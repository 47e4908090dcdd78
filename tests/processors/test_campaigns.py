"""Campaigns write the same bytes on a processor without fused multiply-add and wide vectors.

Truth: the folder of the same campaign on this processor. The C library, numpy and OpenBLAS are configured to use fewer
instructions. `make processors` simulates complete campaigns.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.processors.settings import PROCESSORS
from tests.support.campaigns.folders import bytes_of
from tests.support.lengths import LONG, either

pytestmark = pytest.mark.usefixtures("fmus")

EVERY_FUNCTION = str(Path(__file__).with_name("every_function.toml"))
SMALL = [("lunar_terminal_guidance", EVERY_FUNCTION, 6, [])]
WHOLE = [
    ("lunar_landing", "terminal_box", 60, []),
    ("robot_rendezvous", "seeds", 8, []),
    ("orbital_attitude", "noisy", 200, []),
    ("entry_attitude", "cases", 24, []),
    ("landing_mission", "contacts", 100, []),
    ("lunar_terminal_guidance", EVERY_FUNCTION, 1000, []),
]


def fly(campaign: list[str], folder: Path, environment: dict[str, str]) -> dict[str, str]:
    """Return the bytes of the files that a campaign writes to a folder."""
    words = ["batch", *campaign, "--seed", "5", "--output", str(folder)]
    done = subprocess.run(
        [sys.executable, "-m", "perilune", *words], env={**os.environ, **environment}, capture_output=True, text=True
    )
    assert done.returncode in (0, 1), done.stderr  # 1: some requirement or flight fails
    return bytes_of(folder)


@pytest.mark.parametrize(("system", "campaign", "trials", "options"), either(WHOLE, SMALL))
def test_a_campaign_leaves_the_same_bytes_on_another_processor(system, campaign, trials, options, tmp_path):
    words = [system, "--campaign", campaign, "--trials", str(trials), *options]
    here = fly(words, tmp_path / "here", {})
    assert any(name.startswith("trials/") for name in here)
    for name, environment in PROCESSORS.items():
        if LONG or name == "old":
            assert fly(words, tmp_path / name, environment) == here
