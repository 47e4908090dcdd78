"""How a stability page words its values: dB and degrees, what is infinite, what could not be had, verdicts.

The exact SI value (a factor, rad, s) stands in the markup's ``value``, as everywhere on our pages. Nothing is
ever shown as "inf" or "nan": an infinite margin has no crossing, an unstable loop has no margins and says so,
anything else that is not finite is a dash.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from markupsafe import Markup

from ...stability.loops.margin_values import UNSTABLE, Margins
from ...stability.loops.readings import decibel_size, decibels, degree_size
from ...stability.results.report import LoopReport
from ...stability.results.requirement import Requirement, Verdict
from ..common.page import exact, with_exact
from ..common.quantities import MINUS, NONE, display_unit, number

NO_CROSSING = "none (no crossing)"
UNSTABLE_WORD = "unstable"
SIGNS = {Verdict.PASS: "✓", Verdict.FAIL: "✗", Verdict.WITHHELD: "?", Verdict.NOT_APPLICABLE: NONE}


def _data(value: float, shown: float, digits: int, infinite: str) -> Markup:
    if math.isinf(shown):
        return Markup("<span>{}</span>").format(infinite)
    if math.isnan(shown):
        return Markup("<span>{}</span>").format(NONE)
    return with_exact(repr(value), number(shown, digits))


def numeral(value: Any, unit: str | None = None, digits: int = 4, infinite: str = NONE) -> Markup:
    """A number in the unit that is shown (degrees for radians), without the unit."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return _data(value, value, digits, infinite)
    return exact(value, unit, digits)


def in_decibels(factor: float | None, infinite: str = NO_CROSSING, *, absolute: bool = False) -> Markup:
    """A factor in dB, without the unit; ``absolute``: how far from 1, up or down."""
    if factor is None:
        return numeral(None)
    displayed = decibel_size(factor) if absolute else decibels(float(factor))
    return _data(float(factor), displayed, 4, infinite)


def in_degrees(angle: float | None, infinite: str = NO_CROSSING) -> Markup:
    """An angle in degrees, without the unit."""
    return numeral(None) if angle is None else numeral(float(angle), "rad", infinite=infinite)


def per_cent(value: float | None) -> Markup:
    """A relative change in per cent."""
    return numeral(None) if value is None else _data(float(value), 100.0 * float(value), 3, NONE)


def complex_number(value: complex, digits: int = 4) -> Markup:
    """A complex number in Cartesian form; of a pair with its conjugate only the upper one is ever shown, with ±."""
    value = complex(value)
    if not (math.isfinite(value.real) and math.isfinite(value.imag)):
        return Markup("<span>{}</span>").format(NONE)
    displayed = number(value.real, digits)
    if value.imag:
        displayed += f" {'±' if value.imag > 0.0 else MINUS} {number(abs(value.imag), digits)} j"
    return with_exact(repr(value).strip("()"), displayed)


def left_out(part: str, reason: str, loop: LoopReport) -> Markup:
    """Why a part of a loop's study could not be had; without a count of encirclements, what judges stability."""
    if part != "encirclements" or loop.classical.encirclements is not None:
        return Markup("{} is not applicable: {}").format(part, reason)
    words = Markup("Encirclements of {}1 are not counted: {}.").format(MINUS, reason)
    if loop.stable is None:
        return words
    return words + Markup(
        " The verdict does not rest on the count: the closed loop is {} by its poles, largest |z| {}."
    ).format(text_of_closed_loop(loop.stable), numeral(loop.margins.largest, digits=6))


def mode_numbers(z: complex, s: complex, damping: float, frequency: float) -> tuple[Markup, Markup, Markup]:
    """s (rad/s), damping and frequency (rad/s) of a closed-loop pole z; dashes where they mean nothing.

    ln(z)/T of a real z below 0 has an imaginary part, that of half the sampling rate, and no conjugate: there is one
    pole, which changes its sign with every sample. At z = 0 there is no logarithm.
    """
    if z.imag == 0.0 and z.real <= 0.0:
        return numeral(None), numeral(None), numeral(None)
    return complex_number(s), numeral(damping, digits=3), numeral(frequency)


def state(margins: Margins) -> Markup | None:
    """What stands in the place of margins that an unstable loop has not."""
    return Markup("<b>{}</b>").format(UNSTABLE_WORD) if margins.unstable else None


def gain_margin(margins: Margins) -> Markup:
    """A gain margin in dB with its direction."""
    if margins.unstable or not math.isfinite(margins.gain):
        return state(margins) or Markup("<span>{}</span>").format(NO_CROSSING)
    direction = "upper" if margins.gain >= 1.0 else "lower"
    return in_decibels(margins.gain, absolute=True) + Markup(" ({})").format(direction)


def phase_margin(margins: Margins) -> Markup:
    """A phase margin in degrees; a lead is said to be one."""
    if margins.unstable or not math.isfinite(margins.phase):
        return state(margins) or Markup("<span>{}</span>").format(NO_CROSSING)
    displayed = _data(float(margins.phase), degree_size(margins.phase), 4, NO_CROSSING)
    return displayed + Markup("" if margins.phase >= 0.0 else " (lead)")


def size(value: float | None) -> Markup:
    """The size of a margin in its unit: a number, unstable, or without a crossing."""
    if value == UNSTABLE:
        return Markup("<b>{}</b>").format(UNSTABLE_WORD)
    return numeral(value, infinite=NO_CROSSING)


def samples(delay: float, period: float) -> Markup:
    """A delay in sample periods."""
    return numeral(float(delay) / period, infinite=NO_CROSSING)


def verdict(word: Verdict) -> Markup:
    """Pass, fail, withheld or not applicable: a word, a sign and a colour."""
    return Markup('<span class="verdict {}">{} {}</span>').format(word.replace(" ", "-"), SIGNS[word], word)


def text_of_closed_loop(stable: bool | None) -> str:
    """Whether the closed loop is stable, in a word or two."""
    return {True: "stable", False: "unstable", None: "not known"}[None if stable is None else bool(stable)]


def crossing_text(requirement: Requirement) -> Markup:
    """The value of a requirement with its unit."""
    value = requirement.value
    return size(value) + (_unit(requirement.unit) if value is not None and math.isfinite(value) else Markup(""))


def limit(requirement: Requirement) -> Markup:
    """The limit of a requirement with its unit."""
    return numeral(float(requirement.limit)) + _unit(requirement.unit)


def _unit(unit: str) -> Markup:
    displayed = unit if unit in ("dB", "deg") else display_unit(unit)
    return Markup(" {}").format(displayed) if displayed else Markup("")
