"""Plotting area of a picture, and the conversion of data to positions in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...interactive.charts import Axis

EDGE = 0.05  # pt, tolerance of marks on an edge


def fraction(axis: Axis, numbers: np.ndarray) -> np.ndarray:
    """Return the positions of numbers on an axis: 0 at its first end, 1 at its second; NaN where undefined."""
    low, high = axis.ends
    if axis.logarithmic:
        low, high = np.log10(low), np.log10(high)
        numbers = np.log10(np.where(numbers > 0.0, numbers, np.nan))
    lying: np.ndarray = (numbers - low) / (high - low)
    return lying


@dataclass(frozen=True)
class Frame:
    """A plotting area (pt, from the upper left corner of the picture) with its axes."""

    x: Axis
    y: Axis
    left: float
    top: float
    width: float
    height: float

    @property
    def right(self) -> float:
        return self.left + self.width

    @property
    def bottom(self) -> float:
        return self.top + self.height

    def across(self, numbers: np.ndarray, *, of_axes: bool = False) -> np.ndarray:
        """Return the positions of abscissas; with ``of_axes`` they are fractions of the width, from the left."""
        position: np.ndarray = self.left + self.width * (numbers if of_axes else fraction(self.x, numbers))
        return position

    def down(self, numbers: np.ndarray, *, of_axes: bool = False) -> np.ndarray:
        """Return the positions of ordinates; with ``of_axes`` they are fractions of the height, from the bottom."""
        position: np.ndarray = self.top + self.height * (1.0 - (numbers if of_axes else fraction(self.y, numbers)))
        return position

    def point(self, at: tuple[float, float], of_axes: tuple[bool, bool] = (False, False)) -> tuple[float, float]:
        """Return the position of a point; ``of_axes`` tells which coordinates are fractions of the axes."""
        x, y = (np.array([each]) for each in at)
        return float(self.across(x, of_axes=of_axes[0])[0]), float(self.down(y, of_axes=of_axes[1])[0])

    def format_x(self, x: float) -> str:
        """Return an abscissa as text of an SVG attribute."""
        return f"{x:.2f}"

    def format_y(self, y: float) -> str:
        """Return an ordinate as text of an SVG attribute."""
        return f"{y:.2f}"

    def stretch(self, elements: str) -> str:
        """Return paths in coordinates of this frame, which are left unchanged."""
        return elements

    def repeat(self, element: str, positions: Sequence[tuple[float, float]]) -> str:
        """Return copies of an element, drawn about the origin, at these positions."""
        return "".join(f'<g transform="translate({x:g} {y:g})">{element}</g>' for x, y in positions)

    def contains(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return True for each position within the area or on its edge, [rows]."""
        inside: np.ndarray = (
            (x >= self.left - EDGE) & (x <= self.right + EDGE) & (y >= self.top - EDGE) & (y <= self.bottom + EDGE)
        )
        return inside
