"""Diagrams as SVG, in a page and as files."""

from __future__ import annotations

from dataclasses import replace

from markupsafe import Markup

from ..chart.svg.fluid import POINT
from ..chart.write_svg import write_svg
from ..interactive.charts import Fluid
from ..pictures import Diagram

NO_MARGINS = (0.0, 0.0, 0.0, 0.0)


def diagram_svg(diagram: Diagram) -> Markup:
    """Return a diagram as an <svg> element of its size, reproducible to the byte."""
    chart, width, height = diagram.draw()
    fluid = replace(chart, fluid=Fluid(NO_MARGINS, POINT))
    svg = write_svg(fluid, diagram.name, diagram.words, width, height)
    size = f'width="{POINT * width:g}" height="{POINT * height:g}"'
    return Markup('<svg xmlns="http://www.w3.org/2000/svg" {}>{}</svg>').format(Markup(size), svg)
