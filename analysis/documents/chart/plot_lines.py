"""Lines of matplotlib figures with the quantity that they show, which a page names at the cursor."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D


class QuantityLine(Line2D):
    """A line over time or over another quantity.

    ``quantity`` is in SI, [rows]; ``factor`` converts it to the drawn ``unit``. ``time`` (s, [rows]) is stated if the
    abscissa is another quantity. ``metric`` is stated if the line is the distribution of this metric over the trials of
    the variant ``name``.
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
        metric: str = "",
        **style: Any,
    ) -> None:
        super().__init__(x, factor * quantity, **style)
        self.name = name
        self.unit = unit
        self.factor = factor
        self.quantity = quantity
        self.time = time
        self.metric = metric


class TrialDots(Line2D):
    """Marks of the successful or the failed trials of a ``variant`` over two columns, ``names``."""

    def __init__(
        self, x: np.ndarray, y: np.ndarray, *, variant: str, names: tuple[str, str], success: bool, **style: Any
    ) -> None:
        super().__init__(x, y, **style)
        self.variant = variant
        self.names = names
        self.success = success
