"""Records in Python: values with named fields and the operations of a vector space.

Truth: numpy's arrays of the same numbers.
"""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.block import Block, State
from perilune.fmus_src.kernel.records import Field, Record, replace
from perilune.fmus_src.mathlib.vectors import Vector3, vector
from tests.support.kernels.record_blocks import Motion, Outcome, Pair

NUMBERS = st.lists(st.floats(-1e6, 1e6), min_size=6, max_size=6)


@given(NUMBERS, NUMBERS, st.floats(-10.0, 10.0), st.floats(0.5, 3.0))
def test_operations_are_those_of_the_numbers(first, second, factor, divisor):
    a, b = Motion.of_elements(first), Motion.of_elements(second)
    x, y = np.array(first), np.array(second)
    for mine, truth in (
        (a + b, x + y),
        (a - b, x - y),
        (-a, -x),
        (factor * a, factor * x),
        (a * factor, x * factor),
        (a / divisor, x / divisor),
    ):
        assert np.array(mine.elements()).tobytes() == truth.tobytes()


def test_fields_are_read_and_replaced():
    start = Motion(position=vector(1.0, 2.0, 3.0), heading=vector(1.0, 0.0), mass=5.0)
    lighter = replace(start, mass=4.0)
    assert (start.mass, lighter.mass, lighter.position) == (5.0, 4.0, vector(1.0, 2.0, 3.0))
    pair = Pair(first=start, second=lighter, weight=0.5)
    assert pair.elements() == (1.0, 2.0, 3.0, 1.0, 0.0, 5.0, 1.0, 2.0, 3.0, 1.0, 0.0, 4.0, 0.5)
    assert (2.0 * pair).second.mass == 8.0
    assert pickle.loads(pickle.dumps(pair)) == pair
    assert repr(lighter) == "Motion(position=vector(1.0, 2.0, 3.0), heading=vector(1.0, 0.0), mass=4.0)"


def test_what_does_not_fit_is_refused():
    with pytest.raises(
        TypeError, match=r"Motion.__init__\(\) missing 2 required keyword-only arguments: 'position' and 'heading'"
    ):
        Motion(mass=1.0)
    with pytest.raises(TypeError, match="Motion has no field 'speed'"):
        replace(Motion.of_elements([0.0] * 6), speed=1.0)
    with pytest.raises(TypeError, match="a field is a float, int, bool, vector or record, not <class 'str'>"):
        type("Wrong", (Record,), {"name": Field(str)})
    with pytest.raises(TypeError, match="a record cannot inherit from another; make Motion one of its fields"):
        type("More", (Motion,), {"name": Field()})
    outcome = Outcome(motion=Motion.of_elements([0.0] * 6), count=1, good=True)
    with pytest.raises(TypeError, match="unsupported operand"):
        outcome + outcome
    with pytest.raises(TypeError):
        Motion.of_elements([0.0] * 6) + Pair.of_elements([0.0] * 13)


class Turning(Record):
    """A body that turns."""

    rate = Field(Vector3, unit="rad/s", frame="body", description="angular velocity")
    heat = Field(unit="Pa", frozen=True, description="pressure")


class Turned(Block):
    """Has a record for its state."""

    state = State(Turning, heat=300.0)

    def step(self, t: float, h: float) -> None:
        """Do nothing."""


def test_a_state_has_a_variable_for_each_number():
    declared = Turned.variables["state"]
    assert declared.element_names() == ["state.rate[1]", "state.rate[2]", "state.rate[3]", "state.heat"]
    assert declared.units() == ["rad/s"] * 3 + ["Pa"]
    assert declared.descriptions()[0] == "angular velocity (body frame)"
    assert State(Turning, description="estimate").descriptions()[3] == "estimate: pressure"
    assert declared.frozen_elements() == [False, False, False, True]
    block = Turned()
    assert block.state == Turning(rate=vector(0.0, 0.0, 0.0), heat=300.0)
    block.state = [1, 2, 3, 4]
    assert block.state.rate == vector(1.0, 2.0, 3.0)
    with pytest.raises(TypeError, match=r"turned\.state: give a list of 4"):
        block.state = [1.0]
