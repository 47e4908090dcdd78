"""perilune.analysis.design.transfers.adjoint: costates along the optimum, and its optimality conditions.

Truth: the paper's equations of motion and adjoint equations (Huang 2017) as printed, in its n1, p and tm, integrated by
scipy's DOP853; the least propellant of other distances and descents, whose differences are psi1 and psi3; the order of
the direct method's step; the second derivative of the tangent law's angle by differences.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from perilune.analysis.design.trajectories.vehicle import Transfer, Vehicle
from perilune.analysis.design.transfers.adjoint import INTEGRALS, NODES, integrate_adjoint, zeros_of
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.design.transfers.programme import find_programme
from perilune.analysis.design.transfers.true_optimum import find_true_optimum
from perilune.common.errors import InputError
from tests.support.lengths import either

ENGINE = 4707.192
VEHICLE = Vehicle(600.0, 0.0, 300.0, ENGINE, ENGINE / 15.0, math.radians(1.0))
TRANSFER = Transfer(1600.0, 2300.0, 1.622)
INTERVALS = either(320, 80)
EARTH, IMPULSE, THRUST_RATIO = 9.80665, 300.0, 0.8  # g_e (m/s2), p (s), n1


@cache
def optimum(transfer=TRANSFER, intervals=INTERVALS):
    return find_true_optimum(find_programme(VEHICLE, transfer), intervals, ENGINE)


@cache
def solution(intervals=INTERVALS):
    return integrate_adjoint(optimum(intervals=intervals), VEHICLE, TRANSFER, ENGINE)


def as_printed(_, s, throttle, turning):
    """Return the paper's equations (1) and its adjoint system."""
    _, vx, _, vy, tm, angle, rate, psi1, psi2, psi3, psi4, _, psi6, _ = s
    acceleration = THRUST_RATIO * EARTH * throttle * IMPULSE / (IMPULSE - THRUST_RATIO * tm)
    along = psi2 * math.cos(angle) + psi4 * math.sin(angle)
    across = -psi2 * math.sin(angle) + psi4 * math.cos(angle)
    motion = [
        vx,
        acceleration * math.cos(angle),
        vy,
        acceleration * math.sin(angle) - TRANSFER.gravity,
        throttle,
        rate,
        turning,
    ]
    fifth = -along * EARTH * throttle * IMPULSE / (IMPULSE / THRUST_RATIO - tm) ** 2
    return [*motion, 0.0, -psi1, 0.0, -psi3, fifth, -across * acceleration, -psi6]


def test_costates_are_those_of_the_printed_system():
    path, actual = optimum(), solution()
    state = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * math.pi, 0.0, *actual.costates[0, 0]])
    scale = np.abs(actual.costates).max(axis=(0, 1))
    for k in range(path.throttle.size):
        controls = (path.throttle[k], path.acceleration[k])
        state = solve_ivp(as_printed, path.time[k : k + 2], state, "DOP853", args=controls, rtol=1e-10, atol=1e-13).y[
            :, -1
        ]
        assert np.abs(state[7:] - actual.costates[k, -1]) / scale == pytest.approx(np.zeros(7), abs=1e-6)
    assert state[:4] == pytest.approx([1600.0, 0.0, -2300.0, 0.0], abs=either(1e-4, 2e-2))
    assert state[4] * THRUST_RATIO / IMPULSE == pytest.approx(path.propellant_fraction, abs=1e-12)
    assert actual.costates[-1, -1, 4] == pytest.approx(THRUST_RATIO / IMPULSE)  # of the propellant by tm


@pytest.mark.parametrize(("name", "index", "sign"), [("distance", 0, -1.0), ("descent", 2, 1.0)])
def test_costates_are_differences_of_the_least_propellant(name, index, sign):
    """A start that is shifted is another distance or descent."""
    step = 2.0
    ends = [replace(TRANSFER, **{name: getattr(TRANSFER, name) + change}) for change in (-step, step)]
    less, more = (optimum(end, 80).propellant_fraction for end in ends)
    assert solution(80).costates[0, 0, index] == pytest.approx(sign * (more - less) / (2.0 * step), rel=2e-3)


def test_multipliers_agree_to_the_order_of_the_step():
    mismatch = [solution(intervals).mismatch for intervals in (40, 80)]
    assert math.log2(mismatch[0] / mismatch[1]) == pytest.approx(4.0, abs=0.5)


