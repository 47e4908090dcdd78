"""Scalars over time, each in a panel of its own or all in one, with the limits that they have."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes

from ...runtime.flight.results import Result
from ..common.page import exact
from ..common.quantities import shown_factor, shown_unit
from ..common.style import FAINT, look
from .declaration.figures import Curve
from .section import (
    Section,
    choice,
    chosen_rows,
    history_panel,
    legend_of,
    nothing_chosen,
    sentence,
    trimmed,
    wide_history,
)


def curve_section(curve: Curve, result: Result, name: str) -> Section:
    """The figures of curves; ``name`` must differ between the figures of a page."""
    chosen = chosen_rows(curve.rows, result)
    if curve.rows is not None and not chosen.any():
        return nothing_chosen(curve.title, curve.rows)
    rows = trimmed(chosen)
    time = result.time[rows]
    shown = [np.where(chosen, signal.shown(result)[0], np.nan)[rows] for signal in curve.signals]
    unit_name = curve.signals[0].unit_name
    unit = shown_unit(unit_name)

    def draw(axes: Axes, which: range) -> None:
        for limit in (curve.low, curve.high):
            if limit is not None:
                axes.axhline(shown_factor(unit_name) * limit, color=FAINT, linewidth=0.9, linestyle=(0, (5, 3)))
        for index in which:
            style = look(index if curve.together else 0)
            axes.plot(
                time, shown[index], color=style.colour, linestyle=style.dashes, marker="." if time.size == 1 else ""
            )

    notes = _reading(curve, unit)
    if len(shown) == 1 or curve.together:
        names = ", ".join(signal.label for signal in curve.signals)
        drawn = wide_history(
            name, f"{curve.title}: {names} over time", unit, time, lambda axes: draw(axes, range(len(shown)))
        )
        return Section(title=curve.title, drawn=drawn, legend=legend_of(curve.labels), notes=notes)
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


def _reading(curve: Curve, unit: str) -> list[Markup]:
    words = Markup("line: {}").format(", ".join(signal.label for signal in curve.signals))
    limits = [limit for limit in (curve.low, curve.high) if limit is not None]
    if limits:
        values = Markup(" and ").join(exact(limit, curve.signals[0].unit_name) for limit in limits)
        words = Markup("{}; dashed: {} {}").format(words, values, unit)
    if curve.rows is not None:
        words = Markup("{}; where {}").format(words, choice(curve.rows))
    return [sentence(words), *(Markup("{}").format(note) for note in curve.notes)]
