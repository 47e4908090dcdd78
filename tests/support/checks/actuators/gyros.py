"""Truths of gyro steerings: linear equations."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow


def gyro_steering_robust():
    """Compute the smallest rates that give the torque, by least squares, scaled together where
    one is beyond the limit."""
    rows, momentum, limit = 25, 30.0, 0.6
    random = np.random.default_rng(284)
    angles = np.array([1.0, -1.0, 1.1, -0.9]) + random.normal(0.0, 0.1, (rows, 4))
    torque = random.normal(0.0, 10.0, (rows, 3))
    rates, measures, limited = [], [], []
    for (b1, b2, b3, b4), desired in zip(angles, torque, strict=True):
        # derivatives of h = (C1 + C2 + C3 + C4, S1 + S2, S3 + S4)
        jacobian = np.array(
            [
                -np.sin([b1, b2, b3, b4]),
                [np.cos(b1), np.cos(b2), 0.0, 0.0],
                [0.0, 0.0, np.cos(b3), np.cos(b4)],
            ]
        )
        rate = np.linalg.lstsq(jacobian, -desired / momentum, rcond=None)[0]
        rates.append(rate / max(1.0, np.abs(rate).max() / limit))
        limited.append(np.abs(rate).max() > limit)
        measures.append(np.prod(np.linalg.svd(jacobian, compute_uv=False)))
    assert min(measures) > 0.5
    assert 0 < sum(limited) < rows
    return Check(
        truth="least squares by numpy",
        step=STEP,
        inputs={"torque_command": torque, "gimbal_angles": angles},
        outputs={
            "gimbal_rates": follow(np.array(rates)),
            "singularity": follow(np.array(measures)),
            "status": follow(2 * np.array(limited)),
        },
        tolerances={"gimbal_rates": (1e-12, 0.0), "singularity": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={"rotor_momentum": momentum, "gimbal_rate_limit": limit, "sample_period": STEP},
    )


def momentum(angles):
    """Return the cluster's momentum over that of one rotor."""
    c, s = np.cos(angles), np.sin(angles)
    return np.array([c.sum(), s[0] + s[1], s[2] + s[3]])


def pairs(angles):
    """Return u and v of the distribution law, the momentum of each pair along x over its maximum, and these maxima."""
    c, s = np.cos(angles), np.sin(angles)
    maxima = np.sqrt(4.0 - np.array([s[0] + s[1], s[2] + s[3]]) ** 2)
    return np.array([c[0] + c[1], c[2] + c[3]]) / maxima, maxima


def derivative(function, angles):
    """Differentiate by complex steps, a column for each angle."""
    return np.transpose([function(angles + 1e-30j * e).imag / 1e-30 for e in np.eye(4)])


def gyro_steering_explicit():
    """Solve four linear equations: the momentum's derivative, and that of the law f = u - v + rho (u v - 1), f' = -gain
    f.

    Near singular states of the law the pseudo-inverse W A' (A W A' + k E)^-1 in matrices; the phases in E are the
    block's. The last row has a torque that counts as no number.
    """
    rows, rotor, limit, lead, rho, gain, divisor, damping, swing, threshold = (
        33,
        30.0,
        0.6,
        0.06,
        0.9,
        0.3,
        0.05,
        0.1,
        0.2,
        0.6,
    )
    random = np.random.default_rng(293)
    angles = np.array([0.6, -0.6, 3.7, 2.5]) + random.normal(0.0, 0.2, (rows, 4))
    angles[5:9, 1] = angles[5:9, 0] + random.uniform(-0.08, 0.08, 4)  # rotors of the first pair side by side
    angles[10:14, 2:] = 1.6 + random.uniform(-0.08, 0.08, (4, 2))  # of the second one, across x
    angles[15:19] = random.uniform(-0.08, 0.08, (4, 4))  # all of them
    torque = random.normal(0.0, 9.0, (rows, 3))
    torque[-2:, 1] = 1e102

    def law(angles):
        (u, v), _ = pairs(angles)
        return u - v + rho * (u * v - 1.0)

    def lawful(angles):
        (u, v), (a, b) = pairs(angles)
        divisors = [np.sin(angles[1] - angles[0]), np.sin(angles[3] - angles[2]), a * (1 - rho * u) + b * (1 + rho * v)]
        return np.abs(divisors).min() >= divisor

    def steer(angles, desired, time):
        jacobian = derivative(momentum, angles)
        if lawful(angles):
            return np.linalg.solve(np.vstack([jacobian, derivative(law, angles)]), [*desired, -gain * law(angles)]), 0
        lack = max(0.0, 1.0 - np.prod(np.linalg.svd(jacobian, compute_uv=False)) / threshold)
        weight = np.diag(1.0 + swing * lack * np.array([1.0, -1.0, 1.0, -1.0]))
        e23, e13, e12 = swing * np.sin(np.pi / 2.0 * (time + np.arange(3)))
        e = np.array([[1.0, e12, e13], [e12, 1.0, e23], [e13, e23, 1.0]])
        gram = jacobian @ weight @ jacobian.T + damping * lack**2 * e
        return weight @ jacobian.T @ np.linalg.solve(gram, desired), 1

    def limited(rates, status):
        largest = np.abs(rates).max()
        return (rates * limit / largest, 2) if largest > limit else (rates, status)

    rates, statuses, measures = np.zeros((rows, 4)), np.full(rows, 3), np.zeros(rows)
    for row, (now, desired) in enumerate(zip(follow(angles), -follow(torque) / rotor, strict=True)):
        if np.abs(desired).max() < 1e100:
            first, _ = limited(*steer(now, desired, STEP * row))
            rates[row], statuses[row] = limited(*steer(now + lead * first, desired, STEP * row))
            measures[row] = np.prod(np.linalg.svd(derivative(momentum, now), compute_uv=False))
        else:
            measures[row] = measures[row - 1]
    assert set(statuses) == {0, 1, 2, 3}
    assert (measures[statuses == 1] < threshold).any()
    assert (measures[statuses == 1] > threshold).any()
    return Check(
        truth="linear equations by numpy, derivatives by complex steps",
        step=STEP,
        inputs={"torque_command": torque, "gimbal_angles": angles},
        outputs={"gimbal_rates": rates, "singularity": measures, "status": statuses},
        tolerances={"gimbal_rates": (1e-11, 0.0), "singularity": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={
            "rotor_momentum": rotor,
            "gimbal_rate_limit": limit,
            "torque_lead": lead,
            "rho": rho,
            "law_gain": gain,
            "least_divisor": divisor,
            "damping": damping,
            "damping_threshold": threshold,
            "swing": swing,
            "sample_period": STEP,
        },
    )


TRUTHS = {"gyro_steering_explicit": gyro_steering_explicit, "gyro_steering_robust": gyro_steering_robust}
