"""Figures of a stability study with their texts for screen readers, and single figures by name."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from functools import partial

import numpy as np

from ....stability.loops.margin_values import MARGINS, UNSTABLE
from ....stability.loops.readings import decibels
from ....stability.results.report import JointReport, LoopReport, StabilityStudy
from ....stability.results.varied import SweepReport
from ...chart.axes import linear_axis
from ...chart.equal import Ends, to_scale
from ...chart.panel import POINTS
from ...common.panels import PANEL_WIDTH
from ...common.quantities import number
from ...interactive.charts import Chart
from ...pictures import Figure
from .charts.bode import bode_charts
from .charts.frequency import LimitLines, margin_words, sensitivity_chart
from .charts.nyquist import INVERSE, balance_chart, nichols_chart, nyquist_chart
from .charts.poles import are_crowded, cloud_chart, intervals, pole_chart, poles_of
from .charts.sets import amplitude_charts, describing_chart, joint_chart, margin_chart, step_chart, sweep_charts
from .shared import FiguresBySection

HEIGHT = 3.0  # in; two axes above each other, and squares, need more height than panels of other pages
OVERVIEW_HEIGHT = 3.5  # in, height of the first figures, two side by side
LOW = 2.4  # in, height of histograms, sensitivities and joint margins
OVERVIEW = "overview"  # key of the first figures


def _small(label: str, name: str, words: str, chart: Chart, height: float = HEIGHT) -> Figure:
    """Return a figure of a third of the page's width."""
    return Figure(label, name, words, chart, height, is_narrow=True)


def _stack(label: str, name: str, words: str, charts: tuple[Chart, Chart]) -> Figure:
    """Return a figure of a third of the page's width with two charts over one abscissa."""
    upper, lower = charts
    return Figure(label, name, words, upper, HEIGHT, is_narrow=True, below=lower)


def _plane(label: str, name: str, words: str, chart: Chart, height: float = HEIGHT) -> Figure:
    """Return a figure of a third of the page's width with a complex plane on equal scales."""
    return _small(label, name, words, _to_scale(chart, PANEL_WIDTH, height), height)


def _to_scale(chart: Chart, width: float, height: float, *, fluid: bool = True) -> Chart:

    def chart_of(x: Ends, y: Ends) -> Chart:
        abscissa = linear_axis(x, intervals(x[1] - x[0]), label=chart.x.label)
        return replace(chart, x=abscissa, y=linear_axis(y, 5))

    return to_scale(
        chart_of, chart.x.ends, chart.y.ends, POINTS * width, POINTS * height, title=chart.title, fluid=fluid
    )


def overview_figures(loop: LoopReport, name: str) -> list[Figure]:
    """Return the first figures of a loop: Bode and Nichols diagram with margins and limits."""
    nichols = f"Nichols diagram of {loop.name}: {margin_words(loop)}"
    return [
        bode_figure(loop, "Bode", f"{name}-bode", OVERVIEW_HEIGHT),
        Figure("Nichols", f"{name}-nichols", nichols, nichols_chart(loop), OVERVIEW_HEIGHT),
    ]


def bode_figure(loop: LoopReport, label: str, name: str, height: float) -> Figure:
    """Return the figure of a loop's gain above its phase."""
    gain, phase = bode_charts(loop)
    return Figure(label, name, f"Bode diagram of {loop.name}: {margin_words(loop)}", gain, height, below=phase)


def loop_figures(loop: LoopReport, name: str) -> list[Figure]:
    """Return the other figures of a loop: Nyquist diagram, poles (also near z = 1), step response."""
    unstable = loop.margins.unstable
    modulus = margin_words(loop) if unstable else f"modulus margin {number(float(loop.robust.modulus_margin), 3)}"
    words = f"Nyquist diagram of {loop.name}: {modulus}"
    figures = [_plane("Nyquist", f"{name}-nyquist", words, nyquist_chart(loop))]
    poles = poles_of(loop)
    if poles.size:
        outside = int(np.sum(np.abs(poles) >= 1.0))
        words = f"{poles.size} closed-loop poles of {loop.name}, {outside} on or outside the unit circle"
        figures.append(_plane("Poles", f"{name}-poles", words, pole_chart(loop, near=False)))
        if are_crowded(poles):
            words = f"Closed-loop poles of {loop.name} near z = 1"
            figures.append(_plane("Poles near z = 1", f"{name}-poles-near", words, pole_chart(loop, near=True)))
    if loop.step is not None:
        last = float(loop.step[1][-1])
        words = f"Step response of {loop.name}, {number(last, 3)} at {number(float(loop.step[0][-1]))} s"
        figures.append(_small("Step response", f"{name}-step", words, step_chart(loop)))
    return figures


def figures_by_section(loop: LoopReport, name: str) -> FiguresBySection:
    """Return all figures of a loop by section of its article; figures of no section have an empty key."""
    return {
        OVERVIEW: overview_figures(loop, name),
        "": loop_figures(loop, name),
        "robust": [sensitivity_figure(loop, name)],
        "dispersed": dispersion_figures(loop, name),
        "amplitudes": amplitude_figures(loop, name),
    } | {f"nonlinear-{index}": nonlinear_figures(loop, name, index) for index in range(len(loop.nonlinearities))}


def sensitivity_figure(loop: LoopReport, name: str) -> Figure:
    """Return the figure of sensitivity and complementary sensitivity."""
    peaks = [number(decibels(peak), 3) for peak in (loop.robust.sensitivity_peak, loop.robust.complementary_peak)]
    words = f"Sensitivities of {loop.name}: peaks {peaks[0]} dB and {peaks[1]} dB"
    return _small("Sensitivities", f"{name}-sensitivity", words, sensitivity_chart(loop), LOW)


