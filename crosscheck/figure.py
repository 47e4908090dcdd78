"""The figure of a cross-check: how far both codes are apart over time, with a step and with half of it."""

from pathlib import Path

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from crosscheck.case import Case
from docs.figures.pictures import write_picture
from perilune.analysis.reports.common.quantities import log_tick
from perilune.analysis.reports.common.style import COLOURS, DASHES, house_style, new_figure, plain_ticks

WIDTH, ROW_HEIGHT = 7.4, 2.2  # in
POINTS = 20  # of a line
FLOOR = 1e-18  # what is drawn of a difference that is zero


def draw_differences(cases: dict[str, Case], flown: dict[str, list[dict[str, np.ndarray]]], path: Path) -> None:
    """Write a panel for each case; full lines: its step, dashed: half of it."""
    with house_style():
        rows = (len(cases) + 1) // 2
        figure = new_figure(ROW_HEIGHT * rows, WIDTH)
        panels = figure.subplots(rows, 2, squeeze=False).flatten()
        for axes, (name, case) in zip(panels, cases.items(), strict=False):
            for apart, dashes in zip(flown[name], DASHES, strict=False):
                for colour, (quantity, (unit, _)) in zip(COLOURS, case.quantities.items(), strict=False):
                    label = f"{quantity}, {unit}" if dashes == DASHES[0] else None
                    thin = slice(1, None, max(1, apart["time"].size // POINTS))  # both begin alike
                    values = np.maximum(apart[quantity][thin], FLOOR)
                    axes.semilogy(
                        apart["time"][thin], values, color=colour, linestyle=dashes, linewidth=1.0, label=label
                    )
            axes.set_title(case.title, loc="left", fontsize=8.5)
            axes.set_xlabel("time, s")
            plain_ticks(axes, x=3)
            axes.yaxis.set_major_locator(LogLocator(numticks=3))
            axes.yaxis.set_minor_locator(NullLocator())
            axes.yaxis.set_major_formatter(FuncFormatter(log_tick))
            axes.legend(fontsize=7.5, loc="best")
        for axes in panels[len(cases) :]:
            axes.remove()
        write_picture(figure, path)
