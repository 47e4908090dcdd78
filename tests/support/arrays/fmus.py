"""FMUs of FMI 2.0 whose variables are elements of arrays, ``x[1]`` or ``x[2,1]``; and some of rare kinds.

`grid` and `grid_gain` are the same FMUs as `six` and `six_gain` with the names of a matrix of 2 x 3 in their
descriptions; `fixed` has a constant and `settled` a calculated parameter instead of an output.
"""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import fmpy

from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import retouched

SHAPE = (2, 3)
BLOCKS = '''
from perilune.fmus_src.block import Block, Input, Output, Parameter, State


class {name}(Block):
    """y rises by its number a second from start; count is a local variable."""

    start = Parameter({values}, unit="m", description="y at the start", vector=False)
    count = State(0, description="steps taken")
    y = Output({zeros}, unit="m", description="values that rise", vector=False)

    def initialize(self) -> None:
        for i in range({size}):
            self.y[i] = self.start[i]

    def step(self, t: float, h: float) -> None:
        self.count = self.count + 1
        for i in range({size}):
            self.y[i] = self.y[i] + (i + 1.0) * h


class {name}Gain(Block):
    """y = 2 u at the same time."""

    u = Input({zeros}, unit="m", description="values", vector=False)
    y = Output({zeros}, unit="m", direct=True, description="twice the values", vector=False)

    def initialize(self) -> None:
        for i in range({size}):
            self.y[i] = 2.0 * self.u[i]

    def step(self, t: float, h: float) -> None:
        for i in range({size}):
            self.y[i] = 2.0 * self.u[i]
'''
SINGLE = '''

class Counted(Block):
    """y = n at the same time; p is a whole number that is set."""

    p = Parameter(3, description="a whole number")
    n = Input(0, description="a whole number")
    y = Output(0, direct=True, description="n")

    def initialize(self) -> None:
        self.y = self.n

    def step(self, t: float, h: float) -> None:
        self.y = self.n


class Fixed(Block):
    """y is 7 throughout."""

    y = Output(7, description="seven")

    def initialize(self) -> None:
        self.y = 7

    def step(self, t: float, h: float) -> None:
        self.y = 7
'''


def build_array_fmus(folder: Path) -> None:
    """Build the native FMUs into ``folder``/native."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, size in (("Three", 3), ("Six", 6)):
        blocks = folder / f"{name.lower()}_blocks.py"
        values = tuple(float(number) for number in range(1, size + 1))
        text = BLOCKS.format(name=name, size=size, values=values, zeros=(0.0,) * size)
        blocks.write_text(text + (SINGLE if name == "Three" else ""))
        build_own_blocks(blocks, folder, ["native"], [fmpy.platform])
    native = folder / "native"
    for source, target in (("six", "grid"), ("six_gain", "grid_gain")):
        retouched(native / f"{source}.fmu", native / f"{target}.fmu", _as_matrix)
    retouched(native / "fixed.fmu", native / "settled.fmu", lambda text: _with_kind(text, "calculatedParameter"))
    retouched(native / "fixed.fmu", native / "constant.fmu", lambda text: _with_kind(text, "output"))


def _as_matrix(text: str) -> str:
    for number, index in enumerate(itertools.product(*(range(1, size + 1) for size in SHAPE)), 1):
        text = text.replace(f'[{number}]"', f'[{index[0]},{index[1]}]"')
    return text


def _with_kind(text: str, causality: str) -> str:
    """Declare the one output as a calculated parameter, or as a constant of 7."""
    text = re.sub(r"<ModelStructure>.*</ModelStructure>", "<ModelStructure/>", text, flags=re.DOTALL)
    if causality == "output":
        text = text.replace('variability="discrete" initial="calculated"', 'variability="constant" initial="exact"')
        return text.replace("<Integer/>", '<Integer start="7"/>')
    return text.replace('causality="output" variability="discrete"', f'causality="{causality}" variability="fixed"')
