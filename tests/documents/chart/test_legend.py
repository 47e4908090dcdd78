"""Legends of charts.

Truth: the curves of the chart.
"""

from __future__ import annotations

import numpy as np
from lxml import etree

from perilune.analysis.documents.chart.axes import linear_axis
from perilune.analysis.documents.chart.legend import legend_of
from perilune.analysis.documents.chart.lines import line
from perilune.analysis.documents.chart.symbols import marker, marks
from perilune.analysis.documents.interactive.charts import NO_BOX, Chart

TIME = np.arange(3.0)


def test_a_legend_has_each_name_once_with_line_and_mark():
    axis = linear_axis((0.0, 2.0), 4)
    curves = [
        line(TIME, TIME, "#0072B2", dashes=(4.0, 2.0), name="dashed"),
        line(TIME, TIME, "#000000"),
        marks(TIME, TIME, marker("D", 6.0, "#D55E00"), name="points"),
    ]
    entries = legend_of([Chart(NO_BOX, axis, axis, curves=curves), Chart(NO_BOX, axis, axis, curves=curves[:1])])
    assert [name for _, name in entries] == ["dashed", "points"]
    dashed, points = (etree.fromstring(swatch) for swatch, _ in entries)
    (stroke,) = dashed.xpath("//path")
    assert stroke.get("stroke") == "#0072b2"
    assert stroke.get("stroke-dasharray") is not None
    (diamond,) = points.xpath("//path")
    assert diamond.get("fill") == "#d55e00"
    assert points.get("aria-hidden") == "true"
