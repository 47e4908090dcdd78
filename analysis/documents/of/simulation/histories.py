"""Signals of a run over time: on its page a panel for each, states and commands first; elsewhere signals by name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ....campaigns.verdicts.order_statistics import quantiles
from ....runtime.flight.results import FlightResult
from ....runtime.ssp.names import elements
from ...cell import Inline, LegendEntry, Quantity, Rich
from ...chart.axes import bare_axis, linear_axis, named_axis
from ...chart.quantity import quantity_curve
from ...chart.ticks import axis_ends
from ...common.colours import FAINT, look
from ...common.quantities import display_factor, display_unit, label_with_unit, number
from ...common.signals import (
    SignalGroup,
    axes_of,
    displayed_name,
    distinct,
    names_of_elements,
    signal_groups,
    states_and_commands,
)
from ...interactive.charts import NO_BOX, Chart, ChartNote
from ...model import Group, Items, Node, Note
from ...pictures import Figure, Figures
from .figures.figure_texts import join

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

HEIGHT = 1.9  # in, of a panel on the page
PLOT_HEIGHT, PLOT_WIDTH = 2.0, 6.8  # in, of a panel in a separate figure
MOST = 12  # number of unfolded panels if no signal has the name of a state or command
SPIKE = 8.0  # ratio of the full range to the range of the middle 98 % of values from which the axis is clipped


@dataclass(frozen=True)
class ComponentHistory:
    """Signals of one component over time: figures, and signals without a figure.

    ``legend`` explains the elements of its vectors, for each way in which they are named. ``constant`` are (label,
    values, unit) of constant groups; ``copies`` are (label, label of the group with the same values).
    """

    component: str
    figures: list[Figure]
    legend: list[LegendEntry]
    constant: list[tuple[str, list[float | int | bool], str | None]]
    copies: list[tuple[str, str]]

    @property
    def is_in_order(self) -> bool:
        """True if no element is along a named axis, so legend entries apply to the lines in order."""
        return all(name.startswith("[") for entry in self.legend for name in entry.lines)

    @property
    def is_empty(self) -> bool:
        """True if there is nothing to show."""
        return not (self.figures or self.constant or self.copies)

    def subsection(self) -> Group:
        """Return the figures below the component's name, then constant and duplicate signals."""
        nodes: list[Node] = (
            [Figures(lambda: self.figures, self.legend, is_in_order=self.is_in_order)] if self.figures else []
        )
        if self.constant:
            nodes += [Note("Constant:"), Items([_constant(*entry) for entry in self.constant], "pairs")]
        if self.copies:
            nodes += [
                Note("Identical to:"),
                Items([f"{label} = {original}" for label, original in self.copies], "pairs"),
            ]
        return Group(self.component or "System connectors", nodes)


def _constant(label: str, values: Sequence[float | int | bool], unit: str | None) -> Rich:
    numbers: list[list[Inline]] = [[Quantity(value, unit, 6, is_bare=True)] for value in values]
    return [f"{label} = ", *join(numbers, ", "), f" {display_unit(unit)}"]


@dataclass(frozen=True)
class Histories:
    """Sections of the states and commands (``first``), and of the ``rest``, which the page folds.

    If no signal has the name of a state or command, the first `MOST` panels are ``first``.
    """

    first: list[ComponentHistory]
    rest: list[ComponentHistory]
    are_named: bool

    @property
    def folded(self) -> int:
        """The number of figures that the page folds."""
        return sum(len(history.figures) for history in self.rest)


def time_histories(result: FlightResult) -> Histories:
    """Return the sections of all components in the order of the record; none for a run without rows."""
    if not result.time.size:
        return Histories([], [], False)
    groups = signal_groups(result)
    originals = distinct(groups, result)
    varying = [group for group in groups if originals[group] == group and not _is_constant(group, result)]
    named = states_and_commands(varying, result)
    unfolded = named or varying[:MOST]
    components = list(dict.fromkeys(group.component for group in groups))
    first, remainder = [], []
    for position, component in enumerate(components):
        members = [group for group in groups if group.component == component]
        selected = [group for group in unfolded if group.component == component]
        if selected:
            name = f"history{position}-first"
            plotted = _figures(selected, result, name, is_reduced=False)
            first.append(ComponentHistory(component, plotted, _legend(selected), [], []))
        others = [group for group in members if group not in unfolded]
        remainder.append(_fold_history(component, others, originals, result, position))
    return Histories(first, [history for history in remainder if not history.is_empty], bool(named))


def _fold_history(
    component: str,
    groups: list[SignalGroup],
    originals: dict[SignalGroup, SignalGroup],
    result: FlightResult,
    position: int,
) -> ComponentHistory:
    """Return the folded section of a component's other signals: with a panel, constant, or copies of others."""
    constant = [group for group in groups if _is_constant(group, result)]
    copies = [(group, originals[group]) for group in groups if originals[group] != group and group not in constant]
    varying = [group for group in groups if group not in constant and originals[group] == group]
    final = result.final()
    return ComponentHistory(
        component=component,
        figures=_figures(varying, result, f"history{position}", is_reduced=True),
        legend=_legend(varying),
        constant=[(group.heading, [final[name] for name in group.names], group.unit) for group in constant],
        copies=[(group.label, original.label) for group, original in copies],
    )


