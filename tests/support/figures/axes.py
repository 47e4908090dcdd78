"""Axes as drawn by matplotlib in pages: rows with names, decades, lines of failed trials."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from perilune.analysis.documents.common.colours import INK
from perilune.analysis.documents.common.quantities import log_tick
from perilune.analysis.documents.interactive.measures import FAILED_DASHES

FAILED: dict[str, Any] = {"color": INK, "linestyle": (0, FAILED_DASHES)}


def label_lanes(axes: Axes, labels: Sequence[str]) -> None:
    """Label horizontal lanes, the first at the top."""
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def log_ticks_x(axes: Axes) -> None:
    """Make the abscissa logarithmic, with a handful of whole decades marked."""
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(numticks=6))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(log_tick))
