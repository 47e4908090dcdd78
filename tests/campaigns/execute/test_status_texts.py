"""Texts on the end of a trial, written and read back.

Truth: hand-written outcomes with known worst statuses.
"""

import numpy as np
import pytest

from perilune.analysis.campaigns.execute.evaluation import trial_statuses, worst_statuses
from perilune.analysis.runtime.flight.group import FlightGroup
from perilune.analysis.runtime.flight.results import Flight


@pytest.mark.parametrize(
    ("statuses", "text"),
    [
        ({}, "finished"),
        ({"guidance.status": [0, 0]}, "finished"),
        ({"guidance.status": [0, 2, 1]}, "finished (guidance.status 2)"),
        ({"a.b.status": [3], "guidance.status": [0], "status": [-1]}, "finished (a.b.status 3, status -1)"),
    ],
)
def test_what_is_written_is_read_back(statuses, text):
    signals = {name: np.array(values, dtype=float) for name, values in statuses.items()}
    longest = max((len(values) for values in signals.values()), default=0)
    signals = {name: np.resize(values, longest) for name, values in signals.items()}
    flight = FlightGroup.of(Flight(np.arange(longest) * 0.1, signals, {}, "finished", ""))
    assert trial_statuses(flight, list(statuses)) == [text]
    worst = {name: int(max(values)) for name, values in statuses.items()}
    assert worst_statuses(text) == {name: status for name, status in worst.items() if status != 0}
