"""The limits that a loop's diagrams show, and how they are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...stability.loops.margin_values import Quantity
from ...stability.results.report import LoopReport
from ..common.style import VERMILION

LIMIT: Any = {"color": VERMILION, "linewidth": 1.0, "linestyle": (0, (4, 2))}
FORBIDDEN = "#f6d5c0"  # fill of where a response or a margin must not be
BEHIND: Any = {"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.8}  # of words over a line


@dataclass(frozen=True)
class Limits:
    """The limits that figures show, as they are required of the loop; None: not required."""

    gain: float | None  # dB
    phase: float | None  # deg
    modulus: float | None


def limits_of(loop: LoopReport) -> Limits:
    """The limits among a loop's requirements."""
    limits = {item.quantity: item.limit for item in loop.requirements}
    return Limits(limits.get(Quantity.GAIN), limits.get(Quantity.PHASE), limits.get(Quantity.MODULUS))
