"""Formulas as kernel functions: accepted by the translator, the same bits as Python and as C.

Truth: the formula at random values, to 30 digits.
"""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Iterator

import numpy as np
import pytest
import sympy as sp

from perilune import modal
from perilune.fmus_src.block import Block
from perilune.fmus_src.export.judge.subset import check
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.native_instance import NativeInstance

K, D, M, ANGLE = sp.symbols("k d m angle", positive=True)
BLOCK = '''"""A block that makes its gain from its parameters."""

from perilune import Block, Input, Output, State
from symbolic_gain_of_a_test import pendulum_gain


class PendulumGain(Block):
    """The gain of a pendulum whose parameters change."""

    angle = Input(0.3, unit="rad", description="at rest")
    d = Input(0.1, description="damping")
    k = Input(2.0, description="stiffness")
    m = Input(1.5, unit="kg", description="mass")
    gain = Output([0.0] * 2, vector=False, direct=True, description="gain")
    matrix = State([0.0] * 2, columns=2, description="gain as a matrix")

    def initialize(self) -> None:
        self.step(0.0, 0.0)

    def step(self, t: float, h: float) -> None:
        self.matrix = pendulum_gain(self.angle, self.d, self.k, self.m)
        self.gain[0] = self.matrix[0, 0]
        self.gain[1] = self.matrix[0, 1]
'''


def pendulum() -> modal.SymbolicGain:
    """Return a pendulum about a rest at an angle; one pole has a root."""
    a = [[0, 1], [-K * sp.cos(ANGLE) / M, -D / M]]
    return modal.symbolic_gain(a, [[0], [sp.sin(ANGLE) / M**2]], [-sp.sqrt(K / M), sp.Rational(-1, 3)])


@pytest.fixture(scope="module")
def block(tmp_path_factory: pytest.TempPathFactory) -> Iterator[type[Block]]:
    folder = tmp_path_factory.mktemp("blocks")
    (folder / "symbolic_gain_of_a_test.py").write_text(pendulum().kernel("pendulum_gain"))
    (folder / "pendulum_gain_of_a_test.py").write_text(BLOCK)
    sys.path.insert(0, str(folder))
    yield importlib.import_module("pendulum_gain_of_a_test").PendulumGain
    sys.path.remove(str(folder))


def test_the_translator_accepts_it(block: type[Block]) -> None:
    assert check(block) == []


def test_python_and_c_have_the_formula_s_values(block: type[Block]) -> None:
    formula, random = pendulum(), np.random.default_rng(64)
    assert formula.names == ["angle", "d", "k", "m"]
    python, native = BlockInstance(block), NativeInstance(block)
    native.enter()
    python.start()
    native.start()
    for n in range(100):
        values = random.uniform(0.2, 1.4, 4).tolist()
        python.set([0, 1, 2, 3], values)
        native.set([0, 1, 2, 3], values)
        python.do_step(n * 0.1, 0.1)
        native.do_step(n * 0.1, 0.1)
        actual = python.get([4, 5])
        assert native.get([4, 5]) == actual
        exact = formula.at(dict(zip(formula.names, values, strict=True)))[0]
        # a difference of two terms of the size of k/m / sin(angle), 25 at most
        np.testing.assert_allclose(actual, exact, rtol=1e-12, atol=1e-13)
    native.free()


def test_the_file_names_the_functions_that_it_uses() -> None:
    text = pendulum().kernel("pendulum_gain")
    assert "import math\n" in text
    assert "from perilune.fmus_src.kernel.functions import cos, sin\n" in text
    assert "**" not in text


@pytest.mark.parametrize(
    ("pole", "name", "message"),
    [
        (-K, "lambda", "the name 'lambda': not a Python identifier"),
        (-sp.Symbol("k_{1}", real=True), "formula", "the name 'k_{1}': not a Python identifier"),
        (-K, "gain", "the generated function already uses this name"),
        (-sp.gamma(K), "formula", "kernels do not support the function gamma"),
        (-sp.cbrt(K), "formula", "kernels do not support the power"),
    ],
)
def test_refusals(pole: sp.Expr, name: str, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        modal.symbolic_gain([[0]], [[1]], [pole]).kernel(name)
