"""Charts as numbers: axes, lines, areas and notes, which the page's script redraws.

Titles, axis labels and legends remain in the page's SVG and are not included. A page omits fields that are empty by
default and empty in a chart, and all fields with the metadata `PICTURE`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from .columns import Coarse

PICTURE = {"picture": True}  # metadata of fields that only the SVG uses


@dataclass(frozen=True, kw_only=True)
class Axis:
    """An axis: its ends as drawn, the first at the left or bottom, and its ticks with their labels.

    - ``label``: identifier of an abscissa shared by figures.
    - ``named``: True if tick labels are not numbers; ``bare``: True if there are no tick labels.
    - ``size``: text size of tick labels (pt).
    - ``grid``, ``marked``: True if ticks have grid lines, tick marks.
    - ``few``: indices of the ticks that a figure shows up to the width ``narrow`` (px), if not all.
    """

    label: str = ""
    ends: tuple[float, float]
    logarithmic: bool = False
    ticks: Sequence[tuple[float, str]] = ()
    named: bool = False
    bare: bool = False
    size: float
    grid: bool = False
    marked: bool = False
    few: Sequence[int] = ()
    narrow: int | None = None


@dataclass(frozen=True, kw_only=True)
class Marker:
    """A mark at points of a line: a circle of diameter ``size`` (pt), or the strokes ``outline`` in multiples of it.

    A stroke is a sequence x, y, x, y, ...; ``fill`` and ``edge`` are colours, empty for none.
    """

    size: float
    outline: Sequence[Sequence[float]] = ()
    fill: str = ""
    edge: str = ""
    width: float


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A line through ``x`` and ``factor`` * ``y``.

    - ``signal``: name of the signal, if it differs from ``name``.
    - ``time``: times (s), if the abscissa is another quantity.
    - ``metric``: metric of which the line is the distribution over the trials of a variant.
    - ``reduced``: True if the line is an envelope.
    - ``beyond``: True if marks are not clipped at the axes.
    """

    x: np.ndarray
    y: np.ndarray | Coarse
    factor: float
    time: np.ndarray | None = None
    name: str = ""
    signal: str = ""
    unit: str = ""
    colour: str
    opacity: float
    width: float
    dashes: Sequence[float] = ()
    steps: bool = False
    joined: bool = False
    marker: Marker | None = None
    beyond: bool = False
    reduced: bool = False
    metric: str = ""

    @property
    def displayed(self) -> np.ndarray:
        """The ordinates in ``unit``, [rows]."""
        numbers: np.ndarray = self.factor * (self.y.numbers if isinstance(self.y, Coarse) else self.y)
        return numbers


@dataclass(frozen=True, kw_only=True)
class Dots:
    """Marks of the successful or the failed trials of a variant, as a ``cross`` or a filled circle."""

    variant: str
    names: tuple[str, str]
    success: bool = False
    colour: str
    size: float
    cross: bool = False


@dataclass(frozen=True)
class Area:
    """A filled polygon, or strokes between points 1 and 2, 3 and 4, ...; coordinates are of the data or of the axes."""

    x: np.ndarray
    y: np.ndarray
    of_axes: tuple[bool, bool]
    colour: str
    opacity: float
    stroke: float
    dashes: Sequence[float] = ()


@dataclass(frozen=True, kw_only=True)
class Rule:
    """A straight line across the axes at ``at``, an abscissa if ``upright``, else an ordinate."""

    at: float
    upright: bool = False
    colour: str
    width: float
    dashes: Sequence[float] = ()


@dataclass(frozen=True)
class Backing:
    """The background of a text: a rectangle that extends beyond it by ``margin`` (pt)."""

    colour: str
    opacity: float
    margin: float


@dataclass(frozen=True)
class ChartNote:
    """A text at a point with coordinates of the data or of the axes, ``offset`` (pt) to the right and up."""

    text: str
    at: tuple[float, float]
    of_axes: tuple[bool, bool]
    offset: tuple[float, float]
    align: tuple[str, str]
    colour: str
    size: float
    bold: bool = False
    backing: Backing | None = None


@dataclass(frozen=True)
class Fluid:
    """Margins of a figure of variable width: distances (px) of its axes from its left, top, right and bottom.

    ``point`` is the size of a pt in px. With ``to_scale`` the height follows the width, so the aspect ratio is
    constant.
    """

    margins: tuple[float, float, float, float]
    point: float
    to_scale: bool = field(default=False, metadata=PICTURE)


NO_BOX = (0.0, 0.0, 0.0, 0.0)  # box of a chart that has not been laid out


@dataclass(frozen=True)
class Chart:
    """A pair of axes with their content.

    ``box`` is the plotting area as left, top, width and height, in fractions of the figure; with ``fluid`` margins it
    applies to a figure on a wide screen. ``title`` is above the axes. A chart that is a ``picture`` has no data for the
    page's script, which only marks the cursor in it.
    """

    box: tuple[float, float, float, float] = field(metadata=PICTURE)
    x: Axis
    y: Axis
    title: str = ""
    picture: bool = False
    fluid: Fluid | None = None
    curves: Sequence[Curve] = ()
    dots: Sequence[Dots] = ()
    areas: Sequence[Area] = ()
    rules: Sequence[Rule] = ()
    notes: Sequence[ChartNote] = ()


class Drawing(NamedTuple):
    """A figure as an <svg> element and as data; ``below`` is a second figure over the same abscissa."""

    svg: Markup
    charts: list[Chart]
    below: Drawing | None = None

    def __html__(self) -> str:
        return self.svg

    @property
    def drawings(self) -> list[Drawing]:
        """The figure and all figures below it."""
        return [self, *([] if self.below is None else self.below.drawings)]
