"""Style of matplotlib figures: colours of Okabe and Ito, distinguishable by colour-blind readers, and plain axes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ..interactive import measures
from ..interactive.measures import WIDTH
from .colours import FAINT, GRID, INK
from .quantities import tick
from .svg import Picture

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
    "text.parse_math": False,  # a $ in a name is an ordinary character
}


@contextmanager
def house_style() -> Iterator[None]:
    """Apply the house style to figures created in the context, regardless of the user's matplotlibrc."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        yield


def new_figure(height: float, width: float = WIDTH) -> Picture:
    """Return an empty figure; sizes are in inches."""
    return Picture(figsize=(width, height), layout="constrained")


def plain_ticks(axes: Axes, *, x: int | None = None, y: int | None = None, whole_y: bool = False) -> None:
    """Limit the number of intervals on axes, and label them with plain numbers."""
    if x is not None:
        axes.xaxis.set_major_locator(MaxNLocator(x, steps=[1, 2, 2.5, 5, 10]))
        axes.xaxis.set_major_formatter(FuncFormatter(tick))
    if y is not None:
        axes.yaxis.set_major_locator(MaxNLocator(y, steps=[1, 2, 2.5, 5, 10], integer=whole_y, min_n_ticks=2))
        axes.yaxis.set_major_formatter(FuncFormatter(tick))
