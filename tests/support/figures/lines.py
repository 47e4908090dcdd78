"""Lines of quantities in figures, with name, unit and exact SI numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from perilune.analysis.documents.chart.plot_lines import QuantityLine
from perilune.analysis.documents.common.colours import look
from perilune.analysis.documents.common.quantities import display_factor, display_unit


def plot_quantity(
    axes: Axes,
    x: np.ndarray,
    quantity: np.ndarray,
    name: str,
    unit: str | None,
    index: int = 0,
    *,
    time: np.ndarray | None = None,
    **style: Any,
) -> None:
    """Draw a line over ``x`` in the look of the index-th series; a lone point as a dot.

    ``quantity`` in ``unit``, [rows]; what is not finite is left out. ``time`` (s) is needed where ``x`` is another
    quantity; ``style`` is matplotlib's.
    """
    finite = np.where(np.isfinite(quantity), quantity, np.nan)
    factor, displayed = display_factor(unit), display_unit(unit)
    _add(
        axes,
        QuantityLine(x, finite, name=name, unit=displayed, factor=factor, time=time, **_style(finite, index), **style),
    )


def plot_path(
    axes: Axes, x: np.ndarray, y: np.ndarray, name: str, time: np.ndarray, index: int = 0, **style: Any
) -> None:
    """Draw a path in the look of the index-th series, a lone point as a dot; ``x`` and ``y`` in the axes' units."""
    _add(axes, QuantityLine(x, y, name=name, time=time, **_style(y, index), **style))


def _style(y: np.ndarray, index: int) -> dict[str, Any]:
    colour, dashes, _ = look(index)
    is_lone = np.count_nonzero(np.isfinite(y)) == 1
    return {"color": colour, "linestyle": dashes, "marker": "." if is_lone else ""}


def _add(axes: Axes, line: QuantityLine) -> None:
    axes.add_line(line)
    axes.autoscale_view()
