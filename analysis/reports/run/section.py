"""What the page shows of one figure that a system asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes

from ..kit.page import exact
from ..kit.panels import HALF_WIDTH, Panel, panel, swatch
from ..kit.style import look, plain_ticks

HEIGHT = 2.6  # in


@dataclass(frozen=True)
class Section:
    """A heading with figures: ``panels`` side by side, or a ``wide`` one.

    ``legend`` are (swatch, label) of the series, ``findings`` what the figure comes to, ``notes`` how to read it.
    """

    title: str
    panels: list[Panel] = field(default_factory=list)
    wide: Markup | None = None
    legend: list[tuple[Markup, str]] = field(default_factory=list)
    findings: list[Markup] = field(default_factory=list)
    notes: list[Markup] = field(default_factory=list)


def legend_of(labels: tuple[str, ...]) -> list[tuple[Markup, str]]:
    """A vector's elements with the looks that they are drawn with; a scalar needs none."""
    return [(swatch(look(index)), label) for index, label in enumerate(labels)] if len(labels) > 1 else []


def history_panel(
    label: str, name: str, description: str, unit: str, time: np.ndarray, draw: Callable[[Axes], None]
) -> Panel:
    """A panel over time, half as wide as the page's column; ``draw`` adds the lines and sets the ordinate."""

    def dress(axes: Axes) -> None:
        draw(axes)
        axes.set_xlim(time[0], time[-1] if time[-1] > time[0] else time[0] + 1.0)
        axes.set_xlabel("time, s")
        axes.set_title(unit, loc="left", pad=4)
        plain_ticks(axes, x=6, y=5)

    return panel(label, name, description, dress, HEIGHT, HALF_WIDTH)


def seconds(time: float) -> Markup:
    """A time on the page."""
    return Markup("{} s").format(exact(float(time), digits=6))


def sentence(words: Markup) -> Markup:
    """With a capital at its beginning and a full stop at its end."""
    return Markup("{}.").format(Markup(capital(words)))


def capital(words: str) -> str:
    """With a capital at its beginning; the rest as it is."""
    return words[:1].upper() + words[1:]
