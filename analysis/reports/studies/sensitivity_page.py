"""The page of a sensitivity study: which dispersed parameters drive which metrics, and under which conditions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...studies.sensitivity import SensitivityResult
from ...studies.sobol import CONFIDENCE
from ..chart.axes import lane_axis, linear_axis
from ..chart.lines import line
from ..chart.marks import instant, rectangle
from ..chart.panel import chart_panel
from ..chart.symbols import marker
from ..common.colours import BLUE, INK, SKY, Look
from ..common.page import Table, fraction, fractions
from ..common.panels import HALF_WIDTH, Panel, swatch
from ..interactive.charts import NO_BOX, Chart
from ..interactive.measures import TICK_SIZE
from .conditions import write_study_page

WIDE = 0.3  # of an interval of a total index, from which on a larger base is advised


def write_sensitivity_page(result: SensitivityResult, path: Path, folder: Path | None = None) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``folder`` is where the result has been written, if it has: the page says how its flights are flown again.
    """
    replay = result.replay(folder, 0)
    write_study_page(
        path,
        "sensitivity.html",
        "sensitivity",
        result,
        percent=f"{100 * CONFIDENCE:g} %",
        drivers=driver_table(result),
        panels=index_panels(result),
        legend=[(swatch(Look(colour, "-", "")), order) for colour, order in ORDERS],
        most=MOST,
        tables=[(metric, index_table(result, metric)) for metric in result.told],
        ranks=rank_table(result),
        wide=[metric for metric in result.told if np.ptp(bars_of(result, metric)[0].total_interval) > WIDE],
        wide_from=WIDE,
        replays=[("the first simulation", replay)] if replay else [],
    )


def driver_table(result: SensitivityResult) -> Table:
    """A row per metric: its parameter with the largest total index, and the sum of first-order indices."""
    rows = []
    for metric in result.told:
        bars = bars_of(result, metric)
        first = sum(bar.first for bar in bars)
        rows.append(
            (metric, bars[0].name, fraction(bars[0].total), fractions(*bars[0].total_interval), fraction(first))
        )
    heads = ("metric", "largest total index", "total", f"{100 * CONFIDENCE:g} % interval", "sum of first order")
    return Table(heads, rows, (2, 3, 4))


def index_table(result: SensitivityResult, metric: str) -> Table:
    """A row per parameter with the indices of one metric, by total index."""
    rows = [
        (
            bar.name,
            fraction(bar.total),
            fractions(*bar.total_interval),
            fraction(bar.first),
            fractions(*bar.first_interval),
            fraction(bar.rank),
        )
        for bar in bars_of(result, metric)
    ]
    percent = f"{100 * CONFIDENCE:g} %"
    return Table(("parameter", "total", percent, "first order", percent, "rank correlation"), rows, range(1, 6))


def rank_table(result: SensitivityResult) -> Table:
    """Rank correlations, a row per metric and a column per parameter."""
    names = result.space.names
    rows = [(metric, *(fraction(ranks[name]) for name in names)) for metric, ranks in result.ranks.items()]
    return Table(("metric", *names), rows, range(1, 1 + len(names)))


MOST = 12  # parameters of a panel, those with the largest total index
LANE = 0.34  # in
BAR, OFFSET = 0.34, 0.19  # of a lane: the height of a bar, its middle above or below that of the lane
CAP = marker("|", 5.0, INK)  # the end of an interval
ORDERS = ((BLUE, "total"), (SKY, "first order"))


class Bar(NamedTuple):
    """A parameter's indices for a metric, each with the two ends of its interval."""

    name: str
    total: float
    total_interval: tuple[float, float]
    first: float
    first_interval: tuple[float, float]
    rank: float | None


def bars_of(result: SensitivityResult, metric: str) -> list[Bar]:
    """A bar for each parameter, by total index, the largest first."""
    bars = [
        Bar(
            name,
            entry["total"],
            _ends(entry["total_interval"]),
            entry["first"],
            _ends(entry["first_interval"]),
            entry["rank"],
        )
        for name, entry in result.of(metric).items()
        if "total" in entry
    ]
    return sorted(bars, key=lambda bar: -bar.total)


def _ends(interval: list[float | None]) -> tuple[float, float]:
    """The ends of an interval, nan where JSON has none."""
    low, high = (math.nan if end is None else end for end in interval)
    return low, high


def index_panels(result: SensitivityResult) -> list[Panel]:
    """Return a panel for each metric that has indices."""
    panels = []
    for index, metric in enumerate(result.told):
        bars = bars_of(result, metric)[:MOST]
        words = f"Total and first-order Sobol' indices of {metric}"
        height = 0.75 + LANE * len(bars)
        panels.append(chart_panel(metric, f"indices-{index}", words, index_chart(bars), height, HALF_WIDTH))
    return panels


def index_chart(bars: Sequence[Bar]) -> Chart:
    """Return two bars for each parameter with its intervals: total above, first-order below."""
    areas, curves = [], []
    for lane, bar in enumerate(bars):
        for size, ends, offset, (colour, _) in (
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
        areas=areas,
        curves=curves,
        rules=[instant(0.0, INK, 0.8)],
    )


def sensitivity_charts(result: SensitivityResult, metrics: Sequence[str]) -> list[Chart]:
    """Return the indices of each metric."""
    return [replace(index_chart(bars_of(result, metric)[:MOST]), title=metric) for metric in metrics]