def dispersion_figures(loop: LoopReport, name: str) -> list[Figure]:
    """Return figures of the margins' histograms over the trials of a campaign, and of the cloud of poles."""
    dispersion = loop.dispersion
    if dispersion is None:
        return []
    limits = {item.quantity: item.limit for item in dispersion.requirements}
    figures = []
    for quantity in MARGINS:
        smallest = _smallest_size(dispersion.sizes(quantity))
        words = f"Histogram of the {quantity} of {loop.name} over {dispersion.trials} trials, {smallest}"
        label, key = f"{quantity.capitalize()} over trials", f"{name}-trials-{quantity.replace(' ', '-')}"
        figures.append(_small(label, key, words, margin_chart(dispersion, quantity, limits.get(quantity)), LOW))
    if np.any(np.isfinite(dispersion.poles)):
        words = f"Closed-loop poles of {loop.name} in {dispersion.trials} trials"
        near = ", near z = 1" if are_crowded(poles_of(loop)) else ""
        figures.append(_plane(f"Poles over trials{near}", f"{name}-cloud", words, cloud_chart(loop), LOW))
    return figures


def _smallest_size(sizes: np.ndarray) -> str:
    finite = sizes[np.isfinite(sizes)]
    words = [f"least {number(float(finite.min()), 3)}"] if finite.size else []
    unstable = int(np.sum(sizes == UNSTABLE))
    return ", ".join([*([f"{unstable} unstable"] if unstable else []), *words]) or "none with a crossing"


def amplitude_figures(loop: LoopReport, name: str) -> list[Figure]:
    """Return the figure of gain and phase over the amplitude, if there are several amplitudes."""
    if len(loop.amplitudes) < 2:
        return []
    words = f"Gain and phase of {loop.name} over {len(loop.amplitudes)} amplitudes at the cut"
    return [_stack("Gain and phase", f"{name}-amplitudes", words, amplitude_charts(loop))]


def nonlinear_figures(loop: LoopReport, name: str, index: int) -> list[Figure]:
    """Return figures of the describing function of one element, and of the harmonic balance."""
    element = loop.nonlinearities[index]
    cycles = len(element.cycles)
    words = f"Describing function of {element.name} with {cycles} predicted limit cycle{'s' if cycles != 1 else ''}"
    balance = f"L of {loop.name} and {INVERSE} of {element.name} in the complex plane"
    return [
        _small("Describing function", f"{name}-describing-{index}", words, describing_chart(element)),
        _plane("Harmonic balance", f"{name}-balance-{index}", balance, balance_chart(loop, element)),
    ]


def joint_figure(joint: JointReport, name: str) -> Figure:
    """Return the figure of the disk margin of several channels over frequency."""
    words = f"Disk margin of {joint.name} over frequency, least {number(float(joint.disk_margin), 3)}"
    if not joint.stable:
        words = f"Distance of {joint.name} from the critical point over frequency; the closed loop is unstable"
    elif math.isfinite(joint.disk_frequency):
        words += f" at {number(float(joint.disk_frequency))} rad/s"
    return _small(f"{joint.name}, {joint.point}", name, words, joint_chart(joint), LOW)


def sweep_figure(sweep: SweepReport, report: StabilityStudy, name: str) -> Figure:
    """Return the figure of margins over a parameter with the study's limits."""
    limits = LimitLines(report.limits.get("gain_margin_db"), report.limits.get("phase_margin_deg"), None)
    words = f"Gain and phase margin of {sweep.loop} over {sweep.parameter}, {sweep.values.size} values"
    if unstable := sum(item.unstable for item in sweep.margins):
        words += f", {unstable} of them unstable"
    label = f"{sweep.loop} over {sweep.parameter}"
    return _stack(label, name, words, sweep_charts(sweep, limits))


SIZE = 4.6  # in, of a single diagram


class LoopDiagram(StrEnum):
    """A diagram of a loop."""

    BODE = "bode"
    NYQUIST = "nyquist"
    NICHOLS = "nichols"
    SENSITIVITY = "sensitivity"
    POLES = "poles"
    STEP = "step"


def loop_charts(loop: LoopReport, diagram: LoopDiagram) -> list[Chart]:
    """Return the charts of one diagram of a loop, for figures of `SIZE`.

    Raises ValueError if the study lacks the data for it.
    """
    lacking = {
        LoopDiagram.POLES: "no poles: it has no linear model" if not poles_of(loop).size else "",
        LoopDiagram.STEP: "no step response: it is unstable or has no linear model" if loop.step is None else "",
    }
    if words := lacking.get(diagram):
        raise ValueError(f"{loop.name} at {loop.point}: {words}")
    single: dict[LoopDiagram, Callable[[LoopReport], Chart]] = {
        LoopDiagram.NYQUIST: nyquist_chart,
        LoopDiagram.NICHOLS: nichols_chart,
        LoopDiagram.SENSITIVITY: sensitivity_chart,
        LoopDiagram.POLES: partial(pole_chart, near=False),
        LoopDiagram.STEP: step_chart,
    }
    if diagram is LoopDiagram.BODE:
        return list(bode_charts(loop))
    chart = single[diagram](loop)
    return [_to_scale(chart, SIZE, SIZE, fluid=False) if diagram in (LoopDiagram.NYQUIST, LoopDiagram.POLES) else chart]
