"""Subset of Python for kernels: every block conforms; every rule rejects with file, line and remedy."""

from __future__ import annotations

import ast
import importlib.util
import re
import warnings
from pathlib import Path

import pytest

from perilune.fmus_src.block import Block, Output, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.judge.subset import SubsetError, analyse_kernel, check
from perilune.fmus_src.export.judge.subset_table import REFUSED_FUNCTIONS, REFUSED_SYNTAX, RULES, SubsetRule
from perilune.fmus_src.kernel.records import Field, Record
from tests.support.kernels import bad_kernels, record_blocks
from tests.support.lengths import either

TEMPLATE = '''import math
from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.bundles import Bundle, Inputs, Outputs
from perilune.fmus_src.kernel.integrators import runge_kutta_4
from perilune.fmus_src.kernel.matrices import Matrix, add_product, matrix, zeros
from perilune.fmus_src.kernel.records import Field, Record, replace
from perilune.fmus_src.mathlib.vectors import Vector3, vector
from perilune.fmus_src.ports import Port


class Level(Bundle):
    height = Port(0.0, description="height")
    count = Port(0, description="count")


class Other(Bundle):
    height = Port(0.0, description="height")


class Motion(Record):
    height = Field()
    count = Field(int)


def helper(value: float) -> float:
    return 2.0 * value


def still(height: float, count: int) -> Motion:
    return Motion(height=height, count=count)


def helper_of_vectors(value: Vector3) -> Vector3:
    return 2.0 * value


def norm_of(values: list) -> float:
    return values[0]


def swap(a: Matrix, b: Matrix) -> None:
    a[0, 1] = b[1, 0]


def two() -> tuple[Vector3, float]:
    return vector(1.0, 2.0, 3.0), 1.0


{functions}


class Bad(Block):
    """A block that breaks one rule."""

    x = Input(0.0, description="x")
    k = Input(1, description="k")
    u = Input([0.0] * 5, description="u")
    given = Input([0.0] * 3, description="given")
    p = Parameter(1.0, description="p")
    y = Output(0.0, description="y")
    wanted = Inputs(Level, prefix="wanted_")
    last = Outputs(Level, prefix="last_")
    other = Outputs(Other, prefix="other_")
    n = State(0, description="n")
    flag = State(False, description="flag")
    v = State([0.0] * 5, description="v")
    w = State([0.0] * 3, description="w")
    pair = State([0.0] * 2, description="pair")
    m = State([0.0] * 6, columns=3, description="m")

    def bump(self) -> float:
        self.n = self.n + 1
        return 1.0

    def drift(self, t: float, y: float) -> float:
        self.n = self.n + 1
        return y

    def step(self, t: float, h: float) -> None:
        {step}
'''


def block_of(folder: Path, step: str, functions: str = "") -> tuple[type[Block], Path]:
    """Return a block with this body of step, from a separate file."""
    file = folder / "bad.py"
    file.write_text(TEMPLATE.format(step=step.replace("\n", "\n        "), functions=functions), encoding="utf-8")
    spec = importlib.util.spec_from_file_location(f"bad_{abs(hash((step, functions)))}", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SyntaxWarning)  # `is` with a literal
        spec.loader.exec_module(module)
    return module.Bad, file


def refusal(folder: Path, rule: SubsetRule, step: str, functions: str = "") -> None:
    """Assert that a kernel is refused by a rule, at the marked line, with the rule's remedy."""
    block, file = block_of(folder, step, functions)
    line = next(n for n, text in enumerate(file.read_text().splitlines(), 1) if "# here" in text)
    actual = [violation for violation in check(block) if violation.line == line]
    assert actual, [str(violation) for violation in check(block)]
    fixed = re.split(r"\{\w*\}", f"{rule.what}{{}}{rule.remedy}")
    assert any(
        violation.file == file and all(part in f"{violation.what}; {violation.remedy}" for part in fixed)
        for violation in actual
    ), actual
    assert all(str(violation).startswith(f"{file}:{line}: ") for violation in actual)


@pytest.mark.parametrize("block", list(catalogue().values())[:: either(1, 3)], ids=lambda block: block.fmu_name)
def test_every_block_is_in_the_subset(block: type[Block]) -> None:
    if not block.python_only:
        assert check(block) == []


@pytest.mark.parametrize("rule", bad_kernels.STEPS)
def test_rule_refuses_statement(rule: str, tmp_path: Path) -> None:
    refusal(tmp_path, RULES[rule], bad_kernels.STEPS[rule])


