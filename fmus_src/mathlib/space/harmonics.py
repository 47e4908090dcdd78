"""Gradient of a spherical-harmonic potential, for gravity and the magnetic field of a planet. Kernel functions.

U = (mu/r) sum (R/r)^n P_nm(sin phi) (C_nm cos m lambda + S_nm sin m lambda), over degrees n and orders m, with latitude
phi, longitude lambda and unnormalised coefficients. One matrix contains both kinds of coefficients: C_nm is element [n,
m], S_nm is element [m - 1, n].

Frame: planet-fixed, origin at the planet's centre.

The solid harmonics V_nm and W_nm are computed by recursion along an order and not stored; there is no singularity at
the poles. Their contributions to the gradient are summed immediately; the central term, which is the largest, comes
last.

Source: Cunningham 1970; Montenbruck and Gill 2000, section 3.2.4.
"""

import math

from ...kernel.matrices import Matrix, zeros
from ..vectors import Vector3, dot, vector

SIZE = 14  # rows and columns of a matrix of coefficients: degrees 0 to 13


def schmidt_normalisation(n: int, m: int) -> float:
    """Return the factor sqrt((2 - [m = 0]) (n - m)!/(n + m)!) from a Schmidt quasi-normalised to an unnormalised
    coefficient.
    """
    if m == 0:
        return 1.0
    square = 2.0
    for k in range(n - m + 1, n + m + 1):
        square = square / float(k)
    return math.sqrt(square)


def full_normalisation(n: int, m: int) -> float:
    """Return the factor from a fully normalised to an unnormalised coefficient.

    It is sqrt(2n + 1) times `schmidt_normalisation`.
    """
    return math.sqrt(float(2 * n + 1)) * schmidt_normalisation(n, m)


def set_pair(cs: Matrix, n: int, m: int, c: float, s: float) -> None:
    """Set both coefficients of degree n and order m; ``s`` is ignored for m = 0."""
    cs[n, m] = c
    if m > 0:
        cs[m - 1, n] = s


def gravity_coefficients(normalised: list, degree: int) -> Matrix:
    """Return the matrix of coefficients for `gradient` from fully normalised ones: C, S of orders 0 to n, for each
    degree n from 2 on.
    """
    cs = zeros(SIZE, SIZE)
    cs[0, 0] = 1.0
    k = 0
    for n in range(2, degree + 1):
        for m in range(n + 1):
            factor = full_normalisation(n, m)
            set_pair(cs, n, m, factor * normalised[k], factor * normalised[k + 1])
            k = k + 2
    return cs


def gradient(position: Vector3, mu: float, radius: float, cs: Matrix, degree: int) -> Vector3:
    """Return the gradient of U (planet-fixed) at a position (m, planet-fixed) other than the centre.

    ``mu`` is the factor of U: the gravitational parameter (m3/s2) for gravity in m/s2. ``radius`` (m) is R, and
    ``degree`` the highest degree of the sum, at most 13.
    """
    square = dot(position, position)
    distance = math.sqrt(square)
    scaled = radius / square * position
    rho = radius * radius / square
    sector_v = radius / distance
    sector_w = 0.0
    x = 0.0
    y = 0.0
    z = 0.0
    for m in range(degree + 2):
        if m > 0:
            odd = float(2 * m - 1)
            before = sector_v
            sector_v = odd * (scaled.x * before - scaled.y * sector_w)
            sector_w = odd * (scaled.x * sector_w + scaled.y * before)
        v = sector_v
        w = sector_w
        lower_v = 0.0
        lower_w = 0.0
        for n in range(m, degree + 2):
            if n > m:
                inverse = 1.0 / float(n - m)
                first = inverse * float(2 * n - 1) * scaled.z
                second = inverse * float(n + m - 1) * rho
                higher_v = first * v - second * lower_v
                higher_w = first * w - second * lower_w
                lower_v = v
                lower_w = w
                v = higher_v
                w = higher_w
            k = n - 1  # the degree of the coefficients whose gradient has V_nm and W_nm
            if k < 1:
                continue
            if m == 0:
                z = z - float(n) * cs[k, 0] * v
            elif m <= k:
                z = z - float(n - m) * (cs[k, m] * v + cs[m - 1, k] * w)
            if m == 1:
                x = x - cs[k, 0] * v
                y = y - cs[k, 0] * w
            elif m > 1:
                c = 0.5 * cs[k, m - 1]
                s = 0.5 * cs[m - 2, k]
                x = x - (c * v + s * w)
                y = y - (c * w - s * v)
            if m < k:
                factor = 0.5 * float((k - m) * (n - m))
                c = factor * cs[k, m + 1]
                s = factor * cs[m, k]
                x = x + (c * v + s * w)
                y = y + (s * v - c * w)
    return mu / (radius * radius) * vector(x, y, z) - cs[0, 0] * mu / (square * distance) * position
