"""Figure as an SVG document: equal to the output of matplotlib's savefig, without changes to the figure.

Truth: matplotlib's savefig, to the byte.
"""

import io

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure

from perilune.analysis.documents.common.colours import look
from perilune.analysis.documents.common.style import house_style, new_figure
from perilune.analysis.documents.common.svg import svg_bytes
from tests.support.lengths import either


def lines(figure):
    """Draw two axes whose labels need room, and a legend that looks for the best place."""
    for index, axes in enumerate(figure.subplots(1, 2)):
        x = np.linspace(0.1, 50.0, 400)
        axes.plot(x, 1e5 * np.sin(x) / x, color=look(index).colour, label="damped")
        axes.set(xlabel="time, s", ylabel="height,\nm", title=f"figure {index}", yscale=("linear", "symlog")[index])
        axes.legend(loc="best")


def colours(figure):
    """Draw an image, which is no vector, and its colour bar."""
    axes = figure.subplots()
    figure.colorbar(axes.imshow(np.arange(12.0).reshape(3, 4)), label="share")
    axes.set_xlabel("column")


def saved(figure, text_as_paths):
    """Return the output of savefig."""
    content = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "it", "svg.fonttype": "path" if text_as_paths else "none"}):
        figure.savefig(content, format="svg", dpi=200, metadata={"Date": None, "Creator": None})
    return content.getvalue()


@pytest.mark.parametrize("draw", [lines, colours])
@pytest.mark.parametrize("text_as_paths", either([False, True], [True]))
@pytest.mark.parametrize("layout", either(["constrained", "tight", None], ["constrained", None]))
def test_it_is_what_savefig_writes(draw, text_as_paths, layout):
    with house_style():
        ours, theirs = (new_figure(3.0, 6.0) for _ in range(2))
        for figure in (ours, theirs):
            figure.set_layout_engine(layout)
            draw(figure)
        actual = svg_bytes(ours, "it", text_as_paths=text_as_paths)
        assert actual == saved(theirs, text_as_paths)
        assert actual.startswith(b"<?xml")


def test_the_figure_is_as_it_was():
    figure = Figure(figsize=(6.0, 3.0), dpi=90, layout="constrained")
    lines(figure)
    canvas, engine = figure.canvas, figure.get_layout_engine()
    first = svg_bytes(figure, "it", text_as_paths=True)
    assert (figure.canvas, figure.get_layout_engine(), figure.dpi) == (canvas, engine, 90)
    assert svg_bytes(figure, "it", text_as_paths=True) == first
