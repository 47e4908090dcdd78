"""Parameters in Gray code.

Truth: the reflected binary code of three bits as printed in textbooks; the definition of a Gray code (every number
once, neighbours one bit apart); fixed-point numbers in exact fractions.
"""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.design.synthesis.search_settings import Coding, from_gray, to_gray


def test_three_bits_as_printed():
    printed = [0b000, 0b001, 0b011, 0b010, 0b110, 0b111, 0b101, 0b100]
    assert [to_gray(number) for number in range(8)] == printed


def test_every_number_of_sixteen_bits_has_a_code_of_its_own():
    codes = [to_gray(number) for number in range(2**16)]
    assert sorted(codes) == list(range(2**16))
    assert [from_gray(code) for code in codes] == list(range(2**16))


@given(st.integers(0, 2**200))
def test_there_and_back(number):
    assert from_gray(to_gray(number)) == number


@given(st.integers(0, 2**200))
def test_neighbours_differ_in_one_bit(number):
    assert (to_gray(number) ^ to_gray(number + 1)).bit_count() == 1


CODINGS = st.builds(Coding, st.integers(1, 4), st.integers(1, 8), st.integers(0, 14))


@given(CODINGS, st.data())
def test_codes_are_all_the_numbers_of_their_width(coding, data):
    code = data.draw(st.integers(0, 2**coding.bits - 1))
    values = coding.decode(code)
    assert coding.encode(values) == code
    for value in values:
        steps = Fraction(value) * 2**coding.fraction
        assert steps.denominator == 1
        assert 0 <= steps < 2**coding.width


@given(CODINGS, st.data())
def test_a_value_is_coded_to_the_nearest_step(coding, data):
    maximum = 2**coding.integer - 2.0**-coding.fraction
    values = data.draw(st.lists(st.floats(0.0, maximum), min_size=coding.count, max_size=coding.count))
    for value, actual in zip(values, coding.decode(coding.encode(values)), strict=True):
        assert abs(Fraction(value) - Fraction(actual)) <= Fraction(1, 2 ** (coding.fraction + 1))


def test_the_first_parameter_has_the_highest_bits():
    coding = Coding(3, 4, 12)
    assert coding.decode(to_gray(4096) << 32 | to_gray(2048) << 16 | to_gray(1)) == (1.0, 0.5, 2.0**-12)


def test_published_parameters_lie_on_the_published_grid():
    """4 integer and 12 fraction bits: 1.50049, 13.54590 and 12.96753 are multiples of 2^-12, rounded to five digits."""
    published = (1.50049, 13.54590, 12.96753)
    coding = Coding(3, 4, 12)
    assert [round(value, 5) for value in coding.decode(coding.encode(published))] == list(published)


@pytest.mark.parametrize(("values", "place"), [((-1.0, 1.0, 1.0), 0), ((1.0, 16.0, 1.0), 1), ((0.0, 0.0, 1e9), 2)])
def test_a_value_without_code_is_refused_by_its_place(values, place):
    with pytest.raises(ValueError, match=f"^{place}$"):
        Coding(3, 4, 12).encode(values)
