"""Gravity and magnetic field. Truth: sums in 40 digits, published IGRF code, and properties of any potential."""

from fractions import Fraction
from functools import cache
from itertools import zip_longest

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import zeros
from perilune.fmus_src.mathlib.space import earth_gravity, magnetic_field, moon_gravity
from perilune.fmus_src.mathlib.space.harmonics import SIZE, full_normalisation, gradient, schmidt_normalisation
from perilune.fmus_src.mathlib.vectors import vector

YEAR_2025, MIDDLE_OF_2027 = 788961600.0, 788961600.0 + (730 + 181) * 86400.0  # s TT since J2000.0

# Sums of the same coefficients in 40 digits, by another program: position (m), gravity (m/s2), planet-fixed.
EARTH = [
    ((6878137.0, 0.0, 0.0), (-8.437340804265698, -3.377528161853072e-05, 2.27082766790855e-05)),
    ((-3.1e6, 4.2e6, 4.5e6), (3.7684430881768485, -5.105861715704508, -5.485781030930139)),
    ((1e3, -2e3, 7e6), (-0.001086684102029239, 0.002306361954696773, -8.112882863072887)),
]
MOON = [((1837400.0, 0.0, 0.0), (-1.452563038782156, 1.1225536677056787e-04, 1.0844873094408247e-04))]
# By ppigrf 2.1.0, from its own file of coefficients: position (m), time (s), flux density (T), planet-fixed.
FIELD = [
    ((6878137.0, 0.0, 0.0), YEAR_2025, (1.0816759092913277e-05, -1.686234679152024e-06, 2.15507507685104e-05)),
    ((6878137.0, 0.0, 0.0), MIDDLE_OF_2027, (1.079790776163897e-05, -1.5743094297363102e-06, 2.150880254287985e-05)),
    ((-3.1e6, 4.2e6, 4.5e6), YEAR_2025, (2.6385025558643244e-05, -3.074009808191102e-05, -6.551557413557996e-06)),
    ((1.2e6, -2.3e6, 6.4e6), MIDDLE_OF_2027, (-1.2638627559404015e-05, 1.8496864960742513e-05, -3.818690716904187e-05)),
]

directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)


def earth(position, degree=8):
    cs = earth_gravity.earth_gravity()
    g = gradient(vector(*position), earth_gravity.GRAVITATIONAL_PARAMETER, earth_gravity.RADIUS, cs, degree)
    return np.array(g.elements())


def close(a, b, relative):
    assert np.linalg.norm(np.subtract(a, b)) <= relative * np.linalg.norm(b)


@pytest.mark.parametrize(("position", "gravity"), EARTH)
def test_gravity_of_the_earth(position, gravity):
    close(earth(position), gravity, 1e-14)


@pytest.mark.parametrize(("position", "gravity"), MOON)
def test_gravity_of_the_moon(position, gravity):
    cs = moon_gravity.moon_gravity()
    g = gradient(vector(*position), moon_gravity.GRAVITATIONAL_PARAMETER, moon_gravity.RADIUS, cs, 8)
    close(g.elements(), gravity, 1e-14)


@pytest.mark.parametrize(("position", "t", "field"), FIELD)
def test_magnetic_field(position, t, field):
    close(magnetic_field.magnetic_field(vector(*position), magnetic_field.igrf14(t), 13).elements(), field, 1e-13)


def test_sums_of_the_coefficients():
    """As published: what a slip in a table would change."""
    assert sum(magnetic_field.FIELD[0::2]) == pytest.approx(-26449.7, abs=1e-9)
    assert sum(magnetic_field.FIELD[1::2]) == pytest.approx(487.6, abs=1e-9)
    assert sum(magnetic_field.VARIATION[0::2]) == pytest.approx(-26.1, abs=1e-9)
    assert sum(magnetic_field.VARIATION[1::2]) == pytest.approx(-54.2, abs=1e-9)


@cache
def legendre(n, m):
    """Return the m-th derivative of the Legendre polynomial P_n: exact coefficients in ascending powers."""
    before, polynomial = [Fraction(1)], [Fraction(0), Fraction(1)]
    for k in range(1, n):
        longer = [Fraction(0), *(Fraction(2 * k + 1, k + 1) * c for c in polynomial)]
        before, polynomial = (
            polynomial,
            [c - Fraction(k, k + 1) * b for c, b in zip_longest(longer, before, fillvalue=0)],
        )
    for _ in range(m):
        polynomial = [power * c for power, c in enumerate(polynomial)][1:]
    return [mpmath.mpf(c.numerator) / c.denominator for c in polynomial]


