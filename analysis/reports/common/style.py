"""The look of every figure: Okabe and Ito's colours, which colour-blind readers can tell apart, and plain axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypedDict

import matplotlib
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.typing import CapStyleType, LineStyleType

from ..interactive import measures
from ..interactive.measures import WIDTH
from .colours import (  # noqa: F401
    BLUE,
    COLOURS,
    DASHES,
    FAINT,
    GREEN,
    GRID,
    INK,
    MARKERS,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    Look,
    look,
)
from .quantities import log_tick, tick
from .svg import Picture


class LineStyle(TypedDict, total=False):
    """Keyword arguments of matplotlib's lines."""

    color: str
    linestyle: LineStyleType
    linewidth: float
    solid_capstyle: CapStyleType
    marker: str
    markersize: float
    markerfacecolor: str
    markeredgecolor: str
    markeredgewidth: float
    rasterized: bool
    clip_on: bool
    zorder: float


FAILED: LineStyle = {
    "color": INK,
    "linestyle": (0, measures.FAILED_DASHES),
}  # flights that failed, and what is to be expected
SETTINGS: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": measures.LABEL_SIZE,
    "axes.titlesize": measures.LABEL_SIZE,
    "axes.labelsize": measures.LABEL_SIZE,
    "xtick.labelsize": measures.TICK_SIZE,
    "ytick.labelsize": measures.TICK_SIZE,
    "legend.fontsize": 8.5,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "text.color": INK,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "axes.linewidth": measures.AXES_WIDTH,
    "lines.linewidth": measures.LINE_WIDTH,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": measures.GRID_WIDTH,
    "legend.frameon": False,
    "figure.facecolor": "white",
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
    "axes.formatter.use_mathtext": False,
    "axes.unicode_minus": True,
    "text.parse_math": False,  # a $ in a name is a $
}


@contextmanager
def house_style() -> Iterator[None]:
    """Figures made inside have the house style, whatever the user's matplotlibrc says."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        yield


def new_figure(height: float, width: float = WIDTH) -> Picture:
    """An empty figure, sizes in inches."""
    return Picture(figsize=(width, height), layout="constrained")


def plain_ticks(axes: Axes, *, x: int | None = None, y: int | None = None, whole_y: bool = False) -> None:
    """At most so many intervals on an axis, with plain numbers at them."""
    if x is not None:
        axes.xaxis.set_major_locator(MaxNLocator(x, steps=[1, 2, 2.5, 5, 10]))
        axes.xaxis.set_major_formatter(FuncFormatter(tick))
    if y is not None:
        axes.yaxis.set_major_locator(MaxNLocator(y, steps=[1, 2, 2.5, 5, 10], integer=whole_y, min_n_ticks=2))
        axes.yaxis.set_major_formatter(FuncFormatter(tick))


def label_lanes(axes: Axes, labels: Sequence[str], top: float = -0.6, size: float = 9.0) -> None:
    """Labels of horizontal lanes, the first at the top; ``top`` is the end of the axis above it."""
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.4, top)
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0, labelsize=size)


def log_ticks_x(axes: Axes) -> None:
    """A logarithmic abscissa with a handful of whole decades marked."""
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(numticks=6))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(log_tick))
