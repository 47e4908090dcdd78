"""White noise through a linear system over a step: Van Loan's exponential (1978)."""

import numpy as np
from scipy.linalg import expm

from tests.support.checks.check import STEP


def discretise(a, density):
    """Return transition over a step, and the covariance of white noise of a density, of x' = A x + noise."""
    n = len(a)
    both = expm(STEP * np.block([[-a, density], [np.zeros((n, n)), a.T]]))
    return both[n:, n:].T, both[n:, n:].T @ both[:n, n:]
