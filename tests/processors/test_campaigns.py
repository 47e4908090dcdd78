"""Campaigns leave the same bytes on a processor without fused operations and wide vectors.

Truth: the folder of the same campaign on this processor. The C library, numpy, OpenBLAS and numba are set to use
less of it. `make processors` flies whole campaigns.
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
SMALL = [
    ("lunar_landing", "terminal_box", 6),
    ("robot_rendezvous", "seeds", 1),
    ("orbital_attitude", "noisy", 40),  # one flight for each point of its grid
    ("lunar_terminal_guidance", EVERY_FUNCTION, 24),
]
WHOLE = [
    ("lunar_landing", "terminal_box", 60),
    ("robot_rendezvous", "seeds", 8),
    ("orbital_attitude", "noisy", 200),
    ("entry_attitude", "cases", 24),
    ("landing_mission", "contacts", 100),
    ("lunar_terminal_guidance", EVERY_FUNCTION, 1000),
]


def fly(system: str, campaign: str, trials: int, folder: Path, environment: dict[str, str]) -> dict[str, str]:
    """The bytes that a campaign leaves in a folder."""
    words = ["batch", system, "--campaign", campaign, "--trials", str(trials), "--seed", "5", "--output", str(folder)]
    done = subprocess.run(
        [sys.executable, "-m", "perilune", *words], env={**os.environ, **environment}, capture_output=True, text=True
    )
    assert done.returncode in (0, 1), done.stderr  # 1: some requirement or flight fails
    return bytes_of(folder)


@pytest.mark.parametrize(("system", "campaign", "trials"), either(WHOLE, SMALL))
def test_a_campaign_leaves_the_same_bytes_on_another_processor(system, campaign, trials, tmp_path):
    here = fly(system, campaign, trials, tmp_path / "here", {})
    assert any(name.startswith("trials/") for name in here)
    for name, environment in PROCESSORS.items():
        if LONG or name == "old":
            assert fly(system, campaign, trials, tmp_path / name, environment) == here
