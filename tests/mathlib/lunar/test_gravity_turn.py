"""Gravity turn in closed form, compared with its integration by DOP853 and with quadrature of the hodograph.

Truth: v proportional to tan(psi/2)^n/sin(psi) (Culler and Fried 1957), whose height, time and distance are integrals;
the equations of motion; the vertical descent, n = 1 + v^2/(2 g H). Printed numbers are from a separate program.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.mathlib.lunar.gravity_turn import gravity_turn
from tests.support.descent.hodograph import integrals

GRAVITY = 1.624219
PRINTED = [
    (100.0, np.radians(60.0), 2000.0, (1.837409049382183, 60.56622914543622, 1780.1829321544617)),
    (50.0, 0.3, 800.0, (1.9193631523665244, 32.971801532820486, 158.75658288197667)),
]
cases = {"speed": st.floats(1.0, 900.0), "angle": st.floats(0.01, 1.5), "height": st.floats(10.0, 2e4)}


@pytest.mark.parametrize(("speed", "angle", "height", "printed"), PRINTED)
def test_the_printed_turns(speed, angle, height, printed):
    turn = gravity_turn(speed, np.cos(angle), height, GRAVITY)
    assert (turn.ratio, turn.duration, turn.distance) == pytest.approx(printed, rel=1e-12)


@pytest.mark.parametrize(("speed", "angle", "height", "printed"), PRINTED)
def test_the_turn_flown_comes_to_rest_there(speed, angle, height, printed):
    """To 1 % of the time before the end, where the closed form has still that much to go."""
    turn = gravity_turn(speed, np.cos(angle), height, GRAVITY)

    def motion(t, state):
        velocity = state[2:]
        return np.concatenate([velocity, -turn.ratio * GRAVITY * velocity / np.linalg.norm(velocity) - [0.0, GRAVITY]])

    start = [0.0, height, speed * np.sin(angle), -speed * np.cos(angle)]
    end = 0.99 * turn.duration
    path = solve_ivp(motion, (0.0, end), start, method="DOP853", rtol=1e-11, atol=1e-9)
    x, z, vx, vz = path.y[:, -1]
    left = gravity_turn(np.hypot(vx, vz), -vz / np.hypot(vx, vz), z, GRAVITY)
    assert left.ratio == pytest.approx(turn.ratio, rel=1e-6)
    assert left.duration == pytest.approx(turn.duration - end, rel=1e-6)
    assert x + left.distance == pytest.approx(turn.distance, rel=1e-9)


@given(**cases)
@settings(deadline=None, max_examples=40)
def test_the_integrals_of_the_hodograph(speed, angle, height):
    turn = gravity_turn(speed, np.cos(angle), height, GRAVITY)
    if turn.ratio < 1.05:  # all but hovering for hours: quad does not resolve the end
        return
    fallen, time, distance = integrals(speed, angle, turn.ratio, GRAVITY)
    assert fallen == pytest.approx(height, rel=1e-6)
    assert time == pytest.approx(turn.duration, rel=1e-6)
    assert distance == pytest.approx(turn.distance, rel=1e-6)


@given(speed=cases["speed"], height=cases["height"], beyond=st.sampled_from([1.0, 1.0 + 1e-15]))
def test_straight_down(speed, height, beyond):
    """A cosine that rounding has put above 1 counts as 1."""
    turn = gravity_turn(speed, beyond, height, GRAVITY)
    assert turn.ratio == pytest.approx(1.0 + speed**2 / (2.0 * GRAVITY * height), rel=1e-12)
    assert turn.duration == pytest.approx(2.0 * height / speed, rel=1e-9)
    assert turn.distance == 0.0


@pytest.mark.parametrize(
    ("speed", "cosine", "height", "gravity"),
    [
        (50.0, 0.5, 0.0, GRAVITY),
        (50.0, 0.5, -1.0, GRAVITY),
        (50.0, 0.0, 9.0, GRAVITY),
        (0.0, 1.0, 9.0, GRAVITY),
        (50.0, -0.1, 9.0, GRAVITY),
        (50.0, 0.5, 9.0, 0.0),
        (1e-20, 0.5, 9.0, GRAVITY),
        (1e-200, 0.5, 9.0, GRAVITY),
    ],
)
def test_no_turn(speed, cosine, height, gravity):
    """At or below the target, level or ascending, at rest but for rounding, or without gravity."""
    assert gravity_turn(speed, cosine, height, gravity).ratio == 0.0
