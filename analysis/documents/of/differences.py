"""Document of the comparison of two runs: the compared signals, their differences, and the times of these."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ...differences.differences import RunDifferences, SignalDifference
from ..cell import Cell, Quantity
from ..common.quantities import number
from ..model import Document, Fold, Node, Note, Section, Table, Text
from ..pictures import Figures
from .differences_figures import difference_figures, difference_legend, plotted_signals

NAMED = 6  # listed signals that only one run has
COMPARED_DIGITS = 9  # digits of numbers that differ


def differences_document(runs: RunDifferences, tolerance: float) -> Document:
    """Return the document of two runs; signals within a relative ``tolerance`` are summarised."""
    beyond, within = runs.split(tolerance)
    identical = [each.name for each in runs.signals if not each.differs]
    sections = [
        Section("Signals that differ", _figures(beyond, runs.time) if beyond else [Text(_no_difference(within))])
    ]
    if beyond:
        sections.append(Section("Largest differences", [_table(beyond, runs.time)]))
    if within:
        names = ", ".join(f"{each.name} ({number(each.relative, 3)})" for each in within)
        sections.append(Section("", [Fold(_within(within, tolerance), [Note(names)])]))
    if identical:
        sections.append(Section("", [Fold(f"{len(identical)} identical signals", [Note(", ".join(identical))])]))
    return Document("Differences of two runs", [Text(each) for each in _statements(runs)], sections, _json(runs))


def _no_difference(within: Sequence[SignalDifference]) -> str:
    return "no signal differs by more than the tolerance" if within else "all signals that both runs have are identical"


def _figures(beyond: Sequence[SignalDifference], time: np.ndarray) -> list[Node]:
    plotted, left_out = plotted_signals(beyond)
    order = "In order of the relative difference: the largest difference over the largest magnitude of both runs."
    more = f" {left_out} further signals and vectors are in the table below." if left_out else ""
    return [
        Figures(partial(difference_figures, plotted, time), difference_legend(plotted)),
        Note(order + more),
    ]


def _table(beyond: Sequence[SignalDifference], time: np.ndarray) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (
            each.name,
            Quantity(each.greatest, each.unit),
            Quantity(each.relative, digits=3),
            Quantity(float(time[each.row])),
            *(
                Quantity(float(samples[each.row]), each.unit, COMPARED_DIGITS, is_bare=True)
                for samples in (each.first, each.second)
            ),
        )
        for each in beyond
    ]
    return Table(("signal", "largest difference", "relative", "at, s", "first", "second"), rows)


def _within(signals: Sequence[SignalDifference], tolerance: float) -> str:
    count = "1 signal differs" if len(signals) == 1 else f"{len(signals)} signals differ"
    return (
        f"{count} by at most {signals[0].relative:.2g} of the largest magnitude, within the tolerance of {tolerance:g}"
    )


def _json(runs: RunDifferences) -> dict[str, object]:
    rows = [
        {
            "signal": each.name, "unit": each.unit, "difference": each.greatest, "relative": each.relative,
            "copy_of": each.copy_of, "time": float(runs.time[each.row]), "first": _known(each.first[each.row]),
            "second": _known(each.second[each.row]),
        }
        for each in runs.signals
    ]  # fmt: skip
    return {
        "first": runs.first.file,
        "second": runs.second.file,
        "samples": int(np.size(runs.time)),
        "resampled": runs.resampled,
        "signals": rows,
        "only_first": runs.only[0],
        "only_second": runs.only[1],
        "unlike_units": [list(each) for each in runs.unlike],
    }


def _known(sample: float) -> float | None:
    """Return a sample for JSON, with NaN as None."""
    return None if np.isnan(sample) else float(sample)


def _statements(runs: RunDifferences) -> list[str]:
    copies = sum(bool(each.differs and each.copy_of) for each in runs.signals)
    statements = [
        f"{which}: {run.file}{f' ({run.origin})' if run.origin else ''}"
        for which, run in (("first", runs.first), ("second", runs.second))
    ]
    statements += [
        f"{len(runs.signals)} signals in both, {copies} copies of others",
        f"{runs.time.size} samples from {number(float(runs.time[0]))} s to {number(float(runs.time[-1]))} s",
    ]
    if runs.resampled:
        statements.append("sample times differ: the second run is interpolated at those of the first")
    for which, names in zip(("first", "second"), runs.only, strict=True):
        if names:
            more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
            statements.append(f"only in the {which}: {', '.join(names[:NAMED])}{more}")
    return [*statements, *(f"not compared: {name} is in {unit} and in {other}" for name, unit, other in runs.unlike)]
