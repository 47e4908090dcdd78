"""Generalised Ackermann and Bass-Gura formulas in symbols; see `poles/ackermann.py` for their sources."""

from __future__ import annotations

from collections.abc import Sequence

from ..poles.results import PlacementError, Reason
from .algebra import Symbols, factor_elements, inverse_of, is_zero, powers, sympy


def last_symbol_rows(a: Symbols, b: Symbols, formula: str) -> Symbols:
    """Return T (m, n), the last rows of U^-1. Raises PlacementError, which names ``formula``."""
    sp = sympy()
    states, inputs = b.shape
    if states % inputs:
        problem = f"the number of states, {states}, is not a multiple of the number of inputs, {inputs}"
        raise PlacementError(formula, Reason.CLASS, problem, states / inputs, "use method multilevel")
    columns = sp.Matrix.hstack(*(row.T for row in powers(a.T, b.T, states // inputs - 1)))
    inverse = inverse_of(columns)
    if inverse is None:
        rank = columns.rank(iszerofunc=is_zero)
        problem = f"the controllability matrix U = [B AB ..] has rank {rank}, but the plant has {states} states"
        remedy = "use method multilevel, which reports whether the plant is controllable"
        raise PlacementError(formula, Reason.CLASS, problem, float(rank), remedy)
    return inverse[states - inputs :, :]


def ackermann_symbols(a: Symbols, b: Symbols, coefficients: Sequence[Symbols]) -> Symbols:
    """Return K = T A^p + sum N_i T A^i of u = -K x. Raises PlacementError."""
    rows = last_symbol_rows(a, b, "generalised Ackermann")
    *lower, top = powers(a, rows, len(coefficients))
    return factor_elements(sum((n * row for n, row in zip(coefficients, lower, strict=True)), top))


def bass_gura_symbols(a: Symbols, b: Symbols, coefficients: Sequence[Symbols]) -> Symbols:
    """Return K = [N_0 - a_0 .. N_(p-1) - a_(p-1)] V of u = -K x. Raises PlacementError."""
    sp = sympy()
    rows = last_symbol_rows(a, b, "generalised Bass-Gura")
    *lower, top = powers(a, rows, len(coefficients))
    stack = sp.Matrix.vstack(*lower)
    plant = factor_elements(-top * inverse_of(stack))
    return factor_elements((sp.Matrix.hstack(*coefficients) - plant) * stack)
