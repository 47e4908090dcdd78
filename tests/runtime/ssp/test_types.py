"""Types of SSP 2.0: ranges of values, and equal types.

Truth: numpy's integer types. SSP 1.0 has only Real and Integer, whatever the types of an FMU.
"""

import numpy as np
import pytest

from perilune.analysis.runtime.ssp.parameter_values import parse_value
from perilune.analysis.runtime.ssp.types import integer_range, is_of_type
from perilune.common.errors import InputError

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


def test_real_and_integer_are_said_of_all_of_their_kind():
    assert is_of_type("Float32", "Real")
    assert is_of_type("UInt64", "Integer")
    assert is_of_type("Float64", "Float64")
    assert not is_of_type("Float64", "Float32")
    assert is_of_type("Enumeration", "Integer")
    assert not is_of_type("Integer", "Enumeration")
    assert not is_of_type("Float64", "Integer")
