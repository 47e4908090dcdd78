"""Scatter plots of two metrics on the page of a batch, and the number of trials with each status.

Truth: hand-written outcomes, whose marks are counted in the figure, and the positions of its ticks.
"""

import contextlib
import math
import re
from collections import Counter
from dataclasses import replace

import numpy as np
from lxml import etree

from perilune.analysis.documents.of.batch.scatters import scatter_nodes, scatter_title
from perilune.analysis.documents.of.campaign.statuses import component_statuses
from perilune.analysis.documents.render.cell_markup import rich_markup
from perilune.analysis.documents.render.html import panel_of
from tests.support.pages.checks import assert_self_contained, parse, text_of
from tests.support.pages.samples import DRAWS, batch_result, write_batch_page

PLANE = """
[metric.east]
expression = "ship.position[1]"
reduction = "final"
unit = "{0}"
[metric.north]
expression = "ship.position[2]"
reduction = "final"
unit = "{1}"
[success]
expression = "east < 9"
[scatter.contact]
x = "east"
y = "north"
{2}
"""
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
NEAR = [(True, 1.0, 2.0), (True, -3.0, 0.5), (False, 12.0, 0.0), (False, math.nan, 0.0)]
FAR = [(True, 5.0, 5.0)] * 4
CONTACTS = PLANE.format("m", "m", 'circle = 10\ntitle = "Contact points"')


def paths(figure):
    """Return the paths of the figure of each colour of marks: successes as strokes without length, failures as
    crosses."""
    root = etree.fromstring(figure)
    return {
        colour: " ".join(root.xpath(f"//*[local-name()='path'][@stroke='{colour}']/@d"))
        for colour in ("#9a9a9a", "#d55e00")
    }


def plotted(batch):
    """Return the title of the only scatter plot of a batch, its panels and its notes as markup."""
    (scatter,) = batch.plan.campaign.scatters
    figures, *notes = scatter_nodes(batch, scatter)
    return (
        scatter_title(scatter),
        list(map(panel_of, figures.draw())),
        [str(rich_markup(each.content)) for each in notes],
    )


def test_every_finite_trial_has_its_mark():
    title, panels, notes = plotted(batch_result({"near": NEAR, "far": FAR[:1]}, DRAWS + CONTACTS))
    assert title == "Contact points"
    assert [panel.label for panel in panels] == ["near: 2 of 4 failed", "far: 0 of 1 failed"]
    near, far = (paths(panel.figure.svg) for panel in panels)
    assert (near["#9a9a9a"].count("h0"), near["#d55e00"].count("m")) == (2, 2)  # a cross has two strokes
    assert (far["#9a9a9a"].count("h0"), far["#d55e00"]) == (1, "")
    assert notes[1] == 'Dashed: <data value="10.0">10</data> m around the origin.'
    assert notes[2:] == ["near: 1 of 4 trials have no finite value and are not plotted."]


def test_the_circle_is_round_and_to_scale():
    _, panels, _ = plotted(batch_result({"near": NEAR}, DRAWS + CONTACTS))
    root = etree.fromstring(panels[0].figure.svg)
    wide, high = map(float, re.search(r"aspect-ratio:([\d.]+)/([\d.]+)", root.get("style")).groups())
    path = next(path for path in root.xpath("//*[@stroke='#222222']/@d") if path.count("M") > 30)
    starts = np.array([re.findall(NUMBER, stroke)[:2] for stroke in path.split("M")[1:]], dtype=float)
    width, height = np.ptp(starts, axis=0)
    view = root.xpath("//*[@viewBox][@fill='none']/@viewBox")[0].split()
    np.testing.assert_allclose([wide, high], list(map(float, view[2:])))
    ticks_at = {}  # of the texts at the abscissa's ticks, px
    for text in root.xpath("//*[local-name()='g'][@text-anchor='middle']/*[local-name()='text']"):
        with contextlib.suppress(ValueError):
            ticks_at[float(text.text.replace("\N{MINUS SIGN}", "-"))] = (
                float(text.get("x").removesuffix("%")) / 100.0 * wide
            )
    low, high = min(ticks_at), max(ticks_at)
    scale = (ticks_at[high] - ticks_at[low]) / (high - low)
    np.testing.assert_allclose([width, height], 20.0 * scale, rtol=5e-3)


def test_angles_are_in_degrees():
    requested = PLANE.format("rad", "rad", f"circle = {math.pi / 6}")
    title, panels, notes = plotted(batch_result({"near": NEAR}, DRAWS + requested))
    assert title == "north vs. east"
    assert ">30</data> deg around the origin." in notes[1]
    assert "east, deg" in panels[0].figure.svg


def test_units_that_differ_and_nothing_finite(tmp_path):
    _, panels, _ = plotted(batch_result({"near": NEAR}, DRAWS + PLANE.format("m", "kg", "")))
    assert "north, kg" in panels[0].figure.svg
    nothing = batch_result({"lost": [(False, math.nan, math.inf)] * 3}, DRAWS + CONTACTS)
    write_batch_page(nothing, tmp_path / "page.html", "Lost")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert_self_contained(page)
    assert "lost: 3 of 3 trials have no finite value and are not plotted." in text_of(page)


def test_statuses_are_counted_by_component_where_trials_saw_several(tmp_path):
    result = batch_result({"near": NEAR, "far": FAR}, DRAWS + CONTACTS)
    assert component_statuses(result.summary) == []  # the table of ends says it all
    texts = ["finished (hover.status 2, sequencer.status 4)", "finished (hover.status 2)", "finished", "stop_time"]
    result.summary["near"] = replace(result.summary["near"], statuses=Counter(texts))
    rows = [("near", "hover.status", 2, 2, 4), ("near", "sequencer.status", 4, 1, 4)]
    assert [tuple(row) for row in component_statuses(result.summary)] == rows
    write_batch_page(result, tmp_path / "page.html", "Seen")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    (table,) = parse(page).xpath("//h3[text()='Statuses by component']/following-sibling::div[1]/table")
    cells = [[" ".join(cell.text_content().split()) for cell in row.xpath("td")] for row in table.xpath(".//tbody/tr")]
    assert cells == [["near", "hover.status", "2", "2", "50.00"], ["", "sequencer.status", "4", "1", "25.00"]]
