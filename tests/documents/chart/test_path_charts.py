"""Charts of paths, and of bands over another signal.

Truth: the same charts drawn by matplotlib, read back from its figures.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.documents.common.panels import HALF_WIDTH
from perilune.analysis.documents.interactive.measures import WIDTH
from perilune.analysis.documents.of.simulation.figures.band_figure import against_chart
from perilune.analysis.documents.of.simulation.figures.path_figure import HEIGHT, WIDE_INTERVALS
from perilune.analysis.documents.of.simulation.figures.section import HEIGHT as PANEL_HEIGHT
from tests.documents.chart import matplotlib_paths
from tests.documents.chart.test_history_charts import plain
from tests.support.documents.subsections import figure_sections
from tests.support.pages.mission_samples import PATH, mission
from tests.support.pages.own_samples import ANGLES, TIME, angles, flown, scalar


@pytest.mark.parametrize("rows", [PATH.rows, None])
@pytest.mark.parametrize("factor", [1.0, 400.0])
def test_a_path(rows, factor):
    path = replace(PATH, equal=False, rows=rows)
    names = [f"ship.{each}" for each in ("x", "y", "site_x", "site_y")]
    run = mission()
    run = replace(run, signals=run.signals | {name: factor * run[name] for name in names})
    (section,) = figure_sections([path], run)
    (chart,) = section.plot.charts
    assert [curve.name for curve in chart.curves] == ["ship.y", "", "site", "site"]
    unnamed = [chart.curves[0], *(replace(curve, name="") for curve in chart.curves[1:])]
    expected = matplotlib_paths.path_chart(path, run, HEIGHT, WIDTH, WIDE_INTERVALS)
    assert plain(replace(chart, curves=unnamed, title="")) == plain(expected)


def test_a_band_over_another_signal():
    height = scalar("ship.height")
    run = flown(angles=angles(), height=1e5 - np.sin(TIME) * TIME)
    expected = matplotlib_paths.against_chart(ANGLES, run, height, PANEL_HEIGHT, HALF_WIDTH)
    assert plain(against_chart(ANGLES, run, height)) == plain(expected)
