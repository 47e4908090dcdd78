"""Figures of docs/modal_synthesis.md; `modal_comparison` computes the data of the first two and writes all."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter
from scipy.linalg import expm

from perilune.analysis.design.poles.output_feedback_set import common_feedback
from perilune.analysis.documents.common.colours import BLUE, FAINT, INK, VERMILION, look
from perilune.analysis.documents.common.quantities import log_tick
from perilune.analysis.documents.common.style import new_figure, plain_ticks

TURN = np.radians(-20.0)
PLANTS = (0.05, 0.5, 2.0, 8.0)


def choices_figure(kappa: dict[str, np.ndarray], norm: dict[str, np.ndarray]) -> Figure:
    """Draw kappa and |K| relative to place_poles, (systems,) for several sizes, systems in ascending order."""
    figure = new_figure(3.6)
    panels = figure.subplots(1, 2)
    for axes, sizes, label in (
        (panels[0], kappa, "kappa, least condition / place_poles"),
        (panels[1], norm, "|K|, least norm / place_poles"),
    ):
        for index, (name, ratios) in enumerate(sizes.items()):
            style = look(index)
            axes.plot(
                np.arange(1, len(ratios) + 1),
                np.sort(ratios),
                color=style.colour,
                linestyle=style.dashes,
                marker=style.marker,
                markersize=3.5,
                label=f"n, m = {name}",
            )
        axes.axhline(1.0, color=FAINT, linewidth=0.8)
        axes.set(xlabel="systems, in order", ylabel=label, ylim=(0.0, 1.1))
        plain_ticks(axes, x=10, y=6)
    panels[0].legend(loc="lower right")
    return figure


def spreads_figure(direct: np.ndarray, dual: np.ndarray, smallest: np.ndarray) -> Figure:
    """Draw |F| of every spread for every system, and the minimum; systems in the order of the least spread."""
    figure = new_figure(3.6)
    axes = figure.subplots()
    order = np.argsort(np.minimum(direct.min(axis=1), dual.min(axis=1)))
    for norms, colour, marker, shift, label in (
        (direct, BLUE, "o", -0.12, "direct, 20 spreads"),
        (dual, VERMILION, "s", 0.12, "dual, 15 spreads"),
        (smallest, INK, "D", 0.0, "smallest, from there"),
    ):
        places = np.repeat(np.arange(1, len(norms) + 1), norms.shape[1]) + shift
        axes.plot(
            places,
            norms[order].ravel(),
            linestyle="",
            marker=marker,
            markersize=3.0,
            color=colour,
            alpha=0.6,
            label=label,
        )
    axes.set(xlabel="systems, in the order of the least |F|", ylabel="|F|", yscale="log")
    axes.set_xlim(0.0, len(direct) + 1.0)
    plain_ticks(axes, x=len(direct) + 1)
    axes.yaxis.set_major_formatter(FuncFormatter(log_tick))
    axes.legend(loc="upper left")
    return figure


def turned_plant(q: float) -> np.ndarray:
    """Return A for x = (e, b, wx, wy): two angles in axes rotated by `TURN`, b held by a spring of stiffness q."""
    c, s = np.cos(TURN), np.sin(TURN)
    return np.array([[0, 0, c, -s], [0, 0, s, c], [0, -q * s, 0, 0], [0, -q * c, 0, 0]])


def free_figure() -> Figure:
    """Draw e and b from one initial state under one regulator, for springs that differ by a factor of 160."""
    c, s = np.cos(TURN), np.sin(TURN)
    b = np.vstack([np.zeros((2, 2)), [[c, s], [-s, c]]])
    wanted = np.array([[[0.25, 0.0], [0.0, np.nan]], np.eye(2)])
    feedback = common_feedback([turned_plant(q) for q in PLANTS], b, np.eye(4)[[0, 2, 3]], wanted)
    figure = new_figure(3.2)
    panels = figure.subplots(1, 2, sharex=True)
    time = np.linspace(0.0, 20.0, 401)
    for index, (q, loop) in enumerate(zip(PLANTS, feedback.loops, strict=True)):
        states = np.array([expm(loop.closed_loop * t) @ [1.0, 1.0, 0.0, 0.0] for t in time])
        style = look(index)
        for axes, state in zip(panels, states.T, strict=False):
            axes.plot(time, state, color=style.colour, linestyle=style.dashes, label=f"q = {q:g}")
    for axes, name in zip(panels, ("e, measured", "b, not measured"), strict=True):
        axes.set(xlabel="time, s", ylabel=name)
        plain_ticks(axes, x=8, y=6)
    panels[1].legend(loc="upper right")
    return figure
