"""Figures of two runs: each signal or vector in both, and its difference."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import cycle

import numpy as np

from ...differences.differences import SignalDifference
from ..cell import LegendEntry
from ..chart.axes import linear_axis
from ..chart.quantity import quantity_curve
from ..chart.ticks import axis_ends
from ..common.colours import COLOURS, DASHES, INK, Look
from ..common.quantities import label_with_unit
from ..common.signals import INDEXED, vector_of
from ..interactive.charts import NO_BOX, Chart, Curve
from ..pictures import Figure

PLOTTED = 24  # signals and vectors
HEIGHT = 1.9  # in, of a figure

Vectors = Mapping[str, Sequence[SignalDifference]]


def plotted_signals(signals: Iterable[SignalDifference]) -> tuple[Vectors, int]:
    """Return the elements of the first signals and vectors by name, and the number of signals not plotted."""
    vectors: dict[str, list[SignalDifference]] = {}
    for each in signals:
        vectors.setdefault(vector_of(each.name), []).append(each)
    return dict(list(vectors.items())[:PLOTTED]), max(len(vectors) - PLOTTED, 0)


def difference_legend(vectors: Vectors) -> list[LegendEntry]:
    """Return the legend: the looks of both runs, and the axes or indices of the elements of each colour."""
    runs = [
        LegendEntry(Look(INK, dashes, ""), [name]) for dashes, name in zip(DASHES, ("first", "second"), strict=False)
    ]
    signals = [each for elements in vectors.values() for each in elements]
    lines: dict[str, list[str]] = {}
    for index, colour in _palette(vectors).items():
        labels = dict.fromkeys(each.axis or f"[{index}]" for each in signals if _index(each.name) == index)
        lines.setdefault(colour, []).extend(labels)
    return [*runs, *(LegendEntry(Look(colour, DASHES[0], ""), labels) for colour, labels in lines.items())]


def difference_figures(vectors: Vectors, time: np.ndarray) -> list[Figure]:
    """Return two figures of each signal or vector over ``time`` (s): both runs, and second minus first."""
    palette = _palette(vectors)
    figures = []
    for order, (name, elements) in enumerate(vectors.items()):
        ordered = sorted(elements, key=lambda each: each.name)
        label = label_with_unit(name, ordered[0].unit)
        both = [
            _curve(time, values, f"{which} {each.axis or each.name.removeprefix(name)}".strip(), each, palette, look)
            for each in ordered
            for look, (which, values) in enumerate((("first", each.first), ("second", each.second)))
        ]
        differences = [_curve(time, each.difference, each.axis or each.name, each, palette) for each in ordered]
        figures += [
            Figure(label, f"both-{order}", f"{name} in both runs over time", _chart(both), HEIGHT),
            Figure(
                f"{label}: second less first",
                f"difference-{order}",
                f"Difference of {name} over time",
                _chart(differences),
                HEIGHT,
            ),
        ]
    return figures


def _palette(vectors: Vectors) -> dict[str, str]:
    """Return a colour for every index of a plotted vector's elements, the same in all figures."""
    indices = {_index(each.name) for elements in vectors.values() for each in elements} - {""}
    ordered = sorted(indices, key=lambda index: [int(each) for each in index.split(",")])
    return dict(zip(ordered, cycle(COLOURS), strict=False))


def _curve(
    time: np.ndarray,
    values: np.ndarray,
    name: str,
    element: SignalDifference,
    palette: Mapping[str, str],
    look: int = 0,
) -> Curve:
    """Return a line in the colour of an element and the dashes of a look."""
    colour = palette.get(_index(element.name), COLOURS[0]).lower()
    return replace(quantity_curve(time, values, name, element.unit, look), colour=colour, marker=None)


def _chart(curves: Sequence[Curve]) -> Chart:
    finite = [np.isfinite(curve.displayed) for curve in curves]
    times = np.concatenate([curve.x[rows] for curve, rows in zip(curves, finite, strict=True)])
    ordinates = np.concatenate([curve.displayed for curve in curves])
    abscissa = linear_axis(axis_ends(times), 6, label="time, s")
    return Chart(NO_BOX, abscissa, linear_axis(axis_ends(ordinates), 5), curves=curves)


def _index(name: str) -> str:
    indexed = INDEXED.fullmatch(name)
    return indexed[2] if indexed else ""
