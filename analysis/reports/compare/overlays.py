"""All contenders in one panel: medians over time, and ellipses of where flights end."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from ..common.panels import Panel, far, panel
from ..common.style import Look, plain_ticks
from .bands import HEIGHT as LOW
from .bands import Bands, frame_of
from .bundles import TARGET
from .dispersions import HEIGHT, SIGMAS, ellipse, reach_of, shown_ends
from .recorded import Quantity
from .targets import Ends

ALL = "all variants"
FAINT_BAND = 0.09  # opacity of the bands of nine tenths, which lie on each other


def overlaid_bands(quantity: Quantity, bands: Mapping[str, Bands], looks: Mapping[str, Look], name: str) -> list[Panel]:
    """Medians with the bands of nine tenths, to the scale of the contenders' own panels; none of a single one.

    Bands of errors over sigma would hide each other, since all are to be the same.
    """
    if len(bands) < 2:
        return []
    frame = frame_of(quantity, bands)
    shaded = bands if quantity.kind != "consistency" else {}

    def draw(axes: Axes) -> None:
        for label, found in shaded.items():
            rows, style = frame.factor * found.percentiles, looks[label]
            axes.fill_between(
                found.time, rows[0], rows[-1], color=style.colour, alpha=FAINT_BAND, linewidth=0.0,
                step="post" if quantity.held else None,
            )  # fmt: skip
        for label, found in bands.items():
            median, style = frame.factor * found.percentiles[2], looks[label]
            steps = "steps-post" if quantity.held else "default"
            axes.plot(found.time, median, color=style.colour, linestyle=style.dashes, drawstyle=steps)
        frame.dress(axes)

    return [panel(f"{quantity.label}, {ALL}", name, f"Medians of {quantity.label} over time, {ALL}", draw, LOW)]


def overlaid_ends(ends: Mapping[str, Ends], looks: Mapping[str, Look], unit: str, name: str) -> list[Panel]:
    """Mean and 3-sigma ellipse of each contender about the target; none of a single one."""
    if len(ends) < 2:
        return []
    reach = max(map(reach_of, ends.values()))
    factor, shown = far(np.array([reach])) if unit == "m" else (1.0, unit)

    def draw(axes: Axes) -> None:
        for label, found in ends.items():
            good, style = factor * shown_ends(found)[0], looks[label]
            if len(good) > 1:
                axes.plot(*ellipse(good, SIGMAS[-1]), color=style.colour, linestyle=style.dashes)
                axes.plot(*good[:, :2].mean(axis=0), "+", color=style.colour, markersize=8, markeredgewidth=1.4)
        axes.plot(0.0, 0.0, **TARGET)
        axes.set_xlim(-factor * reach, factor * reach)
        axes.set_ylim(-factor * reach, factor * reach)
        axes.set_box_aspect(1.0)
        axes.set_xlabel(f"x, {shown}")
        axes.set_title(f"y, {shown}", loc="left", fontsize=8.5)
        plain_ticks(axes, x=4, y=4)

    what = next(iter(ends.values())).variable
    return [
        panel(f"final {what}, {ALL}", name, f"Final {what} about the target: 3-sigma ellipses, {ALL}", draw, HEIGHT)
    ]
