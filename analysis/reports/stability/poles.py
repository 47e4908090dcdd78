"""Closed-loop poles in the plane of z: the unit circle, lines of constant damping, and clouds over a campaign."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ...stability.results.report import LoopReport
from ..common.style import BLUE, FAINT, INK, VERMILION, plain_ticks
from .frequency import faint_line

DAMPINGS = (0.2, 0.5, 0.8)
KINDS = {"loop": "x", "not controllable": "v", "not observable": "^", "neither": "s"}
NEAR = 0.3  # from z = 1; slow loops have their poles there
MOST = 2500  # points of a cloud; more are thinned to a grid
SHAPE, LOW_SHAPE = 1.2, 1.6  # width over height of the panels' axes


def poles_of(loop: LoopReport) -> np.ndarray:
    """All closed-loop poles, from the modes where no more are given."""
    return loop.poles_z if loop.poles_z.size else np.array([mode.z for mode in loop.modes], dtype=complex)


def are_crowded(poles: np.ndarray) -> bool:
    """Whether so many poles lie near z = 1 that a map of the unit circle does not tell them apart."""
    return bool(np.sum(np.abs(poles - 1.0) < NEAR) >= 2)


def _grid(axes: Axes, *, named: bool) -> None:
    """The unit circle and lines of constant damping, z = exp(-(d +- j sqrt(1 - d^2)) w) for w T up to pi."""
    angle = np.linspace(0.0, np.pi, 181)
    for sign in (1.0, -1.0):
        axes.plot(np.cos(angle), sign * np.sin(angle), color=INK, linewidth=0.9, zorder=1.6)
        for damping in DAMPINGS:
            radius = np.exp(-damping / math.sqrt(1.0 - damping**2) * angle)
            faint_line(axes, radius * np.cos(angle), sign * radius * np.sin(angle))
    if named:
        for damping in DAMPINGS:
            height = math.exp(-damping / math.sqrt(1.0 - damping**2) * 0.5 * math.pi)
            behind = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
            axes.text(0.0, height, f"{damping:g}", fontsize=8.0, color=FAINT, ha="center", va="center", bbox=behind)


def _frame(axes: Axes, centre: float, half: float, shape: float = SHAPE) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(centre - shape * half, centre + shape * half)
    axes.set_ylim(-half, half)
    plain_ticks(axes, x=_intervals(2.0 * shape * half), y=5)
    axes.set_title("imaginary", loc="left", fontsize=8.5)
    axes.set_xlabel("real")


def _intervals(width: float) -> int:
    """Return the number of intervals whose labels have room side by side: near z = 1 they have many decimals."""
    decimals = max(1, math.ceil(-math.log10(width / 5)))
    return max(2, min(5, 30 // (decimals + 2)))


def _near_one(poles: np.ndarray, near: float = NEAR, shape: float = SHAPE) -> tuple[float, float]:
    """Centre and half height of a frame that holds the poles near z = 1, and a little beyond the circle."""
    close = poles[np.abs(poles - 1.0) < near]
    reach = max(float(np.max(np.abs(close - 1.0))), 1e-6)
    left, right = float(np.min(close.real)) - 0.12 * reach, max(1.0, float(np.max(close.real))) + 0.12 * reach
    half = max(1.15 * float(np.max(np.abs(close.imag))), 0.5 * (right - left) / shape)
    return right - shape * half, half


def draw_poles(loop: LoopReport, axes: Axes, *, near: bool) -> None:
    """All poles, or those near z = 1: crosses where the cut moves and sees the mode, orange where unstable."""
    poles = poles_of(loop)
    _grid(axes, named=not near)
    by_kind = {"x": poles}
    if loop.modes:
        by_kind = {
            marker: np.array([mode.z for mode in loop.modes if mode.kind == kind], dtype=complex)
            for kind, marker in KINDS.items()
        }
    for marker, members in by_kind.items():
        for colour, some in ((BLUE, members[np.abs(members) < 1.0]), (VERMILION, members[np.abs(members) >= 1.0])):
            axes.plot(
                some.real, some.imag, linestyle="", marker=marker, color=colour, markersize=5.5,
                markerfacecolor="none", markeredgewidth=1.3, zorder=3,
            )  # fmt: skip
    if near:
        _frame(axes, *_near_one(poles))
    else:
        _frame(axes, 0.0, max(1.12, min(2.0, 1.1 * float(np.max(np.abs(poles), initial=1.0)))))


def thin(poles: np.ndarray, extent: float) -> np.ndarray:
    """A cloud with at most so many points: one in each cell of a grid, fine enough not to be seen."""
    cells = 400
    while poles.size > MOST and cells >= 25:
        rounded = np.round(poles.real / extent * cells) + 1j * np.round(poles.imag / extent * cells)
        _, first = np.unique(rounded, return_index=True)
        if first.size <= MOST or cells == 25:
            return poles[np.sort(first)]
        cells //= 2
    return poles


def draw_cloud(loop: LoopReport, axes: Axes) -> None:
    """The poles of all trials, with the nominal ones as crosses over them."""
    assert loop.dispersion is not None
    poles = np.ravel(loop.dispersion.poles)
    poles = poles[np.isfinite(poles)]
    nominal = poles_of(loop)
    near = are_crowded(nominal if nominal.size else poles)
    if near:
        centre, half = _near_one(np.concatenate([poles, nominal]), 1.7 * NEAR, LOW_SHAPE)
    else:
        centre, half = 0.0, max(1.12, min(2.0, 1.1 * float(np.max(np.abs(poles)))))
    displayed = thin(poles[np.abs(poles - centre) < 3.0 * half], half)
    _grid(axes, named=not near)
    outside = np.abs(displayed) >= 1.0
    for some, colour in ((displayed[~outside], BLUE), (displayed[outside], VERMILION)):
        axes.plot(some.real, some.imag, linestyle="", marker=".", markersize=2.6, color=colour, alpha=0.5, zorder=2)
    axes.plot(nominal.real, nominal.imag, linestyle="", marker="x", markersize=5.5, color=INK, zorder=4)
    _frame(axes, centre, half, LOW_SHAPE)
