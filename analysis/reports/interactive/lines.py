"""Lines of figures that know which quantity they show, so that a page can name it at the cursor."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D


class QuantityLine(Line2D):
    """A line over time or over another quantity.

    ``quantity`` is in SI, [rows]; it is drawn times ``factor``, in ``unit`` as displayed. ``time`` (s, [rows]) is
    given where the abscissa is another quantity.
    """

    def __init__(
        self,
        x: np.ndarray,
        quantity: np.ndarray,
        *,
        name: str,
        unit: str = "",
        factor: float = 1.0,
        time: np.ndarray | None = None,
        **style: Any,
    ) -> None:
        super().__init__(x, factor * quantity, **style)
        self.name = name
        self.unit = unit
        self.factor = factor
        self.quantity = quantity
        self.time = time
