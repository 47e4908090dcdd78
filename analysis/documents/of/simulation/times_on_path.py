"""Times along a path: rows to mark, and their labels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...chart.ticks import axis_ticks
from ...common.colours import FAINT, INK
from ...common.quantities import number
from ...font.text import text_width
from ...interactive.charts import Chart, ChartNote
from ...interactive.measures import TICK_SIZE

INTERVALS = 8  # largest number of intervals between marks
LAST = 0.6  # fraction of an interval before the end without marks
RADIUS = 3.5  # pt, of marks, which labels must not cover
APART = 12.0  # pt, least distance between marks with labels
CAPITAL = 0.73  # height of digits over the font size


class Extent(NamedTuple):
    """A rectangle within the axes (pt, from their lower left corner)."""

    left: float
    bottom: float
    right: float
    top: float


def mark_rows(time: np.ndarray) -> np.ndarray:
    """Return the rows nearest to about eight round times, and the last row."""
    if time.size == 1 or time[-1] == time[0]:
        return np.array([0])
    ticks = axis_ticks(float(time[0]), float(time[-1]), INTERVALS)
    inside = [each for each in ticks if each <= time[-1] - LAST * (ticks[1] - ticks[0])]
    return np.append(np.searchsorted(time, np.array(inside) - 1e-9), time.size - 1)


def time_notes(
    chart: Chart, size: tuple[float, float], paths: Sequence[np.ndarray], time: np.ndarray, rows: np.ndarray
) -> list[ChartNote]:
    """Return labels with the times at marks of the first of the ``paths``, next to its line.

    A label covers neither marks of any path nor another label. A time without space for it, or whose mark is close to
    another, has no label, except at the end. ``size`` (pt) is the size of the plotting area; paths are in units of the
    axes, [2, samples]; marks are at ``rows``.
    """
    corner = np.array([chart.x.ends[0], chart.y.ends[0]])[:, None]
    ranges = np.ptp([chart.x.ends, chart.y.ends], axis=1)[:, None]
    area = np.array(size)[:, None]
    marks = [(path[:, rows] - corner) / ranges * area for path in paths]  # pt, from the lower left corner
    obstacles, points = np.concatenate(marks, axis=1), marks[0].T
    labelled: list[np.ndarray] = []
    occupied: list[Extent] = []
    notes = []
    for mark, row in zip(points[::-1], rows[::-1], strict=True):
        is_end = bool(row == rows[-1])
        if not np.isfinite(mark).all() or any(np.linalg.norm(mark - other) < APART for other in labelled):
            continue
        offsets = _candidates(paths[0], rows, row, is_left=mark[0] < area[0, 0] / 2.0)
        candidates = [_note(time[row], paths[0][:, row], offset, is_end=is_end) for offset in offsets]
        free = [note for note in candidates if _is_free(_extent(note, mark), obstacles, occupied, area)]
        for note in (free or candidates[: int(is_end)])[:1]:
            labelled.append(mark)
            occupied.append(_extent(note, mark))
            notes.append(note)
    return notes


def _candidates(path: np.ndarray, rows: np.ndarray, row: int, *, is_left: bool) -> list[tuple[float, float]]:
    """Return candidate offsets (pt) of a label from its mark: first next to the line, then on it."""
    if row == rows[-1]:
        side, below = 8.0 if is_left else -8.0, path[1, rows[max(0, rows.size - 2)]] >= path[1, -1]
        return [(across, up) for across in (side, -side) for up in ((-13.0, 6.0) if below else (6.0, -13.0))]
    left, right = path[:, max(0, row - 1)], path[:, row + 1]
    rising = (right[0] - left[0]) * (right[1] - left[1]) > 0.0  # then there is space above on the left
    above = -5.0 if rising else 5.0
    return [(above, 4.0), (-above, -10.0), (-above, 4.0), (above, -10.0)]


def _note(time: float, at: np.ndarray, offset: tuple[float, float], *, is_end: bool) -> ChartNote:
    align = ("left" if offset[0] > 0.0 else "right", "baseline")
    point, text = (float(at[0]), float(at[1])), f"{number(float(time), 4)} s"
    return ChartNote(text, point, (False, False), offset, align, INK if is_end else FAINT, TICK_SIZE, bold=is_end)


def _extent(note: ChartNote, mark: np.ndarray) -> Extent:
    width = text_width(note.text, note.size, is_bold=note.bold)
    left, bottom = float(mark[0] + note.offset[0]), float(mark[1] + note.offset[1])
    left -= width if note.align[0] == "right" else 0.0
    return Extent(left, bottom, left + width, bottom + CAPITAL * note.size)


def _is_free(text: Extent, marks: np.ndarray, occupied: Sequence[Extent], area: np.ndarray) -> bool:
    """Return True if a text is within the axes and covers neither a mark nor another text."""
    covered = (marks[0] > text.left - RADIUS) & (marks[0] < text.right + RADIUS)
    covered &= (marks[1] > text.bottom - RADIUS) & (marks[1] < text.top + RADIUS)
    is_apart = all(
        text.left > other.right or text.right < other.left or text.bottom > other.top or text.top < other.bottom
        for other in occupied
    )
    is_inside = text.left >= 0.0 and text.right <= area[0, 0] and text.bottom >= 0.0 and text.top <= area[1, 0]
    return bool(is_apart and is_inside and not covered.any())
