"""Figure docs/images/architecture/concept.svg, from a block to a campaign: `python -m docs.figures.concept`."""

from __future__ import annotations

from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from perilune.analysis.documents.common.colours import BLUE, FAINT, INK, ORANGE, SKY
from perilune.analysis.documents.common.style import house_style, new_figure

from .pictures import IMAGES, write_picture

Point = tuple[float, float]


def concept_figure() -> Figure:
    """Draw block, FMU, closed-loop system and campaign, with the output of each."""
    figure = new_figure(3.1)
    axes = figure.subplots()
    axes.set(xlim=(0.0, 100.0), ylim=(0.0, 38.0))
    axes.axis("off")
    _stage(axes, (0.0, 6.0), 16.0, "Block", "a Python class:\ninputs, outputs,\nparameters, step")
    _stage(axes, (21.0, 6.0), 16.0, "FMU", "FMI 2.0, native C\nor Python; runs\nin any importer")
    _stage(axes, (42.0, 6.0), 33.0, "System (SSP)", "")
    _stage(axes, (80.0, 6.0), 20.0, "Campaign", "thousands of trials\nwith dispersed\nparameters, noise\nand faults")
    for left, right in ((16.0, 21.0), (37.0, 42.0), (75.0, 80.0)):
        _arrow(axes, (left, 18.0), (right, 18.0))
    _loop(axes)
    for x, text in (
        (8.0, "perilune new block"),
        (29.0, "perilune export"),
        (58.5, "perilune run, stability"),
        (90.0, "perilune batch, compare"),
    ):
        axes.text(x, 2.0, text, ha="center", fontsize=7.5, color=FAINT, family="monospace")
    return figure


def _stage(axes: Axes, corner: Point, width: float, title: str, text: str) -> None:
    box = FancyBboxPatch(
        corner, width, 24.0, boxstyle="round,pad=0,rounding_size=1.2", facecolor="#f4f7fa", edgecolor=BLUE
    )
    axes.add_patch(box)
    x, y = corner
    axes.text(x + width / 2.0, y + 26.0, title, ha="center", fontsize=10.0, color=INK, weight="bold")
    axes.text(x + width / 2.0, y + 12.0, text, ha="center", va="center", fontsize=8.0, color=INK)


def _loop(axes: Axes) -> None:
    """Draw the loop of sensors, navigation, guidance, allocation and plant; guidance is the slot."""
    boxes = {
        "sensors": (48.0, 24.5),
        "navigation": (58.5, 24.5),
        "guidance": (69.0, 24.5),
        "plant": (48.0, 12.0),
        "allocation": (69.0, 12.0),
    }
    for name, (x, y) in boxes.items():
        is_slot = name == "guidance"
        box = FancyBboxPatch(
            (x - 4.6, y - 2.4), 9.2, 4.8, boxstyle="round,pad=0,rounding_size=0.8",
            facecolor="white", edgecolor=ORANGE if is_slot else SKY, linewidth=1.6 if is_slot else 1.0,
        )  # fmt: skip
        axes.add_patch(box)
        axes.text(x, y, name, ha="center", va="center", fontsize=7.0, color=INK)
    route = ("plant", "sensors", "navigation", "guidance", "allocation", "plant")
    for start, end in pairwise(route):
        (x0, y0), (x1, y1) = boxes[start], boxes[end]
        step_x, step_y = 4.6 * ((x1 > x0) - (x1 < x0)), 2.4 * ((y1 > y0) - (y1 < y0))
        _arrow(axes, (x0 + step_x, y0 + step_y), (x1 - step_x, y1 - step_y))
    axes.text(
        58.5,
        15.6,
        "one FMU each; any FMU\nwith the same connectors\nfits a slot",
        ha="center",
        fontsize=6.5,
        color=FAINT,
    )


def _arrow(axes: Axes, start: Point, end: Point) -> None:
    axes.add_patch(
        FancyArrowPatch(
            start, end, arrowstyle="-|>", mutation_scale=9.0, color=INK, linewidth=0.9, shrinkA=0, shrinkB=0
        )
    )


if __name__ == "__main__":
    with house_style():
        print(write_picture(concept_figure(), IMAGES / "architecture" / "concept.svg"))
