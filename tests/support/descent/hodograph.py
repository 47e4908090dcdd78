"""Gravity turn with a constant ratio of thrust to gravity, by quadrature of its hodograph.

Along the turn d ln(v)/d psi = (n - cos psi)/sin psi, so v sin(psi)/tan(psi/2)^n is constant; dt = -v dpsi/(g sin psi).
"""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def integrals(speed, angle, ratio, gravity):
    """Return height lost (m), time (s) and distance (m) until rest, of a velocity at an
    ``angle`` (rad) from straight down."""
    end = np.log(np.tan(angle / 2.0))

    def integrate(power, of):
        # with u = ln tan(psi/2), dpsi = sin(psi) du, and all integrands fade exponentially towards rest
        def integrand(u):
            cosh = np.logaddexp(u, -u) - np.log(2.0)  # of 1/sin(psi), the logarithm
            flown = speed * np.sin(angle) * np.exp(ratio * (u - end) + cosh)
            return flown**power * of(2.0 * np.arctan(np.exp(u))) / gravity

        return quad(integrand, end - 40.0 / (ratio - 1.0), end, limit=400, epsabs=0.0, epsrel=1e-11)[0]

    return integrate(2, np.cos), integrate(1, np.ones_like), integrate(2, np.sin)


def ratio_to_rest(speed, angle, height, gravity):
    """Return the ratio with which the turn loses just this height."""
    return brentq(lambda n: integrals(speed, angle, n, gravity)[0] - height, 1.001, 1e4, xtol=1e-13, rtol=1e-14)
