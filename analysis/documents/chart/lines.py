"""Lines of charts in the look of a series or a style, in units of the axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..interactive.charts import Curve
from ..interactive.measures import LINE_WIDTH


def line(
    x: np.ndarray,
    y: np.ndarray,
    colour: str,
    *,
    width: float = LINE_WIDTH,
    dashes: Sequence[float] = (),
    opacity: float = 1.0,
    steps: bool = False,
    name: str = "",
    unit: str = "",
    metric: str = "",
) -> Curve:
    """Return a line through points, [rows]; dashes are in multiples of the line width, ``unit`` is the displayed unit.

    With ``metric`` the line is the distribution of this column over the trials of the variant ``name``.
    """
    return Curve(
        x=np.asarray(x, dtype=float),
        y=np.asarray(y, dtype=float),
        factor=1.0,
        name=name,
        unit=unit,
        colour=colour.lower(),
        opacity=opacity,
        width=width,
        dashes=dashes,
        steps=steps,
        joined=True,
        metric=metric,
    )
