"""The figures of a stability page as panels with what a screen reader says, and single figures by their names."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...stability.loops.margin_values import MARGINS, UNSTABLE, Quantity
from ...stability.loops.readings import decibels
from ...stability.results.report import JointReport, LoopReport, StabilityReport
from ...stability.results.varied import SweepReport
from ..common.panels import HALF_WIDTH, PANEL_WIDTH, Panel, panel
from ..common.quantities import number
from ..common.style import house_style, new_figure
from ..common.svg import inline_svg
from .bode import draw_bode
from .frequency import Limits, draw_sensitivity, limits_of, margin_words
from .nyquist import INVERSE, draw_harmonic_balance, draw_nichols, draw_nyquist
from .poles import are_crowded, draw_cloud, draw_poles, poles_of
from .sets import draw_amplitudes, draw_describing, draw_histogram, draw_joint, draw_step, draw_sweep
from .shared import Panels

HEIGHT = 3.0  # in; two axes above each other and squares need more than the other pages' panels
SIGHT_HEIGHT = 3.5  # in; of what is seen at first sight, two beside each other
LOW = 2.4  # in; of histograms, sensitivities and joint margins
SIGHT = "sight"  # key of the figures that are seen at first sight


def stack(
    label: str,
    name: str,
    description: str,
    draw: Callable[[Axes, Axes], None],
    height: float = HEIGHT,
    width: float = PANEL_WIDTH,
) -> Panel:
    """A panel of two axes above each other, over the same abscissa; sizes in inches."""
    with house_style():
        figure = new_figure(height, width)
        upper, lower = figure.subplots(2, 1, sharex=True)
        draw(upper, lower)
        return Panel(label, inline_svg(figure, name, description))


def sight_panels(loop: LoopReport, name: str) -> list[Panel]:
    """What is seen of a loop at first sight: Bode and Nichols with margins and limits."""
    margins = margin_words(loop)
    bode, nichols = f"Bode diagram of {loop.name}: {margins}", f"Nichols diagram of {loop.name}: {margins}"
    return [
        stack("Bode", f"{name}-bode", bode, lambda g, p: draw_bode(loop, g, p), SIGHT_HEIGHT, HALF_WIDTH),
        panel("Nichols", f"{name}-nichols", nichols, lambda axes: draw_nichols(loop, axes), SIGHT_HEIGHT, HALF_WIDTH),
    ]


def loop_panels(loop: LoopReport, name: str) -> list[Panel]:
    """The other figures of a loop: Nyquist; poles, those near z = 1, step response."""
    unstable = loop.margins.unstable
    modulus = margin_words(loop) if unstable else f"modulus margin {number(float(loop.robust.modulus_margin), 3)}"
    words = f"Nyquist diagram of {loop.name}: {modulus}"
    panels = [panel("Nyquist", f"{name}-nyquist", words, lambda axes: draw_nyquist(loop, axes), HEIGHT)]
    poles = poles_of(loop)
    if poles.size:
        outside = int(np.sum(np.abs(poles) >= 1.0))
        words = f"{poles.size} closed-loop poles of {loop.name}, {outside} on or outside the unit circle"
        panels.append(panel("Poles", f"{name}-poles", words, lambda axes: draw_poles(loop, axes, near=False), HEIGHT))
        if are_crowded(poles):
            words = f"Closed-loop poles of {loop.name} near z = 1"
            draw = partial(draw_poles, loop, near=True)
            panels.append(panel("Poles near z = 1", f"{name}-poles-near", words, draw, HEIGHT))
    if loop.step is not None:
        last = float(loop.step[1][-1])
        words = f"Step response of {loop.name}, {number(last, 3)} at {number(float(loop.step[0][-1]))} s"
        panels.append(panel("Step response", f"{name}-step", words, lambda axes: draw_step(loop, axes), HEIGHT))
    return panels


def loop_figures(loop: LoopReport, name: str) -> Panels:
    """All figures of a loop: those of first sight, by an empty key those that belong to no part, and the parts'."""
    return {
        SIGHT: sight_panels(loop, name),
        "": loop_panels(loop, name),
        "robust": [sensitivity_panel(loop, name)],
        "dispersed": dispersion_panels(loop, name),
        "amplitudes": amplitude_panels(loop, name),
    } | {f"nonlinear-{index}": nonlinear_panels(loop, name, index) for index in range(len(loop.nonlinearities))}


