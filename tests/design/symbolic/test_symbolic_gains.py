"""Gains as formulas in symbols.

Truth: the formulas in docs/systems/orbital_attitude.md and entry_attitude.md, by sympy's algebra; the numeric methods
of `perilune.modal` at random values; characteristic polynomials.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
import sympy as sp

from perilune import modal
from perilune.analysis.design.symbolic import algebra
from tests.support.lengths import either

COUNT = either(100, 10)
W0 = sp.Symbol("w0", positive=True)
EYE3, EYE6, NONE3 = sp.eye(3), sp.eye(6), sp.zeros(3, 3)
ANGLES_AND_RATES = [EYE6[:, 3:], EYE6[:, :3]]


def cross(v: sp.Matrix) -> sp.Matrix:
    return sp.Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def orbit(inertia: sp.Matrix) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix, sp.Matrix, sp.Matrix]:
    """Return A, B, A11, A21, A22 as the page has them."""
    inverse, down, up = inertia.inv(), sp.Matrix([0, 0, -W0]), sp.Matrix([0, 1, 0])
    a11 = sp.Matrix([[0, -W0, 0], [W0, 0, 0], [0, 0, 0]])
    tilt = sp.Matrix([[0, 0, 1], [0, 0, 0], [-1, 0, 0]])
    a21 = 3 * W0**2 * inverse * (cross(up) * inertia - cross(inertia * up)) * tilt
    a22 = inverse * (cross(inertia * down) - cross(down) * inertia)
    a = sp.Matrix.vstack(sp.Matrix.hstack(a11, EYE3), sp.Matrix.hstack(a21, a22))
    return a, sp.Matrix.vstack(NONE3, inverse), a11, a21, a22


def full_inertia() -> sp.Matrix:
    """Return moments and one product, so that the page's J^-1 matters."""
    jx, jy, jz, jxy = sp.symbols("jx jy jz jxy", positive=True)
    return sp.Matrix([[jx, jxy, 0], [jxy, jy, 0], [0, 0, jz]])


def test_the_gain_of_the_orbit_is_the_one_that_its_page_prints() -> None:
    """u = J ((N A11 - S0 N - A21) a + (N + S0 - A22)(w - wp)), N = S1 - A11."""
    inertia = full_inertia()
    a, b, a11, a21, a22 = orbit(inertia)
    s1, s0 = -sp.diag(*sp.symbols("p1:4")), -sp.diag(*sp.symbols("q1:4"))
    actual = modal.symbolic_gain(a, b, [s0, s1], bases=ANGLES_AND_RATES)
    n = s1 - a11
    printed = inertia * sp.Matrix.hstack(n * a11 - s0 * n - a21, n + s0 - a22)
    assert sp.simplify(actual.gain + printed) == sp.zeros(3, 6)


def test_the_gain_of_the_orbit_in_numbers() -> None:
    a, b, *_ = orbit(full_inertia())
    s1, s0 = -sp.diag(*sp.symbols("p1:4")), -sp.diag(*sp.symbols("q1:4"))
    formula = modal.symbolic_gain(a, b, [s0, s1], bases=ANGLES_AND_RATES)
    assert formula.names == ["jx", "jxy", "jy", "jz", "p1", "p2", "p3", "q1", "q2", "q3", "w0"]
    random = np.random.default_rng(61)
    for _ in range(COUNT):
        values = {"jx": 6500.0, "jy": 30000.0, "jz": 29000.0, "jxy": -150.0, "w0": 0.0011} | dict.fromkeys(
            ["p1", "p2", "p3", "q1", "q2", "q3"], 0.1
        )
        values = {name: value * random.uniform(0.5, 2.0) for name, value in values.items()}
        poles = [-np.diag([values[f"{letter}{k}"] for k in (1, 2, 3)]) for letter in "qp"]
        state, driven = numbers(a, values), numbers(b, values)
        bases = [np.eye(6)[:, 3:], np.eye(6)[:, :3]]
        numeric = modal.place_levels(state, driven, poles, bases=bases).gain
        np.testing.assert_allclose(formula.at(values), numeric, rtol=0.0, atol=1e-11 * np.abs(numeric).max())


def numbers(matrix: sp.Matrix, values: dict[str, float]) -> np.ndarray:
    return np.array(compiled(matrix.as_immutable())(**values), dtype=float)


@cache
def compiled(matrix: sp.ImmutableMatrix) -> Callable[..., np.ndarray]:
    names = sorted(matrix.free_symbols, key=str)
    function = sp.lambdify(names, matrix, modules="numpy")
    return lambda **values: function(*(values[str(name)] for name in names))


def vanishes(matrix: sp.Matrix, angle: sp.Symbol) -> bool:
    """Return True if 0 with the tangent of half the angle as an unknown."""
    t = sp.Symbol("t")
    rational = {sp.sin(angle): 2 * t / (1 + t**2), sp.cos(angle): (1 - t**2) / (1 + t**2)}
    return all(sp.cancel(element.subs(rational)) == 0 for element in matrix)


