"""Types of SSP 2.0: which are the same, which values fit into which.

Truth: numpy's integer types and its rule of safe casts; Real and Integer are defined as Float64 and Int32 by SSP 2.0.
"""

import numpy as np
import pytest

from perilune.analysis.common.errors import InputError
from perilune.analysis.runtime.ssp.given_values import parse_value
from perilune.analysis.runtime.ssp.types import fits, integer_range, is_same_type

INTEGERS = ("Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")


@pytest.mark.parametrize("name", INTEGERS)
def test_integers_have_the_range_of_numpy_s(name):
    limits = np.iinfo(name.lower())
    assert integer_range(name) == (limits.min, limits.max)
    for number in (limits.min, limits.max):
        assert parse_value(str(number), name, "f", "e") == number
    if name != "Int32":  # whose targets have the bounds
        with pytest.raises(InputError, match=f"is not of type {name}"):
            parse_value(str(int(limits.max) + 1), name, "f", "e")


def test_integers_go_where_nothing_is_lost():
    for source in INTEGERS:
        for target in INTEGERS:
            assert fits(source, target) == np.can_cast(source.lower(), target.lower(), "safe")


def test_floats_go_either_way_and_take_integers():
    assert fits("Float32", "Float64")
    assert fits("Float64", "Float32")
    assert fits("Int16", "Real")
    assert not fits("Real", "Int16")
    assert not fits("Boolean", "Int8")
    assert not fits("String", "Enumeration")


def test_real_is_float64_and_integer_is_int32():
    assert is_same_type("Real", "Float64")
    assert is_same_type("Int32", "Integer")
    assert not is_same_type("Real", "Float32")
    assert not is_same_type("Integer", "Int64")
