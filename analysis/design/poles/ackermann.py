"""Generalised Ackermann and Bass-Gura formulas for several inputs, without canonical forms.

For n = p m states and U = [B AB .. A^(p-1) B] nonsingular, T = [0 .. 0 I] U^-1, u = -K x with

    K = T A^p + sum N_i T A^i    gives    det(s I - A + B K) = det(I s^p + N_(p-1) s^(p-1) + .. + N_0).

The m x m matrices N_i are arbitrary apart from that determinant: a parametrised set that contains every K. Ackermann,
"Der Entwurf linearer Regelungssysteme im Zustandsraum", Regelungstechnik 20 (1972), for m = 1; for several inputs
Lapin's thesis (2.1.2.3) and Zubov, Mikrin and Ryabchenko. The formulas were derived here, from T A^i B = 0 for i < p -
1 and T A^(p-1) B = I.

Bass and Gura compute the gain from the actual and the required coefficients of the characteristic polynomial. With V =
[T; T A; ..; T A^(p-1)], -T A^p V^-1 = [a_0 .. a_(p-1)], it is K = [N_0 - a_0 .. N_(p-1) - a_(p-1)] V. The a_i are left
coefficients; the right ones, of A^p B = -sum A^i B b_i, differ for several inputs. Bass and Gura, "High order system
design via state-space considerations", JACC (1965), for m = 1; for several inputs Lapin's thesis (2.1.2.2), with the
formulas derived here.
"""

from __future__ import annotations

import numpy as np

from .controllability import controllability_matrix
from .polynomial import block_companion, make_polynomial
from .results import PlacementError, Reason, StateFeedback
from .spectrum import Spectrum

FORMULA = "generalised Ackermann"  # name in error messages


def ackermann(a: np.ndarray, b: np.ndarray, spectrum: Spectrum) -> StateFeedback:
    """Place the spectrum with diagonal N_i as far as its pairs permit. Raises PlacementError."""
    rows, _ = last_rows(a, b)
    return ackermann_of(a, b, make_polynomial(spectrum, [len(a) // len(rows)] * len(rows)), spectrum.poles)


def ackermann_of(
    a: np.ndarray, b: np.ndarray, coefficients: np.ndarray, desired: np.ndarray | None = None
) -> StateFeedback:
    """Return the gain for coefficients N (p, m, m); ``desired`` are the poles if known. Raises PlacementError."""
    rows, condition = last_rows(a, b)
    gain = rows
    for block in coefficients[::-1]:  # Horner
        gain = gain @ a + block @ rows
    if desired is None:
        desired = np.linalg.eigvals(block_companion(coefficients))
    return StateFeedback("ackermann", gain, desired, a - b @ gain, condition)


def coefficients_of(a: np.ndarray, b: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """Return the coefficients N (p, m, m) of any feedback u = -K x: N = (K - T A^p) V^-1. Raises PlacementError."""
    stack, power, _ = row_stack(a, b)
    return split(np.linalg.solve(stack.T, (gain - power).T).T, b.shape[1])


def last_rows(a: np.ndarray, b: np.ndarray, formula: str = FORMULA) -> tuple[np.ndarray, float]:
    """Return T (m, n), and cond(U).

    Raises PlacementError, which names ``formula``, if n is not a multiple of m or U is singular.
    """
    states, inputs = b.shape
    if states % inputs:
        problem = f"the number of states, {states}, is not a multiple of the number of inputs, {inputs}"
        raise PlacementError(formula, Reason.CLASS, problem, states / inputs, "use method indices or multilevel")
    matrix = controllability_matrix(a, b, states // inputs)
    condition = float(np.linalg.cond(matrix))
    if not condition < 1.0 / (states * np.finfo(float).eps):
        problem = (
            f"the controllability matrix U = [B AB ..] is singular to working precision, cond(U) = {condition:.2g}"
        )
        remedy = "use method indices or multilevel, which report whether the plant is controllable"
        raise PlacementError(formula, Reason.CLASS, problem, condition, remedy)
    return np.linalg.solve(matrix.T, np.eye(states, inputs, inputs - states)).T, condition


def row_stack(a: np.ndarray, b: np.ndarray, formula: str = FORMULA) -> tuple[np.ndarray, np.ndarray, float]:
    """Return V = [T; T A; ..; T A^(p-1)] (n, n), T A^p (m, n), and cond(U). Raises PlacementError like `last_rows`."""
    rows, condition = last_rows(a, b, formula)
    stacked = [rows]
    for _ in range(len(a) // len(rows)):
        stacked.append(stacked[-1] @ a)
    return np.vstack(stacked[:-1]), stacked[-1], condition


def split(side_by_side: np.ndarray, inputs: int) -> np.ndarray:
    """Return [N_0 .. N_(p-1)] (m, n) as an array (p, m, m)."""
    return np.stack(np.hsplit(side_by_side, side_by_side.shape[1] // inputs))


def bass_gura(a: np.ndarray, b: np.ndarray, spectrum: Spectrum) -> StateFeedback:
    """Place the spectrum with the same N_i as the Ackermann formula. Raises PlacementError."""
    stack, power, condition = row_stack(a, b, "generalised Bass-Gura")
    inputs = b.shape[1]
    own = np.linalg.solve(stack.T, -power.T).T
    desired = np.hstack(list(make_polynomial(spectrum, [len(a) // inputs] * inputs)))
    gain = (desired - own) @ stack
    return StateFeedback("bass_gura", gain, spectrum.poles, a - b @ gain, condition)
