"""matplotlib's figure as a page's element, with its charts read back: an oracle of constructed ones."""

from __future__ import annotations

from matplotlib.figure import Figure

from docs.figures.inline_svg import inline_svg as svg_of
from perilune.analysis.reports.interactive.charts import Drawing
from tests.support.figures.read_figure import read_charts


def inline_svg(figure: Figure, name: str, description: str, *, reduced: bool = False) -> Drawing:
    """Return the element and the charts of a figure; ``reduced``: envelopes of its lines."""
    return Drawing(svg_of(figure, name, description), read_charts(figure, reduced=reduced))
