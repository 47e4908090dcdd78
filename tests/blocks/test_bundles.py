"""Bundles: ports declared together, with separate variables that are read, assigned and passed on together.

Truth: the same variables declared one by one.
"""

from __future__ import annotations

import re

import hypothesis
import pytest
from hypothesis import strategies as st

from perilune.fmus_src.block import Block, Output
from perilune.fmus_src.bundles import Bundle, Inputs, Outputs
from perilune.fmus_src.export.attributes import UndeclaredError, check_attributes
from perilune.fmus_src.export.description.fmi2 import model_description
from perilune.fmus_src.export.judge.subset import check
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.ports import Port
from perilune.fmus_src.variables import DeclarationError, Input, State
from tests.support.kernels.users_blocks import Bundles, EngineCommand


class Level(Bundle):
    """One number."""

    level = Port(0.0, unit="m", description="level")
    slope = Port([0.0, 0.0, 0.0], unit="1", frame="body", description="slope")


class Bundled(Block):
    """Two tanks."""

    one = Inputs(Level, prefix="one_", about="of the first tank:")
    filled = State(False, description="filled")
    two = Outputs(Level, direct=True, level=2.0, slope=[1.0, 0.0, 0.0])

    def step(self, t: float, h: float) -> None:
        self.two = self.one


class Single(Block):
    """Two tanks."""

    one_level = Input(0.0, unit="m", description="of the first tank: level")
    one_slope = Input([0.0, 0.0, 0.0], unit="1", frame="body", description="of the first tank: slope")
    filled = State(False, description="filled")
    level = Output(2.0, unit="m", direct=True, description="level")
    slope = Output([1.0, 0.0, 0.0], unit="1", frame="body", direct=True, description="slope")

    def step(self, t: float, h: float) -> None:
        self.level = self.one_level
        self.slope = self.one_slope


def describe(block: type[Block]) -> str:
    text = model_description(block, guid="", origin={}, needs_execution_tool=False).decode()
    return text.replace(block.fmu_name, "")


def test_a_bundle_declares_what_its_members_do_one_by_one() -> None:
    assert describe(Bundled) == describe(Single)


@hypothesis.given(st.floats(), st.tuples(st.floats(), st.floats(), st.floats()))
def test_members_are_the_variables(level: float, slope: tuple[float, float, float]) -> None:
    block, other = Bundled(), Single()
    block.one.level, block.one.slope = level, slope
    other.one_level, other.one_slope = level, slope
    for each in (block, other):
        each.step(0.0, 0.1)
    assert repr(vars(block)) == repr(vars(other))
    assert repr((block.two.level, block.two.slope)) == repr((level, vector(*slope)))


def test_a_bundle_is_assigned_from_another_block() -> None:
    giver, taker = Bundled(), Bundled()
    giver.two.level = 7.0
    taker.one = giver.two
    assert (taker.one_level, taker.one.slope) == (7.0, vector(1.0, 0.0, 0.0))


def test_a_subclass_may_declare_a_bundle_again_with_other_starts() -> None:
    class Weaker(Bundles):
        """Starts with less."""

        second = Inputs(EngineCommand, prefix="second_", about="of the second source:", thrust=0.5)

    assert list(Weaker.variables) == list(Bundles.variables)
    assert (Weaker().second.thrust, Bundles().second.thrust) == (0.5, 2.5)


def test_what_is_no_bundle_of_the_kind_is_refused_whole() -> None:
    for values in (1.0, Bundles().first):
        with pytest.raises(TypeError, match=r"bundled: give a Level of a block, or assign level, slope"):
            Bundled().two = values  # type: ignore[assignment]


def test_a_member_that_does_not_exist_is_refused() -> None:
    with pytest.raises(AttributeError, match="height"):
        Bundled().two.height  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match="height"):
        Bundled().two.height = 1.0  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ({"one": Inputs(Level), "two": Inputs(Level)}, "Bad.two: level is declared twice; give the bundle another"),
        ({"one": Inputs(Level), "level": Input(0.0, description="x")}, "Bad.one: level is declared twice"),
        ({"one": Inputs(Level, height=1.0)}, "Bad.one: Level has no height; it has level, slope"),
        ({"one": Inputs(Level, level=[1.0, True])}, "Bad.level: start must be one float, int or bool"),
        ({"one": Outputs(Level, direct=("in",))}, "Bad.level: direct names 'in', which is not an input"),
        ({"one": Outputs(type("Mute", (Bundle,), {"m": Port(0.0)}))}, "Bad.m: give a description"),
    ],
)
def test_declarations_that_do_not_fit_are_refused(declared: dict, message: str) -> None:
    with pytest.raises(DeclarationError, match=re.escape(message)):
        type("Bad", (Block,), {"__doc__": "A block.", "step": lambda self, t, h: None, **declared})


def test_a_method_with_the_name_of_a_bundle_is_refused() -> None:
    with pytest.raises(
        DeclarationError, match=r"Named\.two: is a Level in a base class of Named; give the variable another name"
    ):

        class Named(Bundled):
            """Has a method two."""

            def two(self) -> None:  # type: ignore[override]
                """Write another meaning."""


def test_an_input_cannot_become_an_output_by_a_bundle() -> None:
    with pytest.raises(DeclarationError, match=r"Giving\.one_level: has causality output here, but input"):

        class Giving(Bundled):
            """Gives what it took."""

            one = Outputs(Level, prefix="one_")


def test_a_block_in_python_alone_is_refused_for_a_member_that_does_not_exist() -> None:
    class Lost(Bundled):
        """Reads no member."""

        python_only = True

        def step(self, t: float, h: float) -> None:
            self.two.level = self.one.height  # type: ignore[attr-defined]

    with pytest.raises(UndeclaredError, match=r"test_bundles\.py:\d+: self\.one has no height; it has level, slope"):
        check_attributes(Lost)


def test_the_subset_has_bundles() -> None:
    assert check(Bundled) == []
    assert check(Bundles) == []