def sensitivity_panel(loop: LoopReport, name: str) -> Panel:
    """Sensitivity and complementary sensitivity."""
    peaks = [number(decibels(peak), 3) for peak in (loop.robust.sensitivity_peak, loop.robust.complementary_peak)]
    words = f"Sensitivities of {loop.name}: peaks {peaks[0]} dB and {peaks[1]} dB"
    draw = partial(draw_sensitivity, loop, modulus_limit=limits_of(loop).modulus)
    return panel("Sensitivities", f"{name}-sensitivity", words, draw, LOW)


def dispersion_panels(loop: LoopReport, name: str) -> list[Panel]:
    """Histograms of the margins over the trials of a campaign, and the cloud of poles."""
    dispersion = loop.dispersion
    if dispersion is None:
        return []
    limits = {item.quantity: item.limit for item in dispersion.requirements}
    panels = []
    for quantity in MARGINS:
        sizes = dispersion.sizes(quantity)

        def draw(axes: Axes, sizes: np.ndarray = sizes, quantity: Quantity = quantity) -> None:
            unit = "" if quantity.unit == "1" else f", {quantity.unit}"
            draw_histogram(sizes, axes, f"{quantity}{unit}", limits.get(quantity), dispersion.worst)

        words = f"Histogram of the {quantity} of {loop.name} over {dispersion.trials} trials, {_least(sizes)}"
        label = f"{quantity.capitalize()} over trials"
        panels.append(panel(label, f"{name}-trials-{quantity.replace(' ', '-')}", words, draw, LOW))
    if np.any(np.isfinite(dispersion.poles)):
        words = f"Closed-loop poles of {loop.name} in {dispersion.trials} trials"
        near = ", near z = 1" if are_crowded(poles_of(loop)) else ""
        panels.append(panel(f"Poles over trials{near}", f"{name}-cloud", words, partial(draw_cloud, loop), LOW))
    return panels


def _least(sizes: np.ndarray) -> str:
    finite = sizes[np.isfinite(sizes)]
    words = [f"least {number(float(finite.min()), 3)}"] if finite.size else []
    unstable = int(np.sum(sizes == UNSTABLE))
    return ", ".join([*([f"{unstable} unstable"] if unstable else []), *words]) or "none with a crossing"


def amplitude_panels(loop: LoopReport, name: str) -> list[Panel]:
    """Gain and phase over the amplitude, where there are several."""
    if len(loop.amplitudes) < 2:
        return []
    words = f"Gain and phase of {loop.name} over {len(loop.amplitudes)} amplitudes at the cut"
    return [stack("Gain and phase", f"{name}-amplitudes", words, lambda g, p: draw_amplitudes(loop, g, p))]


def nonlinear_panels(loop: LoopReport, name: str, index: int) -> list[Panel]:
    """The describing function of one element, and harmonic balance."""
    element = loop.nonlinearities[index]
    cycles = len(element.cycles)
    words = f"Describing function of {element.name} with {cycles} predicted limit cycle{'s' if cycles != 1 else ''}"
    draw_balance = partial(draw_harmonic_balance, loop, element)
    balance = f"L of {loop.name} and {INVERSE} of {element.name} in the complex plane"
    return [
        panel("Describing function", f"{name}-describing-{index}", words, partial(draw_describing, element), HEIGHT),
        panel("Harmonic balance", f"{name}-balance-{index}", balance, draw_balance, HEIGHT),
    ]


def joint_panel(joint: JointReport, name: str) -> Panel:
    """The disk margin of several channels over frequency."""
    words = f"Disk margin of {joint.name} over frequency, least {number(float(joint.disk_margin), 3)}"
    if not joint.stable:
        words = f"Distance of {joint.name} from the critical point over frequency; the closed loop is unstable"
    elif math.isfinite(joint.disk_frequency):
        words += f" at {number(float(joint.disk_frequency))} rad/s"
    return panel(f"{joint.name}, {joint.point}", name, words, lambda axes: draw_joint(joint, axes), LOW)


def sweep_panel(sweep: SweepReport, report: StabilityReport, name: str) -> Panel:
    """Margins over a parameter with the study's limits."""
    limits = Limits(report.limits.get("gain_margin_db"), report.limits.get("phase_margin_deg"), None)
    words = f"Gain and phase margin of {sweep.loop} over {sweep.parameter}, {sweep.values.size} values"
    if unstable := sum(item.unstable for item in sweep.margins):
        words += f", {unstable} of them unstable"
    label = f"{sweep.loop} over {sweep.parameter}"
    return stack(label, name, words, lambda g, p: draw_sweep(sweep, limits, g, p))


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
