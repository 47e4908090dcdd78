"""Declarations of variables: names of elements, and refusal of inconsistent declarations at their place.

Truth: FMI 2.0, section 2.2.9 (structured naming convention: a[1], a[2,3]), and the rules of `perilune.fmus_src.block`.
"""

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.kernel.records import Field, Record
from perilune.fmus_src.variables import DeclarationError, Input, Parameter, State


def refusal(**variables):
    """Return the message with which a block of these variables is refused."""
    with pytest.raises((DeclarationError, RuntimeError)) as caught:
        type("Refused", (Block,), {"__doc__": "A block.", **variables})
    return str(caught.value.__cause__ or caught.value)


def test_elements_of_a_matrix_are_named_by_row_and_column_in_row_order():
    matrix = Parameter([0] * 6, columns=3, description="two rows of three")
    assert matrix.element_names() == [f"[{i},{j}]" for i in (1, 2) for j in (1, 2, 3)]


def test_elements_of_a_vector_and_a_scalar():
    class Named(Block, interface=True):
        """A block."""

        vector = Input([0.0, 0.0], unit="1", description="a vector")
        scalar = Input(0.0, unit="1", description="a scalar")

    assert Named.variables["vector"].element_names() == ["vector[1]", "vector[2]"]
    assert Named.variables["scalar"].element_names() == ["scalar"]


@pytest.mark.parametrize("columns", [0, 4, 7])
def test_columns_that_do_not_divide_the_elements_are_refused(columns):
    assert "rows" in refusal(matrix=Parameter([0] * 6, columns=columns, description="a matrix"))


@pytest.mark.parametrize("kind", [int, bool])
def test_a_record_with_a_field_that_is_no_float_is_refused(kind):
    """Its native FMU would store all numbers as those of one type."""

    class Crossing(Record):
        """A root."""

        root = Field(unit="s", description="root")
        exists = Field(kind, description="there is one")

    assert "the field exists of its record is not a float" in refusal(crossing=State(Crossing))


@pytest.mark.parametrize("name", ["sample_period", "start_time", "internal_step", "longest_step"])
@pytest.mark.parametrize("start", [[0.0, 1.0], False])
def test_what_the_life_cycle_computes_with_is_one_number(name, start):
    message = refusal(**{name: State(start, description="of another meaning")})
    assert f"Refused.{name}: is no number" in message
    assert message.endswith("declare one number, or choose another name")


def test_other_names_with_a_role_stay_free():
    class Free(Block, interface=True):
        """A block as one may have written it."""

        seed = Input([0.0, 0.0], description="no random numbers")
        status = State(False, description="no report")
        stream = Parameter(0.5, unit="m3/s", description="of water")

    assert list(Free.variables) == ["seed", "status", "stream"]


def test_columns_of_a_scalar_are_refused():
    assert "rows" in refusal(matrix=Parameter(0, columns=1, description="no matrix"))


def test_mixed_types_unknown_units_and_missing_descriptions_are_refused():
    assert "start must be" in refusal(mixed=Parameter([0, 0.5], description="an int and a float"))
    assert "unit 'furlong/s' is unknown" in refusal(speed=Parameter(0.0, unit="furlong/s", description="a speed"))
    assert "give a description" in refusal(speed=Parameter(0.0, unit="m/s"))


def test_what_a_slot_leaves_to_its_blocks_has_to_be_written():
    assert "has no step, which every Block has; write def step(self, t, h) in it" in refusal()

    class Slot(Block, interface=True):
        """A slot."""

        to_write = ("decide",)

        def decide(self) -> None:
            """Decide."""

        def step(self, t: float, h: float) -> None:
            self.decide()

    def nothing(self, *_):
        pass

    with pytest.raises((DeclarationError, RuntimeError)):
        type("Undecided", (Slot,), {"__doc__": "A block."})
    assert type("Decided", (Slot,), {"__doc__": "A block.", "decide": nothing}).fmu_name == "decided"
    assert type("Other", (Slot,), {"__doc__": "A block that steps its own way.", "step": nothing}).fmu_name == "other"
