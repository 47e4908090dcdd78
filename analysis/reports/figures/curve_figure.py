"""Scalars over time with their limits, each in its own panel or all in one."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes

from ...runtime.flight.results import Result
from ..common.page import exact
from ..common.quantities import display_factor, display_unit
from ..common.style import FAINT, look
from .declared import Curve
from .section import (
    Section,
    condition_text,
    empty_section,
    history_panel,
    legend_of,
    select_rows,
    sentence,
    span_of,
    wide_history,
)


def curve_section(curve: Curve, result: Result, name: str) -> Section:
    """The section of curves; ``name`` must differ between the figures of a page."""
    chosen = select_rows(curve.rows, result)
    if curve.rows is not None and not chosen.any():
        return empty_section(curve.title, curve.rows)
    rows = span_of(chosen)
    time = result.time[rows]
    values = [np.where(chosen, signal.plot_values(result)[0], np.nan)[rows] for signal in curve.signals]
    unit_name = curve.signals[0].unit_name
    unit = display_unit(unit_name)

    def draw(axes: Axes, which: range) -> None:
        for limit in (curve.low, curve.high):
            if limit is not None:
                axes.axhline(display_factor(unit_name) * limit, color=FAINT, linewidth=0.9, linestyle=(0, (5, 3)))
        for index in which:
            style = look(index if curve.together else 0)
            axes.plot(
                time, values[index], color=style.colour, linestyle=style.dashes, marker="." if time.size == 1 else ""
            )

    notes = _caption(curve, unit)
    if len(values) == 1 or curve.together:
        names = ", ".join(signal.label for signal in curve.signals)
        plot = wide_history(
            name, f"{curve.title}: {names} over time", unit, time, lambda axes: draw(axes, range(len(values)))
        )
        return Section(title=curve.title, plot=plot, legend=legend_of(curve.labels), notes=notes)
    panels = [
        history_panel(
            label,
            f"{name}-{index}",
            f"{curve.title}: {signal.label} over time",
            unit,
            time,
            lambda axes, index=index: draw(axes, range(index, index + 1)),  # type: ignore[misc]
        )
        for index, (label, signal) in enumerate(zip(curve.labels, curve.signals, strict=True))
    ]
    return Section(title=curve.title, panels=panels, notes=notes)


def _caption(curve: Curve, unit: str) -> list[Markup]:
    text = Markup("line: {}").format(", ".join(signal.label for signal in curve.signals))
    limits = [limit for limit in (curve.low, curve.high) if limit is not None]
    if limits:
        numbers = Markup(" and ").join(exact(limit, curve.signals[0].unit_name) for limit in limits)
        text = Markup("{}; dashed: limits {} {}").format(text, numbers, unit)
    if curve.rows is not None:
        text = Markup("{}; samples where {}").format(text, condition_text(curve.rows))
    return [sentence(text), *(Markup("{}").format(note) for note in curve.notes)]
