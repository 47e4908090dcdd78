"""Summaries as plain text for a terminal: rows of cells as aligned lines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..common.percent import percent
from .statistics import STATISTICS
from .summary import CONFIDENCE, SummaryRow, summary_rows


def aligned(rows: list[list[str]]) -> list[str]:
    """Rows of cells as lines, the first column to the left, the others to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        "  ".join(
            [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        )
        for row in rows
    ]


def assumption_lines(facts: Mapping[str, Any]) -> list[str]:
    """What a result's ``facts`` assume since an FMU does not declare it, a line for each assumption."""
    return [f"assumed: {assumption}" for assumption in facts.get("assumptions", ())]


def who_heads(group: str | None) -> list[str]:
    """Headings of `who_cells`; ``group`` is what trials are grouped by, if they are."""
    return ["variant"] if group is None else ["variant", group]


def who_cells(row: SummaryRow, group: str | None) -> list[str]:
    """A row's variant and, where trials are grouped, its group's value, or that it is all of them."""
    return [row.variant] if group is None else [row.variant, row.group or "all"]


def metric_lines(rows: Sequence[SummaryRow], metrics: Iterable[str], group: str | None) -> list[str]:
    """A line per metric and row: statistics over successful trials."""
    cells = [["metric, successful trials", *who_heads(group), *STATISTICS, "unit"]]
    for metric in metrics:
        for row in rows:
            found = row.entry["metrics"][metric]
            cells.append([metric, *who_cells(row, group), *(_cell(found[key]) for key in STATISTICS), found["unit"]])
    return aligned(cells) if len(cells) > 1 else []


def _cell(value: float | str | None) -> str:
    if value is None:
        return "-"
    return value if isinstance(value, str) else f"{value:.4g}"


def requirement_lines(summary: Mapping[str, Any]) -> list[str]:
    """A line per requirement and variant: what is required, the figures and the verdict; then tolerance bounds."""
    head = ["requirement", "variant", "flights", "failures", "risk %", "verdict", "more for 0, 1, 2 failures"]
    cells, bounds = [head], []
    for variant, name, found in requirement_rows(summary):
        risk = percent(found["consumer_risk"])
        more = ", ".join("-" if number is None else str(number) for number in found["flights_to_decide"].values())
        text, flights = f"{name}: {found['text']}", str(found["flights"])
        cells.append([text, variant, flights, str(found["failures"]), risk, found["verdict"], more])
        if found["bound"] is not None:
            unit = summary[variant]["metrics"][found["bound"]["metric"]]["unit"]
            value = f"{_cell(found['bound']['value'])} {'' if unit == '1' else unit}".strip()
            bounds.append(f"{variant}: {bound_text(found, value)}")
    return [*aligned(cells), *bounds] if len(cells) > 1 else []


def requirement_rows(summary: Mapping[str, Any]) -> list[tuple[str, str, dict[str, Any]]]:
    """Variant, name and verdict of every requirement of every variant, those of one requirement together."""
    names = dict.fromkeys(name for variant in summary.values() for name in variant.get("requirements", {}))
    return [(variant, name, entry["requirements"][name]) for name in names for variant, entry in summary.items()]


def bound_text(found: Mapping[str, Any], value: str) -> str:
    """The tolerance bound of a requirement in words, with its ``value`` as it is shown."""
    bound = found["bound"]
    share = f"{100 * found['share']:.10g} % of flights at {100 * found['confidence']:.10g} %"
    if bound["rank"] is None:
        more = f"a campaign longer by {bound['flights_to_decide']} has one"
        return f"no {bound['side']} bound of {bound['metric']} in {share}: {more}"
    rank = "the worst" if bound["rank"] == 1 else f"the worst but {bound['rank'] - 1}"
    sign = "<=" if bound["side"] == "upper" else ">="
    return f"{bound['metric']} {sign} {value} in {share}: {rank} of {bound['flights']} flights"


def faults_line(faults: Iterable[object]) -> str:
    """What results say of the faults that flew."""
    return f"with faults: {'; '.join(map(str, faults))}"


def summary_text(summary: Mapping[str, Any], group: str | None = None) -> str:
    """A summary for the terminal: success rates, requirements, then metrics of successful trials, of groups too."""
    rows = summary_rows(summary)
    rates = [[*who_heads(group), "trials", "success %", f"{100 * CONFIDENCE:g} % interval", "statuses"]]
    for row in rows:
        low, high = row.entry["success_interval"]
        statuses = ", ".join(f"{count} {status}" for status, count in row.entry["statuses"].items())
        rate = percent(row.entry["success_rate"])
        interval = f"{percent(low)} to {percent(high)}"
        rates.append([*who_cells(row, group), str(row.entry["trials"]), rate, interval, statuses])
    metrics = dict.fromkeys(metric for variant in summary.values() for metric in variant["metrics"])
    found = metric_lines(rows, metrics, group)
    required = requirement_lines(summary)
    return "\n".join([*aligned(rates), *(["", *required] if required else []), *(["", *found] if found else [])])
