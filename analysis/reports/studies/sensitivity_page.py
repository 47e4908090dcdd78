"""The page of a sensitivity study: which dispersed parameters drive which metrics, and under which conditions."""

from __future__ import annotations

from pathlib import Path

from ...studies.sensitivity import SensitivityResult
from ...studies.sobol import CONFIDENCE
from ..common.page import write_page
from ..common.tables import Table, fraction, fractions
from .conditions import conditions_of
from .sensitivity_figures import MOST, bars_of, index_panels

WIDE = 0.3  # of an interval of a total index, from which on a larger base is advised


def write_sensitivity_page(result: SensitivityResult, path: Path, folder: Path | None = None) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``folder`` is where the result has been written, if it has: the page says how its flights are flown again.
    """
    conditions = conditions_of(result)
    replay = result.replay(folder, 0)
    write_page(
        path,
        Path(__file__).with_name("sensitivity.html"),
        title=f"{conditions.system}: sensitivity",
        result=result,
        conditions=conditions,
        percent=f"{100 * CONFIDENCE:g} %",
        drivers=driver_table(result),
        panels=index_panels(result),
        most=MOST,
        tables=[(metric, index_table(result, metric)) for metric in result.told],
        ranks=rank_table(result),
        wide=wide_metrics(result),
        wide_from=WIDE,
        replays=[("the first simulation", replay)] if replay else [],
    )


def driver_table(result: SensitivityResult) -> Table:
    """A row per metric: its parameter with the largest total index, and the sum of first-order indices."""
    rows = []
    for metric in result.told:
        bars = bars_of(result, metric)
        first = sum(bar.first for bar in bars)
        rows.append(
            (metric, bars[0].name, fraction(bars[0].total), fractions(*bars[0].total_interval), fraction(first))
        )
    heads = ("metric", "largest total index", "total", f"{100 * CONFIDENCE:g} % interval", "sum of first order")
    return Table(heads, rows, (2, 3, 4))


def index_table(result: SensitivityResult, metric: str) -> Table:
    """A row per parameter with the indices of one metric, by total index."""
    rows = [
        (
            bar.name,
            fraction(bar.total),
            fractions(*bar.total_interval),
            fraction(bar.first),
            fractions(*bar.first_interval),
            fraction(bar.rank),
        )
        for bar in bars_of(result, metric)
    ]
    percent = f"{100 * CONFIDENCE:g} %"
    return Table(("parameter", "total", percent, "first order", percent, "rank correlation"), rows, range(1, 6))


def rank_table(result: SensitivityResult) -> Table:
    """Rank correlations, a row per metric and a column per parameter."""
    names = result.space.names
    rows = [(metric, *(fraction(ranks[name]) for name in names)) for metric, ranks in result.ranks.items()]
    return Table(("metric", *names), rows, range(1, 1 + len(names)))


def wide_metrics(result: SensitivityResult) -> list[str]:
    """Metrics whose largest total index has an interval wider than `WIDE`."""
    metrics = []
    for metric in result.told:
        low, high = bars_of(result, metric)[0].total_interval
        if high - low > WIDE:
            metrics.append(metric)
    return metrics
