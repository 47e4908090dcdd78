"""Block that calls every elementary function, with arguments of all magnitudes from its generator."""

from __future__ import annotations

import math

from perilune.fmus_src.block import Block, Output, State
from perilune.fmus_src.kernel.functions import (
    acos,
    asin,
    atan,
    atan2,
    cbrt,
    cos,
    cosh,
    exp,
    exp2,
    expm1,
    log,
    log1p,
    log2,
    log10,
    pow,
    sin,
    sinh,
    tan,
    tanh,
)

MODULUS = 2147483647.0  # Park and Miller's minimal standard generator, 1988, exact in doubles
FACTOR = 48271.0


class ElementaryFunctions(Block):
    """Values of all elementary functions, of a new argument in each step."""

    seed = State(1.0, description="of the generator")
    value = Output([0.0] * 19, unit="1", description="values")

    def initialize(self) -> None:
        self.seed = 20240607.0

    def step(self, t: float, h: float) -> None:
        u = self.draw()
        fine = self.draw()
        v = 2.0 * u - 1.0 + fine / MODULUS
        exponent = self.draw()
        wide = math.ldexp(v, int(600.0 * exponent) - 500)
        narrow = math.ldexp(v, int(-30.0 * fine))
        self.value[0] = sin(wide)
        self.value[1] = cos(wide)
        self.value[2] = tan(1e3 * narrow)
        self.value[3] = asin(narrow)
        self.value[4] = acos(narrow)
        self.value[5] = atan(wide)
        self.value[6] = atan2(narrow, v + 0.1 * u)
        self.value[7] = exp(700.0 * narrow)
        self.value[8] = exp2(1000.0 * narrow)
        self.value[9] = expm1(30.0 * narrow)
        self.value[10] = log(abs(wide) + 1e-300)
        self.value[11] = log2(u + 1e-300)
        self.value[12] = log10(1.0 + narrow * 0.5)
        self.value[13] = log1p(0.9 * narrow)
        self.value[14] = pow(u + 0.5, 100.0 * narrow)
        self.value[15] = sinh(20.0 * narrow)
        self.value[16] = cosh(20.0 * narrow)
        self.value[17] = tanh(20.0 * narrow)
        self.value[18] = cbrt(wide)

    def draw(self) -> float:
        """Draw a number in (0, 1)."""
        self.seed = math.fmod(FACTOR * self.seed, MODULUS)
        return self.seed / MODULUS
