"""Kalman navigation by numpy: matrices of fifteen states, with all scalars of a sensor at once.

Equations: docs/systems/lunar_navigation.md.
"""

import numpy as np
from scipy.linalg import solve_triangular

from tests.support.checks.check import STEP
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.navigation.lunar_flight import (
    CENTRE,
    MOON_RADIUS,
    MU,
    SEED,
    STREAM,
    UPPER,
    dead_reckon,
    first_knowledge,
)

SENSORS = ("altitude", "velocity", "position")
GOOD, REJECTED, LOCKED_OUT = 0, 1, 2
SIGMAS = {  # of position, velocity, bias, scale factors, rotation at the start
    "first_position_sigma": 40.0,
    "first_velocity_sigma": 0.8,
    "bias_sigma": 0.02,
    "scale_factor_sigma": 0.01,
    "attitude_sigma": 0.005,
}
NOISE = {  # of a measurement: fraction of altitude, speed, altitude, and constant
    "altitude": (5e-4, 1.0),
    "velocity": (2e-4, 0.05),
    "position": (1.5e-3, 2.0),
}
WALK, DRIFT, GATE, LIMIT = 0.01, 1e-3, 5.0, 2


def with_blocks(blocks):
    """Return a matrix of fifteen states that is 1 but for blocks {(i, k): 3 x n} from row 3 i, column 3 k."""
    made = np.eye(15)
    for (i, k), block in blocks.items():
        made[3 * i : 3 * i + 3, 3 * k : 3 * k + np.shape(block)[1]] = block
    return made


def transition(force, up, distance, free):
    """Return F and Q over a step: half a step's drift, a kick of the velocity by gravity and
    sensor errors, the other half."""
    gradient = MU / distance**3 * (3.0 * np.outer(up, up) - np.eye(3))
    drift = with_blocks({(0, 1): STEP / 2.0 * np.eye(3)})
    # of bias, scale factors and rotation w: w x f = -f x w
    sensor = np.hstack([np.eye(3), np.diag(force), -np.cross(np.eye(3), force)]) * (0.0 if free else 1.0)
    kick = with_blocks({(1, 0): STEP * gradient, (1, 2): -STEP * sensor})
    kicked = np.repeat([0.0, 0.0 if free else WALK**2, DRIFT**2, 0.0, 0.0], 3)
    return drift @ kick @ drift, STEP * drift @ np.diag(kicked) @ drift.T


class Filter:
    """Position, velocity, errors of the inertial sensor, and their covariance, from rows of the true motion."""

    def __init__(self, position, velocity):
        errors = (SIGMAS["first_position_sigma"], SIGMAS["first_velocity_sigma"])
        self.x = np.concatenate([*first_knowledge(Numbers(SEED, STREAM), position, velocity, *errors), np.zeros(9)])
        self.p = np.diag(np.repeat(np.square(list(SIGMAS.values())), 3))
        self.squares = dict.fromkeys(SENSORS, 0.0)
        self.in_a_row = dict.fromkeys(SENSORS, 0)
        self.last_square, self.rejected, self.samples, self.before = 0.0, 0, 0, None
        self.grown = False

    def vertical(self):
        """Return up, and distance from the Moon's centre."""
        distance = np.linalg.norm(self.x[:3] - CENTRE)
        return (self.x[:3] - CENTRE) / distance, distance

    def advance(self, force, free):
        """Predict a step under a measured mean specific force."""
        if not free:
            bias, scale, rotation = self.x[6:].reshape(3, 3)
            force = force - bias - scale * force - np.cross(rotation, force)
        before = force if self.before is None else self.before
        self.x = np.concatenate([*dead_reckon(self.x[:3], self.x[3:6], force, before), self.x[6:]])
        self.before = force
        f, q = transition(force, *self.vertical(), free)
        self.p = f @ self.p @ f.T + q

    def measure(self, sensor, sample):
        """Take a sample in; the innovations of sequential updates are those of one update, whitened by Cholesky."""
        up, distance = self.vertical()
        altitude = distance - MOON_RADIUS
        size = np.linalg.norm(self.x[3:6]) if sensor == "velocity" else altitude
        sigma = NOISE[sensor][0] * size + NOISE[sensor][1]
        if sensor == "altitude":
            h, innovation = np.append(up, np.zeros(12))[None], np.array([sample - altitude])
        else:
            first = 3 if sensor == "velocity" else 0
            h, innovation = np.eye(15)[first : first + 3], sample - self.x[first : first + 3]

        def covariance(rows):
            return h[rows] @ self.p @ h[rows].T + sigma**2 * np.eye(len(rows))

        accepted, squares = [], []
        for k in range(len(h)):
            tried = [*accepted, k]
            whitened = solve_triangular(np.linalg.cholesky(covariance(tried)), innovation[tried], lower=True)
            squares.append(whitened[-1] ** 2)
            if squares[-1] > GATE**2 and self.in_a_row[sensor] >= LIMIT:
                assert len(h) == 1  # or what was taken in before would have to grow, too
                self.p *= (innovation[0] ** 2 - sigma**2) / (covariance([0])[0, 0] - sigma**2)
                self.grown = True
            elif squares[-1] > GATE**2:
                self.rejected += 1
                continue
            accepted = tried
        if accepted:
            gain = np.linalg.solve(covariance(accepted), h[accepted] @ self.p).T
            self.x = self.x + gain @ innovation[accepted]
            self.p = self.p - gain @ covariance(accepted) @ gain.T
        self.squares[sensor], self.last_square = sum(squares), squares[-1]
        self.in_a_row[sensor] = self.in_a_row[sensor] + 1 if len(accepted) < len(h) else 0
        self.samples += 1

    def status(self):
        longest = max(self.in_a_row.values())
        return LOCKED_OUT if longest >= LIMIT else REJECTED if longest > 0 else GOOD

    def outputs(self):
        sigma = np.sqrt(np.diag(self.p)[:6])
        return {
            "estimated_position": self.x[:3],
            "estimated_velocity": self.x[3:6],
            "estimated_bias": self.x[6:9],
            "position_estimate_sigma": sigma[:3],
            "velocity_estimate_sigma": sigma[3:],
            "estimate_covariance": self.p[:6, :6][UPPER],
            "innovation_square": self.last_square,
            **{f"{sensor}_innovation_square": self.squares[sensor] for sensor in SENSORS},
            "rejected_count": self.rejected,
            "sample_count": self.samples,
            "status": self.status(),
        }
