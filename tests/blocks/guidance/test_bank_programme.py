"""Bank programme: reversals, and the time-optimal reference compared with an integrated bang-coast-bang profile.

Truth: the least time in closed form, 2 sqrt(angle/c) or angle/v + v/c, and the integral of the reference's second
derivative.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.guidance.bank_programme import BankProgramme

DEGREE = math.pi / 180.0
ways = st.floats(1.0 * DEGREE, 180.0 * DEGREE)


def programme(**parameters):
    block = BankProgramme(**parameters)
    block.initialize()
    return block


def at(block, time):
    block.programme(time)
    return block.reference_bank, block.reference_bank_rate, block.reference_bank_acceleration


def bound(way, speed, acceleration):
    """Return the least time for a distance (rad) at rest on both ends."""
    if way * acceleration <= speed * speed:
        return 2.0 * math.sqrt(way / acceleration)
    return way / speed + speed / acceleration


def test_reversals_change_the_sign():
    block = programme(reversal_times=[150.0, 200.0], method=0)
    targets = [(0.0, 1, 1e9), (149.9, 1, 1e9), (150.0, -1, 0.0), (199.0, -1, 49.0), (200.0, 1, 0.0), (300.0, 1, 100.0)]
    for time, sign, since in targets:
        block.programme(time)
        assert block.target_bank == block.reference_bank == sign * 60.0 * DEGREE
        assert block.time_since_reversal == since
    assert block.error_limit == math.pi
    limited = programme(method=1)
    assert limited.error_limit == pytest.approx(48.0 * DEGREE)


def test_120_degrees_take_13_49_seconds():
    block = programme(reversal_times=[200.0, 1e9])
    assert bound(120.0 * DEGREE, block.bank_rate, block.bank_acceleration) == pytest.approx(13.49, abs=0.005)
    times = np.arange(200.0, 220.0, 1e-3)
    away = np.array([abs(at(block, time)[0] + 60.0 * DEGREE) for time in times])
    assert times[np.flatnonzero(away > 3.0 * DEGREE)[-1]] - 200.0 == pytest.approx(12.17, abs=0.01)
    assert times[np.flatnonzero(away > 1e-12)[-1]] - 200.0 == pytest.approx(13.49, abs=0.01)


@given(ways, st.floats(0.05, 0.5), st.floats(0.02, 0.2))
def test_it_is_the_quickest_within_its_limits(way, speed, acceleration):
    """Its acceleration, integrated twice, is it; neither limit is passed, and it takes the least time: 1e-6 rad."""
    block = programme(
        first_target=0.5 * way, reversal_times=[10.0, 1e9], bank_rate=speed, bank_acceleration=acceleration
    )
    minimum = bound(way, speed, acceleration)
    times = np.linspace(10.0, 10.0 + minimum, 2001)
    rows = np.array([at(block, time) for time in times])
    assert np.abs(rows[:, 1]).max() <= speed * (1.0 + 1e-12)
    assert set(np.round(np.abs(rows[:, 2]) / acceleration, 9)) <= {0.0, 1.0}
    h = times[1] - times[0]
    middle = rows[:-1, 0] + h * 0.5 * (rows[:-1, 1] + rows[1:, 1])
    assert np.abs(middle - rows[1:, 0]).max() < acceleration * h * h
    assert np.abs(np.diff(rows[:, 1])).max() <= acceleration * h * (1.0 + 1e-6)
    assert rows[0, 0] == pytest.approx(0.5 * way)
    assert rows[-1, 0] == pytest.approx(-0.5 * way, abs=1e-9)
    assert at(block, 10.0 + minimum + 1e-6) == (-0.5 * way, 0.0, 0.0)
