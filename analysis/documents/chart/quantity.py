"""Curves of quantities, with name, unit and exact SI numbers for the page."""

from __future__ import annotations

import numpy as np

from ..common.colours import COLOURS
from ..common.quantities import display_factor, display_unit
from ..interactive.charts import Curve, Marker
from ..interactive.measures import DASHES, LINE_WIDTH

DOT = 3.0  # pt, diameter of the dot for a single sample


def quantity_curve(
    x: np.ndarray, quantity: np.ndarray, name: str, unit: str | None, index: int = 0, *, steps: bool = False
) -> Curve:
    """Return a curve over ``x`` in the look of the index-th series; a single sample is a dot.

    ``quantity`` is in ``unit``, [rows]; non-finite values are omitted. With ``steps`` each value holds until the next
    row.
    """
    finite = np.where(np.isfinite(quantity), quantity, np.nan)
    colour = COLOURS[index % len(COLOURS)].lower()
    is_lone = np.count_nonzero(np.isfinite(finite)) == 1
    return Curve(
        x=x,
        y=finite,
        factor=display_factor(unit),
        name=name,
        unit=display_unit(unit),
        colour=colour,
        opacity=1.0,
        width=LINE_WIDTH,
        dashes=DASHES[index % len(DASHES)],
        steps=steps,
        joined=True,
        marker=Marker(size=DOT, fill=colour, edge=colour, width=1.0) if is_lone else None,
    )
