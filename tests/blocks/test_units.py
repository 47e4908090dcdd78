"""Units by name: meaning of each symbol, composition, and refusals.

Truth: scipy.constants for factors; dimensional analysis for exponents (property-based: products and powers multiply).
"""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import constants

from perilune.fmus_src.units import BASE_UNITS, SYMBOLS, unit_definition

FACTORS = {
    "ft": constants.foot,
    "in": constants.inch,
    "nmi": constants.nautical_mile,
    "kn": constants.knot,
    "lb": constants.pound,
    "lbf": constants.pound_force,
    "deg": constants.degree,
    "arcmin": constants.arcminute,
    "arcsec": constants.arcsecond,
    "bar": constants.bar,
    "min": constants.minute,
    "h": constants.hour,
    "d": constants.day,
    "g": constants.gram,
    "km/h": constants.kmh,
    "lbf.ft": constants.pound_force * constants.foot,
    "deg/s2": constants.degree,
    "rev/min": 2.0 * constants.pi / constants.minute,
    "g/cm3": 1000.0,
}
COMPOSED = {
    "N.m/rad": {"kg": 1, "m": 2, "s": -2, "rad": -1},
    "V/A": {"kg": 1, "m": 2, "s": -3, "A": -2},
    "W/m2": {"kg": 1, "s": -3},
    "1/s2": {"s": -2},
    "J/kg.K": {"m": 2, "s": -2, "K": 1},
    "T.m2": {"kg": 1, "m": 2, "s": -2, "A": -1},
    "m.s-2": {"m": 1, "s": -2},
}
POWERS = {"": 1, "2": 2, "3": 3, "-1": -1, "-2": -2}
PLAIN = sorted(name for name, meaning in SYMBOLS.items() if not meaning.offset and name != "1")


@pytest.mark.parametrize("name", FACTORS)
def test_factors(name):
    assert unit_definition(name).factor == pytest.approx(FACTORS[name], rel=1e-14)


@pytest.mark.parametrize("name", COMPOSED)
def test_compositions(name):
    assert unit_definition(name).exponents == COMPOSED[name]


@pytest.mark.parametrize(("scale", "value"), [("degC", 21.5), ("degF", -40.0)])
def test_temperatures(scale, value):
    actual = unit_definition(scale)
    names = {"degC": "Celsius", "degF": "Fahrenheit"}
    expected = constants.convert_temperature(value, names[scale], "Kelvin")
    assert actual.factor * value + actual.offset == pytest.approx(expected, rel=1e-14)


@given(
    st.lists(
        st.tuples(st.sampled_from(PLAIN), st.sampled_from(sorted(POWERS)), st.sampled_from("./")),
        min_size=1,
        max_size=4,
    )
)
def test_products_multiply(parts):
    """Factors multiply and exponents add, whatever the order of the symbols."""
    name = "".join(
        f"{sign if index else ('' if sign == '.' else '1/')}{symbol}{power}"
        for index, (symbol, power, sign) in enumerate(parts)
    )
    factor, exponents = 1.0, dict.fromkeys(BASE_UNITS, 0)
    for symbol, power, sign in parts:
        times = POWERS[power] * (1 if sign == "." else -1)
        factor *= SYMBOLS[symbol].factor ** times
        for base, exponent in SYMBOLS[symbol].exponents.items():
            exponents[base] += times * exponent
    actual = unit_definition(name)
    assert actual.factor == pytest.approx(factor, rel=1e-12)
    assert actual.exponents == {base: power for base, power in exponents.items() if power}


@pytest.mark.parametrize("name", ["", "ell", "m//s", "m.", "/s", "m s", "degC/s", "m^2", "m2.5", "2m"])
def test_what_is_no_unit(name):
    assert unit_definition(name) is None
