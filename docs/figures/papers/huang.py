"""Figures 3 and 7 of Huang 2017: `python -m docs.figures.papers.huang` writes docs/images/hover_*.svg."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from perilune.analysis.design.trajectories.vehicle import HOVER_TRANSFER, HOVER_VEHICLE
from perilune.analysis.design.transfers.free_fall import find_free_fall
from perilune.analysis.design.transfers.programme import Programme, find_programme
from perilune.analysis.documents.common.colours import FAINT, INK, look
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks

from ..pictures import IMAGES, write_picture

DURATIONS = np.linspace(68.0, 92.0, 49)  # s
DISTANCES = np.linspace(0.0, 3000.0, 61)  # m
PUBLISHED = (78.0, 0.0494)  # t7 (s) and propellant fraction of the paper's (6)
DEARER = (1600.0, 1.29)  # distance (m) and its propellant relative to a vertical descent, as published
LINE = (700.0, 0.033349, 1.0102e-5)  # m, from where the line holds; fraction at 0 and per m
SIZE = (2.6, 3.6)  # in


def duration_figure() -> Figure:
    """Draw propellant over the duration t7 of the programme: figure 3."""
    figure = new_figure(*SIZE)
    axes = figure.subplots()
    _plot(axes, DURATIONS, [find_programme(HOVER_VEHICLE, HOVER_TRANSFER, float(value)) for value in DURATIONS], 0, "")
    best = _programme(HOVER_TRANSFER.distance)
    axes.plot(best.duration, best.propellant_fraction, "o", color=INK, markersize=4)
    axes.plot(*PUBLISHED, "x", color=INK)
    return _finish(figure, axes, "t7, s")


def distance_figure() -> Figure:
    """Draw least propellant over the distance to the end: figure 7, with the turn in free fall."""
    figure = new_figure(*SIZE)
    axes = figure.subplots()
    programmes = [_programme(float(value)) for value in DISTANCES]
    _plot(axes, DISTANCES, programmes, 0, "programme")
    _plot(axes, DISTANCES, [find_free_fall(each) for each in programmes], 1, "turn in free fall")
    begin, start, slope = LINE
    far = np.array([begin, DISTANCES[-1]])
    axes.plot(far, start + slope * far, color=FAINT, linestyle=":", linewidth=1.0)
    axes.plot(DEARER[0], DEARER[1] * programmes[0].propellant_fraction, "x", color=INK)
    axes.legend(loc="upper left", fontsize=7.5)
    return _finish(figure, axes, "distance, m")


def _programme(distance: float) -> Programme:
    programme = find_programme(HOVER_VEHICLE, replace(HOVER_TRANSFER, distance=distance))
    assert programme is not None  # exists at these distances
    return programme


def _plot(axes: Axes, at: np.ndarray, plans: list, index: int, label: str) -> None:
    fractions = [np.nan if plan is None else plan.propellant_fraction for plan in plans]
    style = look(index)
    axes.plot(at, fractions, color=style.colour, linestyle=style.dashes, linewidth=1.3, label=label)


def _finish(figure: Figure, axes: Axes, quantity: str) -> Figure:
    axes.set(xlabel=quantity, ylabel="propellant fraction")
    plain_ticks(axes, x=5, y=5)
    return figure


def draw_hover_figures(folder: Path = IMAGES) -> list[Path]:
    """Write both figures."""
    with house_style():
        return [
            write_picture(duration_figure(), folder / "hover_duration.svg"),
            write_picture(distance_figure(), folder / "hover_distance.svg"),
        ]


if __name__ == "__main__":
    print(*draw_hover_figures(), sep="\n")
