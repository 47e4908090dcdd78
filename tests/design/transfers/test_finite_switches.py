"""perilune.analysis.design.transfers.finite_switches: best profile of the form of equation (3) in Huang 2017.

Truth: the paper's equations integrated by scipy's DOP853 with pitch as a state, driven on the tangent law by the second
derivative of the law's angle; bounds by the true optimum, which is not restricted to this form, and by the simplified
programme.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from perilune.analysis.design.trajectories.vehicle import Margins, Transfer, Vehicle
from perilune.analysis.design.transfers.finite_switches import find_finite_switches
from perilune.analysis.design.transfers.programme import find_programme
from perilune.analysis.design.transfers.true_optimum import find_true_optimum
from tests.design.transfers.test_adjoint import tangent_acceleration
from tests.support.lengths import either

ENGINE = 4707.192
VEHICLE = Vehicle(600.0, 0.0, 300.0, ENGINE, ENGINE / 15.0, math.radians(1.0))
TRANSFER = Transfer(1600.0, 2300.0, 1.622)
VEHICLES = {"limits": VEHICLE, "margins": Margins(0.90, 0.10, math.radians(0.70)).of(VEHICLE)}


@pytest.fixture(scope="module", params=either(["limits", "margins"], ["limits"]))
def planned(request):
    vehicle = VEHICLES[request.param]
    programme = find_programme(vehicle, TRANSFER)
    return vehicle, programme, find_finite_switches(programme)


def test_profile_ends_where_it_should(planned):
    vehicle, _, profile = planned
    t2, t3, t4, t5, t7 = profile.times
    direction, nearest, scale = profile.tangent
    sine, cosine = math.sin(direction), math.cos(direction)
    constants = sine, scale * cosine + nearest * sine, -cosine, scale * sine - nearest * cosine  # c1 to c4
    corners = [0.0, t2 / 2.0, t3, t4, (t5 + t7) / 2.0, t7]
    signs = [-1.0, 1.0, math.nan, -1.0, 1.0]

    def rates(t, s, thrust, sign):
        acceleration = thrust / (1.0 - s[4])
        law = math.isnan(sign)
        turning = tangent_acceleration(t, *constants) if law else sign * vehicle.angular_acceleration
        speed = [s[1], acceleration * math.cos(s[5]), s[3], acceleration * math.sin(s[5]) - TRANSFER.gravity]
        return [*speed, thrust / vehicle.exhaust_speed, s[6], turning]

    state = np.array([0.0, 0.0, 0.0, 0.0, 0.0, math.pi / 2.0, 0.0])
    for start, stop in pairwise(sorted({*corners, *(time for burn in profile.full_thrust for time in burn)})):
        middle = (start + stop) / 2.0
        is_full = any(low < middle < high for low, high in profile.full_thrust)
        arguments = vehicle.full if is_full else vehicle.least, signs[np.searchsorted(corners, middle) - 1]
        state = solve_ivp(rates, (start, stop), state, "DOP853", args=arguments, rtol=1e-11, atol=1e-11).y[:, -1]
    assert state[:4] == pytest.approx([1600.0, 0.0, -2300.0, 0.0], abs=1e-4)
    assert state[4] == pytest.approx(profile.propellant_fraction, abs=1e-9)
    assert state[5:] == pytest.approx([math.pi / 2.0, 0.0], abs=1e-6)


def test_finite_switches_cost_more_than_chattering_and_less_than_the_programme(planned):
    _, programme, profile = planned
    optimum = find_true_optimum(programme, 80, ENGINE)
    more = profile.propellant_fraction / optimum.propellant_fraction - 1.0
    assert 2e-3 < more < 2e-2
    assert profile.propellant_fraction < programme.propellant_fraction


def test_nothing_to_switch_straight_down():
    assert find_finite_switches(find_programme(VEHICLE, Transfer(0.0, 2300.0, 1.622))) is None