def _is_constant(group: SignalGroup, result: FlightResult) -> bool:
    values = group.values(result)
    return bool(np.all(values == values[:, :1]))


def _figures(groups: list[SignalGroup], result: FlightResult, name: str, *, is_reduced: bool) -> list[Figure]:
    """Return a figure for each group: Real signals first, sorted by unit in order of first occurrence."""
    kinds = [(not group.is_real, group.unit) for group in groups]
    first = {kind: index for index, kind in reversed(list(enumerate(kinds)))}
    ranked = sorted(groups, key=lambda group: (not group.is_real, first[not group.is_real, group.unit]))
    return [
        Figure(
            label_with_unit(group.variable, group.unit),
            f"{name}-{index}",
            f"{group.label} over time",
            history_chart(group, result),
            HEIGHT,
            is_narrow=True,
            is_reduced=is_reduced,
        )
        for index, group in enumerate(ranked)
    ]


def _legend(groups: list[SignalGroup]) -> list[LegendEntry]:
    """Return the line styles of elements along named axes, and of the elements of the longest other vector."""
    vectors = [group for group in groups if group.indices]
    unnamed = max((group.labels for group in vectors if not group.is_named), key=len, default=())
    series = [*(group.labels for group in vectors if group.is_named), unnamed]
    entries = dict.fromkeys(entry for labels in series for entry in enumerate(labels))
    return [LegendEntry(look(position), [label]) for position, label in entries]


def history_chart(group: SignalGroup, result: FlightResult, *, intervals: tuple[int, int] = (5, 4)) -> Chart:
    """Return the chart of a scalar or a vector over time; Integers and Booleans as steps.

    ``intervals`` are the maximum numbers of intervals between ticks of abscissa and ordinate.
    """
    values, factor = group.values(result), display_factor(group.unit)
    curves = [
        replace(
            quantity_curve(result.time, row, label, group.unit, index, steps=not group.is_real),
            signal=name if group.is_named else "",
        )
        for index, (name, label, row) in enumerate(
            zip(group.names, group.labels if group.is_named else group.names, values, strict=True)
        )
    ]
    finite_times = result.time[np.isfinite(values).any(axis=0)]
    abscissa = linear_axis(axis_ends(finite_times), intervals[0], label="time, s")
    if group.type == "Boolean":
        ordinate = named_axis((-0.15, 1.15), [(0.0, "false"), (1.0, "true")])
        return Chart(NO_BOX, abscissa, ordinate, curves=curves)
    ends, notes = _find_ends(factor * values) if group.is_real else (axis_ends(values), [])
    ordinate = linear_axis(ends, intervals[1], integer=not group.is_real)
    return Chart(NO_BOX, abscissa, ordinate, curves=curves, notes=notes)


def _find_ends(values: np.ndarray) -> tuple[tuple[float, float], list[ChartNote]]:
    """Return the ends of the ordinate, clipped if few extreme values would flatten the rest, and a note on clipping."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return axis_ends(finite), [_annotation("no finite value", (0.5, 0.5), ("center", "center"), 9.0)]
    low, high = quantiles(finite, [0.01, 0.99])
    minimum, maximum = float(finite.min()), float(finite.max())
    if not (high > low and maximum - minimum > SPIKE * (high - low)):
        return axis_ends(finite), []
    margin = 0.15 * (high - low)
    ends = (low - margin, high + 3.0 * margin)  # space for the note
    outside = np.flatnonzero(np.any((values < ends[0]) | (values > ends[1]), axis=0))
    early = float(np.mean(outside)) < values.shape[1] / 2
    text = f"clipped; full range {number(minimum, 3)} to {number(maximum, 3)}"
    return ends, [_annotation(text, (0.98 if early else 0.02, 0.98), ("right" if early else "left", "top"), 8.0)]


def _annotation(text: str, at: tuple[float, float], align: tuple[str, str], size: float) -> ChartNote:
    return ChartNote(text, at, (True, True), (0.0, 0.0), align, FAINT, size)


def signal_plot(result: FlightResult, names: Sequence[str]) -> Drawing:
    """Return a figure with a panel for each signal or vector, below each other over a common time.

    Raises KeyError for an unknown name.
    """
    from ...chart.plot import plot_charts  # which imports matplotlib

    charts, titles, legends = [], [], []
    for name in names:
        group = _group_of(name, result)
        charts.append(history_chart(group, result, intervals=(8, 5)))
        titles.append(label_with_unit(group.variable, group.unit))
        legends.append(group.labels)
    ends = [chart.x.ends for chart in charts]
    time = linear_axis((min(low for low, _ in ends), max(high for _, high in ends)), 8, label="time, s")
    panels = [replace(chart, x=bare_axis(time)) for chart in charts[:-1]]
    return plot_charts([*panels, replace(charts[-1], x=time)], PLOT_HEIGHT, PLOT_WIDTH, titles=titles, legends=legends)


def _group_of(name: str, run: FlightResult) -> SignalGroup:
    """Return the signal of this name, or the elements of the vector."""
    run[name]  # raises KeyError
    names, axes = elements(name, run.signals), axes_of(run)
    labels = names_of_elements(names, axes) or tuple(each.removeprefix(name) for each in names)
    labels = labels if len(names) > 1 else ()
    return SignalGroup(
        "", displayed_name(name, axes), run.units[names[0]], run.types[names[0]], tuple(names), (), labels
    )
