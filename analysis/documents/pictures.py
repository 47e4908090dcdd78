"""Nodes of a document that are drawn: figures, diagrams, scenes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:  # figures double the start-up time of verbs without figures
    from markupsafe import Markup
    from matplotlib.figure import Figure as Drawing

    from .cell import LegendEntry
    from .chart.write_svg import TrialPositions
    from .common.colours import Look
    from .diagram.diagram import BlockDiagram
    from .interactive.charts import Chart


@dataclass(frozen=True)
class Figure:
    """A chart of ``height`` (in); ``name`` is unique in its document, and ``words`` are the text for screen readers.

    ``is_wide`` fills the width of the page; ``is_narrow`` puts three instead of two in a row. ``below`` is a second
    chart over the same abscissa. ``look`` is the look of the object that the label names. ``legend`` is for this figure
    alone. ``is_printed`` includes it on paper. ``trials`` returns the positions of marks of trials.
    """

    label: str
    name: str
    words: str
    chart: Chart
    height: float
    is_wide: bool = False
    is_narrow: bool = False
    legend: Sequence[LegendEntry] = ()
    below: Chart | None = None
    look: Look | None = None
    is_printed: bool = True
    is_reduced: bool = False  # a page contains only envelopes of the curves
    trials: TrialPositions | None = None


@dataclass(frozen=True)
class Figures:
    """Figures side by side with one legend; ``draw`` is called only where they are shown.

    ``is_in_order`` means that legend entries are in the order of each figure's first lines, which may be unnamed.
    """

    kind: ClassVar[str] = "figures"
    draw: Callable[[], Sequence[Figure]]
    legend: Sequence[LegendEntry] = ()
    is_in_order: bool = False


@dataclass(frozen=True)
class Diagram:
    """A drawing without axes; ``draw`` returns it with its width and height (pt), which are constant on a page.

    ``name`` is unique in its document; ``words`` are the text for screen readers.
    """

    kind: ClassVar[str] = "diagram"
    name: str
    words: str
    draw: Callable[[], tuple[Chart, float, float]]


@dataclass(frozen=True)
class Plot:
    """A figure drawn by matplotlib, which a notebook shows in place of the charts."""

    kind: ClassVar[str] = "plot"
    draw: Callable[[], Drawing | None]


@dataclass(frozen=True)
class Blocks:
    """The block diagram of a system."""

    kind: ClassVar[str] = "blocks"
    diagram: BlockDiagram


@dataclass(frozen=True)
class Scene:
    """A three-dimensional view that a page's script rotates and plays; without a script its first and last picture."""

    kind: ClassVar[str] = "scene"
    view: Any
    pictures: Sequence[tuple[float, Markup]] = ()
    notes: Sequence[str] = ()
