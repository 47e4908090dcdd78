"""A figure as numbers: the form of its axes, lines, areas and notes, from which the page's script draws them again.

Titles, labels of axes and legends are not in it: they remain where the figure's picture has them. Fields with an empty
default are left out of a page where they are empty, those of `PICTURE` always.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from .columns import Coarse

PICTURE = {"picture": True}  # the metadata of a field that the picture alone is made of


@dataclass(frozen=True, kw_only=True)
class Axis:
    """An axis: its ends as drawn, the first at the left or the bottom, and its ticks in between with their texts.

    ``label`` is what figures that share an abscissa have in common; ``named`` where texts are no numbers, ``bare``
    where ticks have none; ``size`` (pt) is that of the texts; ``grid`` and ``marked`` where ticks have lines, strokes;
    ``few`` are the numbers of those ticks that a figure has up to the width ``narrow`` (px), where it has not all.
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
    """A mark at points of a line: a circle of diameter ``size`` (pt), or the strokes ``outline`` in units of it.

    A stroke is abscissas and ordinates in turn. ``fill`` and ``edge`` are colours, empty where nothing is drawn.
    """

    size: float
    outline: Sequence[Sequence[float]] = ()
    fill: str = ""
    edge: str = ""
    width: float


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A line; ``signal`` where its ``name`` is not that of the signal; ``time`` (s) where its abscissa is another
    quantity; ``reduced`` where it is the envelope of its rows;
    ``metric`` where it is the distribution of that over the trials of a variant; ``beyond`` where marks reach beyond
    the area of the axes.
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
    """Marks of trials, `TrialDots`; ``cross`` or a filled circle."""

    variant: str
    names: tuple[str, str]
    success: bool = False
    colour: str
    size: float
    cross: bool = False


@dataclass(frozen=True)
class Area:
    """A filled polygon, or strokes from each second point to the next; a coordinate is of the data or of the axes."""

    x: np.ndarray
    y: np.ndarray
    of_axes: tuple[bool, bool]
    colour: str
    opacity: float
    stroke: float
    dashes: Sequence[float] = ()


@dataclass(frozen=True, kw_only=True)
class Rule:
    """A straight line across the axes, at ``at`` of the abscissa (``upright``) or of the ordinate."""

    at: float
    upright: bool = False
    colour: str
    width: float
    dashes: Sequence[float] = ()


@dataclass(frozen=True)
class Backing:
    """The background of a text: a rectangle that is larger by ``margin`` (pt) on each side."""

    colour: str
    opacity: float
    margin: float


@dataclass(frozen=True)
class ChartNote:
    """A text at a point, each coordinate of the data or of the axes, ``offset`` (pt) from it to the right and up."""

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
    """A figure of any width: its axes keep their distances (px) from its left, top, right and bottom.

    ``point``: px of a pt. ``to_scale``: its height follows its width, so that the axes keep the ratio of their lengths.
    """

    margins: tuple[float, float, float, float]
    point: float
    to_scale: bool = field(default=False, metadata=PICTURE)


NO_BOX = (0.0, 0.0, 0.0, 0.0)  # of a chart that has not been laid out


@dataclass(frozen=True)
class Chart:
    """A pair of axes; ``box`` is left, top, width and height of their area as fractions of the figure.

    With ``fluid`` margins they are those of a figure as wide as on a wide screen. The ``title`` stands above the axes.

    A ``picture`` is one of a figure that is not stated in full: the page's script marks the cursor in it.
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
    """A figure as an <svg> element, and what it shows as data; ``below`` is one below it over the same abscissa."""

    svg: Markup
    charts: list[Chart]
    below: Drawing | None = None

    def __html__(self) -> str:
        return self.svg

    @property
    def drawings(self) -> list[Drawing]:
        """The figure and those below it."""
        return [self, *([] if self.below is None else self.below.drawings)]
