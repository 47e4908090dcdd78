"""Summary of a run for a notebook: its end, limits or key values, and one plot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ....runtime.flight.results import FlightResult
from ...cell import Cell, QuantityVector
from ...figures.declared import BandFigure, FigureDeclaration, LimitsFigure
from ...model import Node, Table, Text
from ...pictures import Plot
from .figures.limits import limit_rows
from .final_values import key_values
from .histories import signal_plot
from .trajectory import trajectory_plot

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

MOST_PLOTTED = 3  # signals of a run without a path


def notebook_nodes(result: FlightResult, figures: Sequence[FigureDeclaration]) -> list[Node]:
    """Return the nodes of a run for a notebook."""
    tables = [
        Table((figure.title, "value", "limit", "unit", ""), limit_rows(figure, result))
        for figure in figures
        if isinstance(figure, LimitsFigure)
    ]
    if not tables:
        rows: list[list[Cell]] = [
            [row.label, row.note, QuantityVector(row.values, row.unit, 4, is_bare=False)] for row in key_values(result)
        ]
        tables = [Table(("", "", "at the end"), rows)]
    return [
        Text(f"{result.ending}, {len(result.signals)} signals"),
        *([Text(result.message)] if result.message else []),
        *tables,
        Plot(lambda: main_plot(result, figures)),
    ]


def main_plot(result: FlightResult, figures: Sequence[FigureDeclaration]) -> Drawing | None:
    """Return a plot of the trajectory, else of signals with a tolerance band, else of vectors, else of any signals."""
    if not result.time.size:
        return None
    signals = [figure.signal for figure in figures if isinstance(figure, BandFigure)]
    bands = [signal.names[0] if len(signal.names) == 1 else signal.label for signal in signals]
    vectors = [row.label for row in key_values(result) if len(row.values) > 1]
    return trajectory_plot(result) or signal_plot(result, (bands or vectors or list(result.signals))[:MOST_PLOTTED])
