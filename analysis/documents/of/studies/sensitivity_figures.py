"""Figures of a sensitivity study: for each metric the indices of parameters as bars with confidence intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ....studies.sensitivity import SensitivityOutcome
from ...chart.axes import lane_axis, linear_axis
from ...chart.lines import line
from ...chart.marks import rectangle, vertical_line
from ...chart.symbols import marker
from ...common.colours import BLUE, INK, SKY
from ...interactive.charts import NO_BOX, Chart
from ...interactive.measures import TICK_SIZE
from ...pictures import Figure

MOST = 12  # parameters of a panel, those with the largest total index
LANE = 0.34  # in
BAR, OFFSET = 0.34, 0.19  # over the height of a lane: height of a bar, distance of its middle from the lane's
CAP = marker("|", 5.0, INK)  # the end of an interval
ORDERS = (BLUE, SKY)  # total, first order


class IndexBar(NamedTuple):
    """A parameter's indices for a metric, each with the ends of its interval."""

    name: str
    total: float
    total_interval: tuple[float, float]
    first: float
    first_interval: tuple[float, float]
    rank: float | None


def bars_of(study: SensitivityOutcome, metric: str) -> list[IndexBar]:
    """Return a bar for each parameter, in descending order of total index."""
    bars = [
        IndexBar(
            name,
            entry["total"],
            _ends(entry["total_interval"]),
            entry["first"],
            _ends(entry["first_interval"]),
            entry["rank"],
        )
        for name, entry in study.of(metric).items()
        if "total" in entry
    ]
    return sorted(bars, key=lambda bar: -bar.total)


def _ends(interval: list[float | None]) -> tuple[float, float]:
    """Return the ends of an interval, NaN where JSON has None."""
    low, high = (math.nan if end is None else end for end in interval)
    return low, high


def index_figures(study: SensitivityOutcome, metrics: Sequence[str]) -> list[Figure]:
    """Return a figure of the indices for each metric."""
    figures = []
    for index, metric in enumerate(metrics):
        bars = bars_of(study, metric)[:MOST]
        words = f"Total and first-order Sobol' indices of {metric}"
        figures.append(Figure(metric, f"indices-{index}", words, index_chart(bars), 0.75 + LANE * len(bars)))
    return figures


def index_chart(bars: Sequence[IndexBar]) -> Chart:
    """Return the chart of indices: two bars for each parameter, total above first-order, with confidence intervals."""
    areas, curves = [], []
    for lane, bar in enumerate(bars):
        for size, ends, offset, colour in (
            (bar.total, bar.total_interval, -OFFSET, ORDERS[0]),
            (bar.first, bar.first_interval, OFFSET, ORDERS[1]),
        ):
            at = lane + offset
            areas.append(rectangle(0.0, size, at - BAR / 2.0, at + BAR / 2.0, colour, 1.0))
            interval = line(np.array(ends), np.full(2, at), INK, width=1.1)
            curves.append(replace(interval, marker=CAP))
    plotted = np.array([end for bar in bars for end in (*bar.total_interval, *bar.first_interval)])
    low, high = float(np.nanmin(plotted, initial=0.0)), float(np.nanmax(plotted, initial=1.0))
    return Chart(
        NO_BOX,
        linear_axis((low - 0.02, high + 0.02), 5, label="fraction of the variance"),
        lane_axis([bar.name for bar in bars], (len(bars) - 0.45, -0.55), size=TICK_SIZE),
        title="above: total; below: first order",
        areas=areas,
        curves=curves,
        rules=[vertical_line(0.0, INK, 0.8)],
    )
