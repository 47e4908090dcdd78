"""Kalman filter for a value, its rate and a disturbance of the rate, the same for every axis. Kernel functions.

Axes that are equally known and equally measured share one covariance p (n x n floats, row order), n = 2: value
and rate, or n = 3: the disturbance, a rate of the rate, too. What is known of the rate's change is added to
the estimates by the caller, and so is the innovation times the gain.
Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 6.2.2 and 6.2.3 (discretised white noise).
"""

from .kalman import correct, innovation_variance, predict


def predict_chain(p: list, rate_noise: float, disturbance_noise: float, h: float, n: int) -> None:
    """p after h (s); densities of white noise on the rate's (value^2/s^3) and the disturbance's derivative (/s^5)."""
    x = [0.0] * 3
    f = [0.0] * 9
    q = [0.0] * 9
    for i in range(n):
        f[n * i + i] = 1.0
    f[1] = h
    q[0] = rate_noise * h * h * h / 3.0
    q[1] = rate_noise * h * h / 2.0
    q[n] = q[1]
    q[n + 1] = rate_noise * h
    if n == 3:
        f[2] = 0.5 * h * h
        f[5] = h
        part = disturbance_noise * h
        q[8] = part
        part = part * h
        q[5] = part / 2.0
        part = part * h
        q[2] = part / 6.0
        q[4] = q[4] + part / 3.0
        part = part * h
        q[1] = q[1] + part / 8.0
        q[0] = q[0] + part * h / 20.0
        q[3] = q[1]
        q[6] = q[2]
        q[7] = q[5]
    predict(x, p, f, q, n)


def measure_chain(p: list, variance: float, gain: list, n: int) -> float:
    """p after the value was measured with a variance (> 0); gain[n] = what the innovation adds, per unit.

    Returns the innovation's variance.
    """
    row = [0.0] * 3
    x = [0.0] * 3
    row[0] = 1.0
    s = innovation_variance(p, row, gain, variance, n)
    correct(x, p, row, gain, 0.0, s, variance, n)
    for i in range(n):
        gain[i] = gain[i] / s
    return s
