"""Truths of control blocks of a free-flying robot: the paper's law in matrices, its lead by scipy."""

import numpy as np
from scipy import signal
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow

ROWS = 33


def attitude_control():
    """Compute the paper's torque, and an Euler step of the momentum to mid-period; a sample every two rows.

    Law 1, of attitude and rate.
    """
    inertia, frequency, damping, every = np.array([700.0, 500.0, 800.0]), 0.8, 0.7, 2
    random = np.random.default_rng(289)
    error, rate, turn, desired = (size * random.normal(size=(ROWS, 3)) for size in (0.2, 0.02, 0.05, 0.01))
    gyros, jets, disturbance = (size * random.normal(size=(ROWS, 3)) for size in (20.0, 0.3, 1e-3))
    inputs = {
        "attitude_error": error,
        "rate_error": rate,
        "planned_angular_velocity": turn,
        "planned_angular_acceleration": desired,
        "gyro_momentum": gyros,
        "jet_torque": jets,
        "disturbance": disturbance,
    }
    sine = np.linalg.norm(error, axis=1)
    assert (sine < 1.0).all()
    from_plan = Rotation.from_rotvec((np.arcsin(sine) / sine)[:, None] * error).inv()
    turn = from_plan.apply(turn)
    w = turn + rate
    correction = frequency**2 * error + 2.0 * damping * frequency * rate
    acceleration = from_plan.apply(desired) + np.cross(turn, w) - correction
    external = jets + inertia * disturbance
    momentum = inertia * w + gyros
    half = every * STEP / 2.0
    momentum = momentum + half * (external - np.cross(w, momentum))
    torque = np.cross(w + half * acceleration, momentum) + inertia * acceleration - external
    return Check(
        truth="rotations by scipy, the paper's law by numpy",
        step=STEP,
        inputs=inputs,
        outputs={
            "torque_command": np.repeat(follow(torque)[::every], every, axis=0)[:ROWS],
            "status": np.zeros(ROWS),
        },
        tolerances={"torque_command": (1e-11, 0.0), "status": (0.0, 0.0)},
        parameters={
            "inertia": inertia,
            "natural_frequency": frequency,
            "damping": damping,
            "sample_period": every * STEP,
        },
    )


def translation_control():
    """Compute the lead by scipy's bilinear discretisation and filter, whose state keeps the output at a change of
    design.

    Law 0: slow, fast, slow; the count of ticks pauses and continues.
    """
    mass, designs = 900.0, {0.5: (0.2, 4.0, 0.7), 0.25: (0.7, 2.0, 0.4)}  # period: gain, lead, lag
    random = np.random.default_rng(290)
    error, rate, plan = (size * random.normal(size=(ROWS, 3)) for size in (0.02, 0.001, 1e-3))
    tick = np.isin(np.arange(ROWS), [0, 4, 8, 12, 14, 16, 18, 20, 24, 28])
    period = np.where((np.arange(ROWS) >= 12) & (np.arange(ROWS) < 20), 0.25, 0.5)
    period[8:10] = 0.6  # nearest to the slow design, but another law
    forces, force, b, delayed, before = [], np.zeros(3), None, np.zeros(3), None
    for row in range(ROWS):
        if tick[row]:
            (gain, lead, lag), length = designs[min(designs, key=lambda p: abs(p - period[row]))], period[row]
            new, a, _ = signal.cont2discrete(([gain * lead, gain], [lag, 1.0]), length, method="bilinear")
            if before is not None and before != length:
                delayed = delayed + (b[0] - np.ravel(new)[0]) * error[row]
            b, before = np.ravel(new), length
            m, states = signal.lfilter(b, a, error[row : row + 1], axis=0, zi=delayed[None, :])
            delayed = states[0]
            force = mass * (plan[row] - m[0])
        forces.append(force)
    return Check(
        truth="bilinear discretisation and filter by scipy",
        step=STEP,
        inputs={
            "position_error": error,
            "velocity_error": rate,
            "planned_acceleration": plan,
            "translation_period": period,
            "translation_count": 5 + np.cumsum(tick),
        },
        outputs={
            "force_command": follow(np.array(forces)),
            "command_count": follow(np.cumsum(tick)),
            "status": np.zeros(ROWS),
        },
        tolerances={"force_command": (1e-11, 0.0), "command_count": (0.0, 0.0), "status": (0.0, 0.0)},
        parameters={
            "law": np.array(0),
            "mass": mass,
            "design_period": list(designs),
            "lead_gain": [gain for gain, _, _ in designs.values()],
            "lead_time": [lead for _, lead, _ in designs.values()],
            "lag_time": [lag for _, _, lag in designs.values()],
        },
    )


TRUTHS = {"attitude_control": attitude_control, "translation_control": translation_control}
