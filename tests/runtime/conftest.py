"""Rows of a system written our way; and all flights of these tests compared with the reference loop's."""

import threading

import pytest

from perilune.analysis.runtime.flight.simulation import Simulation
from tests.support.flights.reference import fly_again
from tests.support.foreign.plain_system import fly_plain
from tests.support.lengths import LONG

SHORT = 20_000  # numbers in the record of a flight that is flown again
NOT_AGAIN = ("/program/", "/foreign/test_life_cycle.py")  # flown again anyway; every call of an FMU counts


@pytest.fixture
def plain(tiny, tmp_path):
    return fly_plain(tiny, tmp_path)


if LONG:

    @pytest.fixture(autouse=True)
    def flown_again(monkeypatch, request):
        """Repeat every flight of a simulation in this process from its start to its end by the reference loop."""
        fly = Simulation.advance

        def advance(self, first, last, *excitation, every=1):
            flight = fly(self, first, last, *excitation, every=every)
            is_whole = first < 0 and last == self.prepared.steps and every == 1 and not excitation
            is_plain = not self._selection.more and last * len(flight.signals) < SHORT
            if is_whole and is_plain and threading.current_thread() is threading.main_thread():
                with monkeypatch.context() as patch:
                    patch.setattr(Simulation, "advance", fly)
                    fly_again(self, flight)
            return flight

        if not any(part in request.path.as_posix() for part in NOT_AGAIN):
            monkeypatch.setattr(Simulation, "advance", advance)
