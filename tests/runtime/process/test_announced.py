"""Simulations announced to a child process: each uses its own values, whatever happened to the previous one.

Truth: the integral of the FMU's source, y(1 s) = gain u + count + mode.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.runtime.process.opening import open_simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu

pytestmark = pytest.mark.flies
U, COUNT, MODE = 0.5, 1, 1  # as the FMU declares them
OPTIONS = SystemOptions(stop_time=1.0, step=0.25)
BREAKING = """
[draw."odd.gain"]
distribution = "choice"
values = [-1.0, 0.0, 1.0, 2.0]
"""


def test_an_error_is_of_its_own_trial(tmp_path):
    """The FMU is broken after it, and the next flight, which is announced already, has another process."""
    fmu = odd_fmu(tmp_path, BREAKS=True)
    (tmp_path / "c.toml").write_text(COUNTS.format(name="odd", trials=60) + BREAKING)
    plan = read_plan(fmu, str(tmp_path / "c.toml"), OPTIONS)
    trials = run_batch(plan, workers=1).trials["default"]
    gain, count = (plan.draws.columns[f"odd.{name}"] for name in ("gain", "count"))
    assert [status == "failed" for status in trials.statuses] == (gain < 0.0).tolist()
    expected = gain * U + count + MODE
    np.testing.assert_allclose(trials.metrics["last"][gain >= 0.0], expected[gain >= 0.0], rtol=1e-14)


@pytest.fixture
def simulation(tmp_path):
    with open_simulation(prepare_system(odd_fmu(tmp_path), OPTIONS), varied=["odd.gain"]) as opened:
        yield opened


def last(flight):
    return flight["odd.y"][-1]


def test_two_are_flown_in_order(simulation):
    for gain in (1.0, 3.0, 5.0):
        simulation.queue_run({"odd.gain": gain}, ())
    assert [last(simulation.run({"odd.gain": gain})) for gain in (1.0, 3.0, 5.0)] == [2.5, 3.5, 4.5]


def test_others_fly_instead(simulation):
    simulation.queue_run({"odd.gain": 1.0}, ())
    simulation.queue_run({"odd.gain": 3.0}, ())
    assert last(simulation.run({"odd.gain": 7.0})) == 5.5
    assert last(simulation.run({"odd.gain": 3.0})) == 3.5


def test_a_flight_that_is_interrupted_does_not_end_the_next_one(simulation):
    simulation.run({"odd.gain": 1.0})
    simulation.interrupt()
    assert simulation.run({"odd.gain": 1.0}).status == "interrupted"
    simulation.interrupt(False)
    simulation.queue_run({"odd.gain": 1.0}, ())
    simulation.queue_run({"odd.gain": 3.0}, ())
    assert [last(simulation.run({"odd.gain": gain})) for gain in (1.0, 3.0)] == [2.5, 3.5]


def test_who_hangs_in_a_new_process_hangs_once(tmp_path):
    """The flights announced behind it count for nothing: it is the first of its process, and is not repeated."""
    fmu = odd_fmu(tmp_path, DEED=Deed.HANG, IN=Call.STEP)
    options = replace(OPTIONS, call_timeout=0.5)
    with open_simulation(prepare_system(fmu, options), varied=["odd.gain"]) as opened:
        for gain in (1.0, 3.0):
            opened.queue_run({"odd.gain": gain}, ())
        assert opened.run({"odd.gain": 1.0}).status == "hung"
        assert opened.flights == 1
