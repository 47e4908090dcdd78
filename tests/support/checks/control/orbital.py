"""Truths of regulators of the orbital attitude, with the axes of `orbital_motion`: turns by scipy, linear algebra."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow
from tests.support.flights.orbital_motion import INERTIA, JET_TORQUE, ORBITAL_RATE, acceleration, body_from_orbital

ROWS = 33
TIME = STEP * np.arange(ROWS)
DOWN = np.array([0.0, 0.0, -ORBITAL_RATE])


def rates_of_angles(angles, w):
    """(roll, yaw, pitch)': the angular velocity against the orbital frame along the three axes that they turn about."""
    roll, _, pitch = angles
    pitch_axis = body_from_orbital([roll, 0.0, 0.0])[:, 2]
    yaw_axis = body_from_orbital([roll, 0.0, pitch])[:, 1]
    axes = np.column_stack([[1.0, 0.0, 0.0], yaw_axis, pitch_axis])
    return np.linalg.solve(axes, w - body_from_orbital(angles) @ DOWN)


def estimates(seed, angles_size, rates_size):
    """Attitudes and absolute angular velocities near those wanted."""
    random = np.random.default_rng(seed)
    angles = angles_size * random.normal(size=(ROWS, 3))
    return angles, DOWN + rates_size * random.normal(size=(ROWS, 3))


def linear_model():
    """A of (angles, w - wp)' = A (angles, w - wp): central differences of the motion, of fourth order."""

    def motion(x):
        w = DOWN + x[3:]
        return np.concatenate([rates_of_angles(x[:3], w), acceleration(body_from_orbital(x[:3]), w, np.zeros(3))])

    h = 1e-3
    near, far = (
        np.transpose([motion(k * h * e) - motion(-k * h * e) for e in np.eye(6)]) / (2.0 * k * h) for k in (1, 2)
    )
    return (4.0 * near - far) / 3.0


def orbital_modal_control():
    """The closed loop that is wanted, a' = S1 a + z and z' = S0 z, in the coordinates (a, w - wp); u makes up for A."""
    angle_poles, rate_poles = np.array([0.12, 0.07, 0.1]), np.array([0.16, 0.13, 0.2])
    angles, w = estimates(287, 0.05, 0.003)
    a = linear_model()
    unit, zero = np.eye(3), np.zeros((3, 3))
    lacking = np.block([[unit, zero], [a[:3, :3] + np.diag(angle_poles), unit]])  # (a, z) of (a, w - wp)
    wanted = np.block([[-np.diag(angle_poles), unit], [zero, -np.diag(rate_poles)]])
    gain = INERTIA @ (np.linalg.solve(lacking, wanted @ lacking) - a)[3:]
    return Check(
        truth="poles placed by numpy on a model differentiated numerically",
        step=STEP,
        inputs={"estimated_angles": angles, "estimated_angular_velocity": w},
        outputs={"torque_command": follow(np.hstack([angles, w - DOWN]) @ gain.T), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-10, 0.0), "status": (0.0, 0.0)},
        parameters={"angle_poles": angle_poles, "rate_poles": rate_poles, "sample_period": STEP},
    )


def orbital_arrival_control():
    """The rate that is left to each angle, with yaw led through the corners of a trapezium."""
    arrival, shortest_time, band, pulse = 3.0, 1.2, np.array([0.02, 0.015, 0.01]), 0.2
    turn, turn_rate, turn_start, stay = -0.06, 0.08, 0.81, 1.1
    angles, w = estimates(288, 0.05, 0.01)
    corners = turn_start + np.cumsum([0.0, turn / -turn_rate, stay, turn / -turn_rate])
    led = np.zeros((ROWS, 3))
    led[:, 1] = np.interp(TIME, corners, [0.0, turn, turn, 0.0])
    led_rates = np.zeros((ROWS, 3))
    led_rates[:, 1] = np.array([0.0, -turn_rate, 0.0, turn_rate, 0.0])[np.searchsorted(corners, TIME)]
    seen = follow(angles)
    rates = np.array([rates_of_angles(*row) for row in zip(seen, follow(w), strict=True)])
    error = seen - led
    outside = error - error.clip(-band, band)
    wanted = led_rates - outside / np.maximum(arrival - TIME, shortest_time)[:, None]
    mobility = np.linalg.inv(INERTIA).diagonal()
    by_pulse = np.broadcast_to(mobility * JET_TORQUE * pulse, wanted.shape)
    by_rate = 0.3 * np.abs(wanted)
    change = wanted - rates
    fires = np.abs(change) > np.maximum(by_rate, by_pulse)
    # each threshold decides: a change between the two is let be, whichever is the larger
    assert (~fires & (np.abs(change) > by_pulse)).any()
    assert (~fires & (np.abs(change) > by_rate)).any()
    assert (outside == 0.0).any()
    return Check(
        truth="rates of angles by linear equations, the led yaw by interpolation",
        step=STEP,
        inputs={"estimated_angles": angles, "estimated_angular_velocity": w},
        outputs={"torque_command": np.where(fires, change / (mobility * STEP), 0.0), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-10, 0.0), "status": (0.0, 0.0)},
        parameters={
            "arrival_time": arrival,
            "least_time": shortest_time,
            "band": band,
            "shortest_pulse": pulse,
            "turn_angle": turn,
            "turn_rate": turn_rate,
            "turn_start": turn_start,
            "turn_stay": stay,
            "sample_period": STEP,
        },
    )


TRUTHS = {
    "orbital_arrival_control": orbital_arrival_control,
    "orbital_modal_control": orbital_modal_control,
}
