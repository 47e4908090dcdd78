"""Areas, rules and notes of charts: bands between curves, spans across the axes, levels and instants."""

from __future__ import annotations

import numpy as np

from ..common.colours import FAINT
from ..interactive.charts import Area, ChartNote, Rule
from ..interactive.measures import TICK_SIZE

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
CIRCLE_DASHES, DASH = 72, 2.0 / 3.0  # strokes of a circle, and the fraction of the circle that they cover
HATCHES = 8  # strokes in half a polygon


def band_areas(
    x: np.ndarray, low: np.ndarray, high: np.ndarray, colour: str, opacity: float, *, steps: bool = False
) -> list[Area]:
    """Return the areas between two ordinates, [rows], one for each run of rows in which both are finite.

    With ``steps`` ordinates hold until the next row.
    """
    finite = np.isfinite(low) & np.isfinite(high)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], finite, [False]]).astype(np.int8)))
    areas = []
    for first, end in zip(edges[::2], edges[1::2], strict=True):
        times, lower, upper = x[first:end], low[first:end], high[first:end]
        if steps:
            times, lower, upper = np.repeat(times, 2)[1:], np.repeat(lower, 2)[:-1], np.repeat(upper, 2)[:-1]
        around_x = np.concatenate([times[:1], times, times[-1:], times[::-1], times[:1]])
        around_y = np.concatenate([upper[:1], lower, upper[-1:], upper[::-1], upper[:1]])
        areas.append(Area(around_x, around_y, (False, False), colour.lower(), opacity, 0.0))
    return areas


def horizontal_band(low: float, high: float, colour: str, opacity: float) -> Area:
    """Return the area between two ordinates, across the full width of the axes."""
    return Area(SQUARE[:, 0], low + (high - low) * SQUARE[:, 1], (True, False), colour.lower(), opacity, 0.0)


def vertical_band(begin: float, end: float, colour: str, opacity: float) -> Area:
    """Return the area between two abscissas, across the full height of the axes."""
    return Area(begin + (end - begin) * SQUARE[:, 0], SQUARE[:, 1], (False, True), colour.lower(), opacity, 0.0)


def dashed_circle(radius: float, colour: str, width: float) -> Area:
    """Return a circle around the origin as `CIRCLE_DASHES` chords."""
    angle = 2.0 * np.pi / CIRCLE_DASHES * (np.arange(CIRCLE_DASHES)[:, np.newaxis] + [-DASH / 2.0, DASH / 2.0])
    x, y = radius * np.cos(angle.ravel()), radius * np.sin(angle.ravel())
    return Area(x, y, (False, False), colour.lower(), 1.0, width)


def rectangle(left: float, right: float, low: float, high: float, colour: str, opacity: float) -> Area:
    """Return a rectangle between two abscissas and two ordinates."""
    x, y = left + (right - left) * SQUARE[:, 0], low + (high - low) * SQUARE[:, 1]
    return Area(x, y, (False, False), colour.lower(), opacity, 0.0)


def outline(x: np.ndarray, y: np.ndarray, colour: str, width: float) -> Area:
    """Return strokes that join consecutive points, [rows]."""
    between = np.stack([x, y]).repeat(2, axis=1)[:, 1:-1]
    return Area(between[0], between[1], (False, False), colour.lower(), 1.0, width)


def hatch(x: np.ndarray, y: np.ndarray, colour: str, width: float) -> Area:
    """Return hatching of a closed convex polygon, [rows], parallel to a diagonal of its bounding box."""
    low, size = np.array([x.min(), y.min()]), np.array([np.ptp(x), np.ptp(y)])
    corners = (np.stack([x, y], axis=1) - low) / size
    offsets = corners[:, 1] - corners[:, 0]  # offsets of parallels through the corners
    ends = []
    for offset in np.arange(1, 2 * HATCHES) / HATCHES - 1.0:
        edges = np.flatnonzero((offsets[:-1] - offset) * (offsets[1:] - offset) < 0.0)
        ratio = ((offset - offsets[edges]) / (offsets[edges + 1] - offsets[edges]))[:, np.newaxis]
        ends += [*(corners[edges] + ratio * (corners[edges + 1] - corners[edges]))] if edges.size == 2 else []
    placed = low + size * np.array(ends)
    return Area(placed[:, 0], placed[:, 1], (False, False), colour.lower(), 1.0, width)


def horizontal_line(at: float, colour: str, width: float, dashes: tuple[float, ...] = ()) -> Rule:
    """Return a horizontal line across the axes at an ordinate; dashes are in multiples of its width."""
    return Rule(at=at, colour=colour.lower(), width=width, dashes=dashes)


def vertical_line(at: float, colour: str, width: float, dashes: tuple[float, ...] = ()) -> Rule:
    """Return a vertical line across the axes at an abscissa; dashes are in multiples of its width."""
    return Rule(at=at, upright=True, colour=colour.lower(), width=width, dashes=dashes)


def note_above(text: str) -> ChartNote:
    """Return a subdued text above the right end of the axes."""
    return ChartNote(text, (1.0, 1.0), (True, True), (0.0, 5.0), ("right", "baseline"), FAINT, TICK_SIZE)
