"""Residual motion of a flexible mode after an open-loop slew.

Truth: the response of an undamped oscillator to the angular acceleration of the slew, in closed form. The hub's
amplitude is s/(1 - s) J(W_ff)/W_ff where s is the fraction of the inertia and J the magnitude of the acceleration's
Fourier transform.
"""

from math import pi, sqrt

import numpy as np
import pytest

from perilune.fmus_src.plants.spacecraft import Spacecraft
from tests.support.native.named_instance import NamedInstance
from tests.support.space.states import FAR, FRICTIONLESS

INERTIA, FRACTION = 120.0, 0.1
ANGLE, RATE, ACCELERATION = pi / 3.0, 0.02, 1e-3  # rad, rad/s, rad/s2
RAMP, COAST = RATE / ACCELERATION, ANGLE / RATE  # s
QUINTIC = 15.0 / 8.0 * ANGLE / RATE  # s
ARCSECOND = pi / 648000.0


def bang_coast(w):
    return 4.0 * ACCELERATION / w * abs(np.sin(0.5 * w * RAMP) * np.sin(0.5 * w * COAST))


def quintic(w):
    b = w * QUINTIC
    series = 60.0 * np.sin(b / 2) / b**2 + 360.0 * np.cos(b / 2) / b**3 - 720.0 * np.sin(b / 2) / b**4
    return abs(2.0 * ANGLE / QUINTIC * series)


def segments(turn):
    """Return durations (s) and accelerations (rad/s2) of a turn in segments."""
    if turn is bang_coast:
        return [(RAMP, ACCELERATION), (COAST - RAMP, 0.0), (RAMP, -ACCELERATION)]
    edges = np.linspace(0.0, 1.0, 2001)
    rate = ANGLE / QUINTIC * 30.0 * (edges**2 - 2.0 * edges**3 + edges**4)
    step = QUINTIC / 2000
    return [(step, change / step) for change in np.diff(rate)]


# Frequency on a fixed base (Hz): amplitudes (arcsec) after both turns, computed by another program.
PRINTED = {0.25: (14.8869, 0.240852), 0.5: (7.9158, 0.059542), 1.0: (0.3017, 0.010470)}


@pytest.mark.parametrize("frequency", PRINTED)
@pytest.mark.parametrize("turn", [bang_coast, quintic])
def test_the_hub_swings_as_the_closed_form_says(frequency, turn):
    w = 2.0 * pi * frequency / sqrt(1.0 - FRACTION)
    amplitude = FRACTION / (1.0 - FRACTION) * turn(w) / w
    assert amplitude / ARCSECOND == pytest.approx(PRINTED[frequency][turn is quintic], rel=1e-4)
    rotation = np.zeros((4, 3))
    rotation[0, 2] = sqrt(FRACTION * INERTIA)
    craft = NamedInstance(
        Spacecraft,
        **FAR | FRICTIONLESS,
        inertia=INERTIA * np.eye(3),
        wheel_inertia=1e-9,
        mode_frequency=[2.0 * pi * frequency, 0.0, 0.0, 0.0],
        mode_damping=[0.0] * 4,
        mode_rotation=rotation,
        internal_step=0.01,
    )
    for duration, acceleration in segments(turn):
        craft.set(body_torque=[0.0, 0.0, INERTIA * acceleration])
        craft.fly(duration)
    craft.set(body_torque=[0.0, 0.0, 0.0])
    rates = [craft.fly(2.0 * pi / w / 64)["angular_velocity"][2] for _ in range(64)]
    swing = abs(np.fft.rfft(rates)[1]) / 32 / w
    assert swing == pytest.approx(amplitude, abs=2e-4 * ARCSECOND, rel=1e-4)