@pytest.mark.parametrize(("rule", "step"), bad_kernels.OTHERS)
def test_rule_refuses_other_statements(rule: str, step: str, tmp_path: Path) -> None:
    refusal(tmp_path, RULES[rule], step)


@pytest.mark.parametrize("rule", bad_kernels.FUNCTIONS)
def test_rule_refuses_function(rule: str, tmp_path: Path) -> None:
    functions, step = bad_kernels.FUNCTIONS[rule]
    refusal(tmp_path, RULES[rule], step, functions)


@pytest.mark.parametrize("name", sorted(set(bad_kernels.SYNTAX) - {"Nonlocal"}))
def test_syntax_is_refused(name: str, tmp_path: Path) -> None:
    refusal(tmp_path, REFUSED_SYNTAX[getattr(ast, name)], bad_kernels.SYNTAX[name])


@pytest.mark.parametrize("name", REFUSED_FUNCTIONS)
def test_function_is_refused_with_its_remedy(name: str, tmp_path: Path) -> None:
    in_math = name in ("hypot", "dist", "fsum", "degrees", "radians")
    step = f"self.y = {'math.' if in_math else ''}{name}(self.x)  # here"
    refusal(tmp_path, SubsetRule("", REFUSED_FUNCTIONS[name]), step)


def test_every_rule_has_a_bad_kernel() -> None:
    elsewhere = {"no initialize", "no variables", "python only", "record names"}  # the tests below
    assert set(bad_kernels.STEPS) | set(bad_kernels.FUNCTIONS) | elsewhere == set(RULES)
    unreachable = {"Await", "Nonlocal"}  # only inside an async function, or a nested one, which is refused itself
    assert set(bad_kernels.SYNTAX) | unreachable == {node.__name__ for node in REFUSED_SYNTAX}


class WithoutVariables(Block):
    """A block that declares nothing."""

    def step(self, t: float, h: float) -> None:
        pass


class PythonOnly(Block):
    """A block that uses a library."""

    python_only = True
    requires = ("filterpy",)

    def step(self, t: float, h: float) -> None:
        pass


class InitializeIsNoMethod(Block):
    """A block whose initialize is something else."""

    y = Output(0.0, description="y")
    initialize = staticmethod(print)

    def step(self, t: float, h: float) -> None:
        self.y = t


def test_initialize_that_is_no_method_is_refused() -> None:
    (violation,) = check(InitializeIsNoMethod)
    assert violation.remedy == "write def initialize(self) -> None"


def test_block_without_variables_is_refused() -> None:
    (violation,) = check(WithoutVariables)
    assert violation.what == "WithoutVariables declares no variables"


def test_python_only_block_is_refused() -> None:
    (violation,) = check(PythonOnly)
    assert violation.file == Path(__file__)
    assert violation.remedy == RULES["python only"].remedy
    with pytest.raises(SubsetError, match=r"test_subset\.py:\d+: PythonOnly declares python_only"):
        analyse_kernel(PythonOnly)


class Motion(Record):
    """A record with the name of another."""

    speed = Field()


class OneName(Block):
    """A block with two records of one name, each from its own file."""

    first = State(Motion)
    second = State(record_blocks.Motion)

    def step(self, t: float, h: float) -> None:
        self.first = 2.0 * self.first


def test_two_records_of_one_name_are_refused() -> None:
    (violation,) = check(OneName)
    assert violation.file == Path(__file__)
    first, second = (f"{record.__module__}.Motion" for record in (Motion, record_blocks.Motion))
    assert violation.what == f"OneName uses two records of the same name, {first} and {second}"
    assert violation.remedy.startswith("give one of them another name")


def test_changes_through_calls_are_seen(tmp_path: Path) -> None:
    functions = "def clear(values: list) -> None:\n    for i in range(3):\n        values[i] = 0.0\n"
    block, _ = block_of(tmp_path, "clear(self.v)", functions)
    assert check(block) == []
    refusal(tmp_path, RULES["read-only"], "clear(self.u)  # here", functions)


def test_a_row_of_constants_is_read_and_never_changed(tmp_path: Path) -> None:
    functions = "ROW = (1.0, 2.0)\n\n\ndef last(values: tuple) -> float:\n    return values[1]\n\n\n"
    block, _ = block_of(tmp_path, "self.y = last(ROW)", functions)
    assert check(block) == []
    functions += "def clear(values: list) -> None:\n    values[0] = 0.0\n"
    refusal(tmp_path, RULES["read-only"], "clear(ROW)  # here", functions)
