"""Small figures of one size, side by side on a page, or below each other on a narrow screen.

A figure fills its container, and its text is at least 11 px high at any width.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from ..interactive.charts import Drawing, Marker
from .colours import Look

PANEL_WIDTH = 3.24  # in (99 px each); three panels fill the page's column
PANEL_HEIGHT = 2.5  # in
HALF_WIDTH = 4.95  # in; two in the page's column
SWATCH = 6.0  # px, the size of a mark in a legend
KILOMETRES = 1e4  # m, least length displayed in km


class FigurePanel(NamedTuple):
    """A figure with its label as heading, the label's look if it names a variant, and its legend."""

    label: str
    figure: Drawing
    legend: Sequence[tuple[Markup, str]] = ()


def choose_length_unit(values: np.ndarray) -> tuple[float, str]:
    """Return factor and unit to display lengths in m: km if any length is long, else m."""
    return (1e-3, "km") if values.size and np.nanmax(np.abs(values)) >= KILOMETRES else (1.0, "m")


def swatch(look: Look) -> Markup:
    """Return a look as a short line for legends in text."""
    lengths = " ".join(f"{1.7 * length:g}" for length in look.lengths)
    return Markup(
        '<svg class="swatch" viewBox="0 0 26 8" aria-hidden="true">'
        '<line x1="0" y1="4" x2="26" y2="4" stroke="{}" stroke-width="3.2" stroke-dasharray="{}"/></svg>'
    ).format(look.colour, lengths or "none")


def mark_swatch(marker: Marker) -> Markup:
    """Return a mark for legends in text."""
    scale = SWATCH / marker.size
    paint = f'fill="{marker.fill or "none"}" stroke="{marker.edge or "none"}" stroke-width="{scale * marker.width:g}"'
    lines = [np.reshape(each, (-1, 2)) * [SWATCH, -SWATCH] for each in marker.outline]
    path = "".join("M" + "L".join(f"{x:g} {y:g}" for x, y in line) for line in lines)
    shape = f'<path d="{path}" {paint}/>' if lines else f'<circle r="{SWATCH / 2.0:g}" {paint}/>'
    return Markup(f'<svg class="swatch" viewBox="-13 -4 26 8" aria-hidden="true">{shape}</svg>')
