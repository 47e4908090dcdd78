"""The nodes of a document that are drawn: figures, diagrams, scenes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:  # figures take as long to import as a verb without any takes to answer
    from markupsafe import Markup
    from matplotlib.figure import Figure as Drawing

    from .cell import LegendEntry
    from .chart.write_svg import TrialPositions
    from .common.colours import Look
    from .diagram.diagram import BlockDiagram
    from .interactive.charts import Chart


@dataclass(frozen=True)
class Figure:
    """A chart of ``height`` (in); ``name`` is unique in its document, ``words`` describe it for blind readers.

    ``is_wide``: as wide as the page; ``is_narrow``: three in a row of a wide page, not two. ``below`` is a second chart
    over the same abscissa. ``look``: that of what the label names. ``legend`` is that of this figure alone.
    ``is_printed``: on paper, too. ``trials`` returns the positions of marks of trials.
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
    is_reduced: bool = False  # a page has only envelopes of its curves
    trials: TrialPositions | None = None


@dataclass(frozen=True)
class Figures:
    """Figures next to each other with one legend; ``draw`` them only where they show.

    ``is_in_order``: entries of the legend are for the first lines of each figure, which may have no names.
    """

    kind: ClassVar[str] = "figures"
    draw: Callable[[], Sequence[Figure]]
    legend: Sequence[LegendEntry] = ()
    is_in_order: bool = False


@dataclass(frozen=True)
class Diagram:
    """A drawing without axes; ``draw`` returns it with its width and height (pt), which it has at any width of a page.

    ``name`` is unique in its document, ``words`` are its text for screen readers.
    """

    kind: ClassVar[str] = "diagram"
    name: str
    words: str
    draw: Callable[[], tuple[Chart, float, float]]


@dataclass(frozen=True)
class Plot:
    """A figure that matplotlib draws, for a notebook in the place of the charts."""

    kind: ClassVar[str] = "plot"
    draw: Callable[[], Drawing | None]


@dataclass(frozen=True)
class Blocks:
    """The block diagram of a system."""

    kind: ClassVar[str] = "blocks"
    diagram: BlockDiagram


@dataclass(frozen=True)
class Scene:
    """A view in space that a page's script turns and plays, and its first and last picture where there is no script."""

    kind: ClassVar[str] = "scene"
    view: Any
    pictures: Sequence[tuple[float, Markup]] = ()
    notes: Sequence[str] = ()
