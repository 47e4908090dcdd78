"""Lines of figures that know which quantity they show, so that a page can name it at the cursor."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D


class QuantityLine(Line2D):
    """A line over time or over another quantity.

    ``quantity`` is in SI, [rows]; it is drawn times ``factor``, in ``unit`` as displayed. ``time`` (s, [rows]) is
    given where the abscissa is another quantity; ``metric`` where the line is its distribution over the trials of the
    variant ``name``.
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
    """Marks of trials of a ``variant``: those that succeeded or the others, over two columns of its trials by name."""

    def __init__(
        self, x: np.ndarray, y: np.ndarray, *, variant: str, names: tuple[str, str], success: bool, **style: Any
    ) -> None:
        super().__init__(x, y, **style)
        self.variant = variant
        self.names = names
        self.success = success