def capsule() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix, sp.Matrix]:
    """Return A, B, J2 and W, bank and sideslip rates over body rates; the air's moment is q (mx, my) times sideslip."""
    jx, jy, jxy, q, mx, my, a0 = sp.symbols("jx jy jxy q mx my a0", real=True)
    inertia = sp.Matrix([[jx, jxy], [jxy, jy]])
    turn = sp.Matrix([[sp.cos(a0), -sp.sin(a0)], [sp.sin(a0), sp.cos(a0)]])
    air = inertia.inv() * sp.Matrix([[0, q * mx], [0, q * my]])
    zero = sp.zeros(2, 2)
    a = sp.Matrix.vstack(sp.Matrix.hstack(zero, turn), sp.Matrix.hstack(air, zero))
    return a, sp.Matrix.vstack(zero, inertia.inv()), inertia, turn


def robust_polynomial() -> tuple[sp.Matrix, sp.Matrix]:
    """Return N_0 and N_1 of diag(s^2 + kx s + kg, s^2 + kb s + wb^2) in bank and sideslip,
    which the air couples one way."""
    _, _, inertia, turn = capsule()
    kx, kg, kb, q, mx, my = sp.symbols("kx kg kb q mx my", real=True)
    driven = turn * inertia.inv() * sp.Matrix([q * mx, q * my])  # accelerations of bank and sideslip by sideslip
    change = inertia * turn.T
    lower = sp.Matrix([[kg, -driven[0]], [0, -driven[1]]])
    return change * lower * change.inv(), change * sp.diag(kx, kb) * change.inv()


@pytest.mark.parametrize("method", either(["ackermann", "bass_gura"], ["ackermann"]))
def test_the_robust_law_of_the_capsule_is_the_one_that_its_page_prints(method: str) -> None:
    """x1 = -kx gd - kg e, x2 = -kb bd, u = J (c0 x1 + s0 x2, -s0 x1 + c0 x2): no sideslip, no pressure."""
    a, b, inertia, _ = capsule()
    actual = modal.symbolic_gain(a, b, robust_polynomial(), method=method)
    kx, kg, kb, a0 = sp.symbols("kx kg kb a0", real=True)
    e, slip, wx, wy = sp.symbols("e b wx wy")
    c0, s0 = sp.cos(a0), sp.sin(a0)
    x1 = -kx * (wx * c0 - wy * s0) - kg * e
    x2 = -kb * (wx * s0 + wy * c0)
    printed = inertia * sp.Matrix([c0 * x1 + s0 * x2, -s0 * x1 + c0 * x2])
    assert vanishes(-actual.gain * sp.Matrix([e, slip, wx, wy]) - printed, a0)
    assert actual.names == ["a0", "jx", "jxy", "jy", "kb", "kg", "kx"]
    if method == "ackermann":
        check_the_robust_law_in_numbers(actual, a, b)


def check_the_robust_law_in_numbers(formula: modal.SymbolicGain, a: sp.Matrix, b: sp.Matrix) -> None:
    """Compare with the numeric Ackermann formula at any pressure, and the page's gains and N_1."""
    random = np.random.default_rng(62)
    n0, n1 = robust_polynomial()
    page = {"jx": 1400.0, "jy": 1250.0, "jxy": -40.0, "a0": np.radians(-20.0), "mx": 0.0527, "my": -1.061}
    page |= {"kx": 1.0, "kg": 0.25, "kb": 0.3, "q": 1147.0}
    for _ in range(COUNT):
        values = {name: value * random.uniform(0.5, 2.0) for name, value in page.items()}
        coefficients = [numbers(n, values) for n in (n0, n1)]
        numeric = modal.place_polynomial(numbers(a, values), numbers(b, values), coefficients).gain
        np.testing.assert_allclose(formula.at(values), numeric, rtol=0.0, atol=1e-11 * np.abs(numeric).max())
    expected = [[-325.472, 0.0, -1276.363, -299.691], [-97.484, 0.0, -244.495, -468.357]]
    np.testing.assert_allclose(-formula.at(page), expected, atol=6e-4)
    np.testing.assert_allclose(numbers(n1, page), [[0.9194, 0.2692], [0.1855, 0.3806]], atol=6e-5)


