"""The figure of a cross-check: how far both codes are apart over time, with a step and with half of it."""

import math
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from crosscheck.case import Case
from docs.figures.pictures import write_picture
from perilune.analysis.documents.common.colours import COLOURS, DASHES
from perilune.analysis.documents.common.quantities import log_tick
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks

WIDTH, ROW_HEIGHT, COLUMNS = 7.4, 2.0, 2  # in, of a row of panels
POINTS = 25  # of a line, or up to twice as many
FLOOR = 1e-18  # what is drawn of a difference that is zero


def draw_differences(cases: dict[str, Case], flown: dict[str, list[dict[str, np.ndarray]]], path: Path) -> None:
    """Write a panel for each case, a colour for each quantity; full lines: its step, dashed: half of it."""
    units = {quantity: unit for case in cases.values() for quantity, (unit, _) in case.quantities.items()}
    colours = dict(zip(units, COLOURS, strict=False))
    with house_style():
        rows = math.ceil(len(cases) / COLUMNS)
        figure = new_figure(ROW_HEIGHT * rows, WIDTH)
        panels = figure.subplots(rows, COLUMNS, squeeze=False).flatten()
        for axes, (name, case) in zip(panels, cases.items(), strict=False):
            for apart, dashes in zip(flown[name], DASHES, strict=False):
                thin = slice(1, None, max(1, apart["time"].size // POINTS))  # both begin alike
                for quantity in case.quantities:
                    values = np.maximum(apart[quantity][thin], FLOOR)
                    axes.semilogy(apart["time"][thin], values, color=colours[quantity], linestyle=dashes, linewidth=1.0)
            axes.set_title(case.title, loc="left", fontsize=8.5)
            plain_ticks(axes, x=3)
            axes.yaxis.set_major_locator(LogLocator(numticks=3))
            axes.yaxis.set_minor_locator(NullLocator())
            axes.yaxis.set_major_formatter(FuncFormatter(log_tick))
        for axes in panels[len(cases) - COLUMNS : len(cases)]:
            axes.set_xlabel("time, s")
        for axes in panels[len(cases) :]:
            axes.remove()
        lines = [Line2D([], [], color=colour) for colour in colours.values()]
        labels = [f"{quantity}, {unit}" for quantity, unit in units.items()]
        figure.legend(lines, labels, loc="outside upper left", ncols=len(lines), columnspacing=0.9, handlelength=1.2)
        write_picture(figure, path)
