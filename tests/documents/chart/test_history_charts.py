"""Charts of signals over time, and their pictures.

Truth: the same panels drawn by matplotlib, read back from its figure; points of the path by linear interpolation
between the ends of the axes.
"""

from __future__ import annotations

import re
from dataclasses import fields, replace

import numpy as np
import pytest
from lxml import etree

import perilune
from perilune.analysis.campaigns.verdicts.order_statistics import quantiles
from perilune.analysis.documents.chart.panel import chart_panel
from perilune.analysis.documents.chart.svg.polyline import path_of
from perilune.analysis.documents.common.colours import FAINT
from perilune.analysis.documents.common.panels import PANEL_WIDTH
from perilune.analysis.documents.common.quantities import display_factor, number
from perilune.analysis.documents.common.signals import signal_groups
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.documents.interactive.columns import Coarse
from perilune.analysis.documents.of.simulation.histories import HEIGHT, SPIKE, _is_constant, history_chart
from tests.support.figures.lines import plot_quantity
from tests.support.figures.read_figure import read_charts
from tests.support.lengths import either

SYSTEMS = either(("landing_mission", "satellite_pointing", "robot_rendezvous"), ("satellite_pointing",))
FLOATS = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")


def read_back(group, run, reduced):
    """Return the chart of a panel that matplotlib draws."""
    with house_style():
        figure = new_figure(HEIGHT, PANEL_WIDTH)
        axes = figure.subplots()
        values = group.values(run)
        style = "default" if group.is_real else "steps-post"
        for index, (name, row) in enumerate(zip(group.labels if group.is_named else group.names, values, strict=True)):
            plot_quantity(axes, run.time, row, name, group.unit, index, drawstyle=style)
        axes.set_xlabel("time, s")
        plain_ticks(axes, x=5, y=4, whole_y=not group.is_real)
        if group.type == "Boolean":
            axes.set_yticks([0, 1], ["false", "true"])
            axes.set_ylim(-0.15, 1.15)
        elif group.is_real:
            clip_spikes(axes, display_factor(group.unit) * values)
        (chart,) = read_charts(figure, reduced=reduced)
    return chart


def clip_spikes(axes, values):
    finite = values[np.isfinite(values)]
    if not finite.size:
        axes.text(0.5, 0.5, "no finite value", transform=axes.transAxes, ha="center", va="center", color=FAINT)
        return
    low, high = quantiles(finite, [0.01, 0.99])
    if not (high > low and finite.max() - finite.min() > SPIKE * (high - low)):
        return
    margin = 0.15 * (high - low)
    axes.set_ylim(low - margin, high + 3.0 * margin)
    outside = np.any((values < low - margin) | (values > high + 3.0 * margin), axis=0)
    early = np.mean(np.flatnonzero(outside)) < values.shape[1] / 2
    text = f"clipped; full range {number(float(finite.min()), 3)} to {number(float(finite.max()), 3)}"
    style = {"ha": "right" if early else "left", "va": "top", "fontsize": 8.0, "color": FAINT}
    axes.text(0.98 if early else 0.02, 0.98, text, transform=axes.transAxes, **style)


APART = ("box", "fluid", "few", "signal")  # laid out by either in its own way, or no picture has it


def plain(node):
    """Return numbers and texts alone, rounded as pages have them."""
    if isinstance(node, Coarse):
        return plain(node.numbers)
    if isinstance(node, np.ndarray):
        return np.float32(node).tobytes()
    if isinstance(node, float):
        return float(f"{node:.10g}")
    if isinstance(node, list | tuple):
        return [plain(each) for each in node]
    if hasattr(node, "__dataclass_fields__"):
        return {each.name: plain(getattr(node, each.name)) for each in fields(node) if each.name not in APART}
    return node


