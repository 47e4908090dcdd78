"""Tunable parameters, and reasons why other parameters are fixed.

Truth: small blocks with an obvious answer; for blocks of the catalogue, their behaviour: after initialisation with a
different value of a tunable parameter, every variable that steps do not change is equal.
"""

from __future__ import annotations

import inspect
import math
import re

import pytest

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.judge.tunable import find_fixed, tunable_parameters
from perilune.fmus_src.kernel.integrators import runge_kutta_4
from perilune.fmus_src.kernel.matrices import Matrix, identity, zeros
from perilune.fmus_src.kernel.records import Field, Record
from perilune.fmus_src.kernel.vector_types import Vector3
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.comparison import another
from tests.support.lengths import either

CONSTANT = "a variable that is computed once follows from it: {}"


def scale(q: Matrix, factor: float) -> None:
    """Multiply a matrix where it stands."""
    for k in range(3):
        q[k, k] = q[k, k] * factor


def larger(a: float, b: float) -> float:
    """Return the larger of two numbers."""
    if a > b:
        return a
    return b


class Paths(Block):
    """Each parameter reaches a state of initialisation by a different path."""

    gain = Parameter(1.0, description="read by steps alone")
    sample_period = Parameter(0.0, unit="s", description="sampling")
    start = Parameter(0.0, description="of a state that steps write")
    never = Parameter(0.0, description="read nowhere")
    direct = Parameter(1.0, description="assigned to a constant")
    by_local = Parameter(1.0, description="by way of locals and a function that returns")
    by_test = Parameter(1.0, description="decides a branch")
    by_return = Parameter(1.0, description="decides about an early return")
    by_break = Parameter(1.0, description="decides when a loop ends")
    by_bound = Parameter(1.0, description="in the bound of a loop's test")
    by_matrix = Parameter(1.0, description="changes a matrix by way of an argument")
    by_index = Parameter(0, minimum=0, maximum=2, description="says which element")
    by_state = Parameter(1.0, description="by way of a state that steps write")
    overwritten = Parameter(1.0, description="in the start of a state that steps write")
    unread = Parameter(1.0, description="in a constant that no step reads")
    relied = Parameter(1.0, fixed="the ground relies on it", description="tunable but for its declaration")
    x = Input(0.0, description="input")
    y = Output(0.0, description="output")
    state = State(0.0, description="written by steps")
    written = State(0.0, description="written by steps")
    constant = State(0.0, description="of direct")
    local_constant = State(0.0, description="of by_local")
    test_constant = State(0.0, description="of by_test")
    return_constant = State(0.0, description="of by_return")
    break_constant = State(0.0, description="of by_break")
    bound_constant = State(0, description="of by_bound")
    matrix_constant = State(zeros(3, 3), description="of by_matrix")
    index_constant = State([0.0] * 5, description="of by_index")
    state_constant = State(0.0, description="of by_state")
    unread_constant = State(0.0, description="of unread")

    def initialize(self) -> None:
        self.state = self.start
        self.constant = self.direct
        wider = larger(self.by_local, 2.0)
        self.local_constant = wider * 2.0
        if self.by_test > 0.0:
            self.test_constant = 1.0
        for _ in range(10):
            if self.break_constant > self.by_break:
                break
            self.break_constant = self.break_constant + 1.0
        while float(self.bound_constant) < self.by_bound:
            self.bound_constant = self.bound_constant + 1
        self.matrix_constant = identity(3)
        scale(self.matrix_constant, self.by_matrix)
        self.index_constant[self.by_index] = 1.0
        self.written = self.by_state
        self.state_constant = self.written
        self.state = self.overwritten
        self.unread_constant = self.unread
        self.leave()

    def leave(self) -> None:
        """Return early, or assign."""
        if self.by_return > 1.0:
            return
        self.return_constant = 1.0

    def step(self, t: float, h: float) -> None:
        read = self.constant + self.local_constant + self.test_constant + self.return_constant + self.break_constant
        read = read + float(self.bound_constant) + self.matrix_constant[0, 0] + self.index_constant[0]
        also = self.direct + self.by_local + self.by_test + self.by_return + self.by_break + self.by_bound
        also = (
            also + self.by_matrix + float(self.by_index) + self.by_state + self.overwritten + self.unread + self.relied
        )
        self.written = read + self.state_constant
        self.state = self.state + h * self.gain * self.x
        self.y = self.state + also


class Swing(Record):
    """A point on a spring."""

    position = Field(Vector3, unit="m", description="position")
    velocity = Field(Vector3, unit="m/s", description="velocity")


class Spring(Block):
    """A method that is passed on, and results of several paths that are not mixed up."""

    stiffness = Parameter(1.0, description="read in derivatives")
    mass = Parameter(1.0, description="its inverse is computed once")
    first = Parameter(1.0, description="in the first call of a function alone")
    second = Parameter(1.0, description="in the second call alone")
    internal_step = Parameter(0.1, unit="s", minimum=1e-3, description="longest step")
    motion = State(Swing)
    inverse_mass = State(1.0, description="1 / mass")
    from_first = State(0.0, description="of first")
    y = Output(0.0, description="output")

    def initialize(self) -> None:
        self.inverse_mass = 1.0 / self.mass
        self.from_first = larger(self.first, 0.0)
        self.y = larger(self.second, 0.0)

    def derivatives(self, t: float, s: Swing) -> Swing:
        """Return the rates."""
        return Swing(position=s.velocity, velocity=-self.stiffness * self.inverse_mass * s.position)

    def step(self, t: float, h: float) -> None:
        self.motion = runge_kutta_4(self.derivatives, t, self.motion, h)
        self.y = self.motion.position.x + self.from_first + self.first + larger(self.second, self.mass)


