"""Commands that replay single trials: the first failures, and those with the maximum of a metric."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from ...campaigns.fly.results import BatchResult
from ...campaigns.replay_command import replay_command, replay_of_folder
from ...campaigns.spec.campaign import Variant
from ...campaigns.trials import TrialRows
from ..common.page import exact
from ..common.quantities import display_unit

FAILURES = 3  # of a variant, the first ones


@dataclass(frozen=True)
class Replay:
    """A trial of a variant, the reasons to replay it, and the command that does."""

    variant: str
    trial: int
    reasons: list[Markup]
    command: str


def failures_to_replay(result: BatchResult) -> list[Replay]:
    """The first failures of each variant."""
    return _replays(result, _failures)


def extremes_to_replay(result: BatchResult) -> list[Replay]:
    """The trials with the maximum of a metric of a variant, each once."""
    return _replays(result, _extremes)


def _replays(result: BatchResult, choose: Callable[[BatchResult, str], list[tuple[int, Markup]]]) -> list[Replay]:
    replays: list[Replay] = []
    for variant in result.plan.campaign.variants():
        reasons: dict[int, list[Markup]] = {}
        for trial, reason in choose(result, variant.name):
            reasons.setdefault(trial, []).append(reason)
        replays += [
            Replay(variant.name, trial, texts, replay_of(result, variant, trial)) for trial, texts in reasons.items()
        ]
    return replays


def _failures(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    failures: list[tuple[int, Markup]] = []
    for part in result.rows[variant].parts("trial", "success", "status"):
        for row in np.flatnonzero(~part["success"])[: FAILURES - len(failures)]:
            failures.append((int(part["trial"][row]), Markup("{}").format(part["status"][row])))
        if len(failures) == FAILURES:
            break
    return failures


def _extremes(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    """The trial with the maximum of each metric, unless several trials have it."""
    extremes = []
    for metric in result.plan.campaign.metrics:
        maximum, trials = _maximum(result.rows[variant], f"metric.{metric.name}")
        if len(trials) == 1:
            reason = Markup("{}: {} {}").format(metric.name, exact(maximum, metric.unit), display_unit(metric.unit))
            extremes.append((trials[0], reason))
    return extremes


def _maximum(rows: TrialRows, column: str) -> tuple[float, list[int]]:
    """The maximum of a column, nan counting as minus infinity, and up to two of the trials that have it."""
    maximum, trials = -np.inf, list[int]()
    for part in rows.parts("trial", column):
        values = np.where(np.isnan(part[column]), -np.inf, part[column])
        if values.max() > maximum:
            maximum, trials = float(values.max()), []
        trials += part["trial"][np.flatnonzero(values == maximum)[: 2 - len(trials)]].tolist()
    return maximum, trials


def replay_of(result: BatchResult, variant: Variant, trial: int) -> str:
    """The command that replays one trial of one variant, from the campaign's folder if it has one."""
    if result.folder is None:
        return replay_command(result.plan, variant, trial)
    return replay_of_folder(result.folder, result.rows, variant.name, trial)
