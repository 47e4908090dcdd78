"""Stored variables of a block: any sequence of the right size is stored at its value references.

Truth: a block written here that stores sequences from a library; the declarations of blocks.
"""

import numpy as np
import pytest

from perilune.fmus_src.block import Block, Input, Output, State
from perilune.fmus_src.guidance.network_operator_law import NetworkOperatorLaw
from perilune.fmus_src.mathlib.vectors import Vector3, vector
from perilune.fmus_src.plants.free_flying_robot import FreeFlyingRobot
from perilune.fmus_src.runtime import BlockInstance


class Storing(Block):
    """Stores what a library gives, as only Python can."""

    python_only = True
    given = Input([0.0, 0.0, 0.0], description="three numbers")
    kept = Output([0.0, 0.0, 0.0], direct=True, description="the same, of any type")
    longer = Output([0.0] * 5, direct=True, description="a list")
    count = State([0, 0], description="ints")

    def step(self, t: float, h: float) -> None:
        self.before = self.kept
        self.kept = np.array(self.given) + 1.0
        self.longer = np.arange(5) * t
        self.count = (1, np.int64(2))


def test_python_only_blocks_store_any_sequence_and_outputs_stay_connected():
    """An output stays connected where a library's list replaces the declared one."""
    component = BlockInstance(Storing)
    component.start()
    for n in range(3):
        component.set([0, 1, 2], [n, 2.0 * n, 3.0])
        component.do_step(float(n), 1.0)
        assert component.get(list(range(3, 13))) == [
            n + 1.0,
            2.0 * n + 1.0,
            4.0,
            *(k * float(n) for k in range(5)),
            1,
            2,
        ]
        assert type(component.block.kept) is Vector3
        assert all(type(x) is float for x in component.get(list(range(3, 11))))
    assert component.block.before == [2.0, 3.0, 4.0]  # a vector kept before a step is what it was


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("kept", [1.0, 2.0], r"storing\.kept: give a list of 3, or another sequence; got \[1\.0, 2\.0\]"),
        ("kept", 5.0, r"storing\.kept: give a list of 3"),
        ("kept", vector(1.0, 2.0), r"storing\.kept: give a list of 3"),
        ("kept", ["up", "down", "left"], r"storing\.kept: its elements are of type Real"),
        ("longer", [0.0] * 6, r"storing\.longer: give a list of 5"),
        ("count", [1.5, 2], r"storing\.count: its elements are of type Integer"),
    ],
)
def test_what_does_not_fit_is_refused_with_block_and_variable(name, value, message):
    block = Storing()
    with pytest.raises(TypeError, match=message):
        setattr(block, name, value)
    with pytest.raises(TypeError, match="give a list of 3"):
        Storing(given=[1.0])


def test_instances_do_not_share_their_starts():
    one, other = Storing(), Storing()
    one.kept = [1.0, 2.0, 3.0]
    one.longer[0] = 7.0
    assert other.kept == [0.0, 0.0, 0.0]
    assert other.longer == [0.0] * 5


def test_which_variables_are_vectors():
    variables = FreeFlyingRobot.variables
    assert {name for name, each in variables.items() if each.is_vector} == {
        name
        for name, each in variables.items()
        if isinstance(each.start, list) and each.type_name == "Real" and each.size <= 4
    }
    assert not NetworkOperatorLaw.variables["matrix"].is_vector
    assert not State([1, 2], description="ints").is_vector
    assert not State([1.0] * 4, columns=2, description="a matrix").is_vector
    assert not State([1.0] * 4, vector=False, description="a list").is_vector
    assert not State([1.0], description="one element").is_vector
