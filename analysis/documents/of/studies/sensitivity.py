"""Document of a sensitivity study: the dispersed parameters that drive each metric, and the conditions."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from ....studies.sensitivity import SensitivityOutcome
from ....studies.sobol import CONFIDENCE
from ...cell import Cell, Interval, Quantity
from ...common.quantities import label_with_unit, number
from ...model import Document, Fold, KeyNumbers, Node, Note, Section, Table, Text, Verdict
from ...pictures import Figures
from .conditions import closing_sections, condition_nodes, condition_of
from .sensitivity_figures import MOST, bars_of, index_figures

WIDE = 0.3  # width of a total index's interval from which a larger base is recommended
OPEN = 3  # largest number of tables that a page does not fold
DECIMALS = 3  # decimals of indices and correlations
PERCENT = f"{100 * CONFIDENCE:g} %"


def sensitivity_document(study: SensitivityOutcome, folder: Path | None = None) -> Document:
    """Return the document of a sensitivity study; ``folder`` is the folder that stores it, if any."""
    condition = condition_of(study)
    count = len(study.with_indices) + len(study.without_indices)
    noise = "random; all of these components are one input, the noise realisation"
    replay = study.replay(folder, 0)
    verdict = Verdict(
        f"Sobol' indices of {len(study.with_indices)} of {count} numbers (metrics and success), "
        f"by {study.flights} simulations{study.conditions}",
        condition_nodes(study, noise),
    )
    numbers = KeyNumbers(
        [
            ("simulations", study.flights),
            ("base", study.base),
            ("inputs", len(study.inputs)),
            ("intervals", f"{PERCENT}, bootstrap"),
        ]
    )
    sections = [
        Section("Largest influence on each metric", _drivers(study), condition),
        *([Section("Total and first-order indices", _indices(study), condition)] if study.with_indices else []),
        Section("Rank correlations", [rank_table(study), Note(_on_ranks(study))], condition),
        *closing_sections(study, [("the first simulation", replay)] if replay else []),
    ]
    title = f"{study.facts['system']}: sensitivity"
    return Document(title, [verdict, numbers], sections, study.json_document(folder))


def _drivers(study: SensitivityOutcome) -> list[Node]:
    wide = [metric for metric in study.with_indices if np.ptp(bars_of(study, metric)[0].total_interval) > WIDE]
    advice = f"A base of {2 * study.base} or more narrows them."
    table: list[Node] = [
        driver_table(study),
        Note(
            "First order: the fraction of a metric's variance caused by a parameter alone. Total: the fraction that "
            "would remain if all others were known. A sum of first-order indices well below 1: parameters act "
            "together. They are estimates, which scatter below 0 and above 1, too."
        ),
        *([Note(f"Intervals wider than {WIDE}: {', '.join(wide)}. {advice}")] if wide else []),
    ]
    without = [Text(f"{name}: no indices, {why}") for name, why in study.without_indices.items()]
    return [*(table if study.with_indices else [Text("no metric has indices")]), *without]


def driver_table(study: SensitivityOutcome) -> Table:
    """Return a row for each metric: the parameter with the largest total index, and the sum of first-order indices."""
    rows: list[tuple[Cell, ...]] = []
    for metric in study.with_indices:
        bars = bars_of(study, metric)
        first = sum(bar.first for bar in bars)
        total, ends = bars[0].total, bars[0].total_interval
        rows.append((metric, bars[0].name, _index(total), _interval(ends), _index(first)))
    heads = ("metric", "largest total index", "total", f"{PERCENT} interval", "sum of first order")
    return Table(heads, rows, len(rows))


def _indices(study: SensitivityOutcome) -> list[Node]:
    is_open = len(study.with_indices) <= OPEN
    return [
        Figures(partial(index_figures, study, study.with_indices)),
        Note(
            f"Bars: indices, total above first order; lines: {PERCENT} intervals of the bootstrap over the rows of the "
            f"plan. At most {MOST} parameters of a metric are drawn, those with the largest total index; the tables "
            "have all."
        ),
        *(
            Fold(
                label_with_unit(metric, study.units.get(metric)), [index_table(study, metric)], is_open, is_listed=True
            )
            for metric in study.with_indices
        ),
    ]


def index_table(study: SensitivityOutcome, metric: str) -> Table:
    """Return a row for each parameter with the indices of one metric, ordered by total index."""
    rows = [
        (
            bar.name,
            _index(bar.total),
            _interval(bar.total_interval),
            _index(bar.first),
            _interval(bar.first_interval),
            _index(bar.rank),
        )
        for bar in bars_of(study, metric)
    ]
    return Table(("parameter", "total", PERCENT, "first order", PERCENT, "rank correlation"), rows, len(rows))


def _index(index: float | None) -> Quantity:
    """Return an index or a correlation as a cell."""
    return Quantity(index, decimals=DECIMALS)


def _interval(ends: tuple[float, float]) -> Interval:
    low, high = ends
    return Interval(_index(low), _index(high))


def rank_table(study: SensitivityOutcome) -> Table:
    """Return rank correlations, a row for each metric and a column for each parameter."""
    names = study.space.names
    rows: list[tuple[Cell, ...]] = [
        (metric, *(_index(ranks[name]) for name in names)) for metric, ranks in study.ranks.items()
    ]
    return Table(("metric", *names), rows, len(rows))


def _on_ranks(study: SensitivityOutcome) -> str:
    count = 2 * study.base
    noise = " Noise realisations have no order and no rank." if study.noise.sources else ""
    return (
        f"Spearman's, over the {count} independent simulations of the plan. They measure monotonic dependence "
        f"only; correlations around {number(2.0 / count**0.5, 2)} and below are not significant "
        f"(5 %).{noise}"
    )
