"""Signals of a flight over time, those that are asked for by name."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from ...runtime.flight.results import Result
from ...runtime.system.names import elements
from ..common.quantities import labelled, shown_factor
from ..common.style import house_style, look, new_figure, plain_ticks

HEIGHT = 2.0  # in, of a panel
WIDTH = 6.8  # in


def signal_plot(result: Result, names: Sequence[str]) -> Figure:
    """A panel for each signal or vector, below each other over the same time. Raises KeyError for an unknown name."""
    values = [result[name] for name in names]
    with house_style():
        figure = new_figure(0.3 + HEIGHT * len(names), WIDTH)
        panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
        for axes, name, columns in zip(panels, names, values, strict=True):
            parts = elements(name, result.signals)
            unit = result.units[parts[0]]
            drawn = shown_factor(unit) * columns.reshape(result.time.size, -1)
            for index, part in enumerate(parts):
                style = look(index)
                is_real = result.types[part] == "Real"
                axes.plot(
                    result.time,
                    drawn[:, index],
                    color=style.colour,
                    linestyle=style.dashes,
                    label=part.removeprefix(name),
                    drawstyle="default" if is_real else "steps-post",
                )
            plain_ticks(axes, x=8, y=5)
            axes.set_title(labelled(name, unit), loc="left")
            if len(parts) > 1:
                axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(parts), borderaxespad=0.0)
        panels[-1].set_xlabel("time, s")
    return figure
