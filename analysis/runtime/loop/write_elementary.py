"""Writer of the C code of the elementary functions of arrays, from the functions that FMUs contain."""

from __future__ import annotations

from collections.abc import Callable

from ....fmus_src.block import Block, Input, Output
from ....fmus_src.export.write.translate import translate_functions
from ....fmus_src.kernel import functions
from ....fmus_src.kernel.elementary.exponential import exp, exp2, expm1
from ....fmus_src.kernel.elementary.hyperbolic import cosh, sinh, tanh
from ....fmus_src.kernel.elementary.inverse import acos, asin, atan, atan2
from ....fmus_src.kernel.elementary.logarithm import log, log1p, log2, log10
from ....fmus_src.kernel.elementary.normal_distribution import normal_distribution, normal_quantile
from ....fmus_src.kernel.elementary.power import pow
from ....fmus_src.kernel.elementary.roots import cbrt, hypot
from ....fmus_src.kernel.elementary.trigonometric import cos, sin, tan

FUNCTIONS: dict[str, Callable] = {
    **{function.__name__: function for function in functions.FAULTS},
    **{function.__name__: function for function in (hypot, normal_distribution, normal_quantile)},
}
HEADER = """\
/* The elementary functions over arrays, translated from fmus_src/kernel/elementary. */
#include "kernel_math.h"

"""
OVER_ARRAYS = """\
EXPORT void perilune_{name}(int64_t count, {declared}, double *values)
{{
    for (int64_t i = 0; i < count; i++) values[i] = {called}({arguments});
}}
"""


class EveryFunction(Block):
    """Class that calls every elementary function, so that the translator collects them all."""

    x = Input(0.0, unit="1", description="first argument")
    y = Input(0.0, unit="1", description="second argument")
    value = Output(0.0, unit="1", description="sum of the values")

    def initialize(self) -> None:
        self.value = 0.0

    def step(self, t: float, h: float) -> None:
        x = self.x
        y = self.y
        self.value = sin(x) + cos(x) + tan(x) + asin(x) + acos(x) + atan(x) + atan2(x, y)
        self.value += exp(x) + exp2(x) + expm1(x) + log(x) + log2(x) + log10(x) + log1p(x) + pow(x, y)
        self.value += sinh(x) + cosh(x) + tanh(x) + cbrt(x) + hypot(x, y)
        self.value += normal_distribution(x) + normal_quantile(x)


def write_elementary() -> str:
    """Return the text of `elementary.c`, which `c/library.c` includes."""
    text, names = translate_functions(EveryFunction)
    loops = [_over_arrays(name, names[name]) for name in FUNCTIONS]
    return "\n".join([HEADER + text, *loops])


def _over_arrays(name: str, called: str) -> str:
    letters = ("x", "y")[: FUNCTIONS[name].__code__.co_argcount]
    declared = ", ".join(f"const double *{letter}" for letter in letters)
    return OVER_ARRAYS.format(
        name=name, declared=declared, called=called, arguments=", ".join(f"{a}[i]" for a in letters)
    )