def potential(x, y, z, degree):
    """Return the Earth's potential from the definition: P_nm(s) = (1 - s^2)^(m/2) d^m P_n/ds^m."""
    r = mpmath.sqrt(x * x + y * y + z * z)
    longitude, sine = mpmath.atan2(y, x), z / r
    total = mpmath.mpf(1)
    pairs = iter(zip(earth_gravity.NORMALISED[0::2], earth_gravity.NORMALISED[1::2], strict=True))
    for n in range(2, degree + 1):
        for m in range(n + 1):
            c, s = next(pairs)
            ratio = mpmath.factorial(n - m) / mpmath.factorial(n + m) * (2 * n + 1) * (1 if m == 0 else 2)
            function = mpmath.sqrt(1 - sine * sine) ** m * mpmath.polyval(legendre(n, m), sine, asc=True)
            wave = c * mpmath.cos(m * longitude) + s * mpmath.sin(m * longitude)
            total += (earth_gravity.RADIUS / r) ** n * mpmath.sqrt(ratio) * function * wave
    return earth_gravity.GRAVITATIONAL_PARAMETER / r * total


@settings(max_examples=5)
@given(directions, st.floats(6.5e6, 4e7))
def test_it_is_the_gradient_of_the_definition(direction, distance):
    position = distance * np.array(direction) / np.linalg.norm(direction)
    with mpmath.workdps(40):
        x = [mpmath.mpf(float(c)) for c in position]
        slope = [mpmath.diff(lambda *p: potential(*p, 13), x, n) for n in [(1, 0, 0), (0, 1, 0), (0, 0, 1)]]
    close(earth(position, 13), [float(g) for g in slope], 1e-14)


@given(directions, st.floats(6.5e6, 4e7), st.integers(0, 13))
def test_it_has_neither_source_nor_curl(direction, distance, degree):
    position = distance * np.array(direction) / np.linalg.norm(direction)
    h = 1e-4 * distance
    steps = [(earth(position + h * e, degree) - earth(position - h * e, degree)) / (2.0 * h) for e in np.eye(3)]
    jacobian = np.array(steps)
    bound = 1e-6 * np.linalg.norm(jacobian)
    assert abs(np.trace(jacobian)) < bound
    assert np.abs(jacobian - jacobian.T).max() < bound


@given(directions, st.integers(1, 13))
def test_a_degree_falls_with_its_power_of_the_distance(direction, n):
    cs = zeros(SIZE, SIZE)
    for m in range(n + 1):
        cs[n, m] = 1.0 / (1.0 + m) * full_normalisation(n, m)
    near = np.array(gradient(vector(*direction), 1.0, 1.0, cs, n).elements())
    far = np.array(gradient(vector(*(2.0 * np.array(direction))), 1.0, 1.0, cs, n).elements())
    close(far, near / 2.0 ** (n + 2), 1e-12)


def test_the_dipole_is_the_closed_form():
    """B = (a/r)^3 (3 (m.u) u - m) with m = (g11, h11, g10)."""
    cs = magnetic_field.igrf14(YEAR_2025)
    g10, g11, h11 = magnetic_field.FIELD[0], magnetic_field.FIELD[2], magnetic_field.FIELD[3]
    position = np.array([3e6, -5e6, 4.5e6])
    r = np.linalg.norm(position)
    m, u = 1e-9 * np.array([g11, h11, g10]), position / r
    dipole = (magnetic_field.RADIUS / r) ** 3 * (3.0 * (m @ u) * u - m)
    close(magnetic_field.magnetic_field(vector(*position), cs, 1).elements(), dipole, 1e-14)


@pytest.mark.parametrize(("n", "m"), [(1, 0), (1, 1), (2, 1), (8, 5), (13, 13)])
def test_normalisation(n, m):
    ratio = mpmath.factorial(n - m) / mpmath.factorial(n + m) * (1 if m == 0 else 2)
    assert schmidt_normalisation(n, m) == pytest.approx(float(mpmath.sqrt(ratio)), rel=1e-15)
    assert full_normalisation(n, m) == pytest.approx(float(mpmath.sqrt((2 * n + 1) * ratio)), rel=1e-15)


def test_years_of_the_field():
    end = YEAR_2025 + 1826 * 86400.0
    times = (YEAR_2025, end, YEAR_2025 - 1.0, end + 1.0, float("nan"))
    assert [magnetic_field.in_validity(t) for t in times] == [True, True, False, False, False]
