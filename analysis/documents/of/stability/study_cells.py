"""Cells of a stability study: dB and degrees, infinite margins, verdicts.

No cell is "inf" or "nan": an infinite margin has no crossing, an unstable loop has no margins, and any other non-finite
number is a dash.
"""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np

from ....stability.loops.margin_values import UNSTABLE, LoopMargins
from ....stability.loops.readings import decibel_size, decibels, degree_size
from ....stability.results.report import JointReport, LoopReport, StabilityStudy
from ....stability.results.requirement import MarginRequirement, MarginVerdict
from ...cell import Cell, DisplayedNumber, Head, Inline, Link, Phrase, Quantity, Rich, Strong, VerdictCell
from ...common.quantities import MINUS, NONE, display_unit, number
from ...model import Fold, Node, Table

NO_CROSSING = "none (no crossing)"
UNSTABLE_WORD = "unstable"
SIGNS = {
    MarginVerdict.PASS: "✓",
    MarginVerdict.FAIL: "✗",
    MarginVerdict.WITHHELD: "?",
    MarginVerdict.NOT_APPLICABLE: NONE,
}
GRADES: dict[MarginVerdict, Literal["pass", "fail", "withheld", "not-applicable"]] = {
    MarginVerdict.PASS: "pass",
    MarginVerdict.FAIL: "fail",
    MarginVerdict.WITHHELD: "withheld",
    MarginVerdict.NOT_APPLICABLE: "not-applicable",
}
LONG = 30  # rows; longer tables are folded


def names(*texts: str) -> list[Head]:
    """Return heads of columns of names, which stay on one line."""
    return [Head(text, column="names") for text in texts]


def numbers(*texts: str) -> list[Head]:
    """Return heads of columns of numbers, with words in some cells."""
    return [Head(text, column="numbers") for text in texts]


def sentences(*texts: str) -> list[Head]:
    """Return heads of columns of sentences."""
    return [Head(text, column="sentences") for text in texts]


def fold_long(table: Table, rows: str) -> Node:
    """Return a table, folded if it is long; ``rows`` is a noun for its rows."""
    return Fold(f"All {len(table.rows)} {rows}", [table]) if len(table.rows) > LONG else table


def _display(exact: float | complex, displayed: float, digits: int, infinite: str) -> DisplayedNumber | str:
    if math.isinf(displayed):
        return infinite
    return NONE if math.isnan(displayed) else DisplayedNumber(number(displayed, digits), exact)


def numeral(value: Any, unit: str | None = None, digits: int = 4, infinite: str = NONE) -> Quantity | str:
    """Return a number as a cell in the displayed unit (degrees for radians), without the unit."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return infinite if math.isinf(value) else NONE
    return value if isinstance(value, str) else Quantity(value, unit, digits, is_bare=True)


def anchor(index: int) -> str:
    """Return the anchor of a loop's article, a number because names may contain other characters."""
    return f"loop-{index + 1}"


def link(report: StabilityStudy, subject: LoopReport | JointReport) -> Link | str:
    """Return the name of a loop with a link to its article, or of channels, which have no article."""
    index = next((index for index, loop in enumerate(report.loops) if loop is subject), None)
    return subject.name if index is None else Link(subject.name, anchor(index))


def in_decibels(factor: float | None, infinite: str = NO_CROSSING, *, absolute: bool = False) -> Inline:
    """Return a factor in dB, without the unit; with ``absolute`` its distance from 1 in either direction."""
    if factor is None:
        return numeral(None)
    displayed = decibel_size(factor) if absolute else decibels(float(factor))
    return _display(float(factor), displayed, 4, infinite)


def in_degrees(angle: float | None, infinite: str = NO_CROSSING) -> Quantity | str:
    """Return an angle in degrees, without the unit."""
    return numeral(None) if angle is None else numeral(float(angle), "rad", infinite=infinite)


def per_cent(value: float | None) -> Inline:
    """Return a relative change in per cent."""
    return numeral(None) if value is None else _display(float(value), 100.0 * float(value), 3, NONE)


