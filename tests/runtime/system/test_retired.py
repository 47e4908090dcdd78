"""Names of FMUs that became values of another FMU: they are simulated as before, and a message states the new form.

Truth: the simulation with the new block and its values, signal by signal.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.stale import RETIRED
from perilune.fmus_src.catalogue import catalogue

pytestmark = pytest.mark.usefixtures("fmus")


def test_what_replaces_a_retired_fmu_exists():
    blocks = catalogue()
    assert not set(RETIRED) & set(blocks)
    assert {retired.block for retired in RETIRED.values()} <= set(blocks)


@pytest.mark.parametrize(
    ("system", "old", "new"),
    [
        (
            "entry_attitude",
            {"use": {"regulator": "output_feedback_dual_a"}},
            {"use": {"regulator": "output_feedback"}, "parameters": ["output_feedback_dual_a.ssv"]},
        ),
        (
            "orbital_attitude",
            {"use": {"observer": "orbital_observer_discrete_split", "pulses": "pulse_allocation_mean"}},
            {
                "use": {"observer": "orbital_observer_discrete"},
                "set": {"observer.split": True, "pulses.mean": True},
            },
        ),
    ],
)
def test_a_retired_name_is_its_block_with_values(system, old, new):
    before, now = (perilune.simulate(system, stop_time=20.0, **options) for options in (old, new))
    for name in now.signals:
        np.testing.assert_array_equal(before[name], now[name], err_msg=name)


def test_values_of_the_user_stand_above_those_of_a_retired_name():
    use = {"observer": "orbital_observer_discrete_split"}
    plain = perilune.simulate("orbital_attitude", stop_time=5.0, use=use, set={"observer.split": False})
    assert plain.prepared.settings.variables["observer", "split"] is False


def test_the_command_line_says_what_to_write(capsys):
    arguments = ["run", "orbital_attitude", "--stop-time", "1", "--use", "observer=orbital_observer_discrete_split"]
    assert main(arguments) in (0, 1)  # limits are not met this early
    expected = "observer: orbital_observer_discrete_split is retired and accepted in this release only: "
    assert f"{expected}use orbital_observer_discrete and observer.split = true" in capsys.readouterr().err
    assert main(["run", "entry_attitude", "--stop-time", "1", "--use", "regulator=output_feedback_direct0"]) in (0, 1)
    assert "use output_feedback and output_feedback_direct0.ssv" in capsys.readouterr().err
