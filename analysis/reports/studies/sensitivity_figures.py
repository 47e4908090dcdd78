"""The figures of a sensitivity study: first-order and total indices of each metric with their intervals."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from matplotlib.axes import Axes

from ...studies.sensitivity import SensitivityResult
from ..common.panels import HALF_WIDTH, Panel, panel
from ..common.style import BLUE, INK, SKY, plain_ticks

MOST = 12  # parameters of a panel, those with the largest total index
LANE = 0.34  # in


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
            tuple(entry["total_interval"]),
            entry["first"],
            tuple(entry["first_interval"]),
            entry["rank"],
        )
        for name, entry in result.of(metric).items()
        if "total" in entry
    ]
    return sorted(bars, key=lambda bar: -bar.total)


def index_panels(result: SensitivityResult) -> list[Panel]:
    """A panel for each metric that has indices."""

    def drawing(bars: list[Bar]) -> Callable[[Axes], None]:
        return lambda axes: draw_indices(axes, bars)

    panels = []
    for index, metric in enumerate(result.told):
        bars = bars_of(result, metric)[:MOST]
        words = f"Total and first-order Sobol' indices of {metric}"
        height = 0.95 + LANE * len(bars)
        panels.append(panel(metric, f"indices-{index}", words, drawing(bars), height, HALF_WIDTH))
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
