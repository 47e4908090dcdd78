"""Functions in an OspSystemStructure.xml, which are all linear, with their inputs and outputs.

libcosim evaluates them at every communication point, after outputs are read and before inputs are set.
"""

from __future__ import annotations

from dataclasses import dataclass

from lxml import etree

from ..conversions import IDENTITY, Transformation
from ..documents import tag

Point = tuple[str, str]  # simulator and variable
IN, OUT = "in", "out"
MOST_INPUTS = 10_000


class FunctionError(Exception):
    """Error in a function, with its remedy."""

    def __init__(self, problem: str, remedy: str) -> None:
        super().__init__(problem, remedy)
        self.problem, self.remedy = problem, remedy


@dataclass
class TransformedSum:
    """Sum of transformed inputs. Each signal has ``dimension`` variables; an input is None until it is connected."""

    name: str
    dimension: int
    transformation: Transformation
    inputs: dict[str, list[Point] | None]

    def connect_input(self, signal: str, points: list[Point]) -> None:
        """Connect an input to the variables that drive it. Raises FunctionError."""
        if signal not in self.inputs:
            raise FunctionError(f"{self.name} has no signal {signal}", f"use {', '.join(self.inputs)} or {OUT}")
        if self.inputs[signal] is not None:
            raise FunctionError(f"a second connection to {signal} of {self.name}", "remove one of the two")
        self.inputs[signal] = self._check(points)

    def connect_output(self, points: list[Point]) -> list[tuple[Point, list[Point]]]:
        """Return the variables to which the output is connected, each with its summands. Raises FunctionError."""
        sources = []
        for signal, connected in self.inputs.items():
            if connected is None:
                raise FunctionError(f"nothing is connected to {signal} of {self.name}", "connect a variable to it")
            sources.append(connected)
        return list(zip(self._check(points), map(list, zip(*sources, strict=True)), strict=True))

    def _check(self, points: list[Point]) -> list[Point]:
        if len(points) != self.dimension:
            problem = f"a signal of {self.name} has {self.dimension} elements, not {len(points)}"
            raise FunctionError(problem, "connect one variable for each element of the signal")
        return points


def read_function(element: etree._Element) -> TransformedSum:
    """Return a function of a kind that libcosim supports: LinearTransformation, Sum or VectorSum.

    Raises FunctionError.
    """
    name, kind = element.get("name", ""), tag(element)
    if kind == "LinearTransformation":
        gain = Transformation(_number(element, "factor", "1"), _number(element, "offset", "0"))
        return TransformedSum(name, 1, gain, {IN: None})
    if kind not in ("Sum", "VectorSum"):
        raise FunctionError("functions of this kind are not supported", "replace the function by an FMU")
    inputs = {f"{IN}[{index}]": None for index in range(_count(element, "inputCount"))}
    return TransformedSum(name, _count(element, "dimension") if kind == "VectorSum" else 1, IDENTITY, {**inputs})


def _number(element: etree._Element, attribute: str, default: str) -> float:
    text = element.get(attribute, default)
    try:
        return float(text)
    except ValueError:
        raise FunctionError(f"{attribute} {text!r} is not a number", "write a number") from None


def _count(element: etree._Element, attribute: str) -> int:
    text = element.get(attribute, "1")
    if not (text.isascii() and text.isdigit() and 0 < len(text) < 6 and 0 < int(text) <= MOST_INPUTS):
        raise FunctionError(
            f"{attribute} {text!r} is not a number from 1 to {MOST_INPUTS}", "write a number in this range"
        )
    return int(text)
