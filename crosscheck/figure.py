"""The figure of a cross-check: how far both codes are apart over time, with a step and with half of it."""

from pathlib import Path

import numpy as np

from crosscheck.case import Case
from perilune.analysis.reports.common.style import COLOURS, DASHES, house_style, new_figure
from perilune.analysis.reports.common.svg import svg_bytes

WIDTH, HEIGHT = 8.0, 5.2  # in
FLOOR = 1e-18  # what is drawn of a difference that is zero


def draw_differences(cases: dict[str, Case], flown: dict[str, list[dict[str, np.ndarray]]], path: Path) -> None:
    """Write a panel for each case; full lines: its step, dashed: half of it."""
    with house_style():
        figure = new_figure(HEIGHT, WIDTH)
        panels = figure.subplots(2, 3, squeeze=False).flatten()
        for axes, (name, case) in zip(panels, cases.items(), strict=False):
            for rows, dashes in zip(flown[name], DASHES, strict=False):
                for colour, (quantity, (unit, _)) in zip(COLOURS, case.quantities.items(), strict=False):
                    label = f"{quantity}, {unit}" if dashes == DASHES[0] else None
                    thin = slice(None, None, max(1, rows["time"].size // 150))
                    values = np.maximum(rows[quantity][thin], FLOOR)
                    axes.semilogy(
                        rows["time"][thin], values, color=colour, linestyle=dashes, linewidth=1.0, label=label
                    )
            axes.set_title(case.title, loc="left", fontsize=8.5)
            axes.set_xlabel("time, s")
            axes.legend(fontsize=7.5, loc="lower right")
        for axes in panels[len(cases) :]:
            axes.remove()
        path.write_bytes(svg_bytes(figure, path.stem, text_as_paths=False))
