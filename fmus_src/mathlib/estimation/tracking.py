"""Kalman filter for a value, its rate and a disturbance of the rate, the same for every axis. Kernel functions.

Axes that are equally known and equally measured share one covariance p (n x n floats, row order), n = 2: value
and rate, or n = 3: the disturbance, a rate of the rate, too. What is known of the rate's change is added to
the estimates by the caller, and so is the innovation times the gain.
Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 6.2.2 and 6.2.3 (discretised white noise).
"""

from ...kernel.matrices import identity, mirror, set_element
from .kalman import correct, innovation_variance, predict

# Rows and columns: what is tracked, its rate, and what disturbs the rate.
TRACKED = 0
RATE = 1
DISTURBANCE = 2


def predict_chain(p: list, rate_noise: float, disturbance_noise: float, h: float, n: int) -> None:
    """p after h (s); densities of white noise on the rate's (value^2/s^3) and the disturbance's derivative (/s^5)."""
    x = [0.0] * 3
    f = [0.0] * 9
    q = [0.0] * 9
    identity(f, n)
    set_element(f, n, TRACKED, RATE, h)
    q11 = rate_noise * h * h * h / 3.0
    q12 = rate_noise * h * h / 2.0
    q22 = rate_noise * h
    if n == 3:
        d = disturbance_noise
        set_element(f, n, TRACKED, DISTURBANCE, 0.5 * h * h)
        set_element(f, n, RATE, DISTURBANCE, h)
        set_element(q, n, DISTURBANCE, DISTURBANCE, d * h)
        set_element(q, n, RATE, DISTURBANCE, d * h * h / 2.0)
        set_element(q, n, TRACKED, DISTURBANCE, d * h * h * h / 6.0)
        q22 = q22 + d * h * h * h / 3.0
        q12 = q12 + d * h * h * h * h / 8.0
        q11 = q11 + d * h * h * h * h * h / 20.0
    set_element(q, n, TRACKED, TRACKED, q11)
    set_element(q, n, TRACKED, RATE, q12)
    set_element(q, n, RATE, RATE, q22)
    mirror(q, n, n)
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
