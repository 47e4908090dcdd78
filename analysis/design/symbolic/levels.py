"""Multilevel decomposition in symbols: the automated algorithm of Lapin's thesis, section 2.1.1.

The formulas are those of `poles/multilevel.py` without singular values: Bt consists of columns of B that span its
column space, R = Bt^+ B, and P is a basis of the left null space of Bt that is not orthonormal, so that the next level
is (P A P^+, P A Bt). If each level's Phi is a multiple of I, or bases are prescribed, the gain equals the numeric one.
As in that file u = K x.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..poles.results import PlacementError, Reason
from .algebra import Symbols, factor_elements, is_zero, left_inverse, sympy


@dataclass(frozen=True)
class SymbolicLevel:
    """Level with the matrices A, Bt^+, R^+ and P, and ``rank`` states."""

    a: Symbols
    inverse: Symbols
    spread: Symbols
    down: Symbols
    rank: int


def symbolic_levels(a: Symbols, b: Symbols, sizes: Sequence[int] | None = None) -> list[SymbolicLevel]:
    """Return the levels of a pair, level 0 first; with ``sizes`` they are consecutive groups of states.

    Raises PlacementError for a pair that is not controllable for general values, or sizes that do not match the levels.
    """
    sp = sympy()
    levels: list[SymbolicLevel] = []
    while True:
        states = a.rows
        basis = b[:, list(b.rref(iszerofunc=is_zero)[1])]
        rank = basis.cols
        if not rank:
            problem = f"{states} states are not controllable: no input drives level {len(levels)}"
            remedy = "remove these states, or add an input"
            raise PlacementError("multilevel placement", Reason.NOT_CONTROLLABLE, problem, 0.0, remedy)
        if sizes is None:
            left = basis
            down = sp.Matrix([list(row) for row in left.T.nullspace(iszerofunc=is_zero)])
        else:
            if len(levels) >= len(sizes) or sizes[len(levels)] != rank or not b[rank:, :].is_zero_matrix:
                problem = f"the basis of level {len(levels)} does not span the {rank} directions that the inputs drive"
                remedy = "give a basis of the states that B drives, then of the states that these drive, and so on"
                raise PlacementError("multilevel placement", Reason.RANK, problem, float(rank), remedy)
            left, down = sp.eye(states)[:, :rank], sp.eye(states)[rank:, :]
        inverse = left_inverse(left)
        spread = left_inverse(factor_elements(inverse * b).T).T
        levels.append(SymbolicLevel(a, inverse, spread, down, rank))
        if rank == states:
            return levels
        up = left_inverse(down.T).T
        a, b = factor_elements(down * a * up), factor_elements(down * a * left)


def assemble_symbols(levels: Sequence[SymbolicLevel], required: Sequence[Symbols]) -> Symbols:
    """Return K of u = K x for Phi_i = ``required``, level 0 first."""
    gain = None
    for level, phi in zip(reversed(levels), reversed(required), strict=True):
        inverse = level.inverse if gain is None else factor_elements(level.inverse - gain * level.down)
        gain = factor_elements(level.spread * (phi * inverse - inverse * level.a))
    return gain