class Deciding(Block):
    """A constant of a step that returns early; one that no step reads but that importers do."""

    limit = Parameter(1.0, description="decides in initialize whether a call is reached")
    noted = Parameter(1.0, description="in an output of initialisation")
    reached = State(False, description="by initialisation")
    note = Output(0.0, description="of initialisation")
    y = Output(0.0, description="output")

    def initialize(self) -> None:
        self.note = self.noted
        if self.limit > 0.0:
            self.arrive()

    def arrive(self) -> None:
        """Note that it is reached."""
        self.reached = True

    def step(self, t: float, h: float) -> None:
        if self.reached:
            self.y = self.limit + self.noted


def test_every_way_to_a_constant_is_found() -> None:
    assert find_fixed(Paths) == {
        "gain": None,
        "sample_period": "the sample period",
        "start": "read at the start only",
        "never": "never read",
        "direct": CONSTANT.format("constant"),
        "by_local": CONSTANT.format("local_constant"),
        "by_test": CONSTANT.format("test_constant"),
        "by_return": CONSTANT.format("return_constant"),
        "by_break": CONSTANT.format("break_constant"),
        "by_bound": CONSTANT.format("bound_constant"),
        "by_matrix": CONSTANT.format("matrix_constant"),
        "by_index": CONSTANT.format("index_constant"),
        "by_state": CONSTANT.format("state_constant"),
        "overwritten": None,
        "unread": None,
        "relied": "the ground relies on it",
    }
    assert tunable_parameters(Paths) == ["gain", "overwritten", "unread"]


def test_methods_that_are_passed_on_are_read_and_calls_are_kept_apart() -> None:
    assert find_fixed(Spring) == {
        "stiffness": None,
        "mass": CONSTANT.format("inverse_mass"),
        "first": CONSTANT.format("from_first"),
        "second": None,
        "internal_step": "never read",
    }


def test_a_call_that_a_test_decides_about_and_an_output_that_stands_are_found() -> None:
    assert find_fixed(Deciding) == {"limit": CONSTANT.format("reached"), "noted": CONSTANT.format("note")}


def test_a_block_without_a_kernel_proves_nothing() -> None:
    class Library(Block):
        """Uses a library."""

        python_only = True
        gain = Parameter(1.0, description="factor")
        y = Output(0.0, description="output")

        def step(self, t: float, h: float) -> None:
            self.y = self.gain

    class Other(Block):
        """Is outside the kernel language."""

        gain = Parameter(1.0, description="factor")
        y = Output(0.0, description="output")

        def step(self, t: float, h: float) -> None:
            self.y = sum([self.gain])

    assert find_fixed(Library) == {"gain": "a block with Python only proves nothing"}
    assert find_fixed(Other) == {"gain": "a block outside the kernel language proves nothing"}


KERNELS = [block for block in catalogue().values() if not block.python_only]


@pytest.mark.parametrize("block", KERNELS[:: either(1, 8)], ids=lambda block: block.fmu_name)
def test_nothing_that_steps_leave_alone_follows_from_a_tunable_parameter(block: type[Block]) -> None:
    flown = BlockInstance(block)
    flown.start()
    before, changed = flown.values(), set()
    for n in range(4):
        flown.do_step(n * block.default_step, block.default_step)
        changed |= {k for k, (a, b) in enumerate(zip(before, flown.values(), strict=True)) if not same(a, b)}
    first = 0
    for name, variable in block.variables.items():
        if name in tunable_parameters(block):
            other = BlockInstance(block)
            new = [another(value, variable.minimum, variable.maximum) for value in variable.elements]
            references = list(range(first, first + variable.size))
            other.set(references, new)
            try:
                other.start()
            except ArithmeticError:  # of a parameter that is not to be 1.1 times as large
                first += variable.size
                continue
            differ = {k for k, (a, b) in enumerate(zip(before, other.values(), strict=True)) if not same(a, b)}
            constant = {flown.elements[k][0] for k in differ - set(references) - changed}
            assert [each for each in sorted(constant) if not is_assigned(block, each)] == [], name
        first += variable.size


def is_assigned(block: type[Block], name: str) -> bool:
    """Return True if a method other than `initialize` has an assignment to a variable, as text."""
    texts = [inspect.getsource(each) for base in block.__mro__ for each in vars(base).values()
             if inspect.isfunction(each) and each.__name__ != "initialize" and issubclass(base, Block)]  # fmt: skip
    members = [f"{bundle}\\.{member}|{bundle}" for bundle, each in block.bundles.items()
               for member, variable in each.names.items() if variable == name]  # fmt: skip
    target = re.compile(rf"self\.({'|'.join([name, *members])})\b(\[.*\])?(, .*)? [-+*/]?= ")
    return any(target.search(text) for text in texts)


def same(a: float, b: float) -> bool:
    """Return True for equal numbers, NaN included."""
    return a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b))
