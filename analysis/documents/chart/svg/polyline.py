"""A line of many samples as a compact SVG path."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...interactive.envelope import envelope

SPANS_PER_PIXEL = 1.5  # spans of an envelope per pixel of the abscissa
TOLERANCE = 0.07  # px, distance from the line up to which a point may be omitted
PASSES = 8
FAR = 1e6  # px, distance beyond the picture at which lines are cut


def path_of(x: np.ndarray, y: np.ndarray, *, steps: bool, width: float | None = None) -> str:
    """Return the path through points (px), [rows], with gaps at non-finite coordinates.

    With ``steps`` an ordinate holds until the next row. A line with ascending abscissas and more rows than are
    distinguishable over ``width`` (px) is replaced by its envelope.
    """
    if steps:
        changes = np.flatnonzero(np.append(True, ~((y[1:] == y[:-1]) | (np.isnan(y[1:]) & np.isnan(y[:-1])))))
        rows = np.union1d(changes, [y.size - 1])
        x, y = np.repeat(x[rows], 2)[1:], np.repeat(y[rows], 2)[:-1]
    if width is not None and np.all(np.diff(x) >= 0.0):
        x, y = envelope(x, y, int(SPANS_PER_PIXEL * width))
    points = np.clip(np.stack([x, y]), -FAR, FAR)
    return "".join(_stroke(_thin(points[:, rows])) for rows in _finite_runs(np.isfinite(x) & np.isfinite(y)))


def _finite_runs(finite: np.ndarray) -> list[slice]:
    """Return the runs of consecutive rows with finite coordinates."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], finite, [False]]).astype(np.int8)))
    return [slice(int(first), int(end)) for first, end in zip(edges[::2], edges[1::2], strict=True)]


def _thin(points: np.ndarray) -> np.ndarray:
    """Return points, [2, rows], without points on the chord of their neighbours."""
    for _ in range(PASSES):
        before, here, after = points[:, :-2:2], points[:, 1:-1:2], points[:, 2::2]
        size = min(here.shape[1], after.shape[1])
        chord, aside = (after - before[:, :size])[:, :size], (here - before)[:, :size]
        length = np.hypot(*chord)
        distance = np.abs(chord[0] * aside[1] - chord[1] * aside[0]) / np.maximum(length, TOLERANCE)
        between = np.sum(chord * aside, axis=0)
        on_chord = (distance < TOLERANCE) & (between >= 0.0) & (between <= length * length)
        if not on_chord.any():
            break
        points = np.delete(points, 1 + 2 * np.flatnonzero(on_chord), axis=1)
    return points


def _stroke(points: np.ndarray) -> str:
    """Return the path commands of a stroke, relative to the previous point, without repeated points."""
    tenths = np.rint(10.0 * points).astype(np.int64)
    moves = np.diff(tenths, axis=1).T
    moves = moves[np.any(moves != 0, axis=1)]
    line = f"l{in_tenths(moves.ravel().tolist())}" if moves.size else "h0"
    return f"M{in_tenths(tenths[:, 0].tolist())}{line}"


def in_tenths(tenths: Iterable[int]) -> str:
    """Return numbers of tenths as decimal numbers in the syntax of paths, in which a minus sign is a separator, too."""
    return "".join(map(_number, tenths)).strip()


def _number(tenths: int) -> str:
    whole, tenth = divmod(abs(tenths), 10)
    text = f"{whole or ''}.{tenth}" if tenth else f"{whole}"
    return f"-{text}" if tenths < 0 else f" {text}"