def test_tangent_law():
    """Pitch is a straight line's angle from a point, which four costates determine, within an arc in the middle."""
    actual = solution()
    begin, end = actual.singular_span
    assert begin == pytest.approx(29.0, abs=1.0)
    assert end == pytest.approx(58.0, abs=1.0)
    rms, largest = np.degrees(actual.tangent_residual)
    assert rms < 0.01
    assert largest < 0.1
    c2, c4 = -actual.costates[0, 0, [1, 3]]
    c1, c3 = -actual.costates[0, 0, [0, 2]]
    inside = actual.singular_arc
    time = actual.time[inside]
    law = np.arctan2(c4 - c3 * time, c2 - c1 * time)
    assert np.degrees(np.sqrt(np.mean((law - actual.pitch[inside]) ** 2))) == pytest.approx(rms, rel=1e-6)


def test_controls_are_of_the_sign_of_their_functions():
    actual = solution()
    assert actual.switching_residual < 1e-5
    assert actual.turning_residual < 1e-4
    assert actual.hamiltonian_residual < 0.02
    assert actual.reversals[0] >= 3  # (3) has one on each side
    assert actual.reversals[1] >= 3
    switches = [time for burn in optimum().burns()[:2] for time in burn]
    assert actual.switching_times[:4] == pytest.approx(switches, abs=TRANSFER_STEP)


TRANSFER_STEP = 76.0 / INTERVALS


def tangent_acceleration(t, c1, c2, c3, c4):
    """Return the paper's alpha* with its two mistakes mended: of the fraction (c4 - c3 t)/(c2 - c1 t)."""
    size = (c2 - c1 * t) ** 2 + (c4 - c3 * t) ** 2
    return -2.0 * (c2 * c3 - c1 * c4) * (c1 * c2 + c3 * c4 - (c1**2 + c3**2) * t) / size**2


def printed_acceleration(t, c1, c2, c4):
    """Return the acceleration as printed, which has three constants and belongs to (1 - c4 t)/(c1 - c2 t)."""
    size = (c1 - c2 * t) ** 2 + (1.0 - c4 * t) ** 2
    return 2.0 * (c2 - c1 * c4) * ((c2**2 + c4**2) * t - c1 * c2 - c4) / size**2


@pytest.mark.parametrize("t", [-0.7, 0.2, 1.3])
def test_printed_acceleration_of_the_tangent_law_has_the_wrong_sign(t):
    c1, c2, c4, h = 0.8, -0.3, 0.5, 1e-3

    def bend(rise, run):
        angles = np.unwrap([math.atan2(rise(s), run(s)) for s in (t - h, t, t + h)])
        return (angles[0] - 2.0 * angles[1] + angles[2]) / h**2

    actual = bend(lambda s: 1.0 - c4 * s, lambda s: c1 - c2 * s)
    assert printed_acceleration(t, c1, c2, c4) == pytest.approx(-actual, rel=1e-4)
    assert tangent_acceleration(t, c2, c1, c4, 1.0) == pytest.approx(actual, rel=1e-4)
    general = bend(lambda s: 0.4 - 0.9 * s, lambda s: 1.1 - 0.2 * s)
    assert tangent_acceleration(t, 0.2, 1.1, 0.9, 0.4) == pytest.approx(general, rel=1e-4)


def test_optimum_accelerates_as_the_tangent_law():
    """In the middle of the arc, away from where it is joined."""
    actual = solution()
    arc = actual.singular_arc
    quarter = (arc.stop - arc.start) // 4
    inside = slice(arc.start + quarter, arc.stop - quarter)
    c2, c4 = -actual.costates[0, 0, [1, 3]]
    c1, c3 = -actual.costates[0, 0, [0, 2]]
    law = tangent_acceleration(actual.time[inside].mean(axis=1), c1, c2, c3, c4) / VEHICLE.angular_acceleration
    assert actual.turning[inside] == pytest.approx(law, abs=2e-3)


def test_nodes_integrate_polynomials():
    values = 3.0 * NODES**2 - NODES**5
    assert INTEGRALS @ values == pytest.approx(1.0 - NODES**3 - (1.0 - NODES**6) / 6.0)
    assert zeros_of(np.array([[0.0, 1.0], [1.0, 2.0]]), np.array([[-1.0, 1.0], [1.0, -3.0]])) == pytest.approx(
        [0.5, 1.25]
    )


def test_nothing_turns_straight_down():
    with pytest.raises(InputError, match="a vertical descent, over 0 m, has no turn"):
        hover_study(VEHICLE, replace(TRANSFER, distance=0.0), optimum=True, adjoint=True, intervals=40)
