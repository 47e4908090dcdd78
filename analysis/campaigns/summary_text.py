"""Summaries for a terminal: rates, requirements, and relevant metrics, in lines of at most `WIDTH` columns."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ...common.errors import InputError, suggestion
from ...common.percent import percent
from .plain_text import align_columns, short
from .statistics import STATISTICS
from .summary import CONFIDENCE, Summary, SummaryRow, summary_rows
from .tables import group_cells, group_headings, requirement_lines

ALL = "all"
WIDTH = 100  # columns
LEFT_OUT = ("rms", "p99", "p5", "min", "std", "p50", "p95")  # omitted in this order if lines would be too long


def select_metrics(named: Sequence[str], known: Sequence[str], needed: Collection[str]) -> list[str]:
    """Return the metrics to print: the named ones, or all; by default those needed or, if none is needed, all.

    Raises InputError for an unknown name.
    """
    if ALL in named:
        return list(known)
    for name in named:
        if name not in known:
            raise InputError("`metrics`", name, "no such metric", f"{suggestion(name, known)}; or give {ALL}")
    return list(dict.fromkeys(named)) or [name for name in known if name in needed] or list(known)


def metric_lines(rows: Sequence[SummaryRow], metrics: Sequence[str], group: str | None) -> list[str]:
    """Return a line for each metric and row, with statistics over successful trials.

    Metrics with the same value in all trials share a line; statistics are omitted if lines would be too long.
    """
    same = {metric: number for metric in metrics if (number := _common_value(rows, metric)) is not None}
    varying = [metric for metric in metrics if metric not in same]
    notes = [f"the same in all successful trials: {', '.join(f'{each} {number:.4g}' for each, number in same.items())}"]
    lines, left_out = _fit_lines(rows, varying, group) if varying else ([], [])
    return [
        *lines,
        *([f"columns left out: {', '.join(left_out)}; `json` has all"] if left_out else []),
        *(notes if same else []),
    ]


def rate_lines(table: list[list[str]], first: int) -> list[str]:
    """Return rows of rates as lines; column ``first`` contains the number of trials, the next column success.

    If lines would be longer than `WIDTH`, columns that are equal in all rows become notes, and if necessary the last
    column as well, unless it is success.
    """
    columns, notes = list(range(len(table[0]))), []

    def lines() -> list[str]:
        return align_columns([[row[column] for column in columns] for row in table])

    for each in (first, *reversed(range(first + 2, len(table[0])))):
        if max(map(len, lines())) > WIDTH and len(table) > 2 and len({row[each] for row in table[1:]}) == 1:
            columns.remove(each)
            notes.append(f"the same in all rows: {table[0][each]} {table[1][each]}")
    if max(map(len, lines())) > WIDTH and columns[-1] > first + 1:
        last = columns.pop()
        notes += [f"{table[0][last]} of {', '.join(row[:first])}: {row[last]}" for row in table[1:]]
    return [*lines(), *notes]


def _fit_lines(rows: Sequence[SummaryRow], metrics: Sequence[str], group: str | None) -> tuple[list[str], list[str]]:
    """Return lines of at most `WIDTH` columns, and the statistics omitted for this purpose."""
    for count in range(len(LEFT_OUT) + 1):
        left_out = LEFT_OUT[:count]
        columns = [key for key in STATISTICS if key not in left_out]
        lines = align_columns(_cells(rows, metrics, group, columns))
        if max(map(len, lines)) <= WIDTH:
            break
    return lines, [key for key in STATISTICS if key in left_out]


def _cells(
    rows: Sequence[SummaryRow], metrics: Sequence[str], group: str | None, columns: Sequence[str]
) -> list[list[str]]:
    table = [["metric, successful trials", *group_headings(group), *columns, "unit"]]
    for metric in metrics:
        for row in rows:
            values = row.entry.metrics[metric]
            numbers = [short(values.value(key)) for key in columns]
            table.append([metric, *group_cells(row, group), *numbers, values.unit])
    return table


def _common_value(rows: Sequence[SummaryRow], metric: str) -> float | None:
    """Return the value that a metric has in all successful trials, if there are several, else None."""
    ends, several = set(), False
    for row in rows:
        values, successes = row.entry.metrics[metric], round(row.entry.success_rate * row.entry.trials)
        if values.count < successes:  # the other values are not finite
            return None
        several |= successes > 1
        ends |= {values.min, values.max} if successes else set()
    return ends.pop() if several and len(ends) == 1 else None


def summary_text(summary: Summary, group: str | None = None, metrics: Sequence[str] | None = None) -> str:
    """Return a summary for a terminal: success rates, requirements, and metrics of successful trials, also by group.

    ``metrics`` names the metrics to print; None stands for all.
    """
    rows = summary_rows(summary)
    rates = [[*group_headings(group), "trials", "success %", f"{100 * CONFIDENCE:g} % interval", "statuses"]]
    for row in rows:
        low, high = row.entry.success_interval
        statuses = ", ".join(f"{count} {status}" for status, count in row.entry.statuses.items())
        rate = percent(row.entry.success_rate)
        interval = f"{percent(low)} to {percent(high)}"
        rates.append([*group_cells(row, group), str(row.entry.trials), rate, interval, statuses])
    if metrics is None:
        metrics = list(dict.fromkeys(metric for variant in summary.values() for metric in variant.metrics))
    tables = [
        rate_lines(rates, len(group_headings(group))),
        requirement_lines(summary),
        metric_lines(rows, metrics, group),
    ]
    return "\n\n".join("\n".join(lines) for lines in tables if lines)
