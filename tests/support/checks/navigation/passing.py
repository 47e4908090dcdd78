"""Truths of navigation that passes the true state on. Direct outputs follow one row later."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow

ROWS = 17


def ideal_navigation():
    """Return the truth as the estimate."""
    random = np.random.default_rng(28)
    position, velocity = random.normal(0.0, 1e4, (ROWS, 3)), random.normal(0.0, 1e2, (ROWS, 3))
    return Check(
        truth="closed form",
        step=STEP,
        inputs={"position": position, "velocity": velocity},
        outputs={
            "estimated_position": follow(position),
            "estimated_velocity": follow(velocity),
            "sample_count": 1 + np.arange(ROWS),
        },
        tolerances=dict.fromkeys(("estimated_position", "estimated_velocity", "sample_count"), (0.0, 0.0)),
        parameters={},
    )


def orbital_true_state():
    """Return the truth as the estimate."""
    random = np.random.default_rng(29)
    angles, rates = random.normal(0.0, 0.2, (ROWS, 3)), random.normal(0.0, 1e-2, (ROWS, 3))
    return Check(
        truth="closed form",
        step=STEP,
        inputs={"true_angles": angles, "true_angular_velocity": rates},
        outputs={"estimated_angles": follow(angles), "estimated_angular_velocity": follow(rates)},
        tolerances=dict.fromkeys(("estimated_angles", "estimated_angular_velocity"), (0.0, 0.0)),
        parameters={"sample_period": STEP},
    )


TRUTHS = {
    "ideal_navigation": ideal_navigation,
    "orbital_true_state": orbital_true_state,
}
