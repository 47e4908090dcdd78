"""Figures as SVG documents, the same bytes every time; a notebook shows them so."""

from __future__ import annotations

import io
from typing import Any

import matplotlib
from matplotlib.figure import Figure


class Picture(Figure):
    """matplotlib's figure, which a notebook shows where it stands as a cell's result."""

    def _repr_svg_(self) -> str:
        return svg_bytes(self, "notebook", text_as_paths=True).decode()


def svg_bytes(figure: Figure, name: str, *, text_as_paths: bool) -> bytes:
    """A figure as an SVG document without date or version; ``name`` salts its identifiers."""
    buffer = io.BytesIO()
    settings: Any = {"svg.hashsalt": name, "svg.fonttype": "path" if text_as_paths else "none"}
    with matplotlib.rc_context(settings):
        figure.savefig(buffer, format="svg", dpi=200, metadata={"Date": None, "Creator": None})
    return buffer.getvalue()
