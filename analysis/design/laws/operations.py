"""How the operations of a network operator are written, in formulas and on the edges of a drawing."""

from __future__ import annotations

from typing import NamedTuple

from ...reports.common.quantities import MINUS

SUM, PRODUCT, MAXIMUM, MINIMUM = range(4)
IDENTITY, NEGATIVE, RECIPROCAL = 1, 3, 5


class Notation(NamedTuple):
    """``formula`` has {z} for the argument; ``edge`` is the short form for drawings.

    ``level`` says how tightly the formula binds: SUM_LEVEL, PRODUCT_LEVEL, POWER_LEVEL or ATOM; ``argument``
    how tightly an argument must bind to stand in it without parentheses.
    """

    formula: str
    edge: str
    level: int
    argument: int


SUM_LEVEL, PRODUCT_LEVEL, POWER_LEVEL, ATOM = range(4)

UNARY = {
    1: Notation("{z}", "", ATOM, SUM_LEVEL),
    2: Notation("{z}^2", "z²", POWER_LEVEL, ATOM),
    3: Notation("-{z}", f"{MINUS}z", SUM_LEVEL, PRODUCT_LEVEL),
    4: Notation("sgn({z})*sqrt(|{z}|)", "sgn z √|z|", PRODUCT_LEVEL, SUM_LEVEL),
    5: Notation("1/{z}", "1/z", PRODUCT_LEVEL, POWER_LEVEL),
    6: Notation("exp({z})", "exp", ATOM, SUM_LEVEL),
    7: Notation("ln(|{z}|)", "ln|z|", ATOM, SUM_LEVEL),
    8: Notation("(1 - exp(-{z}))/(1 + exp(-{z}))", f"(1{MINUS}e⁻ᶻ)/(1+e⁻ᶻ)", PRODUCT_LEVEL, PRODUCT_LEVEL),
    9: Notation("step({z})", "step", ATOM, SUM_LEVEL),
    10: Notation("sgn({z})", "sgn", ATOM, SUM_LEVEL),
    11: Notation("cos({z})", "cos", ATOM, SUM_LEVEL),
    12: Notation("sin({z})", "sin", ATOM, SUM_LEVEL),
    13: Notation("atan({z})", "atan", ATOM, SUM_LEVEL),
    14: Notation("{z}^3", "z³", POWER_LEVEL, ATOM),
    15: Notation("cbrt({z})", "∛z", ATOM, SUM_LEVEL),
    16: Notation("clip({z}, -1, 1)", "clip ±1", ATOM, SUM_LEVEL),
    17: Notation("sgn({z})*ln(|{z}| + 1)", "sgn z ln(|z|+1)", PRODUCT_LEVEL, SUM_LEVEL),
    18: Notation("sgn({z})*(exp(|{z}|) - 1)", f"sgn z (e^|z|{MINUS}1)", PRODUCT_LEVEL, SUM_LEVEL),
    19: Notation("sgn({z})*exp(-|{z}|)", f"sgn z e^{MINUS}|z|", PRODUCT_LEVEL, SUM_LEVEL),
    20: Notation("{z}/2", "z/2", PRODUCT_LEVEL, PRODUCT_LEVEL),
    21: Notation("2*{z}", "2z", PRODUCT_LEVEL, PRODUCT_LEVEL),
    23: Notation("{z} - {z}^3", f"z{MINUS}z³", SUM_LEVEL, ATOM),
}
BINARY = {SUM: "+", PRODUCT: "\N{MULTIPLICATION SIGN}", MAXIMUM: "max", MINIMUM: "min"}
