"""Gains in decibels and angles in degrees, as margins are shown and limited."""

from __future__ import annotations

from typing import overload

import numpy as np


@overload
def decibels(factor: complex) -> float: ...
@overload
def decibels(factor: np.ndarray) -> np.ndarray: ...
def decibels(factor: complex | np.ndarray) -> float | np.ndarray:
    """The size of a gain, real or complex, in dB; 0 is minus infinity."""
    with np.errstate(divide="ignore"):
        level = 20.0 * np.log10(np.abs(factor))
    return level if isinstance(factor, np.ndarray) else float(level)


def decibel_size(factor: float) -> float:
    """How far a factor on the gain is from 1, up or down, in dB."""
    return abs(decibels(factor))


def factor_of(decibel: float) -> float:
    """The factor that is ``decibel`` dB."""
    return float(10.0 ** (decibel / 20.0))


def degree_size(angle: float) -> float:
    """The size of an angle (rad), lag or lead, in deg."""
    return float(np.degrees(abs(angle)))
