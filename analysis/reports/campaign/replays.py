"""Trials that are worth flying again, and the command that does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from ...campaigns.fly.results import BatchResult
from ...campaigns.replay_command import replay_command, stored_replay
from ...campaigns.rows import TrialRows
from ...campaigns.spec.campaign import Variant
from ..common.page import exact
from ..common.quantities import shown_unit

FAILURES = 3  # of a variant, the first ones


@dataclass(frozen=True)
class Replay:
    """A trial of a variant, why it is worth a look, and the command line that flies it again."""

    variant: str
    trial: int
    reasons: list[Markup]
    command: str


def failures_to_replay(result: BatchResult) -> list[Replay]:
    """The first failures of each variant."""
    return _replays(result, _failures)


def extremes_to_replay(result: BatchResult) -> list[Replay]:
    """Where a metric of a variant is largest, each trial once."""
    return _replays(result, _extremes)


def _replays(result: BatchResult, choose: Callable[[BatchResult, str], list[tuple[int, Markup]]]) -> list[Replay]:
    found: list[Replay] = []
    for variant in result.plan.campaign.variants():
        own: dict[int, list[Markup]] = {}
        for trial, reason in choose(result, variant.name):
            own.setdefault(trial, []).append(reason)
        found += [
            Replay(variant.name, trial, reasons, command_of(result, variant, trial)) for trial, reasons in own.items()
        ]
    return found


def _failures(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    found: list[tuple[int, Markup]] = []
    for part in result.rows[variant].parts("trial", "success", "status"):
        for row in np.flatnonzero(~part["success"])[: FAILURES - len(found)]:
            found.append((int(part["trial"][row]), Markup("{}").format(part["status"][row])))
        if len(found) == FAILURES:
            break
    return found


def _extremes(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    """Where a metric is largest, unless several trials share that value."""
    found = []
    for metric in result.plan.campaign.metrics:
        most, where = _largest(result.rows[variant], f"metric.{metric.name}")
        if len(where) == 1:
            reason = Markup("{}: {} {}").format(metric.name, exact(most, metric.unit), shown_unit(metric.unit))
            found.append((where[0], reason))
    return found


def _largest(rows: TrialRows, column: str) -> tuple[float, list[int]]:
    """The largest value of a column, nan the least of all, and two at most of the trials that have it."""
    most, where = -np.inf, list[int]()
    for part in rows.parts("trial", column):
        values = np.where(np.isnan(part[column]), -np.inf, part[column])
        if values.max() > most:
            most, where = float(values.max()), []
        where += part["trial"][np.flatnonzero(values == most)[: 2 - len(where)]].tolist()
    return most, where


def command_of(result: BatchResult, variant: Variant, trial: int) -> str:
    """The command line that flies one trial of one variant again: of the campaign's folder, where it has one."""
    if result.folder is None:
        return replay_command(result.plan, variant, trial)
    return stored_replay(result.folder, result.rows, variant.name, trial)
