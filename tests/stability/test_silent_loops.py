"""Loops without a returning signal at the amplitudes of a study, because of a quantiser in the loop.

Truth: jets in steps of 0.05 N do not respond to a change of a thousandth of a step, although the robot docks.
"""

import pytest

from perilune.analysis.cli import main

CUT = "translation_control.force_command"
pytestmark = pytest.mark.usefixtures("fmus")


def test_a_quantiser_on_the_path_is_named_and_passes_nothing(capsys):
    """It read `modulus margin 1.000, disk margin 2.000: pass`."""
    assert main(["stability", "robot_rendezvous", "--loop", CUT, "--at", "20"]) == 1
    captured = capsys.readouterr()
    lines = [f"{CUT}[{k}] at t = 20 s: not applicable: no signal returns downstream of jets" for k in (1, 2, 3)]
    assert captured.out.splitlines()[:3] == lines
    assert captured.err.splitlines() == [f"perilune: loop {line}" for line in lines]
    assert not any(claim in captured.out for claim in ("unstable", "radius", "margin", "pass"))
