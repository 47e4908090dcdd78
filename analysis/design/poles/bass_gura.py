"""Generalised Bass-Gura formula: the gain from the coefficients that a plant has and those that it should have.

For n = p m states and U = [B AB .. A^(p-1) B] nonsingular, V = [T; T A; ..; T A^(p-1)] with the T of the generalised
Ackermann formula, -T A^p V^-1 = [a_0 .. a_(p-1)], and u = -K x with K = [N_0 - a_0 .. N_(p-1) - a_(p-1)] V. The a_i are
left coefficients; the right ones, of A^p B = -sum A^i B b_i, differ for several inputs.
Bass and Gura, "High order system design via state-space considerations", JACC (1965), for m = 1; for several inputs
Lapin's thesis (2.1.2.2), the formulas derived here.
"""

from __future__ import annotations

import numpy as np

from .ackermann import row_stack
from .polynomial import make_polynomial
from .results import StateFeedback
from .spectrum import Spectrum

FORMULA = "generalised Bass-Gura"  # as refusals name it


def bass_gura(a: np.ndarray, b: np.ndarray, spectrum: Spectrum) -> StateFeedback:
    """Place the spectrum with the N_i that the Ackermann formula takes. Raises PlacementError."""
    stack, power, condition = row_stack(a, b, FORMULA)
    inputs = b.shape[1]
    own = np.linalg.solve(stack.T, -power.T).T
    wanted = np.hstack(list(make_polynomial(spectrum, [len(a) // inputs] * inputs)))
    gain = (wanted - own) @ stack
    return StateFeedback("bass_gura", gain, spectrum.poles, a - b @ gain, condition)
