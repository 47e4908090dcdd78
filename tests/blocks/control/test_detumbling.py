"""B-dot law in closed loop with a rotating body: it removes energy until the body turns with the field.

Truth: about one axis perpendicular to a field that turns at W, with slow rates relative to the sampling, w = W + (w0 -
W) exp(-k f t/J), with f the fraction of time in which the dipole acts; about any axis, Euler's equations integrated
here.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.fmus_src.control.magnetic_control import MagneticControl
from perilune.fmus_src.interfaces.ports.space import MagneticMode

CYCLE, GAIN, SIZE = 0.25, 0.0132, 3e-5


def brake(inertia, rate, seconds, field_at, limit):
    """Return rates at each second of a body that a dipole brakes; field_at(t) is the field (T) in inertial axes."""
    control = MagneticControl(mode=MagneticMode.DETUMBLE, detumble_gain=GAIN, dipole_limit=limit)
    inverse, attitude, rate = np.linalg.inv(inertia), Rotation.identity(), np.array(rate)
    control.measured_field = field_at(0.0).tolist()
    control.initialize()
    rows = [rate]

    def acceleration(w, torque):
        return inverse @ (torque - np.cross(w, inertia @ w))

    for n in range(round(seconds / CYCLE)):
        time = CYCLE * n
        middle = attitude * Rotation.from_rotvec(0.5 * CYCLE * rate)
        torque = np.cross(control.dipole, middle.inv().apply(field_at(time + 0.5 * CYCLE)))
        half = rate + 0.5 * CYCLE * acceleration(rate, torque)
        attitude = attitude * Rotation.from_rotvec(CYCLE * half)
        rate = rate + CYCLE * acceleration(half, torque)
        if (n + 1) % 4 == 0:
            control.measured_field = attitude.inv().apply(field_at(time + CYCLE)).tolist()
            control.field_count += 1
            rows.append(rate)
        control.step(time, CYCLE)
    return np.array(rows)


@pytest.mark.parametrize("field_rate", [0.0, 2e-3])
def test_the_rate_falls_to_that_of_the_field(field_rate):
    """To the share of the rate that is lost in a sample, whose mean rate the dipole answers."""
    inertia = 0.8

    def field_at(t):
        return SIZE * np.array([np.cos(field_rate * t), np.sin(field_rate * t), 0.0])

    rates = brake(inertia * np.eye(3), [0.0, 0.0, 0.05], 300.0, field_at, 1e9)
    decay = np.exp(-GAIN * 0.75 * np.arange(len(rates)) / inertia)
    expected = field_rate + (0.05 - field_rate) * decay
    assert np.abs(rates[:, :2]).max() == 0.0
    assert expected[-1] < 0.1 * 0.05
    np.testing.assert_allclose(rates[:, 2], expected, atol=GAIN / inertia * 0.05)


def test_energy_falls_about_every_axis():
    """By means over a minute; the dipole is limited at first."""
    inertia = np.array([[4.2, -0.1, 0.05], [-0.1, 4.0, 0.1], [0.05, 0.1, 3.0]])

    def field_at(t):
        return SIZE * np.array([1.2 * np.cos(2.2e-3 * t), 0.4, 1.2 * np.sin(2.2e-3 * t)])

    rates = brake(inertia, [0.05, -0.04, 0.06], 1200.0, field_at, 5.0)
    energy = 0.5 * np.einsum("ni,ij,nj->n", rates, inertia, rates)
    means = energy[1:].reshape(-1, 60).mean(axis=1)
    assert (np.diff(means) < 0.0).all()
    assert means[-1] < 0.25 * means[0]
