"""Closed-loop poles in the z plane: unit circle, lines of constant damping, and clouds over a campaign."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .....stability.results.report import LoopReport
from ....chart.axes import linear_axis
from ....chart.lines import line
from ....chart.symbols import marker, marks
from ....common.colours import BLUE, FAINT, INK, VERMILION
from ....interactive.charts import NO_BOX, Backing, Chart, ChartNote, Curve
from .frequency import WHITE, faint_line

DAMPINGS = (0.2, 0.5, 0.8)
KINDS = {"loop": "x", "not controllable": "v", "not observable": "^", "neither": "s"}
SLOW_DISTANCE = 0.3  # distance from z = 1 within which slow loops have their poles
MOST = 2500  # largest number of points of a cloud; larger clouds are thinned to a grid
SHAPE, LOW_SHAPE = 1.2, 1.6  # approximate aspect ratios of the panels' axes
NOTES = np.array([0.5, 0.6, 0.4, 0.7, 0.3])  # positions of labels of damping, in half turns
CLEAR = 0.15  # least distance from a label to a pole
SIZE, EDGE = 5.5, 1.3  # pt, of a mark and its strokes


def poles_of(loop: LoopReport) -> np.ndarray:
    """Return all closed-loop poles; the poles of the modes if no others are available."""
    return loop.poles_z if loop.poles_z.size else np.array([mode.z for mode in loop.modes], dtype=complex)


def are_crowded(poles: np.ndarray) -> bool:
    """Return True if poles near z = 1 are too close to be distinguished on a map of the unit circle."""
    return bool(np.sum(np.abs(poles - 1.0) < SLOW_DISTANCE) >= 2)


def pole_chart(loop: LoopReport, *, near: bool) -> Chart:
    """Return the chart of all poles, or only of poles near z = 1.

    Crosses are modes that are controllable and observable at the cut; poles with |z| >= 1 are orange.
    """
    poles = poles_of(loop)
    by_kind = {"x": poles}
    if loop.modes:
        by_kind = {
            marker: np.array([mode.z for mode in loop.modes if mode.kind == kind], dtype=complex)
            for kind, marker in KINDS.items()
        }
    curves = []
    for shape, members in by_kind.items():
        for colour, some in ((BLUE, members[np.abs(members) < 1.0]), (VERMILION, members[np.abs(members) >= 1.0])):
            if some.size:
                curves.append(marks(some.real, some.imag, marker(shape, SIZE, colour, fill="", width=EDGE)))
    frame = _near_one(poles) if near else (0.0, max(1.12, min(2.0, 1.1 * float(np.max(np.abs(poles), initial=1.0)))))
    return _plane(curves, *frame, SHAPE, [] if near else _damping_notes(poles))


def cloud_chart(loop: LoopReport) -> Chart:
    """Return the chart of the poles of all trials, with crosses for the nominal poles on top."""
    assert loop.dispersion is not None
    poles = np.ravel(loop.dispersion.poles)
    poles = poles[np.isfinite(poles)]
    nominal = poles_of(loop)
    near = are_crowded(nominal if nominal.size else poles)
    if near:
        centre, half = _near_one(np.concatenate([poles, nominal]), 1.7 * SLOW_DISTANCE, LOW_SHAPE)
    else:
        centre, half = 0.0, max(1.12, min(2.0, 1.1 * float(np.max(np.abs(poles)))))
    displayed = thin(poles[np.abs(poles - centre) < 3.0 * half], half)
    outside = np.abs(displayed) >= 1.0
    curves = [
        marks(some.real, some.imag, marker(".", 2.6, colour), opacity=0.5)
        for some, colour in ((displayed[~outside], BLUE), (displayed[outside], VERMILION))
        if some.size
    ]
    curves.append(marks(nominal.real, nominal.imag, marker("x", SIZE, INK)))
    return _plane(curves, centre, half, LOW_SHAPE, [] if near else _damping_notes(nominal))


def thin(poles: np.ndarray, extent: float) -> np.ndarray:
    """Return a cloud of at most `MOST` points: one point in each cell of a grid too fine to be visible."""
    cells = 400
    while poles.size > MOST and cells >= 25:
        rounded = np.round(poles.real / extent * cells) + 1j * np.round(poles.imag / extent * cells)
        _, first = np.unique(rounded, return_index=True)
        if first.size <= MOST or cells == 25:
            return poles[np.sort(first)]
        cells //= 2
    return poles


def _plane(curves: Sequence[Curve], centre: float, half: float, shape: float, notes: Sequence[ChartNote]) -> Chart:
    """Return the plane about a centre on the real axis, with its grid and the ``notes`` of the grid."""
    return Chart(
        NO_BOX,
        linear_axis((centre - shape * half, centre + shape * half), intervals(2.0 * shape * half), label="real"),
        linear_axis((-half, half), 5),
        title="imaginary",
        curves=[*_grid(), *curves],
        notes=notes,
    )


def _grid() -> list[Curve]:
    """Return the unit circle and lines of constant damping, z = exp(-(d +- j sqrt(1 - d^2)) w) for w T up to pi."""
    angle = np.linspace(0.0, np.pi, 181)
    curves = []
    for sign in (1.0, -1.0):
        curves.append(line(np.cos(angle), sign * np.sin(angle), INK, width=0.9))
        for damping in DAMPINGS:
            radius = np.exp(-damping / math.sqrt(1.0 - damping**2) * angle)
            curves.append(faint_line(radius * np.cos(angle), sign * radius * np.sin(angle)))
    return curves


def _damping_notes(poles: np.ndarray) -> list[ChartNote]:
    return [_damping_note(damping, poles) for damping in DAMPINGS]


def _damping_note(damping: float, poles: np.ndarray) -> ChartNote:
    """Return the label of a line of constant damping, at the first of several angles at which it covers no pole."""
    positions = np.exp((1j - damping / math.sqrt(1.0 - damping**2)) * np.pi * NOTES)
    distances = np.abs(poles[np.newaxis] - positions[:, np.newaxis]).min(axis=1, initial=np.inf)
    at = complex(positions[int(np.argmax(distances > CLEAR))])
    centred, backing = ("center", "center"), Backing(WHITE, 1.0, 0.6)
    return ChartNote(
        f"{damping:g}", (at.real, at.imag), (False, False), (0.0, 0.0), centred, FAINT, 8.0, backing=backing
    )


def intervals(width: float) -> int:
    """Return the number of intervals whose labels fit side by side; near z = 1 labels have many decimals."""
    decimals = max(1, math.ceil(-math.log10(width / 5)))
    return max(2, min(5, 30 // (decimals + 2)))


def _near_one(poles: np.ndarray, near: float = SLOW_DISTANCE, shape: float = SHAPE) -> tuple[float, float]:
    """Return centre and half the height of a frame around the poles near z = 1 with some margin."""
    close = poles[np.abs(poles - 1.0) < near]
    reach = max(float(np.max(np.abs(close - 1.0))), 1e-6)
    left, right = float(np.min(close.real)) - 0.12 * reach, max(1.0, float(np.max(close.real))) + 0.12 * reach
    half = max(1.15 * float(np.max(np.abs(close.imag))), 0.5 * (right - left) / shape)
    return right - shape * half, half
