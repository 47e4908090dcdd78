"""Charts of errors, curves and bands that the shipped systems declare.

Truth: the same plots drawn by matplotlib, read back from its figures.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

import perilune
from perilune.analysis.documents.figures.declared import BandFigure, CurveFigure, ErrorFigure
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.documents.chart.matplotlib_histories import band_charts, curve_charts, error_charts
from tests.documents.chart.test_history_charts import plain
from tests.support.documents.subsections import figure_sections
from tests.support.lengths import either

SYSTEMS = ("satellite_pointing", "orbital_attitude", "hover_transfer", "entry_attitude", "landing_mission")
BY_MATPLOTLIB = {ErrorFigure: error_charts, CurveFigure: curve_charts, BandFigure: band_charts}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("system", either(SYSTEMS, SYSTEMS[:3]))
def test_constructed_equals_read_back(system):
    run = perilune.simulate(system)
    figures = [each for each in read_figures(prepare_system(system, SystemOptions())) if type(each) in BY_MATPLOTLIB]
    assert figures
    for figure, section in zip(figures, figure_sections(figures, run), strict=True):
        expected_charts = BY_MATPLOTLIB[type(figure)](figure, run)
        plotted = [panel.figure for panel in section.panels] if section.panels else [section.plot]
        for picture, expected in zip(plotted[: len(expected_charts)], expected_charts, strict=True):
            (chart,) = picture.charts
            assert plain(replace(chart, title="")) == plain(expected), figure.title
        assert len(plotted) == len(expected_charts) + (len(figure.against) if isinstance(figure, BandFigure) else 0)
