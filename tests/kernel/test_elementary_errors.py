"""Elementary functions: errors relative to mpmath; special values and faults compared with `math`.

Each function is tested with 10^4 arguments, by `make elementary` with 10^6.
"""

from __future__ import annotations

import math
import os
import statistics
import struct

import pytest
from mpmath import mp

from perilune.fmus_src.face import HOMES
from perilune.fmus_src.kernel import functions
from tests.kernel.arguments import DRAWS, edges, samples
from tests.support.lengths import either, generator

COUNT = int(os.environ.get("PERILUNE_ELEMENTARY_SAMPLES", either("10000", "4000")))
LARGEST, MEDIAN, CORRECTLY_ROUNDED = 1.0, 0.3, 0.8
REFERENCE = {"pow": mp.power, "log2": lambda x: mp.log(x, 2), "exp2": lambda x: mp.power(2, x)}
REFERENCE |= {"cbrt": lambda x: mp.sign(x) * mp.cbrt(abs(x))}


def error(value: float, exact: mp.mpf) -> float:
    """Return error in units of the last place of the exact result, of the smallest normal's below that."""
    exponent = max(mp.frexp(exact)[1] - 53, -1074)
    return float(abs(mp.ldexp(mp.mpf(value) - exact, -exponent)))


def test_what_is_declared_is_public_and_tested_here() -> None:
    declared = {function.__name__ for function in functions.FAULTS}
    assert declared == set(DRAWS) == set(HOMES["kernel.functions"]) - {"fmod"}


@pytest.mark.parametrize("name", DRAWS)
def test_errors_stay_below_one_unit_in_the_last_place(name: str) -> None:
    function, exact = getattr(functions, name), REFERENCE.get(name, getattr(mp, name, None))
    errors, worst = [], (0.0, ())
    with mp.workprec(180):
        for arguments in samples(name, COUNT, generator(name)):
            truth = exact(*map(mp.mpf, arguments))
            if not 2.0**-1075 < abs(truth) < 1.79e308:
                continue
            errors.append(error(function(*arguments), truth))
            worst = max(worst, (errors[-1], arguments))
    assert len(errors) > 0.7 * COUNT
    rounded = sum(each <= 0.5 for each in errors) / len(errors)
    print(f"{name}: largest {worst[0]:.3f} at {worst[1]}, median {statistics.median(errors):.3f}, exact {rounded:.3f}")
    assert worst[0] < LARGEST, worst
    assert statistics.median(errors) < MEDIAN
    assert rounded > CORRECTLY_ROUNDED


def outcome(function, arguments: tuple[float, ...]) -> object:
    """Return the result of a call, as bytes or an error's name and text."""
    try:
        value = function(*arguments)
    except (ValueError, OverflowError) as raised:
        return type(raised).__name__, str(raised).split(",")[0]
    return "nan" if math.isnan(value) else value


@pytest.mark.parametrize("name", DRAWS)
def test_special_values_and_faults_are_those_of_math(name: str) -> None:
    reference = getattr(math, name)
    for arguments in edges(name):
        mine, truth = outcome(getattr(functions, name), arguments), outcome(reference, arguments)
        if isinstance(truth, float) and math.isfinite(truth) and truth != 0.0:
            assert isinstance(mine, float), arguments
            assert math.isclose(mine, truth, rel_tol=4e-16, abs_tol=5e-324), (arguments, mine, truth)
        else:
            assert repr(mine) == repr(truth), (arguments, mine, truth)


@pytest.mark.parametrize("name", ["sin", "tan", "asin", "atan", "sinh", "tanh", "cbrt", "expm1", "log1p"])
def test_a_zero_keeps_its_sign(name: str) -> None:
    assert struct.pack("<d", getattr(functions, name)(-0.0)) == struct.pack("<d", -0.0)


def test_powers_of_two_and_ten_are_exact() -> None:
    assert all(functions.exp2(float(n)) == math.ldexp(1.0, n) for n in range(-1074, 1024))
    assert all(functions.log2(math.ldexp(1.0, n)) == n for n in range(-1074, 1024))
    assert all(functions.log10(float(10**n)) == n for n in range(23))
    assert all(functions.pow(float(n), 2.0) == float(n * n) for n in range(1000))
