"""perilune.analysis.design.transfers.free_fall: the lander turns to the vertical in free fall and brakes once more.

Truth: the equations of motion integrated by scipy's DOP853, with pitch as a state driven by the switched angular
acceleration; a burn of constant deceleration in closed form; other programmes with the same end by scipy's `root`.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import root

from perilune.analysis.design.trajectories.vehicle import Margins, Transfer, Vehicle
from perilune.analysis.design.transfers.free_fall import find_free_fall, stop_falling
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.design.transfers.programme import find_programme
from tests.support.lengths import either

ENGINE = 4707.192
VEHICLE = Vehicle(600.0, 0.0, 300.0, ENGINE, ENGINE / 15.0, math.radians(1.0))
TRANSFER = Transfer(1600.0, 2300.0, 1.622)
MARGINS = Margins(0.90, 0.10, math.radians(0.70))


def plan_of(vehicle, distance, begun=0.0):
    return find_free_fall(find_programme(vehicle, replace(TRANSFER, distance=distance)), begun)


def fly(vehicle, times, fall, last_burn, accuracy=1e-11):
    """Return x, x', y, y', propellant fraction, pitch and its rate before the fall and at the end."""
    t2, t5, width, burn, t7 = times
    off = t7 - fall
    t1, t6 = t2 / 2.0, (t5 + t7) / 2.0
    d = np.min(np.roots([1.0, t2 - t5, t1**2 + (t7 - t6) ** 2]).real)
    begin = t2 - width if width <= t1 else math.sqrt(2.0 * t1**2 - width**2)
    end = t2 + width if width <= d else t2 + (width**2 + d**2) / (2.0 * d)
    corners = [0.0, t1, t2 + d, t5 - d, t6, t7, t7 + last_burn]
    signs = [-1.0, 1.0, 0.0, -1.0, 1.0, 0.0]
    full = [(begin, end), (off - burn, off), (t7, t7 + last_burn)]

    def rates(_, s, thrust, turning):
        acceleration = thrust / (1.0 - s[4])
        speed = [s[1], acceleration * math.cos(s[5]), s[3], acceleration * math.sin(s[5]) - TRANSFER.gravity]
        return [*speed, thrust / vehicle.exhaust_speed, s[6], turning]

    state, at_rest = np.array([0.0, 0.0, 0.0, 0.0, 0.0, math.pi / 2.0, 0.0]), None
    for start, stop in pairwise(sorted({*corners, off, *(time for burn in full for time in burn)})):
        middle = (start + stop) / 2.0
        thrust = 0.0 if off < middle < t7 else vehicle.least
        thrust = vehicle.full if any(low < middle < high for low, high in full) else thrust
        turning = vehicle.angular_acceleration * signs[np.searchsorted(corners, middle) - 1]
        run = solve_ivp(rates, (start, stop), state, "DOP853", args=(thrust, turning), rtol=accuracy, atol=accuracy)
        state = run.y[:, -1]
        at_rest = state if stop == off else at_rest
    return at_rest, state


@pytest.mark.parametrize(
    ("vehicle", "distance", "begun"),
    [(VEHICLE, 1600.0, 0.0), (VEHICLE, 100.0, 0.0), (MARGINS.of(VEHICLE), 1600.0, 0.0), (VEHICLE, 3000.0, 0.6)],
)
def test_programme_ends_where_it_should(vehicle, distance, begun):
    plan = plan_of(vehicle, distance, begun)
    hover, end = fly(vehicle, plan.times.elements(), plan.fall, plan.last_burn)
    assert hover[[1, 3]] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert begun or hover[6] == pytest.approx(0.0, abs=1e-9)  # a hover, tilted
    assert hover[5] > math.pi / 2.0
    assert end[:4] == pytest.approx([distance, 0.0, -2300.0, 0.0], abs=1e-5)
    assert end[4] == pytest.approx(plan.propellant_fraction, abs=1e-9)
    assert end[5:] == pytest.approx([math.pi / 2.0, 0.0], abs=1e-9)
    assert hover[2] - end[2] == pytest.approx(plan.drop, abs=1e-5)


def test_no_other_turn_takes_less():
    """At another duration of the turn, the four conditions solved for the other four times."""
    plan = plan_of(VEHICLE, 1600.0)
    times = np.array(plan.times.elements())
    for change in (-0.3, 0.3):
        turn = plan.fall + change

        def residual(z, turn=turn):
            t2, t5, width, burn = z
            hover, _ = fly(VEHICLE, (t2, t5, width, burn, t5 + turn), turn, 0.0, 1e-9)
            _, drop = stop_falling(VEHICLE, TRANSFER.gravity, hover[4], turn)
            return (hover[:4] - [1600.0, 0.0, drop - 2300.0, 0.0]) / [100.0, 5.0, 100.0, 5.0]

        other = root(residual, times[:4])
        assert other.success
        t2, t5, width, burn = other.x
        hover, _ = fly(VEHICLE, (t2, t5, width, burn, t5 + turn), turn, 0.0, 1e-9)
        last_burn, _ = stop_falling(VEHICLE, TRANSFER.gravity, hover[4], turn)
        spent = hover[4] + VEHICLE.full * last_burn / VEHICLE.exhaust_speed
        assert spent > plan.propellant_fraction


def test_burn_after_a_fall():
    """Without loss of mass a constant deceleration; with it, speed and height by quadrature."""
    heavy, fall, gravity = replace(VEHICLE, specific_impulse=1e4), 10.0, TRANSFER.gravity
    burn, drop = stop_falling(heavy, gravity, 0.0, fall)
    brake = VEHICLE.full - gravity
    assert burn == pytest.approx(gravity * fall / brake, rel=1e-3)
    assert drop == pytest.approx(gravity * fall**2 / 2.0 + (gravity * fall) ** 2 / (2.0 * brake), rel=1e-3)
    burn, drop = stop_falling(VEHICLE, gravity, 0.04, fall)

    def speed(t):
        return gravity * (fall + t) + VEHICLE.exhaust_speed * math.log1p(
            -VEHICLE.full / VEHICLE.exhaust_speed * t / 0.96
        )

    assert speed(burn) == pytest.approx(0.0, abs=1e-9)
    assert drop == pytest.approx(gravity * fall**2 / 2.0 + quad(speed, 0.0, burn)[0], rel=1e-9)


def test_turning_while_braking_takes_less_at_every_distance():
    """The difference is of the order of the speed that the fall gains, over the exhaust speed."""
    distances = either((50.0, 100.0, 300.0, 540.0, 1000.0, 1600.0, 3000.0), (50.0, 1600.0))
    study = hover_study(VEHICLE, TRANSFER, free_fall=True, distances=distances)
    for each in study.comparisons:
        plan = plan_of(VEHICLE, each.distance)
        assert each.free_fall == plan.propellant_fraction
        assert 1.03 * each.programme < each.free_fall < 1.13 * each.programme
        fall_alone = TRANSFER.gravity * plan.fall / VEHICLE.exhaust_speed  # the rocket equation without its losses
        assert each.free_fall - each.programme < 2.0 * fall_alone
    assert study.free_fall.propellant_fraction > study.programme.propellant_fraction
    assert plan_of(VEHICLE, 0.0) is None
