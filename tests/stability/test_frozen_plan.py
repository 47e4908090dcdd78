"""A law without the plan that an operating point freezes is named before any linearisation.

Truth: the command of a network operator does not depend on time, and the law computes time_to_go from its state.
"""

import pytest

from perilune.analysis.cli import main


@pytest.mark.usefixtures("fmus")
def test_a_law_that_ignores_a_frozen_plan_is_named(capsys):
    """It read `the flight ended early` for each of twelve channels."""
    use = ["--use", "guidance=network_operator_guidance"]
    assert main(["stability", "lunar_landing", *use, "--loop", "acceleration"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    (line,) = captured.err.splitlines()
    assert "point time_to_go_100, guidance (network_operator_guidance): guidance.frozen_time_to_go is 100, " in line
    assert "guidance.time_to_go is " in line
    assert line.endswith(
        "choose an FMU that holds its plan (a law in Python: by planned_time), or leave the parameter at 0"
    )