def charts_of(run, reduced=False):
    for group in signal_groups(run):
        if not _is_constant(group, run):
            (chart,) = chart_panel("a", "a", "a", history_chart(group, run), HEIGHT, reduced=reduced).figure.charts
            yield group, chart


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("system", SYSTEMS)
def test_constructed_equals_read_back(system):
    run = perilune.simulate(system)
    number_of_charts = 0
    for group, chart in charts_of(run, reduced=True):
        if number_of_charts % 5 == 0:  # each takes a tenth of a second
            assert plain(chart) == plain(read_back(group, run, reduced=True)), group.label
        number_of_charts += 1
    assert number_of_charts > 20


@pytest.fixture(scope="module")
def odd(fmus):
    """Return a run whose signals have spikes, gaps, lone samples and nothing finite."""
    run = perilune.simulate("satellite_pointing", stop_time=20.0)
    names = [name for name in run.signals if run.types[name] == "Real" and "[" not in name][:5]
    size = run.time.size
    rows = np.random.default_rng(20251).normal(size=(5, size))
    rows[0, 3] = 500.0
    rows[1, 20:40] = np.nan
    rows[2, :] = np.nan
    rows[2, 7] = 1.0
    rows[3, :] = np.nan
    rows[4, size - 3] = np.inf
    return replace(run, signals={**run.signals, **dict(zip(names, rows, strict=True))}), names


def test_odd_signals(odd):
    run, names = odd
    observed = {group.names[0]: (group, chart) for group, chart in charts_of(run)}
    for name in names:
        group, chart = observed[name]
        assert plain(chart) == plain(read_back(group, run, reduced=False)), name
    assert observed[names[3]][1].notes[0].text == "no finite value"
    assert observed[names[0]][1].notes[0].text.startswith("clipped; full range ")
    assert observed[names[2]][1].curves[0].marker is not None


def test_the_picture_has_the_texts_and_points_of_the_chart(odd):
    run, names = odd
    (group,) = [group for group in signal_groups(run) if group.names == (names[1],)]
    figure = chart_panel("a", "spike", "what it shows", history_chart(group, run), HEIGHT).figure
    (chart,) = figure.charts
    root = etree.fromstring(str(figure.svg))
    texts = root.xpath("//*[local-name()='text']/text()")
    ticks = [text for axis in (chart.x, chart.y) for _, text in axis.ticks]
    assert texts == [*ticks, "time, s"]
    assert root.get("aria-label") == "what it shows"
    wide, high = (float(each) for each in root.xpath("//*[@viewBox][@fill='none']/@viewBox")[0].split()[2:])
    path = root.xpath("//*[@stroke-linejoin]/@d")[0]
    strokes = [stroke for stroke in path.split("M") if stroke]
    assert len(strokes) == 2  # on either side of the gap
    numbers = [float(each) for each in FLOATS.findall(strokes[1].partition("l")[0])]
    for axis, at, size in ((chart.x, run.time[40], wide), (chart.y, run[names[1]][40], high)):
        part = (at - axis.ends[0]) / (axis.ends[1] - axis.ends[0])
        expected = (part if axis is chart.x else 1.0 - part) * size
        assert numbers.pop(0) == pytest.approx(expected, abs=0.06)


@pytest.mark.parametrize("rows", [5, 300, 50_000])
def test_a_path_reaches_all_extremes(rows):
    x = np.linspace(0.0, 200.0, rows)
    y = np.random.default_rng(rows).uniform(0.0, 100.0, rows)
    path = path_of(x, y, steps=False, width=200.0)
    points = np.array([float(each) for each in FLOATS.findall(path)]).reshape(-1, 2).cumsum(axis=0)
    assert points[:, 1].min() == pytest.approx(y.min(), abs=0.3)
    assert points[:, 1].max() == pytest.approx(y.max(), abs=0.3)
    assert (points[0, 0], points[-1, 0]) == pytest.approx((0.0, 200.0), abs=1.0)
    assert len(path) < 9000


def test_steps_hold_until_the_next_row():
    path = path_of(np.array([0.0, 1.0, 2.0, 3.0]), np.array([5.0, 5.0, 8.0, 8.0]), steps=True, width=3.0)
    assert path == "M0 5l2 0 0 3 1 0"
