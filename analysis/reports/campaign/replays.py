"""Trials that are worth flying again, and the command that does."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePosixPath

import numpy as np
from markupsafe import Markup

from ...campaigns.fly.replay import stored_replay
from ...campaigns.fly.results import BatchResult
from ...campaigns.rows import TrialRows
from ...campaigns.spec.campaign import Variant
from ...campaigns.spec.plan import BatchPlan
from ...runtime.system.options import SystemOptions
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


def replay_command(plan: BatchPlan, variant: Variant, trial: int) -> str:
    """The command line that flies one trial of one variant again, with the options of the batch."""
    campaign, options = plan.campaign, plan.options
    inside = campaign.file.partition("!")[2]  # of a system's own campaign
    words = ["perilune", "batch", plan.system, "--campaign", PurePosixPath(inside).stem if inside else campaign.file]
    words += ["--trials", str(campaign.trials)] if plan.given is None else ["--draws", plan.given.file]
    words += ["--seed", str(campaign.seed)]
    words += [word for name, fmu in variant.use.items() for word in ("--compare", f"{name}={fmu}")]
    words += [word for name, text in campaign.sweeps.items() for word in ("--set", f"{name}={text}")]
    words += [word for option, text in _options(options) for word in (option, text)]
    words += [word for fault in plan.faults for word in ("--fault", str(fault))]
    words += ["--input", plan.series.file] if plan.series is not None and plan.series.lines else []
    words += ["--allow-unmatched"] if options.allow_unmatched else []
    words += ["--strict"] if options.strict else []
    return shlex.join([*words, "--replay", str(trial)])


def _options(options: SystemOptions) -> list[tuple[str, str]]:
    """What the user asked of the system, as options with their values; nothing that is so anyway."""
    found = [("--use", f"{slot}={fmu}") for slot, fmu in options.use.items()]
    found += [("--parameters", name) for name in options.parameters]
    found += [
        ("--set", f"{name}={str(value).lower() if isinstance(value, bool) else value}")
        for name, value in options.set.items()
    ]
    found += [("--feedthrough", component) for component in options.feedthrough]
    found += [("--no-feedthrough", component) for component in options.no_feedthrough]
    single = {
        "--step": None if options.step is None else repr(options.step),
        "--stop-time": None if options.stop_time is None else repr(options.stop_time),
        "--variant": options.variant,
        "--flavour": options.flavour,
        "--algorithm": options.algorithm,
        "--open-inputs": options.open_inputs if options.open_inputs != SystemOptions.open_inputs else None,
    }
    return found + [(option, value) for option, value in single.items() if value is not None]
