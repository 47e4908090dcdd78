"""Ctrl-C during a simulation: results until then are returned, equal to the results of a complete simulation.

Truth: the same simulation without an interruption, bit for bit.
"""

import threading

import numpy as np
import pytest

from perilune.analysis.runtime.flight.interruptible import fly, wait
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.interrupts import interrupted_when

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.mark.parametrize(("flavour", "step"), [("python", None), ("native", 0.005)])
def test_what_was_flown_comes_back(monkeypatch, flavour, step):
    monkeypatch.setattr("perilune.analysis.runtime.flight.interruptible.PATIENCE", 60.0)
    prepared = prepare_system("lunar_landing", SystemOptions(flavour=flavour, step=step))
    with Simulation(prepared, requested=["plant.position[1]", "plant.mass"]) as simulation:
        with interrupted_when(lambda: simulation.buffers.outcome[4] > 100):
            result = fly(simulation)
        flown = {name: values.copy() for name, values in result.signals.items()}
        times = result.time.copy()
    assert result.status == "interrupted"
    assert not result.complete
    assert result.message == f"interrupted at t = {times[-1]:g} s"
    assert 100 < times.size < prepared.steps
    with Simulation(prepared, requested=["plant.position[1]", "plant.mass"]) as simulation:
        whole = simulation.advance(-1, times.size - 1)
        for name, values in flown.items():
            assert np.array_equal(values, whole[name])
        assert np.array_equal(times, whole.time)


def test_work_that_does_not_end_is_given_up(monkeypatch):
    monkeypatch.setattr("perilune.analysis.runtime.flight.interruptible.PATIENCE", 0.05)
    started, never = threading.Event(), threading.Event()

    def work():
        started.set()
        never.wait(10.0)

    with interrupted_when(started.is_set), pytest.raises(KeyboardInterrupt):
        wait(work, lambda: None, lambda: None)
    never.set()


def test_errors_come_through():
    with pytest.raises(ZeroDivisionError):
        wait(lambda: 1 / 0, lambda: None, lambda: None)
