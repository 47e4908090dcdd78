"""The polynomials of the elementary functions, derived from the functions themselves.

Each is the minimax polynomial of a function's remainder behind its first terms, by Remez' exchange (1934) in 60 digits,
weighted so that the error is that of the function's result. `make coefficients` prints them as they stand in
`fmus_src/kernel/elementary`; a test compares.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mpmath import lu_solve, matrix, mp, mpf

Function = Callable[[mpf], mpf]
DIGITS = 60
EXCHANGES = 12


@dataclass(frozen=True)
class Approximation:
    """A polynomial of ``terms`` coefficients for ``function`` on ``interval``, its errors weighted by ``weight``."""

    name: str
    function: Function
    interval: tuple[str, str]
    terms: int
    weight: Function

    def derive(self) -> list[float]:
        """Return the coefficients, constant term first, each rounded to a double."""
        with mp.workdps(DIGITS):
            return [float(value) for value in _remez(self)]

    def worst_error(self, coefficients: list[float], points: int = 400) -> float:
        """Return largest weighted error of rounded coefficients."""
        with mp.workdps(DIGITS):
            low, high = (mp.mpmathify(end) for end in self.interval)
            arguments = [low + (high - low) * (k + 0.5) / points for k in range(points)]
            errors = [mp.polyval(coefficients, x, asc=True) - self.function(x) for x in arguments]
            return float(max(abs(self.weight(x) * error) for x, error in zip(arguments, errors, strict=True)))


def _remez(case: Approximation) -> list[mpf]:
    low, high = (mp.mpmathify(end) for end in case.interval)
    count = case.terms + 1
    nodes = [(low + high) / 2 - (high - low) / 2 * mp.cos(mp.pi * (k + mpf(1) / 2) / count) for k in range(count)]
    grid = [low + (high - low) * (1 - mp.cos(mp.pi * (k + mpf(1) / 2) / (40 * count))) / 2 for k in range(40 * count)]
    exact = [case.function(x) for x in grid]
    weights = [case.weight(x) for x in grid]
    solution: list[mpf] = []
    for _ in range(EXCHANGES):
        system = matrix(count, count)
        for row, x in enumerate(nodes):
            for column in range(case.terms):
                system[row, column] = x**column
            system[row, case.terms] = (-1) ** row / case.weight(x)
        solution = list(lu_solve(system, matrix([case.function(x) for x in nodes])))[: case.terms]
        errors = [w * (mp.polyval(solution, x, asc=True) - y) for x, y, w in zip(grid, exact, weights, strict=True)]
        nodes = _extremes(grid, errors, count)
    return solution


def _extremes(grid: list[mpf], errors: list[mpf], count: int) -> list[mpf]:
    """Return the points of largest error between its changes of sign."""
    best: list[int] = []
    for k, error in enumerate(errors):
        if best and error * errors[best[-1]] > 0:
            if abs(error) > abs(errors[best[-1]]):
                best[-1] = k
        else:
            best.append(k)
    while len(best) > count:  # one too many at an end
        del best[0 if abs(errors[best[0]]) < abs(errors[best[-1]]) else -1]
    if len(best) < count:
        raise ArithmeticError("the error of a polynomial alternates too rarely: fewer terms reach the digits")
    return [grid[k] for k in best]


def _square(function: Function) -> Function:
    """Return a function of x as one of x^2."""
    return lambda z: function(mp.sqrt(z))


def _exp_remainder(r: mpf) -> mpf:
    return mp.hyp1f1(1, 4, r) / 6  # (exp(r) - 1 - r - r^2/2)/r^3


def _log_remainder(s: mpf) -> mpf:
    return 2 * (mp.atanh(s) - s) / s**3


def _log_tail(s: mpf) -> mpf:
    return (mp.atanh(s) - s - s**3 / 3) / s**5


def _scaled_complement(t: mpf) -> mpf:
    z = mpf(15) / 4 * (1 + t) / (1 - t)
    return (1 + 2 * z) * mp.exp(z * z) * mp.erfc(z)


QUARTER_TURN = "0.6168502750680849136771556874922594459571"  # (pi/4)^2
LN2_HALF = "0.34657359027997265470861606072908828"
LOG_SPAN = "0.0294372515228594143797353094836"  # ((sqrt(2) - 1)/(sqrt(2) + 1))^2
TINY = "1e-12"  # the end of an interval where a quotient would be 0/0

APPROXIMATIONS = (
    Approximation("SIN", _square(lambda x: (mp.sin(x) - x) / x**3), (TINY, QUARTER_TURN), 6, lambda z: z),
    Approximation("COS", _square(lambda x: (mp.cos(x) - 1 + x**2 / 2) / x**4), (TINY, QUARTER_TURN), 6, lambda z: z**2),
    Approximation("EXP", _exp_remainder, (f"-{LN2_HALF}", LN2_HALF), 9, lambda r: abs(r**3) + mpf(10) ** -6),
    Approximation("LOG", _square(_log_remainder), (TINY, LOG_SPAN), 7, lambda z: z),
    Approximation("LOG_TAIL", _square(_log_tail), (TINY, LOG_SPAN), 7, lambda z: z * z + mpf(10) ** -6),
    Approximation("ATAN", _square(lambda x: (mp.atan(x) - x) / x**3), (TINY, "0.19140625"), 11, lambda z: z),
    Approximation("ASIN", _square(lambda x: (mp.asin(x) - x) / x**3), (TINY, "0.25"), 12, lambda z: z),
    Approximation("SINH", _square(lambda x: (mp.sinh(x) - x) / x**3), (TINY, "1"), 8, lambda z: z),
    Approximation("COSH", _square(lambda x: (mp.cosh(x) - 1 - x**2 / 2) / x**4), (TINY, "1"), 7, lambda z: z**2),
    Approximation("TAIL", _scaled_complement, ("-1", "0.761"), 24, lambda t: 1 / _scaled_complement(t)),
    Approximation("CBRT", mp.cbrt, ("0.5", "1"), 5, lambda m: 1 / mp.cbrt(m)),
)

if __name__ == "__main__":
    for approximation in APPROXIMATIONS:
        derived = approximation.derive()
        print(f"# {approximation.name}: weighted error at most {approximation.worst_error(derived):.1e}")
        for number, value in enumerate(derived):
            print(f"{approximation.name}_{number} = {value!r}")