def test_the_yaw_observer_by_the_automated_algorithm() -> None:
    """L = (A + mu)(C' + ey l), l = (-lambda/w0, 0, 0, 0, 0): levels of five and one, multiples of I."""
    slow, fast = sp.symbols("lambda_ mu", positive=True)
    a, *_ = orbit(sp.diag(*sp.symbols("jx jy jz", positive=True)))
    c = EYE6[[0, 2, 3, 4, 5], :]
    actual = modal.symbolic_observer(a, c, [-fast * sp.eye(5), [[-slow]]])
    expected = (a + fast * EYE6) * (c.T + EYE6[:, 1] * sp.Matrix([[-slow / W0, 0, 0, 0, 0]]))
    assert sp.simplify(actual.gain - expected) == sp.zeros(6, 5)
    assert actual.letter == "L"
    random = np.random.default_rng(63)
    base = {"jx": 6500.0, "jy": 30000.0, "jz": 29000.0, "w0": 0.0011, "lambda_": 0.1, "mu": 1.0}
    for _ in range(COUNT):
        values = {name: value * random.uniform(0.5, 2.0) for name, value in base.items()}
        levels = [-values["mu"] * np.eye(5), [[-values["lambda_"]]]]
        numeric = modal.place_levels(numbers(a, values).T, numbers(c, values).T, levels).gain.T
        np.testing.assert_allclose(actual.at(values), numeric, rtol=0.0, atol=1e-10 * np.abs(numeric).max())


@pytest.mark.parametrize("method", ["multilevel", "ackermann", "bass_gura"])
def test_poles_that_are_symbols_on_a_plant_of_symbols(method: str) -> None:
    """Two inputs of five or four states: the closed loop's characteristic polynomial is the product of s - pole."""
    states = 5 if method == "multilevel" else 4
    k, d, m = sp.symbols("k d m", positive=True)
    a = sp.zeros(states, states)
    a[0, 2] = a[1, 3] = 1
    a[2, :4] = sp.Matrix([[-2 * k / m, k / m, -d, 0]])
    a[3, :4] = sp.Matrix([[k / m, -k / m, 0, 0]])
    b = sp.zeros(states, 2)
    b[2, 0] = 1 / m
    b[3, 1] = 1
    if states == 5:
        a[4, 0] = 1  # the integral of a position
    poles, s = list(sp.symbols(f"z1:{states + 1}", real=True)), sp.Symbol("s")
    poles[1] = poles[0]  # of multiplicity 2
    actual = modal.symbolic_gain(a, b, poles, method=method)
    characteristic = actual.closed_loop.charpoly(s).as_expr()
    assert sp.expand(sp.simplify(characteristic - sp.prod([s - pole for pole in poles]))) == 0


def test_decimals_are_exact() -> None:
    actual = modal.symbolic_gain([[0.0, 1.0], [0.0, 0.0]], [[0.0], [0.1]], [-0.1, -0.2], method="ackermann")
    assert actual.gain == sp.Matrix([[sp.Rational(1, 5), 3]])
    assert actual.latex() == r"K = \left[\begin{matrix}\frac{1}{5} & 3\end{matrix}\right]"


X = sp.Symbol("x", real=True)


@pytest.mark.parametrize(
    ("a", "b", "required", "options", "message"),
    [
        ([[1, 0], [0, X]], [[1], [0]], [-1, -2], {}, "no input drives level"),
        ([[1, 0], [0, X]], [[1], [0]], [-1, -2], {"method": "ackermann"}, "has rank 1, but the plant has 2 states"),
        ([[0, X], [0, 0]], [[0], [1]], [-1], {}, "1 poles"),
        ([[0, X], [0, 0]], [[0], [1]], [-1 + sp.I, -1 - sp.I], {}, "not real"),
        ([[0, X], [0, 0]], [[0], [1]], [-1, -2], {"method": "acker"}, "unknown"),
        ([[0, X], [0, 0]], [[0], [1]], [-1, -2], {"method": "ackermann", "bases": []}, "has no such option"),
        (
            [[0, X], [0, 0]],
            [[0], [1]],
            [-1, -2],
            {"bases": [[[1], [0]], [[0], [1]]]},
            "directions that the inputs drive",
        ),
        ([[0, X], [0, 0]], [[0], [1]], [[[-1]]], {}, "1 matrices"),
        ([[0, X]], [[0], [1]], [-1, -2], {}, "has 2 columns"),
    ],
)
def test_refusals(a: list, b: list, required: list, options: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        modal.symbolic_gain(a, b, required, **options)


def test_arrays_are_taken_too() -> None:
    """Arrays of floats, and of numpy's numbers."""
    actual = modal.symbolic_gain(
        np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]]), list(np.array([-1.0, -2.0]))
    )
    assert actual.at({}).tolist() == [[2.0, 3.0]]


def test_without_sympy_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    algebra.sympy.cache_clear()
    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(ValueError, match="which is not installed; pip install 'perilune"):
        modal.symbolic_gain([[0, 1], [0, 0]], [[0], [1]], [-1, -2])
    algebra.sympy.cache_clear()


def test_a_symbol_without_a_value_is_named() -> None:
    formula = modal.symbolic_gain([[0, X], [0, 0]], [[0], [1]], [-1, -2])
    with pytest.raises(ValueError, match="x has no value"):
        formula.at({})
