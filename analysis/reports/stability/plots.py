"""Single figures of a loop, those of the page, by what they are called."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...stability.results.report import LoopReport
from ..common.style import house_style, new_figure
from .bode import draw_bode
from .frequency import draw_sensitivity
from .limits import limits_of
from .nichols import draw_nichols
from .nyquist import draw_nyquist
from .poles import draw_poles, poles_of
from .sets import draw_step

SIZE = 4.6  # in


class Diagram(StrEnum):
    """What can be drawn of a loop."""

    BODE = "bode"
    NYQUIST = "nyquist"
    NICHOLS = "nichols"
    SENSITIVITY = "sensitivity"
    POLES = "poles"
    STEP = "step"


SINGLE: dict[Diagram, Callable[[LoopReport, Axes], None]] = {
    Diagram.NYQUIST: draw_nyquist,
    Diagram.NICHOLS: draw_nichols,
    Diagram.SENSITIVITY: lambda loop, axes: draw_sensitivity(loop, axes, limits_of(loop).modulus),
    Diagram.POLES: lambda loop, axes: draw_poles(loop, axes, near=False),
    Diagram.STEP: draw_step,
}


def loop_plot(loop: LoopReport, diagram: Diagram) -> Figure:
    """One diagram of a loop. Raises ValueError where the study has not what it takes."""
    lacking = {
        Diagram.POLES: "no poles: it has no linear model" if not poles_of(loop).size else "",
        Diagram.STEP: "no step response: it is unstable or has no linear model" if loop.step is None else "",
    }
    if words := lacking.get(diagram):
        raise ValueError(f"{loop.name} at {loop.point}: {words}")
    with house_style():
        if diagram is Diagram.BODE:
            figure = new_figure(SIZE, 1.2 * SIZE)
            draw_bode(loop, *figure.subplots(2, 1, sharex=True))
        else:
            figure = new_figure(SIZE, SIZE)
            SINGLE[diagram](loop, figure.subplots())
        figure.suptitle(f"{loop.name} at {loop.point}", fontsize=9.0)
    return figure
