"""A diagram as SVG, in a page and as a file."""

from __future__ import annotations

from markupsafe import Markup

from ...reports.chart.write_svg import write_svg
from ..model import Diagram


def diagram_svg(diagram: Diagram) -> Markup:
    """Return a diagram as an <svg> element of its size; equal diagrams have equal elements."""
    chart, width, height = diagram.draw()
    svg = write_svg(chart, diagram.name, diagram.words, width, height)
    return Markup('<svg width="{}pt" height="{}pt" {}').format(f"{width:g}", f"{height:g}", svg.removeprefix("<svg "))