def complex_number(value: complex, digits: int = 4) -> Inline:
    """Return a complex number in Cartesian form; the upper pole of a conjugate pair stands for both, with ±."""
    value = complex(value)
    if not (math.isfinite(value.real) and math.isfinite(value.imag)):
        return numeral(None)
    displayed = number(value.real, digits)
    if value.imag:
        displayed += f" {'±' if value.imag > 0.0 else MINUS} {number(abs(value.imag), digits)} j"
    return DisplayedNumber(displayed, value)


def omission_text(part: str, reason: str, loop: LoopReport) -> Rich:
    """Return why a part of a loop's study is missing; without a count of encirclements also how stability is judged."""
    if part != "encirclements" or loop.classical.encirclements is not None:
        return f"{part} is not applicable: {reason}"
    words = f"Encirclements of {MINUS}1 are not counted: {reason}"
    if loop.stable is None:
        return words
    judged = f"The verdict does not rest on the count: the closed loop is {text_of_closed_loop(loop.stable)}"
    return [f"{words}. {judged} by its poles, largest |z| ", numeral(loop.margins.largest, digits=6)]


def mode_numbers(z: complex, s: complex, damping: float, frequency: float) -> tuple[Cell, Cell, Cell]:
    """Return s (rad/s), damping and frequency (rad/s) of a closed-loop pole z; dashes where they are meaningless.

    For real negative z, ln(z)/T has an imaginary part, half the sampling frequency, but no conjugate: it is a single
    pole that changes sign with every sample. At z = 0 there is no logarithm.
    """
    if z.imag == 0.0 and z.real <= 0.0:
        return numeral(None), numeral(None), numeral(None)
    return complex_number(s), numeral(damping, digits=3), numeral(frequency)


def state(margins: LoopMargins) -> Strong | None:
    """Return the word that replaces the margins of an unstable loop; None for others."""
    return Strong(UNSTABLE_WORD) if margins.unstable else None


def gain_margin(margins: LoopMargins) -> Cell:
    """Return a gain margin in dB with its direction."""
    if margins.unstable or not math.isfinite(margins.gain):
        return state(margins) or NO_CROSSING
    direction = "upper" if margins.gain >= 1.0 else "lower"
    return Phrase([in_decibels(margins.gain, absolute=True), f" ({direction})"])


def phase_margin(margins: LoopMargins) -> Cell:
    """Return a phase margin in degrees; a lead is marked."""
    if margins.unstable or not math.isfinite(margins.phase):
        return state(margins) or NO_CROSSING
    displayed = _display(float(margins.phase), degree_size(margins.phase), 4, NO_CROSSING)
    return displayed if margins.phase >= 0.0 else Phrase([displayed, " (lead)"])


def size(value: float | None) -> Inline:
    """Return a margin in its unit: a number, "unstable", or "no crossing"."""
    return Strong(UNSTABLE_WORD) if value == UNSTABLE else numeral(value, infinite=NO_CROSSING)


def samples(delay: float, period: float) -> Quantity | str:
    """Return a delay in sample periods."""
    return numeral(float(delay) / period, infinite=NO_CROSSING)


def verdict(word: MarginVerdict) -> VerdictCell:
    """Return a verdict with its symbol and colour."""
    return VerdictCell(f"{SIGNS[word]} {word}", GRADES[word])


def text_of_closed_loop(stable: bool | None) -> str:
    """Return the stability of the closed loop in a word or two."""
    return {True: "stable", False: "unstable", None: "not known"}[None if stable is None else bool(stable)]


def crossing_text(requirement: MarginRequirement) -> Inline | Phrase:
    """Return the value of a requirement with its unit."""
    value = requirement.value
    is_number = value is not None and math.isfinite(value)
    return _with_unit(size(value), requirement.unit if is_number else "1")


def limit(requirement: MarginRequirement) -> Inline | Phrase:
    """Return the limit of a requirement with its unit."""
    return _with_unit(numeral(float(requirement.limit)), requirement.unit)


def _with_unit(cell: Inline, unit: str) -> Inline | Phrase:
    displayed = display_unit(unit)
    return Phrase([cell, f" {displayed}"]) if displayed else cell
