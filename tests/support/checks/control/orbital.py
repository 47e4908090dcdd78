"""Truths of orbital attitude control, in the axes of `orbital_motion`: rotations by scipy, linear algebra."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow
from tests.support.flights.orbital_motion import INERTIA, JET_TORQUE, ORBITAL_RATE, derivatives_of, rates_of

ROWS = 33
TIME = STEP * np.arange(ROWS)
DOWN = np.array([0.0, 0.0, -ORBITAL_RATE])


def estimates(seed, angles_size, rates_size):
    """Draw attitudes and absolute angular velocities near the desired ones."""
    random = np.random.default_rng(seed)
    angles = angles_size * random.normal(size=(ROWS, 3))
    return angles, DOWN + rates_size * random.normal(size=(ROWS, 3))


def orbital_modal_control():
    """Compute the desired closed loop, a' = S1 a + z and z' = S0 z, in the coordinates (a, w - wp); u compensates A."""
    angle_poles, rate_poles = np.array([0.12, 0.07, 0.1]), np.array([0.16, 0.13, 0.2])
    angles, w = estimates(287, 0.05, 0.003)
    a = derivatives_of(rates_of, np.concatenate([np.zeros(3), DOWN]))
    unit, zero = np.eye(3), np.zeros((3, 3))
    lacking = np.block([[unit, zero], [a[:3, :3] + np.diag(angle_poles), unit]])  # (a, z) of (a, w - wp)
    desired = np.block([[-np.diag(angle_poles), unit], [zero, -np.diag(rate_poles)]])
    gain = INERTIA @ (np.linalg.solve(lacking, desired @ lacking) - a)[3:]
    return Check(
        truth="poles placed by numpy on the motion differentiated by complex steps",
        step=STEP,
        inputs={"estimated_angles": angles, "estimated_angular_velocity": w},
        outputs={"torque_command": follow(np.hstack([angles, w - DOWN]) @ gain.T), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-10, 0.0), "status": (0.0, 0.0)},
        parameters={"angle_poles": angle_poles, "rate_poles": rate_poles, "sample_period": STEP},
    )


def orbital_derivative_control():
    """Compute the same closed loop with roll moving pitch; its gain times the inverse of its matrix, on differences."""
    angle_poles, rate_poles, turn = np.array([0.0012, 0.003, 0.0011]), np.array([0.001, 0.002, 0.0013]), 0.002
    angles, w = estimates(289, 0.05, 1e-5)
    a = derivatives_of(rates_of, np.concatenate([np.zeros(3), DOWN]))
    unit, zero = np.eye(3), np.zeros((3, 3))
    turning = np.array([[0.0, 0.0, -turn], [0.0, 0.0, 0.0], [turn, 0.0, 0.0]])
    upper, lower = turning - np.diag(angle_poles), turning - np.diag(rate_poles)
    lacking = np.block([[unit, zero], [a[:3, :3] - upper, unit]])
    closed = np.linalg.solve(lacking, np.block([[upper, unit], [zero, lower]]) @ lacking)
    gain = INERTIA @ np.linalg.solve(closed.T, (closed - a)[3:].T).T
    observed, rates_seen = follow(angles), follow(w)
    rates = np.array([rates_of(state)[:3] for state in np.hstack([observed, rates_seen])])
    acceleration = np.diff(rates_seen, axis=0, prepend=rates_seen[:1]) / STEP
    constant = -INERTIA @ rates_of(np.concatenate([np.zeros(3), DOWN]))[3:]
    torque = constant + np.hstack([rates, acceleration]) @ gain.T
    torque[0] = constant
    return Check(
        truth="the gain on the state times the inverse of the closed loop by numpy, differences of rates",
        step=STEP,
        inputs={"estimated_angles": angles, "estimated_angular_velocity": w},
        outputs={"torque_command": torque, "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-10, 0.0), "status": (0.0, 0.0)},
        parameters={"angle_poles": angle_poles, "rate_poles": rate_poles, "coupling": turn, "sample_period": STEP},
    )


def orbital_arrival_control():
    """Compute the rate that is left to each angle, with yaw led through the corners of a trapezium."""
    arrival, shortest_time, band, pulse = 3.0, 1.2, np.array([0.02, 0.015, 0.01]), 0.2
    turn, turn_rate, turn_start, stay = -0.06, 0.08, 0.81, 1.1
    angles, w = estimates(288, 0.05, 0.01)
    corners = turn_start + np.cumsum([0.0, turn / -turn_rate, stay, turn / -turn_rate])
    led = np.zeros((ROWS, 3))
    led[:, 1] = np.interp(TIME, corners, [0.0, turn, turn, 0.0])
    led_rates = np.zeros((ROWS, 3))
    led_rates[:, 1] = np.array([0.0, -turn_rate, 0.0, turn_rate, 0.0])[np.searchsorted(corners, TIME)]
    observed = follow(angles)
    rates = np.array([rates_of(state)[:3] for state in np.hstack([observed, follow(w)])])
    error = observed - led
    outside = error - error.clip(-band, band)
    desired = led_rates - outside / np.maximum(arrival - TIME, shortest_time)[:, None]
    mobility = np.linalg.inv(INERTIA).diagonal()
    by_pulse = np.broadcast_to(mobility * JET_TORQUE * pulse, desired.shape)
    by_rate = 0.3 * np.abs(desired)
    change = desired - rates
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
    "orbital_derivative_control": orbital_derivative_control,
    "orbital_modal_control": orbital_modal_control,
}
