"""Trials to inspect, with reasons and the commands that replay them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ....campaigns.definition.campaign import Metric
from ...cell import Cell, CommandLine, Lines, Phrase, Quantity, Row
from ...model import Table
from .verdict_table import JudgedMetric, VerdictRow

FAILURES = 3  # first failures listed for each variant


@dataclass(frozen=True)
class Replay:
    """A trial of a variant, the reasons to replay it, and the command."""

    variant: str
    trial: int
    reasons: Sequence[Cell]
    command: str
    anchor: str = ""


def with_anchors(replays: Sequence[Replay]) -> list[Replay]:
    """Return the rows, each with a unique anchor."""
    return [replace(each, anchor=f"replay-{number}") for number, each in enumerate(replays)]


def anchors_of(replays: Iterable[Replay]) -> dict[tuple[str, int], str]:
    """Return the anchors of rows by variant and trial."""
    return {(each.variant, each.trial): each.anchor for each in replays}


def worst_reasons(row: VerdictRow, metrics: Sequence[JudgedMetric]) -> list[tuple[int, Cell]]:
    """Return the worst trials of a variant, each with the metric and its value."""
    return [
        (cell.trial, value_reason(judged.metric, cell.worst, "worst "))
        for judged, cell in zip(metrics, row.numbers, strict=True)
        if cell.trial is not None
    ]


def value_reason(metric: Metric, value: float | None, which: str = "") -> Cell:
    """Return the text of a metric and its value in a trial, with the prefix ``which``, such as "worst "."""
    return Phrase([f"{which}{metric.name}: ", Quantity(value, metric.unit)])


def replay_table(replays: Sequence[Replay], reason: str) -> Table:
    """Return a row for each trial; ``reason`` is the heading of the column of reasons."""
    rows = [Row((each.variant, each.trial, Lines(each.reasons), CommandLine(each.command)), each.anchor)
            for each in replays]  # fmt: skip
    return Table(("variant", "trial", reason, "command"), rows, len(rows), style="replays", is_grouped=True)
