"""Figures as SVG documents for files and notebooks, reproducible to the byte."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

IMAGE_DPI = 200  # resolution of raster images


class Picture(Figure):
    """A matplotlib figure that a notebook displays as the result of a cell."""

    def _repr_svg_(self) -> str:
        return svg_bytes(self, "notebook", text_as_paths=True).decode()


def svg_bytes(figure: Figure, name: str, *, text_as_paths: bool) -> bytes:
    """Return a figure as an SVG document without date or version; ``name`` makes its identifiers unique."""
    buffer = io.BytesIO()
    settings: Any = {"svg.hashsalt": name, "svg.fonttype": "path" if text_as_paths else "none"}
    with matplotlib.rc_context(settings), _lay_out(figure) as canvas:
        canvas.print_svg(buffer, metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


@contextmanager
def _lay_out(figure: Figure) -> Iterator[FigureCanvasSVG]:
    """Yield the canvas of a figure with its layout computed, which saves a complete drawing in savefig."""
    before, dpi, engine = figure.canvas, figure.dpi, figure.get_layout_engine()
    canvas = FigureCanvasSVG(figure)  # the layout measures its text
    try:
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine("none")
        figure.dpi = IMAGE_DPI
        yield canvas
    finally:
        if engine is not None:
            figure.set_layout_engine(engine)
        figure.set_canvas(before)
        figure.dpi = dpi
