"""The page of two runs over each other: each signal of both, and its difference."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import cycle
from pathlib import Path
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from ...differences.differences import RunDifferences, SignalDifference
from ..chart.axes import linear_axis
from ..chart.panel import chart_panel
from ..chart.quantity import quantity_curve
from ..chart.ticks import axis_ends
from ..common.colours import COLOURS, DASHES, INK, Look
from ..common.page import write_page
from ..common.panels import HALF_WIDTH, Panel, swatch
from ..common.quantities import label_with_unit
from ..common.signals import INDEXED, vector_of
from ..interactive.charts import NO_BOX, Chart, Curve

PLOTTED = 24  # signals and vectors that are plotted
HEIGHT = 1.9  # in, of a panel
FIRST, SECOND = (Look(INK, dashes, "") for dashes in DASHES[:2])


class Row(NamedTuple):
    """A signal of the table, in its unit."""

    difference: SignalDifference
    time: float
    first: float
    second: float


def write_differences_page(runs: RunDifferences, statements: Sequence[str], tolerance: float, path: Path) -> None:
    """Write one self-contained HTML page about two runs; the same runs give the same bytes.

    ``statements`` are sentences about what was compared. The signals that differ most are plotted, those within a
    relative ``tolerance`` are folded.
    """
    differing, within = runs.split(tolerance)
    vectors: dict[str, list[SignalDifference]] = {}
    for each in differing:
        vectors.setdefault(vector_of(each.name), []).append(each)
    plotted = list(vectors.items())[:PLOTTED]
    palette = _palette(each.name for _, group in plotted for each in group)
    write_page(
        path,
        Path(__file__).with_name("differences.html"),
        title="Differences of two runs",
        statements=statements,
        runs=[(swatch(look), name) for look, name in ((FIRST, "first"), (SECOND, "second"))],
        elements=_element_legend(palette),
        panels=[
            each
            for index, (name, group) in enumerate(plotted)
            for each in _panels(index, name, group, runs.time, palette)
        ],
        left_out=len(vectors) - len(plotted),
        rows=[
            Row(each, float(runs.time[each.row]), float(each.first[each.row]), float(each.second[each.row]))
            for each in differing
        ],
        within=within,
        summary=within_tolerance(within, tolerance) if within else "",
        identical=[each.name for each in runs.signals if not each.differs],
    )


def within_tolerance(signals: Sequence[SignalDifference], tolerance: float) -> str:
    """Return the line for signals that differ by no more than a relative ``tolerance``, the largest first."""
    count = "1 signal differs" if len(signals) == 1 else f"{len(signals)} signals differ"
    return (
        f"{count} by at most {signals[0].relative:.2g} of the largest magnitude, within the tolerance of {tolerance:g}"
    )


def _palette(names: Iterable[str]) -> dict[str, str]:
    """Return the colour of every index that an element of a plotted vector has, the same in all panels."""
    indices = sorted(
        {_index(name) for name in names} - {""}, key=lambda index: [int(each) for each in index.split(",")]
    )
    return dict(zip(indices, cycle(COLOURS), strict=False))


def _element_legend(palette: Mapping[str, str]) -> list[tuple[Markup, list[str]]]:
    """Return each colour with the indices of elements that have it."""
    indices: dict[str, list[str]] = {}
    for index, colour in palette.items():
        indices.setdefault(colour, []).append(f"[{index}]")
    return [(swatch(Look(colour, DASHES[0], "")), those) for colour, those in indices.items()]


def _panels(
    index: int, name: str, elements: Iterable[SignalDifference], time: np.ndarray, palette: Mapping[str, str]
) -> list[Panel]:
    """A signal or a vector in both runs, and its difference."""
    ordered = sorted(elements, key=lambda each: each.name)
    unit = ordered[0].unit
    both = [
        _curve(time, values, f"{which} {each.name.removeprefix(name)}".strip(), unit, each.name, palette, look)
        for each in ordered
        for which, values, look in (("first", each.first, 0), ("second", each.second, 1))
    ]
    differences = [_curve(time, each.difference, each.name, unit, each.name, palette) for each in ordered]
    label, words = label_with_unit(name, unit), f"{label_with_unit(name, unit)}: second less first"
    return [
        _panel(label, f"both-{index}", f"{name} in both runs over time", both),
        _panel(words, f"difference-{index}", f"Difference of {name} over time", differences),
    ]


def _curve(
    time: np.ndarray,
    values: np.ndarray,
    name: str,
    unit: str | None,
    element: str,
    palette: Mapping[str, str],
    look: int = 0,
) -> Curve:
    """A line in the colour of an element and the dashes of a look."""
    colour = palette.get(_index(element), COLOURS[0]).lower()
    return replace(quantity_curve(time, values, name, unit, look), colour=colour, marker=None)


def _panel(label: str, name: str, description: str, curves: Sequence[Curve]) -> Panel:
    finite = [np.isfinite(curve.displayed) for curve in curves]
    times = np.concatenate([curve.x[rows] for curve, rows in zip(curves, finite, strict=True)])
    ordinates = np.concatenate([curve.displayed for curve in curves])
    abscissa = linear_axis(axis_ends(times), 6, label="time, s")
    chart = Chart(NO_BOX, abscissa, linear_axis(axis_ends(ordinates), 5), curves=curves)
    return chart_panel(label, name, description, chart, HEIGHT, HALF_WIDTH)


def _index(name: str) -> str:
    indexed = INDEXED.fullmatch(name)
    return indexed[2] if indexed else ""
