"""Gains K and L as symbolic formulas, and their conversion to numbers, LaTeX and kernel functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any

import mpmath
import numpy as np

from ....common.errors import InputError, suggestion
from .algebra import Expression, Symbols, exact, factor_elements, matrix_of, sympy
from .formulas import ackermann_symbols, bass_gura_symbols
from .kernel_text import kernel_text
from .levels import assemble_symbols, symbolic_levels

_DIGITS = 30


class SymbolicMethod(StrEnum):
    """Methods with a symbolic formula."""

    MULTILEVEL = "multilevel"
    ACKERMANN = "ackermann"
    BASS_GURA = "bass_gura"


@dataclass(frozen=True)
class SymbolicGain:
    """Gain as a formula: ``gain`` and ``closed_loop`` are sympy matrices, ``letter`` is K or L.

    Elements are rational functions in factored form, in which sines and cosines are written as functions of their
    angles.
    """

    method: str
    gain: Symbols
    closed_loop: Symbols
    letter: str

    @property
    def names(self) -> list[str]:
        """Names of the symbols in the gain, sorted."""
        return sorted(str(symbol) for symbol in self.gain.free_symbols)

    def at(self, values: Mapping[str, float]) -> np.ndarray:
        """Return the gain as numbers for ``values`` of its symbols by name. Raises InputError for a missing value.

        It is evaluated with 30 digits and rounded once to double precision.
        """
        missing = [name for name in self.names if name not in values]
        if missing:
            raise InputError(
                "modal", f"values of {self.letter}", f"{missing[0]} has no value", "give a value for each symbol"
            )
        with mpmath.workdps(_DIGITS):
            evaluated = self._function(*(mpmath.mpf(float(values[name])) for name in self.names))
        return np.array(evaluated.tolist(), dtype=float)

    @cached_property
    def _function(self) -> Callable[..., Any]:
        symbols = sorted(self.gain.free_symbols, key=str)
        function: Callable[..., Any] = sympy().lambdify(symbols, self.gain, modules="mpmath", cse=True)
        return function

    def latex(self) -> str:
        """Return the formula as LaTeX, ``K = ...``."""
        return f"{self.letter} = {sympy().latex(self.gain)}"

    def kernel(self, name: str) -> str:
        """Return a module with the kernel function ``name``, from the symbols in sorted order to the matrix.

        A block's `initialize` or `step` may call it. Raises InputError for a name or symbol that is not valid in
        Python, or a function that kernels do not support.
        """
        return kernel_text(name, self.letter, self.gain)


def symbolic_gain(
    a: Any,
    b: Any,
    required: Sequence[Any],
    *,
    method: str = SymbolicMethod.MULTILEVEL,
    bases: Sequence[Any] | None = None,
) -> SymbolicGain:
    """Return K of **u = -K x** as a formula in the symbols of A and B; needs `pip install 'perilune[symbolic]'`.

    ``a`` is A (n, n), ``b`` B (n, m), of numbers and sympy symbols; 0.1 is taken as 1/10. ``required`` are n poles
    (numbers, or symbols for real poles) or matrices. The matrices depend on ``method``: for multilevel, Phi_i of each
    level, level 0 first, with ``bases`` as in `place_levels`; for ackermann and bass_gura, N_i, N_0 first, as in
    `place_polynomial`. Poles are assigned in order, along the diagonals of the levels, or n/m to each input. Ranks are
    determined for general values of the symbols. Raises InputError and PlacementError.
    """
    state = matrix_of("A", a)
    state = matrix_of("A", state, (state.rows, state.rows))
    inputs = matrix_of("B", b, (state.rows, None))
    if method not in [*SymbolicMethod]:
        raise InputError("modal", f"method {method!r}", "unknown", suggestion(method, SymbolicMethod))
    if method != SymbolicMethod.MULTILEVEL:
        if bases is not None:
            raise InputError("modal", "bases", f"method {method} has no such option", "use method multilevel")
        size = inputs.cols
        count = state.rows // size
        matrices = _matrices(required, [size] * count) or _polynomial(_poles(required, state.rows), count, size)
        formula = ackermann_symbols if method == SymbolicMethod.ACKERMANN else bass_gura_symbols
        gain = formula(state, inputs, matrices)
    else:
        gain = -_multilevel(state, inputs, required, bases)
    return SymbolicGain(str(method), gain, factor_elements(state - inputs * gain), "K")


def symbolic_observer(
    a: Any,
    c: Any,
    required: Sequence[Any],
    *,
    method: str = SymbolicMethod.MULTILEVEL,
    bases: Sequence[Any] | None = None,
) -> SymbolicGain:
    """Return L of x_h' = A x_h + B u + L (y - C x_h) as a formula: L' is K of `symbolic_gain` for (A', C').

    ``c`` is C (p, n); ``required``, ``method`` and ``bases`` refer to (A', C'). Raises InputError and PlacementError.
    """
    state, outputs = matrix_of("A", a), matrix_of("C", c)
    dual = symbolic_gain(state.T, outputs.T, required, method=method, bases=bases)
    return SymbolicGain(dual.method, dual.gain.T, dual.closed_loop.T, "L")


def _multilevel(a: Symbols, b: Symbols, required: Sequence[Any], bases: Sequence[Any] | None) -> Symbols:
    sp = sympy()
    turn = sp.eye(a.rows)
    sizes = None
    if bases is not None:
        checked = [matrix_of(f"bases[{i}]", basis, (a.rows, None)) for i, basis in enumerate(bases)]
        turn = sp.Matrix.hstack(*checked)
        sizes = [basis.cols for basis in checked]
        if turn.cols != a.rows or factor_elements(turn.T * turn) != sp.eye(a.rows):
            raise InputError(
                "modal", "bases", "together they are not an orthonormal basis of the state space", "orthonormalise them"
            )
    levels = symbolic_levels(factor_elements(turn.T * a * turn), factor_elements(turn.T * b), sizes)
    ranks = [level.rank for level in levels]
    matrices = _matrices(required, ranks)
    if matrices is None:
        poles = _poles(required, a.rows)
        matrices = [sp.diag(*poles[start:end]) for start, end in pairwise(accumulate(ranks, initial=0))]
    return factor_elements(assemble_symbols(levels, matrices) * turn.T)


def _matrices(required: Sequence[Any], sizes: Sequence[int]) -> list[Symbols] | None:
    """Return ``required`` as square matrices of these sizes; None if it contains poles instead."""
    if len(required) and not hasattr(required[0], "__len__"):
        return None
    if len(required) != len(sizes):
        text = ", ".join(map(str, sizes))
        raise InputError("modal", "required", f"{len(required)} matrices", f"give square matrices of orders {text}")
    return [
        matrix_of(f"required[{i}]", matrix, (size, size))
        for i, (matrix, size) in enumerate(zip(required, sizes, strict=True))
    ]


def _poles(required: Sequence[Any], states: int) -> list[Expression]:
    poles = [exact(pole) for pole in required]
    if len(poles) != states:
        raise InputError(
            "modal",
            "required",
            f"{len(poles)} poles",
            f"give {states} poles, with each repeated pole listed as often as it occurs",
        )
    if any(pole.is_real is False for pole in poles):
        remedy = "give real matrices, [[a, b], [-b, a]] for a pair a +- i b"
        raise InputError("modal", "required", "a pole is not real", remedy)
    return poles


def _polynomial(poles: list[Expression], count: int, size: int) -> list[Symbols]:
    """Return diagonal N_0 .. N_(count - 1) that assign ``count`` consecutive poles to each input."""
    sp = sympy()
    variable = sp.Dummy("s")
    columns = []
    for j in range(size):
        product = sp.prod([variable - pole for pole in poles[j * count : (j + 1) * count]])
        columns.append(sp.Poly(product, variable).all_coeffs()[:0:-1])
    return [sp.diag(*(column[i] for column in columns)) for i in range(count)]
