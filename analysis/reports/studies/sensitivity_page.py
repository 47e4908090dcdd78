"""The page of a sensitivity study: which dispersed parameters drive which metrics, and under which conditions."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...studies.sensitivity import SensitivityResult
from ...studies.sobol import CONFIDENCE
from ..common.page import Table, fraction, fractions
from ..common.panels import HALF_WIDTH, Panel, panel
from ..common.style import BLUE, INK, SKY, WIDTH, house_style, new_figure, plain_ticks
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
COLUMNS = 2  # of a notebook's figure


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
    """A panel for each metric that has indices."""

    panels = []
    for index, metric in enumerate(result.told):
        bars = bars_of(result, metric)[:MOST]
        words = f"Total and first-order Sobol' indices of {metric}"
        height = 0.95 + LANE * len(bars)
        panels.append(panel(metric, f"indices-{index}", words, partial(draw_indices, bars=bars), height, HALF_WIDTH))
    return panels


def draw_indices(axes: Axes, bars: list[Bar]) -> None:
    """Two bars for each parameter with its intervals: total above, first-order below."""
    for index, bar in enumerate(bars):
        for order, value, ends, offset, colour in (
            ("total", bar.total, bar.total_interval, -0.19, BLUE),
            ("first order", bar.first, bar.first_interval, 0.19, SKY),
        ):
            (plotted,) = axes.barh(index + offset, value, height=0.34, color=colour, label=None if index else order)
            plotted.set_gid(f"{order.split()[0]}-{index}")
            axes.plot(ends, [index + offset] * 2, color=INK, linewidth=1.1, marker="|", markersize=5)
    axes.axvline(0.0, color=INK, linewidth=0.8)
    all_ends = [end for bar in bars for end in (*bar.total_interval, *bar.first_interval)]
    axes.set_xlim(min(0.0, *all_ends) - 0.02, max(1.0, *all_ends) + 0.02)
    axes.set_yticks(range(len(bars)), [bar.name for bar in bars])
    axes.set_ylim(len(bars) - 0.45, -0.55)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    plain_ticks(axes, x=5)
    axes.set_xlabel("fraction of the variance")
    axes.legend(loc="lower right", ncols=1)


def sensitivity_plot(result: SensitivityResult, metrics: list[str]) -> Figure:
    """A panel of indices for each metric."""
    columns = min(COLUMNS, len(metrics))
    rows = -(-len(metrics) // columns)
    lanes = min(MOST, len(result.inputs))
    with house_style():
        figure = new_figure(rows * (1.1 + LANE * lanes), 0.5 * WIDTH * columns)
        panels = figure.subplots(rows, columns, squeeze=False).flatten()
        for axes, metric in zip(panels, metrics, strict=False):
            draw_indices(axes, bars_of(result, metric)[:MOST])
            axes.set_title(metric, loc="left")
        for axes in panels[len(metrics) :]:
            axes.remove()
    return figure
